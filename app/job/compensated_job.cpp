#include "app/job/compensated_job.hpp"

#include <fmt/format.h>

#include "app/job/machine_files.hpp"
#include "app/job/named_files.hpp"
#include "core/toml_document.hpp"
#include "core/toml_edit.hpp"

namespace frustum::app {

namespace fs = std::filesystem;

Result<std::string> compensated_job(const Job& job, const programs::TestPiece& made,
                                    const std::string& plan, const fs::path& folder) {
  const auto document = TomlDocument::parse(job.text, job.file);
  if (!document) return document.error();
  const TomlTable& root = document->root();
  TomlChanges changes;
  const auto replace = [&changes](std::string key, std::string value) {
    changes.replaced.emplace_back(std::move(key), std::move(value));
  };
  replace("title", toml_text(made.title));
  replace("machine", toml_text(name_for_job(job.machine_file, folder)));
  replace("program.file", toml_text(made.program_file));
  const std::string dialect = toml_text(parser::name_of(made.dialect));
  if (root.table("program").has("dialect")) {
    replace("program.dialect", dialect);
  } else {
    changes.added.push_back({"program.file", "dialect", dialect});
  }
  for (std::size_t i = 0; i < made.operations.size(); ++i) {
    const programs::Operation& operation = made.operations[i];
    replace(fmt::format("operation[{}].lines", i),
            fmt::format("[{}, {}]", operation.first_line, operation.last_line));
  }
  if (!job.plan_file.empty()) replace("inspection.plan", toml_text(plan));
  const auto files = files_named_in(job.text, job.file);
  if (!files) return files.error();
  for (const NamedFile& each : *files) {
    if (each.key.starts_with("errors.") || fs::path(each.written).is_absolute()) continue;
    replace(each.key, toml_text(path_from(each.file, folder)));
  }
  changes.emptied.emplace_back("errors");
  auto text = changed_toml(job.text, changes);
  if (text) return text;
  Diagnostics problems = std::move(text).error();
  for (Diagnostic& d : problems) d.file = job.file.string();
  return problems;
}

}  // namespace frustum::app

#include "app/job/job_evidence.hpp"

#include <algorithm>
#include <filesystem>
#include <system_error>
#include <utility>

#include "app/job/named_files.hpp"
#include "core/whole_file.hpp"
#include "report/measuring_statement.hpp"

namespace frustum::app {
namespace {

namespace fs = std::filesystem;

void put_once(std::vector<report::HashedFile>& files, report::HashedFile file) {
  const bool known = std::ranges::any_of(files, [&](const report::HashedFile& other) {
    return other.role == file.role && other.name == file.name && other.sha256 == file.sha256;
  });
  if (!known) files.push_back(std::move(file));
}

// A pipe or a device, which can be read only once.
bool is_stream(const fs::path& file) {
  std::error_code unknown;
  return fs::exists(file, unknown) && !fs::is_regular_file(file, unknown) &&
         !fs::is_directory(file, unknown);
}

class FileHashes {
 public:
  explicit FileHashes(std::vector<report::HashedFile>& files) : files_(files) {}

  // A document, and what it names in turn.
  void add(const std::string& role, const fs::path& file) {
    note(add_hash(files_, role, file));
    if (file.extension() != ".toml" || is_stream(file)) return;
    if (const auto text = read_whole_file(file)) add_named(*text, file);
  }
  void add_named(std::string_view text, const fs::path& document) {
    const auto named = files_named_in(text, document);
    if (!named) return note(named.error());
    for (const NamedFile& each : *named) add(each.role, each.file);
  }
  void note(const Diagnostics& found) {
    problems_.insert(problems_.end(), found.begin(), found.end());
  }
  [[nodiscard]] const Diagnostics& problems() const { return problems_; }

 private:
  std::vector<report::HashedFile>& files_;
  Diagnostics problems_{};
};

}  // namespace

Diagnostics add_hash(std::vector<report::HashedFile>& files, const std::string& role,
                     const fs::path& file) {
  if (is_stream(file)) {
    put_once(files, {role, file.filename().string(), ""});
    return {};
  }
  std::error_code unknown;
  if (!fs::is_regular_file(file, unknown)) return {};
  const auto bytes = read_whole_file(file);
  if (!bytes) return bytes.error();
  put_once(files, report::hashed_file(role, file.string(), *bytes));
  return {};
}

Diagnostics add_named_hashes(std::vector<report::HashedFile>& files, std::string_view text,
                             const fs::path& document) {
  FileHashes hashes(files);
  hashes.add_named(text, document);
  return hashes.problems();
}

Result<report::Evidence> evidence_of(const Job& job) {
  report::Evidence evidence;
  evidence.header = job.piece.plan.header;
  evidence.measuring =
      report::measuring_statement(job.piece.plan, job.cmm, report::PointSource::virtual_cmm);
  if (job.draw) evidence.error_draw = {job.draw->seed, job.draw->index};
  std::vector<report::HashedFile>& files = evidence.files;
  files.push_back(report::hashed_file("program", job.piece.program_file, job.piece.program));
  FileHashes hashes(files);
  if (!job.plan_file.empty()) {
    files.push_back(report::hashed_file("plan", job.plan_file.string(), job.plan_text));
  }
  files.push_back(report::hashed_file("job", job.file.string(), job.text));
  hashes.add("machine", job.machine_file);
  hashes.add_named(job.text, job.file);
  for (const fs::path& file : job.error_files) hashes.add("errors", file);
  if (!hashes.problems().empty()) return hashes.problems();
  return evidence;
}

void add_subprograms(report::Evidence& evidence, const trials::Trial& trial) {
  const auto program = std::ranges::find(evidence.files, "program", &report::HashedFile::role);
  auto at = program == evidence.files.end() ? program : std::next(program);
  for (const trials::ProgramFile& file : trial.program_files) {
    at = std::next(evidence.files.insert(
        at, {"subprogram", fs::path(file.name).filename().string(), file.sha256}));
  }
}

}  // namespace frustum::app

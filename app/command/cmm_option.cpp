#include "app/command/cmm_option.hpp"

#include <fmt/format.h>

#include <cmath>

#include "app/command/command_line.hpp"
#include "app/job/job.hpp"
#include "core/toml_document.hpp"
#include "core/units.hpp"

namespace frustum::app {
namespace {

using metrology::CmmModel;

Result<CmmModel> cmm_of_job(const std::string& file, const TomlTable& inspection) {
  if (!inspection.has("cmm")) {
    Diagnostic d =
        error("no-cmm"_id, "the job states no CMM", "add [inspection.cmm] with e0 and l_per_um");
    d.file = file;
    d.key = "inspection.cmm";
    return d;
  }
  const auto job = load_job(file, {}, false);
  if (!job) return job.error();
  return job->cmm;
}

Result<CmmModel> cmm_of_file(const std::string& file) {
  const auto document = TomlDocument::load(file);
  if (!document) return document.error();
  const TomlTable& root = document->root();
  if (root.is_table("inspection")) return cmm_of_job(file, root.table("inspection"));
  const CmmModel cmm = metrology::read_cmm_model(root);
  if (Diagnostics found = document->finish(); has_error(found)) return found;
  return cmm;
}

}  // namespace

void add_cmm_options(Command& command, CmmWords& words) {
  command.option("--e0", words.e0,
                 "Of the machine that measures: E = e0 + L/k as a length (\"1.8 um\")");
  command.option("--l-per-um", words.l_per_um, "k, mm of length per um of error")
      .holds(positive_number());
  command.option("--cmm", words.file,
                 "TOML file with the keys of a job's inspection.cmm, or a job that has them");
}

Result<CmmModel> cmm_of(const CmmWords& words) {
  CmmModel cmm;
  if (!words.file.empty()) {
    if (words.e0.empty() && !words.l_per_um) return cmm_of_file(words.file);
    return error("conflicting-options"_id, "--cmm together with --e0 or --l-per-um",
                 "state the accuracy once");
  }
  if (!words.e0.empty()) {
    const auto e0 = parse_length(words.e0);
    if (!e0) return e0.error();
    if (!(e0->value >= 0.0) || !std::isfinite(e0->value)) {
      return error("out-of-range"_id, fmt::format("--e0 {}: must be 0 or more", words.e0),
                   "for example \"1.8 um\"");
    }
    cmm.e0_mm = e0->value;
  }
  cmm.length_per_error = words.l_per_um;
  return cmm;
}

}  // namespace frustum::app

// The files that a user asks results to be written to, beside the report: --export and [output]
// export.
//
// Units: none. Errors: an extension that names no format, a place that cannot be written to:
// reported before the work begins.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "core/file_set.hpp"
#include "core/result.hpp"
#include "core/toml_document.hpp"
#include "metrology/plan/inspection_plan.hpp"
#include "report/run_report.hpp"

namespace frustum::app {

// The files of `export` in the [output] table, relative to the job; mistakes are noted at the key.
[[nodiscard]] std::vector<std::filesystem::path> read_exports(const TomlTable& output);

// Those of the command line and of the job together, or why they cannot be written.
[[nodiscard]] Result<std::vector<std::filesystem::path>> checked_exports(
    const std::vector<std::string>& written, const std::vector<std::filesystem::path>& of_job = {});

// Writes them all; their names go into the report. Those in the folder of `set` are added to it.
[[nodiscard]] Diagnostics write_exports(const std::vector<std::filesystem::path>& files,
                                        report::RunReport& report,
                                        const metrology::InspectionPlan& plan,
                                        FileSet* set = nullptr);

// A measurement that could not be made is still reported to continuous integration: in each JUnit
// file every characteristic becomes an error with the reason. The other formats have nothing to
// say.
void write_failed_exports(const std::vector<std::filesystem::path>& files,
                          const Diagnostics& reason, const metrology::InspectionPlan& plan);

}  // namespace frustum::app

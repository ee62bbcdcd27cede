// The report of a run as one HTML page that opens without a network: tables and charts in
// plain HTML and SVG, which print; the embedded script only turns the workpiece.
//
// Units: as printed beside each number. Errors: writing: a diagnostic that names the file.
#pragma once

#include <filesystem>
#include <string>

#include "core/result.hpp"
#include "report/run_report.hpp"

namespace frustum::report {

[[nodiscard]] std::string html_report(const RunReport& report);

// Writes the page; the folder must exist. Returns the path.
[[nodiscard]] Result<std::filesystem::path> write_html_report(const std::filesystem::path& path,
                                                              const RunReport& report);

}  // namespace frustum::report

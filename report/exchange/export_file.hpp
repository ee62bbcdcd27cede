// A measurement in the format that a file's extension names.
//
// .qif (QIF 3.0), .csv, .json, .xml and .junit.xml (JUnit), .dfq (Q-DAS), .dmo (DMIS output), .dxf
// (points and sections in space), .svg (charts); upper or lower case.
// Units: as each format says. Errors: an extension that names no format, with those known; a place
// that cannot be written to.
#pragma once

#include <filesystem>
#include <string>

#include "core/result.hpp"
#include "metrology/plan/inspection_plan.hpp"
#include "report/run_report.hpp"

namespace frustum::report {

enum class ExportFormat { qif, csv, json, junit, dfq, dmis, dxf, svg };

[[nodiscard]] Result<ExportFormat> export_format(const std::filesystem::path& file);
// Why the file could not be written, found out before the long work. Folders that are not there yet
// are no reason.
[[nodiscard]] Diagnostics export_faults(const std::filesystem::path& file);

[[nodiscard]] std::string exported(ExportFormat format, const RunReport& report,
                                   const metrology::InspectionPlan& plan);

}  // namespace frustum::report

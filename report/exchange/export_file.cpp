#include "report/exchange/export_file.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <array>
#include <cctype>

#include "core/whole_file.hpp"
#include "report/exchange/characteristics_csv.hpp"
#include "report/exchange/charts_svg.hpp"
#include "report/exchange/dfq_report.hpp"
#include "report/exchange/dmis_report.hpp"
#include "report/exchange/json_report.hpp"
#include "report/exchange/junit_report.hpp"
#include "report/exchange/qif_results.hpp"
#include "report/exchange/sections_dxf.hpp"

namespace frustum::report {
namespace {

namespace fs = std::filesystem;

struct FormatRow {
  std::string_view extension;
  ExportFormat format;
};
constexpr std::array kFormats{
    FormatRow{".qif", ExportFormat::qif},   FormatRow{".csv", ExportFormat::csv},
    FormatRow{".json", ExportFormat::json}, FormatRow{".xml", ExportFormat::junit},
    FormatRow{".dfq", ExportFormat::dfq},   FormatRow{".dmo", ExportFormat::dmis},
    FormatRow{".dxf", ExportFormat::dxf},   FormatRow{".svg", ExportFormat::svg}};

std::string lower_extension(const fs::path& file) {
  std::string extension = file.extension().string();
  for (char& c : extension) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  return extension;
}

// The folder that the file, or folders on the way to it, would be made in.
fs::path existing_ancestor(const fs::path& file) {
  std::error_code ignored;
  fs::path folder = file.parent_path();
  while (!folder.empty() && !fs::exists(folder, ignored)) folder = folder.parent_path();
  return folder.empty() ? fs::path(".") : folder;
}

}  // namespace

Result<ExportFormat> export_format(const fs::path& file) {
  const std::string extension = lower_extension(file);
  std::string known;
  for (const FormatRow& row : kFormats) {
    if (row.extension == extension) return row.format;
    known += fmt::format("{}{}", known.empty() ? "" : " ", row.extension);
  }
  return error("unknown-format"_id,
               fmt::format("{}: '{}' names no format of results", file.string(), extension),
               "known: " + known + " (.xml is JUnit)");
}

Diagnostics export_faults(const fs::path& file) {
  const auto format = export_format(file);
  if (!format) return format.error();
  std::error_code ignored;
  if (fs::is_directory(file, ignored)) return {cannot_write(file, "it is a folder")};
  const fs::path folder = existing_ancestor(file);
  if (!fs::is_directory(folder, ignored)) {
    return {cannot_write(file, fmt::format("{} is not a folder", folder.string()))};
  }
  if (access(folder.c_str(), W_OK) != 0) {
    return {cannot_write(file, fmt::format("{} may not be written to", folder.string()))};
  }
  return {};
}

std::string exported(ExportFormat format, const RunReport& report,
                     const metrology::InspectionPlan& plan) {
  switch (format) {
    case ExportFormat::qif:
      return qif_results(report, plan);
    case ExportFormat::csv:
      return characteristics_csv(report.measurement, plan);
    case ExportFormat::json:
      return json_report(report);
    case ExportFormat::junit:
      return junit_report(report, plan);
    case ExportFormat::dfq:
      return dfq_report(report);
    case ExportFormat::dmis:
      return dmis_report(report, plan);
    case ExportFormat::dxf:
      return sections_dxf(report.measurement);
    case ExportFormat::svg:
      return charts_svg(report);
  }
  return {};
}

}  // namespace frustum::report

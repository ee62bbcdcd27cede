#include "app/job/export_request.hpp"

#include <fmt/format.h>

#include <iostream>
#include <system_error>

#include "core/files_read.hpp"
#include "core/whole_file.hpp"
#include "report/exchange/export_file.hpp"

namespace frustum::app {

namespace fs = std::filesystem;

namespace {

// Folders on the way are made.
Result<fs::path> write_file(const fs::path& file, const std::string& bytes) {
  if (file.has_parent_path()) {
    std::error_code failure;
    fs::create_directories(file.parent_path(), failure);
    if (failure) return cannot_write(file, failure.message());
  }
  return write_whole_file(file, bytes);
}

}  // namespace

std::vector<fs::path> read_exports(const TomlTable& output) {
  std::vector<fs::path> files;
  for (const std::string& name : output.texts_or("export", {})) {
    files.push_back(output.folder() / name);
    const Diagnostics faults = report::export_faults(files.back());
    if (!faults.empty()) output.fail("export", faults.front());
  }
  return files;
}

Result<std::vector<fs::path>> checked_exports(const std::vector<std::string>& written,
                                              const std::vector<fs::path>& of_job) {
  std::vector<fs::path> files = of_job;
  Diagnostics problems;
  for (const std::string& name : written) {
    files.emplace_back(name);
    const Diagnostics faults = report::export_faults(files.back());
    problems.insert(problems.end(), faults.begin(), faults.end());
  }
  for (const fs::path& file : files) {
    if (auto lost = would_be_lost(file)) problems.push_back(*std::move(lost));
  }
  if (!problems.empty()) return problems;
  return files;
}

Diagnostics write_exports(const std::vector<fs::path>& files, report::RunReport& report,
                          const metrology::InspectionPlan& plan, FileSet* set) {
  for (const fs::path& file : files) {
    const auto format = report::export_format(file);
    if (!format) return format.error();
    if (const auto name = set == nullptr ? std::nullopt : set->name_of(file)) {
      if (set->has(*name)) {
        return {error("output-twice"_id,
                      fmt::format("--export {}: this run writes that file already", file.string()),
                      "choose another name")};
      }
      set->add(*name, report::exported(*format, report, plan));
      report.files.push_back(file.string());
      continue;
    }
    const auto written = write_file(file, report::exported(*format, report, plan));
    if (!written) return written.error();
    report.files.push_back(file.string());
  }
  return {};
}

void write_failed_exports(const std::vector<fs::path>& files, const Diagnostics& reason,
                          const metrology::InspectionPlan& plan) {
  report::RunReport failed;
  failed.title = plan.title;
  failed.diagnostics = reason;
  for (const fs::path& file : files) {
    const auto format = report::export_format(file);
    if (!format || *format != report::ExportFormat::junit) continue;
    const auto written = write_file(file, report::exported(*format, failed, plan));
    if (!written) print(std::cerr, written.error());
  }
}

}  // namespace frustum::app

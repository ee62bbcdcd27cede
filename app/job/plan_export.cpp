#include "app/job/plan_export.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <string>
#include <system_error>

#include "core/whole_file.hpp"
#include "report/exchange/qif_results.hpp"

namespace frustum::app {

Diagnostics write_plan(const std::filesystem::path& file, const metrology::InspectionPlan& plan) {
  std::string extension = file.extension().string();
  for (char& c : extension) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  if (extension != ".qif" && extension != ".toml") {
    return {error("unknown-format"_id,
                  fmt::format("{}: '{}' names no format of plans", file.string(), extension),
                  "known: .qif .toml")};
  }
  const auto ruled = std::ranges::find(plan.features, metrology::FeatureKind::ruled,
                                       &metrology::PlannedFeature::kind);
  if (extension == ".qif" && ruled != plan.features.end()) {
    return {error("qif-plan"_id,
                  fmt::format("{}: QIF has no element for the ruled surface '{}'", file.string(),
                              ruled->name),
                  "write the plan as .toml")};
  }
  std::error_code failure;
  if (file.has_parent_path()) std::filesystem::create_directories(file.parent_path(), failure);
  if (failure) return {cannot_write(file, failure.message())};
  const std::string text = extension == ".qif" ? report::qif_plan(plan) : to_toml(plan);
  const auto written = write_whole_file(file, text);
  return written ? Diagnostics() : written.error();
}

}  // namespace frustum::app

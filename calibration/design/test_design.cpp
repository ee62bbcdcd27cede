#include "calibration/design/test_design.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "core/spelling.hpp"

namespace frustum::calibration {

Result<TestDesign> test_design(const kinematics::Machine& machine,
                               const std::vector<MeasuredMotion>& motions,
                               std::vector<Unknown> unknowns, const std::vector<Cause>& causes,
                               const TestDesignOptions& options) {
  const std::size_t asked = unknowns.size();
  for (Unknown& ball : ball_unknowns(motions)) unknowns.push_back(std::move(ball));
  const auto found = observations_of(machine, motions, unknowns, causes);
  if (!found) return found.error();
  const Observations& observations = found->observations;
  TestDesign design{.unknowns = unknowns};
  std::vector<DesignBlock> blocks;
  for (std::size_t i = 0; i < observations.rows.size(); ++i) {
    const std::string& test = observations.rows[i].group;
    if (blocks.empty() || blocks.back().name != test) blocks.push_back({.name = test});
    blocks.back().rows.push_back(static_cast<Eigen::Index>(i));
  }
  for (const DesignBlock& block : blocks) design.tests.push_back(block.name);
  DesignOptions choice{.criterion = options.criterion, .asked = asked};
  for (const std::string& name : options.required) {
    const auto at = std::ranges::find(design.tests, name);
    if (at == design.tests.end()) {
      return error("unknown-test"_id, fmt::format("the study has no test '{}'", name),
                   suggestion(name, design.tests));
    }
    choice.required.push_back(static_cast<std::size_t>(at - design.tests.begin()));
  }
  for (const Unknown& unknown : unknowns) {
    const auto limit = options.limits.find(unknown.name);
    choice.limits.push_back(limit == options.limits.end() ? std::optional<double>()
                                                          : std::optional(limit->second));
  }
  auto result = calibration::design(observations, blocks, choice);
  if (!result) return std::move(result).error();
  design.result = *std::move(result);
  if (const auto seen = observability(observations)) design.null_space = seen->null_space;
  return design;
}

}  // namespace frustum::calibration

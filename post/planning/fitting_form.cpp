#include "post/planning/fitting_form.hpp"

#include <algorithm>
#include <optional>
#include <variant>

#include "post/planning/plan_state.hpp"

namespace frustum::post {
namespace {

using kinematics::kRotaryAxes;
using parser::AxisLetter;
using parser::AxisTarget;

bool turns(const std::optional<UnitVec3>& tool_axis, const AxisTarget& end) {
  return tool_axis || std::ranges::any_of(
                          kRotaryAxes, [&](AxisLetter letter) { return end[letter].has_value(); });
}

// Whether the program says anything of the tool axis, or of the tip while it turns.
struct SaysTheToolAxis {
  bool operator()(const parser::Traverse& m) const { return turns(m.tool_axis, m.end); }
  bool operator()(const parser::LinearFeed& m) const { return turns(m.tool_axis, m.end); }
  bool operator()(const parser::ArcFeed& m) const { return turns(m.tool_axis, m.end); }
  bool operator()(const parser::CompensationChange& m) const { return tip_control(m); }
  bool operator()(const parser::TiltedPlaneChange& m) const {
    return m.program_from_plane.has_value();
  }
  template <typename Other>
  bool operator()(const Other& /*other*/) const {
    return false;
  }
};

}  // namespace

PlanOptions with_fitting_form(const kinematics::Machine& machine,
                              std::span<const parser::Motion> motions, PlanOptions options) {
  const bool fixed = std::ranges::none_of(
      kRotaryAxes, [&](AxisLetter letter) { return machine.joint(letter) != nullptr; });
  const bool turning = !fixed && std::ranges::any_of(motions, [](const parser::Motion& motion) {
    return std::visit(SaysTheToolAxis{}, motion.command);
  });
  if (options.output == OutputForm::tip && !turning) options.output = OutputForm::axes;
  return options;
}

}  // namespace frustum::post

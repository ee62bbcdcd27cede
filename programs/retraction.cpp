#include "programs/retraction.hpp"

#include <fmt/format.h>

namespace frustum::programs {

std::optional<Diagnostic> doubt_of_retraction(const kinematics::Machine& machine) {
  const kinematics::Joint* z = machine.joint(kinematics::AxisLetter::Z);
  if (z == nullptr || z->home >= 0.5 * (z->travel.lo + z->travel.hi)) return std::nullopt;
  Diagnostic doubt = warning(
      "low-home"_id,
      fmt::format("the program lifts the tool to the home position of Z, {:g} mm: that is in the "
                  "lower half of its travel, {:g} .. {:g} mm",
                  z->home, z->travel.lo, z->travel.hi),
      "state home in [axis.Z] of the machine file, as a rule the upper end of the travel");
  doubt.key = "axis.Z.home";
  return doubt;
}

}  // namespace frustum::programs

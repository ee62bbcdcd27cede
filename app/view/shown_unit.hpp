// The units in which deviations of machines and parts are shown: um and urad.
// Units: inside mm and rad. Errors: none.
#pragma once

#include "core/units.hpp"

namespace frustum::app {

struct ShownUnit {
  const char* name = "um";
  double per_internal = kUmPerMm;
};
[[nodiscard]] constexpr ShownUnit shown_unit(bool angular) {
  return angular ? ShownUnit{"urad", kUradPerRad} : ShownUnit{"um", kUmPerMm};
}
[[nodiscard]] constexpr double shown(double value, bool angular) {
  return value * shown_unit(angular).per_internal;
}

}  // namespace frustum::app

// Every kind of cutter twice: as the engine makes it, and as a meridian written down from its
// drawing.
//
// Units: mm; frame: tool. Errors: none.
#pragma once

#include <string>
#include <vector>

#include "cutter/body/cutter.hpp"
#include "tests/cutter/standing_cutters.hpp"

namespace frustum::proof {

struct Kind {
  std::string name;
  cutter::Cutter cutter;
  Meridian meridian;
  bool is_convex = true;
};

[[nodiscard]] const std::vector<Kind>& cutter_kinds();
[[nodiscard]] const Kind& kind_named(const std::string& name);

}  // namespace frustum::proof

// The turns of a helix one by one, for controls whose arcs are of at most one.
//
// Units : mm, rad
// Errors: none; no turns where an axis that the arc moves starts nowhere known
#pragma once

#include <vector>

#include "parser/motion.hpp"

namespace frustum::parser {

// `start`: the values before the arc, in its own words.
[[nodiscard]] std::vector<ArcFeed> single_turns(const ArcFeed& arc, const AxisTarget& start);

}  // namespace frustum::parser

// What F says of an arc on Fanuc, where it is another feed than that along the path of the tool.
//
// Model : a canonical feed is that along the path, a helix too, or the inverse of the time of its
//         move. Fanuc's F is the speed along the arc in the plane (parameter HTG = 0), so that the
//         path goes by F * path / arc; in G93 it is speed over radius, so that the move takes
//         angle / F minutes
// Units : mm, rad
// Errors: none; 1 where the start of the arc is not known
// Source: Fanuc 15i-MA B-63324EN 4.5, 15i-B B-63783EN-1 6.7 (helices); 16/18-C B-62764EN 5 (G93)
#pragma once

#include "parser/motion.hpp"

namespace frustum::parser {

// What F times is the canonical feed.
[[nodiscard]] double canonical_of_fanuc_feed(const ArcFeed& arc, const AxisTarget& start);

}  // namespace frustum::parser

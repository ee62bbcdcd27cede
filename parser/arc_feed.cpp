#include "parser/arc_feed.hpp"

#include <cmath>

#include "parser/arc.hpp"
#include "parser/interpret/moves/plane_path.hpp"

namespace frustum::parser {

double canonical_of_fanuc_feed(const ArcFeed& arc, const AxisTarget& start) {
  const PlaneAxes axes = axes_of(arc.plane);
  const auto u = static_cast<AxisLetter>(axes.u);
  const auto v = static_cast<AxisLetter>(axes.v);
  const auto w = static_cast<AxisLetter>(axes.w);
  if (!start[u] || !start[v]) return 1.0;
  const PathPiece path{{*start[u], *start[v]},
                       {arc.end[u].value_or(*start[u]), arc.end[v].value_or(*start[v])},
                       {arc.center[axes.u], arc.center[axes.v]},
                       arc.turns};
  if (arc.feed.mode == FeedMode::inverse_time) return 1.0 / sweep_of(path);
  if (!start[w] || !arc.end[w]) return 1.0;
  return std::hypot(1.0, (*arc.end[w] - *start[w]) / length_of(path));
}

}  // namespace frustum::parser

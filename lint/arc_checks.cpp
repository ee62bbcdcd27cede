#include "lint/arc_checks.hpp"

#include <fmt/format.h>

#include <cmath>
#include <numbers>

#include "core/units.hpp"

namespace frustum::lint {

void check_arc(const CuttingMove& move, FindingList& findings) {
  if (move.arc == nullptr) return;
  const auto shape = shape_of(*move.arc, move.start);
  if (!shape) return;
  const auto key = FindingList::key_of(move.place);
  const double apart = std::abs(shape->start_radius - shape->end_radius);
  if (apart > kRadiiDisagree) {
    findings.raise(Check::arc_radii, key, move.place, [&] {
      return Words{fmt::format("the radius is {:.4f} mm at the start of the arc and {:.4f} mm at "
                               "its end, {:.4f} mm apart (reported above {} mm)",
                               shape->start_radius, shape->end_radius, apart, kRadiiDisagree),
                   "some controls refuse the block; correct the centre or the end"};
    });
  }
  if (shape->chord > 0.0 && shape->chord < kSlip && shape->sweep > std::numbers::pi) {
    findings.raise(Check::arc_nearly_full, key, move.place, [&] {
      return Words{fmt::format("the arc ends {:.4f} mm from its start and turns {:.2f} deg",
                               shape->chord, shape->sweep * kDegPerRad),
                   "a full circle ends at its start; a short arc turns the other way or is a line"};
    });
  }
  if (shape->start_radius < kTinyRadius) {
    findings.raise(Check::arc_tiny, key, move.place, [&] {
      return Words{fmt::format("arc of radius {:.4g} mm", shape->start_radius),
                   "leave it out, or write a line"};
    });
  } else if (shape->start_radius > kHugeRadius) {
    findings.raise(Check::arc_huge, key, move.place, [&] {
      return Words{fmt::format("arc of radius {:.4g} m", shape->start_radius / 1000.0),
                   "write a line: controls lose digits on such arcs"};
    });
  }
}

}  // namespace frustum::lint

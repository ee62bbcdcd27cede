// How a ball bar is set up on a table: from above and from the front, with balls, bar, path, work
// offset and the sense in which it runs.
//
// Units  : mm, frame of the table
// Errors : none; outlines of fewer than three points are not drawn
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "core/pose.hpp"
#include "report/wording.hpp"

namespace frustum::report {

struct BarDrawing {
  std::string title{};
  Vec3 table_ball = Vec3::Zero();
  std::vector<Vec3> path{};  // of the spindle ball, in the order of the first pass; first: mounted
  Vec3 offset = Vec3::Zero();  // G54
  double tool_length = 0.0;
  Vec3 tool_axis = Vec3::UnitZ();  // at the first point of the path
  std::string parameter{};         // "phi grows"
  // The rotary axis that the parameter is of: a point, and about what its part turns meanwhile.
  struct Axis {
    Vec3 point = Vec3::Zero(), direction = Vec3::UnitZ();
  };
  std::optional<Axis> turning{};
  struct Outline {
    std::string name{};
    std::vector<Vec3> corners{};  // of a convex body
  };
  std::vector<Outline> bodies{};  // of the table
};

[[nodiscard]] std::string bar_figure_of(const BarDrawing& drawing,
                                        const Wording& words = Wording());

}  // namespace frustum::report

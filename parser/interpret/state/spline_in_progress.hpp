// A spline whose blocks are being read: the control points since G5.2, and how G5 goes on from the
// last one.
//
// Units : mm
// Errors: none
#pragma once

#include <Eigen/Core>
#include <optional>
#include <vector>

#include "parser/motion.hpp"

namespace frustum::parser {

using Vec2 = Eigen::Vector2d;

struct ControlPoint {
  Vec2 place = Vec2::Zero();
  double weight = 1.0;
};

struct SplineInProgress {
  // The control points since G5.2 or G6.2, in the axes of the plane.
  struct Nurbs {
    SourcePlace place{};
    int order = 0;
    std::vector<ControlPoint> points{};
    Vec2 from = Vec2::Zero();     // where the tool is
    std::vector<double> knots{};  // of G6.2; else they are uniform
  };
  std::optional<Nurbs> nurbs{};
  // From where the last G5 ended to the first control point of the next, if that follows.
  std::optional<Vec2> leads{};
};

}  // namespace frustum::parser

// The line, arc or helix on which a block moves the point that its X Y Z words name.
//
// Model    : straight, or in-plane spoke turned about `center` with a steady rise along `normal`; a
//            radius that differs between start and end within the parser's tolerance is spread
//            evenly
// Units    : mm, rad; frame: that of the words
// Errors   : none; arcs without a radius do not leave the parser
#pragma once

#include "core/pose.hpp"
#include "parser/motion.hpp"

namespace frustum::kinematics {

struct TipCurve {
  Vec3 start = Vec3::Zero();
  Vec3 end = Vec3::Zero();
  Vec3 center = Vec3::Zero();
  Vec3 normal = Vec3::UnitZ();
  double turn = 0.0;  // rad, signed; 0: straight

  [[nodiscard]] static TipCurve line(const Vec3& start, const Vec3& end) {
    return {start, end, Vec3::Zero(), Vec3::UnitZ(), 0.0};
  }
  [[nodiscard]] static TipCurve arc(const parser::ArcFeed& arc, const Vec3& start, const Vec3& end);

  [[nodiscard]] Vec3 at(double u) const;  // u in [0, 1]; uniform in length
  [[nodiscard]] double length() const;    // mm
};

}  // namespace frustum::kinematics

// An arc of the program in the words of the output: the same arc, seen from other axes.
//
// Units  : mm
// Errors : none; nothing where it is no arc in a plane of two axes any more
#pragma once

#include <optional>

#include "core/pose.hpp"
#include "parser/motion.hpp"

namespace frustum::post {

struct ArcImage {
  Vec3 center = Vec3::Zero();
  parser::Plane plane = parser::Plane::xy;
  int turns = 1;
};

// `out_from_in` maps displacements; the start is at `start_in` and `start_out`.
[[nodiscard]] std::optional<ArcImage> image_of(const parser::ArcFeed& arc, const Mat3& out_from_in,
                                               const Vec3& start_in, const Vec3& start_out);
// Of the plane's positive side.
[[nodiscard]] Vec3 normal_of(parser::Plane plane);

}  // namespace frustum::post

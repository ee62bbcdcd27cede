// The cutter's way around the levels of a contouring piece.
//
// Model  : contour_piece.hpp
// Units  : mm; frame: workpiece, which is that of the program
// Errors : none
#pragma once

#include <string>
#include <vector>

#include "programs/contour/contour_piece.hpp"

namespace frustum::programs {

// Straight, or on an arc in XY about a centre.
struct ContourMove {
  enum class Kind { rapid, feed, clockwise, counterclockwise };
  Kind kind = Kind::feed;
  Vec3 end = Vec3::Zero();     // of the tip
  Vec3 centre = Vec3::Zero();  // of an arc
};

struct ContourOperation {
  std::string name{};
  std::vector<std::string> makes{};  // features of the plan
  std::vector<ContourMove> moves{};  // from above the part to above the part
};

// Rapids across are at this height above the top face.
inline constexpr double kContourClear = 10.0;

[[nodiscard]] std::vector<ContourOperation> contour_path(const ContourPiece& piece,
                                                         const ContourGeometry& shape);

}  // namespace frustum::programs

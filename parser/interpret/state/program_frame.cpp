#include "parser/interpret/state/program_frame.hpp"

#include <cmath>

namespace frustum::parser {
namespace {

// The axis to mirror so that what is left is a turn, about the normal of a plane where there is
// one.
Eigen::Index mirrored_axis(const Mat3& linear) {
  // Columns are exact where nothing was turned; sums of products of sines and cosines are good to
  // 1e-15.
  constexpr double kSame = 1e-12;
  for (Eigen::Index i = 0; i < 3; ++i) {
    if ((linear.col(i) + Vec3::Unit(i)).norm() < kSame) return i;
  }
  for (Eigen::Index i = 0; i < 3; ++i) {
    if ((linear.col(i) - Vec3::Unit(i)).norm() < kSame) return (i + 1) % 3;
  }
  return 0;
}

}  // namespace

ProgramFrame ProgramFrame::shift(const Vec3& origin, const std::array<double, 3>& rotary_shift) {
  ProgramFrame frame;
  frame.origin = origin;
  frame.rotary_shift = rotary_shift;
  return frame;
}

ProgramFrame ProgramFrame::turn(const Vec3& angles) {
  // Of a right angle, an axis goes on along another one exactly.
  constexpr double kRounding = 1e-15;
  ProgramFrame frame;
  frame.linear = rotation_about(Vec3::UnitZ(), angles[2]) *
                 rotation_about(Vec3::UnitY(), angles[1]) *
                 rotation_about(Vec3::UnitX(), angles[0]);
  frame.linear = frame.linear.unaryExpr([](double part) {
    const double nearest = std::round(part);
    return std::abs(part - nearest) < kRounding ? nearest + 0.0 : part;
  });
  return frame;
}

ProgramFrame ProgramFrame::scaling(double factor) {
  ProgramFrame frame;
  frame.scale = factor;
  return frame;
}

ProgramFrame ProgramFrame::mirror(const std::array<bool, 3>& axes) {
  ProgramFrame frame;
  for (std::size_t i = 0; i < axes.size(); ++i) {
    const auto axis = static_cast<Eigen::Index>(i);
    if (axes.at(i)) frame.linear(axis, axis) = -1.0;
  }
  return frame;
}

ProgramFrame ProgramFrame::with(const ProgramFrame& inner) const {
  ProgramFrame both;
  both.linear = linear * inner.linear;
  both.scale = scale * inner.scale;
  both.origin = point(inner.origin);
  for (std::size_t i = 0; i < rotary_shift.size(); ++i) {
    both.rotary_shift.at(i) = rotary_shift.at(i) + inner.rotary_shift.at(i);
  }
  return both;
}

// A word frame is mirror (scale (turn (words + shift))).
ProgrammedFrame ProgramFrame::programmed_frame() const {
  ProgrammedFrame frame;
  frame.rotary_shift = rotary_shift;
  frame.scale = scale;
  Mat3 rotation = linear;
  Vec3 place = origin / scale;
  if (linear.determinant() < 0.0) {
    const Eigen::Index axis = mirrored_axis(linear);
    frame.mirrors.at(static_cast<std::size_t>(axis)) = 0.0;
    rotation.row(axis) *= -1.0;
    place[axis] *= -1.0;
  }
  if (rotation.isIdentity(0.0)) {
    frame.shift = place;
  } else {
    frame.turn = Pose{rotation, place};
  }
  return frame;
}

}  // namespace frustum::parser

#include "parser/interpret/frames/feature_frame.hpp"

#include <fmt/format.h>

#include <cmath>
#include <numbers>

#include "core/units.hpp"

namespace frustum::parser {
namespace {

// The control takes vectors that are nearly at right angles for such.
constexpr double kMostOffSquare = 5.0 * kRadPerDeg;
// Below a thousandth of a degree two lines are one: the digits of a program do not hold their
// plane.
constexpr double kParallel = 1e-3 * kRadPerDeg;

Mat3 about(int axis, double angle) { return rotation_about(Vec3::Unit(axis), angle); }

// Columns: the axes of the plane. Nothing when z has no direction across x.
std::optional<Mat3> frame_of(const Vec3& x, const Vec3& z) {
  const auto first = UnitVec3::of(x);
  const auto normal = UnitVec3::of(z);
  if (!first || !normal) return std::nullopt;
  const Vec3 across = normal->vec().cross(first->vec());
  if (across.norm() < std::sin(kParallel)) return std::nullopt;
  const Vec3 y = across.normalized();
  Mat3 axes;
  axes << y.cross(normal->vec()), y, normal->vec();
  return axes;
}

Result<Pose> by_angles(const FeatureWords& words) {
  const FeaturePart& part = *words.parts[0];
  const Vec3& angles = part.numbers;
  if (words.form == FeatureForm::euler) {
    return Pose{about(2, angles[0]) * about(0, angles[1]) * about(2, angles[2]), part.place};
  }
  Mat3 turned = Mat3::Identity();
  std::array<bool, 3> used{};
  for (const int power : {100, 10, 1}) {
    const int axis = words.order / power % 10 - 1;
    if (words.order > 999 || axis < 0 || axis > 2 || used.at(static_cast<std::size_t>(axis))) {
      return error("plane-order"_id, fmt::format("Q{} is no order of turns", words.order),
                   "name each axis once: Q123 turns about X, then Y, then Z");
    }
    used.at(static_cast<std::size_t>(axis)) = true;
    turned = about(axis, angles[axis]) * turned;
  }
  return Pose{turned, part.place};
}

Result<Pose> by_points(const FeatureWords& words) {
  const Vec3 origin = words.parts[1]->place;
  const Vec3 x = words.parts[2]->place - origin;
  const auto axes = frame_of(x, x.cross(words.parts[3]->place - origin));
  const auto side = UnitVec3::of(words.parts[3]->place - origin);
  const auto first = UnitVec3::of(x);
  if (!axes || !side || first->vec().cross(side->vec()).norm() < std::sin(kParallel)) {
    return error("plane-degenerate"_id, "the three points of the plane are on one line",
                 "give Q1 the origin, Q2 a place on +X and Q3 a place beside that line");
  }
  const FeaturePart shift = words.parts[0].value_or(FeaturePart{});
  return Pose{*axes * about(2, shift.turn), origin + *axes * shift.place};
}

Result<Pose> by_vectors(const FeatureWords& words) {
  const Vec3& x = words.parts[1]->numbers;
  const Vec3& z = words.parts[2]->numbers;
  const auto axes = frame_of(x, z);
  if (!axes) {
    return error("plane-degenerate"_id, "the two vectors span no plane",
                 "give Q1 the direction I J K of +X and Q2 that of the normal, at right angles");
  }
  const double off =
      std::abs(angle_between(x.normalized(), z.normalized()) - std::numbers::pi / 2.0);
  if (off > kMostOffSquare) {
    return error(
        "plane-vectors"_id,
        fmt::format("the two vectors are {:g} degrees off the right angle", off * kDegPerRad),
        "give directions at right angles; up to 5 degrees are made good along +X");
  }
  return Pose{*axes, words.parts[1]->place};
}

Result<Pose> by_projections(const FeatureWords& words) {
  const FeaturePart& part = *words.parts[0];
  const Vec3 x = about(1, part.numbers[0]) * Vec3::UnitX();
  const Vec3 y = about(0, part.numbers[1]) * Vec3::UnitY();
  const auto axes = frame_of(x, x.cross(y));
  if (!axes || x.cross(y).norm() < std::sin(kParallel)) {
    return error("plane-degenerate"_id, "the two lines of the plane are parallel",
                 "give I and J other than 90 degrees");
  }
  return Pose{*axes * about(2, part.numbers[2]), part.place};
}

}  // namespace

bool FeatureWords::whole() const {
  switch (form) {
    case FeatureForm::three_points:
      return parts[1] && parts[2] && parts[3];
    case FeatureForm::two_vectors:
      return parts[1] && parts[2];
    default:
      return parts[0].has_value();
  }
}

Result<Pose> feature_frame(const FeatureWords& words) {
  switch (words.form) {
    case FeatureForm::three_points:
      return by_points(words);
    case FeatureForm::two_vectors:
      return by_vectors(words);
    case FeatureForm::projection:
      return by_projections(words);
    default:
      return by_angles(words);
  }
}

}  // namespace frustum::parser

#include "tests/cutter/random_paths.hpp"

#include <cmath>
#include <numbers>

namespace frustum::proof {

using kinematics::ToolPath;
using kinematics::ToolPose;

double Draw::decades(double lo, double hi) { return lo * std::pow(hi / lo, between(0.0, 1.0)); }

Vec3 Draw::point(const Vec3& lo, const Vec3& hi) {
  const double x = between(lo.x(), hi.x());
  const double y = between(lo.y(), hi.y());
  return {x, y, between(lo.z(), hi.z())};
}

Vec3 Draw::direction() {
  const double z = between(-1.0, 1.0);
  const double a = between(0.0, 2.0 * std::numbers::pi);
  const double across = std::sqrt(1.0 - z * z);
  return Vec3(across * std::cos(a), across * std::sin(a), z).normalized();
}

Vec3 Draw::axis(double tilt) {
  const double a = between(0.0, 2.0 * std::numbers::pi);
  const double t = between(0.0, tilt);
  return Vec3(std::sin(t) * std::cos(a), std::sin(t) * std::sin(a), std::cos(t)).normalized();
}

std::string to_string(MotionFamily family) {
  constexpr std::array kNames = {"straight",  "tilted", "plunge", "dwell",         "about_the_tip",
                                 "five_axis", "wild",   "tiny",   "block_of_many", "crossing"};
  return kNames[static_cast<std::size_t>(family)];
}

ToolPath path_through(const std::vector<ToolPose>& poses) {
  ToolPath path;
  path.poses = poses;
  for (std::uint32_t i = 0; i + 1 < poses.size(); ++i) {
    path.blocks.push_back({.source_line = i + 1, .tool = 1});
    path.segments.push_back({i, i});
  }
  return path;
}

namespace {

// Turned by `angle` towards a random side.
Vec3 turned(const Vec3& axis, double angle, Draw& draw) {
  const Vec3 about = axis.cross(draw.direction()).normalized();
  return (rotation_about(about, angle) * axis).normalized();
}

ToolPose moved(const ToolPose& from, double travel, double turn, Draw& draw) {
  return {from.tip + travel * draw.direction(),
          turn > 0.0 ? turned(from.axis, turn, draw) : from.axis};
}

std::vector<ToolPose> crossing(Draw& draw) {
  std::vector<ToolPose> poses = {{draw.point(Vec3(-8, -8, -2), Vec3(8, 8, 2)), draw.axis(0.4)}};
  for (int i = 0; i < 6; ++i) {
    const ToolPose& last = poses.back();
    const int what = draw.below(6);
    if (what == 0) {
      poses.push_back(last);
    } else if (what == 1) {
      poses.push_back({last.tip, draw.axis(0.5)});
    } else if (what == 2) {
      poses.push_back({last.tip + draw.between(-4.0, 4.0) * last.axis, last.axis});
    } else {
      poses.push_back(
          {draw.point(Vec3(-8, -8, -2), Vec3(8, 8, 2)), what == 3 ? last.axis : draw.axis(0.5)});
    }
  }
  return poses;
}

}  // namespace

ToolPath random_path(MotionFamily family, Draw& draw) {
  const ToolPose upright{draw.point(Vec3(-3, -3, -3), Vec3(3, 3, 3)), Vec3::UnitZ()};
  const ToolPose leaning{upright.tip, draw.axis(1.2)};
  switch (family) {
    case MotionFamily::straight: {
      const double way = draw.between(0.0, 2.0 * std::numbers::pi);
      return path_through(
          {upright,
           {upright.tip + draw.decades(0.1, 30.0) * Vec3(std::cos(way), std::sin(way), 0),
            upright.axis}});
    }
    case MotionFamily::tilted:
      return path_through({leaning, moved(leaning, draw.decades(0.1, 30.0), 0.0, draw)});
    case MotionFamily::plunge:
      return path_through(
          {leaning, {leaning.tip + draw.between(-20.0, 20.0) * leaning.axis, leaning.axis}});
    case MotionFamily::dwell:
      return path_through({leaning, leaning});
    case MotionFamily::about_the_tip:
      return path_through({leaning, moved(leaning, 0.0, draw.decades(1e-4, 1.2), draw)});
    case MotionFamily::five_axis:
      return path_through(
          {leaning, moved(leaning, draw.between(0.0, 30.0), draw.between(0.0, 0.5), draw)});
    case MotionFamily::wild:
      return path_through(
          {leaning, moved(leaning, draw.between(0.0, 20.0), draw.between(0.5, 2.6), draw)});
    case MotionFamily::tiny:
      return path_through(
          {leaning, moved(leaning, draw.decades(1e-9, 1e-2), draw.decades(1e-12, 1e-3), draw)});
    case MotionFamily::block_of_many:
      return path_through(
          {leaning, moved(leaning, draw.between(0.05, 0.5), draw.between(0.0, 2e-3), draw)});
    case MotionFamily::crossing:
      return path_through(crossing(draw));
  }
  return {};
}

}  // namespace frustum::proof

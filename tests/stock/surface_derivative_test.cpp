// What a contact record says of the surface's motion, against cuts that are moved, turned or of
// another radius.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <iostream>
#include <optional>

#include "core/ray.hpp"
#include "stock/solid/workpiece.hpp"
#include "tests/cutter/cutter_kinds.hpp"
#include "tests/cutter/random_paths.hpp"

namespace frustum::proof {
namespace {

using cutter::Cutter;
using kinematics::ToolPath;
using kinematics::ToolPose;
using stock::SurfacePoint;
using stock::Workpiece;

// How the cut is disturbed: all poses moved and turned about the origin, or the tool's radius.
struct Disturbance {
  const char* name;
  Vec3 shift, turn;
  double radius = 0.0;
};
const std::array kDisturbances = {Disturbance{"shift", Vec3(0.4, -0.5, 0.7), Vec3::Zero()},
                                  Disturbance{"turn", Vec3::Zero(), Vec3(0.02, -0.03, 0.04)},
                                  Disturbance{"radius", Vec3::Zero(), Vec3::Zero(), 1.0}};

// Two segments of 12 mm that turn by 15 degrees each.
ToolPath five_axis_path() {
  return path_through({{Vec3(-12, -2, -3), Vec3(0.3, -0.2, 1.0).normalized()},
                       {Vec3(0, 0, -3.5), Vec3(0.1, -0.3, 1.0).normalized()},
                       {Vec3(11, 3, -3), Vec3(-0.1, -0.2, 1.0).normalized()}});
}

Workpiece cut(const cutter::CutterSpec& spec, const Disturbance& by, double amount) {
  ToolPath path = five_axis_path();
  const double angle = amount * by.turn.norm();
  const Mat3 turned =
      angle == 0.0 ? Mat3(Mat3::Identity()) : rotation_about(by.turn.normalized(), angle);
  for (ToolPose& pose : path.poses) {
    pose = {turned * pose.tip + amount * by.shift, (turned * pose.axis).normalized()};
  }
  cutter::CutterSpec other = spec;
  other.radius_error.value += amount * by.radius;
  return {stock::Blank::make(stock::BoxShape{60.0, 60.0, 20.0}, Vec3(0, 0, -20)).value(),
          *cutter::SweptCutter::sweep(std::move(path), {{1, Cutter::make(other).value()}})};
}

// Along the ray, what the surface moves to first order.
double gain(const Workpiece& part, const SurfacePoint& p, const cutter::CutterSpec& spec,
            const Disturbance& by, const Ray& ray) {
  const ToolPath& path = part.removed().path();
  const auto& segment = path.segments[*p.segment];
  const ToolPose pose = kinematics::between(path.from(segment), path.to(segment), p.t);
  double along_normal = p.normal.dot(by.shift + by.turn.cross(p.point));
  if (by.radius > 0.0) {
    cutter::CutterSpec larger = spec, smaller = spec;
    larger.radius_error.value += 1e-3;
    smaller.radius_error.value -= 1e-3;
    const double u = -p.normal.dot(pose.axis);
    along_normal -=
        (Cutter::make(larger)->body().support(u) - Cutter::make(smaller)->body().support(u)) / 2e-3;
  }
  return along_normal / p.normal.dot(ray.direction);
}

struct Slopes {
  int points = 0;
  std::array<double, 3> worst{};  // with steps h, h / 2, h / 4
};

Slopes compare(const cutter::CutterSpec& spec, const Disturbance& by) {
  constexpr double kStep = 0.04;
  const Workpiece part = cut(spec, by, 0.0);
  std::array<std::pair<std::optional<Workpiece>, std::optional<Workpiece>>, 3> moved;
  for (std::size_t k = 0; k < 3; ++k) {
    const double step = kStep / static_cast<double>(1U << k);
    moved[k] = {cut(spec, by, step), cut(spec, by, -step)};
  }
  Slopes slopes;
  Draw draw(17);
  for (int tries = 0; tries < 60; ++tries) {
    const Vec3 tip = draw.point(Vec3(-10, -2, 4), Vec3(9, 3, 4));
    const Ray ray{tip, (draw.direction() - 1.5 * Vec3::UnitZ()).normalized()};
    const auto here = part.first_surface(ray, {0.0, 30.0});
    if (!here || !here->segment || here->t < 0.05 || here->t > 0.95) continue;
    const double cosine = -here->normal.dot(ray.direction);
    if (cosine < 0.5) continue;
    const double expected = gain(part, *here, spec, by, ray);
    std::array<double, 3> error{};
    bool same = true;
    for (std::size_t k = 0; k < 3; ++k) {
      const auto a = moved[k].first->first_surface(ray, {0.0, 30.0});
      const auto b = moved[k].second->first_surface(ray, {0.0, 30.0});
      same = same && a && b && a->segment == here->segment && b->segment == here->segment &&
             (a->normal - b->normal).norm() < 0.2 && a->t > 0.01 && a->t < 0.99 && b->t > 0.01 &&
             b->t < 0.99;
      if (!same) break;
      const double step = kStep / static_cast<double>(1U << k);
      error[k] = std::abs((a->s - b->s) / (2.0 * step) - expected);
    }
    if (!same) continue;
    ++slopes.points;
    for (std::size_t k = 0; k < 3; ++k) slopes.worst[k] = std::max(slopes.worst[k], error[k]);
  }
  return slopes;
}

// An end is found to 4e-10 mm, and the instant that makes it to the root of that: the normal
// is then off by sqrt(2 * 4e-10 mm / 5 mm) at a radius of 5 mm.
constexpr double kNormal = 1.5e-5;

class SurfaceDerivativeLaws : public ::testing::TestWithParam<std::string> {};

TEST_P(SurfaceDerivativeLaws, AreTheLimitOfCentralDifferencesAtSecondOrder) {
  const cutter::CutterSpec& spec = kind_named(GetParam()).cutter.spec();
  for (const Disturbance& by : kDisturbances) {
    const Slopes s = compare(spec, by);
    std::cout << fmt::format("{} {}: {} points, worst {:.1e} {:.1e} {:.1e} with 40, 20, 10 um\n",
                             GetParam(), by.name, s.points, s.worst[0], s.worst[1], s.worst[2]);
    EXPECT_GT(s.points, 25);
    // Half the step, a quarter of the remainder: at least a third, since the worst point may be
    // another one.
    EXPECT_LT(s.worst[1], s.worst[0] / 3.0 + kNormal) << by.name;
    EXPECT_LT(s.worst[2], s.worst[1] / 3.0 + kNormal) << by.name;
    EXPECT_LT(s.worst[2], 2e-3 + kNormal) << by.name;
  }
}

INSTANTIATE_TEST_SUITE_P(Kinds, SurfaceDerivativeLaws,
                         ::testing::Values("flat", "ball", "bull", "taper_ball", "barrel", "lens",
                                           "waisted"),
                         [](const auto& about) { return about.param; });

}  // namespace
}  // namespace frustum::proof

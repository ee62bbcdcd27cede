#include "app/motion/bar_clearance.hpp"

#include <algorithm>
#include <cmath>
#include <memory>
#include <vector>

#include "kinematics/model/chain.hpp"
#include "stock/collision/pair_watch.hpp"

namespace frustum::app {
namespace {

using kinematics::MachinePart;
using stock::SceneBody;

std::shared_ptr<const stock::SolidBody> rod(double diameter, double length) {
  return std::make_shared<const stock::SolidBody>(
      stock::SolidBody::of(stock::FrustumShape{0.5 * diameter, 0.5 * diameter, length}));
}

// A frame at a place whose Z is along a direction.
Pose along(const Vec3& place, const Vec3& direction) {
  const Vec3 z = direction.normalized();
  const Vec3 other = std::abs(z.x()) < 0.7 ? Vec3::UnitX() : Vec3::UnitY();
  const Vec3 x = other.cross(z).normalized();
  Mat3 rotation;
  rotation << x, z.cross(x), z;
  return {rotation, place};
}

// A sample each two degrees, or more.
int samples_of(const programs::BarPass& pass) {
  constexpr double kStep = 2.0 * kRadPerDeg;
  return 1 + std::max(1, static_cast<int>(std::ceil(std::abs(pass.to - pass.from) / kStep)));
}
double parameter_of(const programs::BarPass& pass, int sample) {
  return std::lerp(pass.from, pass.to, static_cast<double>(sample) / (samples_of(pass) - 1));
}

bool is_ignored(const SceneBody& a, const SceneBody& b) {
  const auto names = [](const SceneBody& one, const SceneBody& other) {
    return std::ranges::find(one.ignored, other.name) != one.ignored.end();
  };
  return names(a, b) || names(b, a);
}

class Nearest {
 public:
  explicit Nearest(const kinematics::Machine& machine) : machine_(machine) {}
  void look(const SceneBody& a, const SceneBody& b, const kinematics::AxisPositions& q,
            double parameter) {
    const stock::Separation apart = stock::PairWatch(machine_, a, b).separation_at(q);
    const double distance = apart.lower < stock::kMeeting ? 0.0 : apart.upper;
    if (found && found->distance <= distance) return;
    found = BarClearance{distance, a.name, b.name, parameter, false};
  }
  std::optional<BarClearance> found{};

 private:
  const kinematics::Machine& machine_;
};

}  // namespace

double least_angle_at_stem(const kinematics::Machine& machine, const instruments::MotionTest& test,
                           const programs::BarPass& pass) {
  double least = HUGE_VAL;
  if (!test.motion.axes) return least;
  const kinematics::GeometricErrors none;
  const kinematics::ForwardChain nominal(machine, none, test.tool_length);
  for (int i = 0; i < samples_of(pass); ++i) {
    const kinematics::AxisPositions q = test.motion.axes(parameter_of(pass, i));
    const Pose tool = nominal.bed_from_tool(q);
    const Vec3 to_table_ball = nominal.bed_from_table(q).point(test.table_ball) - tool.translation;
    least = std::min(least, std::acos(std::clamp(
                                to_table_ball.normalized().dot(tool.rotation.col(2)), -1.0, 1.0)));
  }
  return least;
}

Result<std::optional<BarClearance>> bar_clearance(const kinematics::Machine& machine,
                                                  const instruments::MotionTest& test,
                                                  const programs::BarPass& pass) {
  const auto bodies = stock::bodies_of(machine);
  if (!bodies) return bodies.error();
  if (bodies->empty() || !test.motion.axes) return std::optional<BarClearance>{};
  const bool spindle = test.tool_length >= kLeastStem;
  const MachinePart on_tool{+1, machine.tool_chain().size()};
  const MachinePart on_table{-1, machine.work_chain().size()};
  // The ball itself is no part of its stem.
  constexpr double kOfBall = 10.0;
  const SceneBody stem{.kind = SceneBody::Kind::fixture,
                       .name = "stem of the spindle ball",
                       .part = on_tool.joints > 0 ? on_tool : MachinePart{},
                       .part_from_body = Pose::translated(
                           machine.spindle_offset() - (test.tool_length - kOfBall) * Vec3::UnitZ()),
                       .solid = rod(kStemDiameter, std::max(test.tool_length - kOfBall, 1.0))};
  const SceneBody cup{.kind = SceneBody::Kind::fixture,
                      .name = "cup of the table ball",
                      .part = on_table.joints > 0 ? on_table : MachinePart{},
                      .part_from_body = Pose::translated(machine.table_offset() + test.table_ball -
                                                         (kOfBall + kCupHeight) * Vec3::UnitZ()),
                      .solid = rod(kCupDiameter, kCupHeight)};
  SceneBody bar{.kind = SceneBody::Kind::fixture,
                .name = "bar",
                .solid = rod(kBarDiameter, std::max(test.bar - 2.0 * kBarEnds, 1.0))};
  const kinematics::GeometricErrors none;
  const kinematics::ForwardChain nominal(machine, none, test.tool_length);
  Nearest nearest(machine);
  for (int i = 0; i < samples_of(pass); ++i) {
    const double parameter = parameter_of(pass, i);
    const kinematics::AxisPositions q = test.motion.axes(parameter);
    const Vec3 tip = nominal.bed_from_tool(q).translation;
    const Vec3 ball = nominal.bed_from_table(q).point(test.table_ball);
    const Vec3 u = (tip - ball).normalized();
    bar.part_from_body = along(ball + kBarEnds * u, u);
    for (const SceneBody& body : *bodies) {
      const bool of_tool = body.part.side > 0;
      if (!of_tool || spindle) nearest.look(bar, body, q, parameter);
      if (!spindle) continue;
      if (of_tool) {
        nearest.look(cup, body, q, parameter);
      } else {
        nearest.look(stem, body, q, parameter);
      }
      for (const SceneBody& other : *bodies) {
        if (of_tool && other.part.side < 0 && !is_ignored(body, other)) {
          nearest.look(body, other, q, parameter);
        }
      }
    }
  }
  if (nearest.found) nearest.found->spindle = spindle;
  return nearest.found;
}

}  // namespace frustum::app

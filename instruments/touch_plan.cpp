#include "instruments/touch_plan.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numeric>

#include "core/decimal.hpp"
#include "kinematics/model/joint_motion.hpp"

namespace frustum::instruments {
namespace {

using kinematics::AxisLetter;
using kinematics::Joint;
using kinematics::Machine;

// The artefact, mm.
constexpr double kHalfWidth = 25.0;
constexpr double kTop = 100.0;
constexpr double kTouchHeight = 70.0;
constexpr std::array<std::array<double, 2>, 3> kCentres{
    {{-150.0, -75.0}, {150.0, -75.0}, {0.0, 150.0}}};

constexpr std::array<double, 4> kTilts{0.0, -30.0, -60.0, -90.0};               // deg about x
constexpr std::array<double, 6> kTurns{0.0, 60.0, 120.0, 180.0, 240.0, 300.0};  // deg about z

using Points = std::vector<std::size_t>;
// Upright and turned: without the faces that look most to the middle of the table.
const Points kUpright{1, 2, 3, 4, 5, 7, 8, 9, 10, 11, 12, 14};
// Tilted, by the turn: eight of those within reach.
const std::array<Points, 6> kTilted{{{0, 1, 3, 4, 8, 9, 10, 14},
                                     {1, 3, 4, 6, 8, 9, 11, 14},
                                     {1, 2, 4, 6, 7, 9, 11, 14},
                                     {0, 1, 2, 4, 7, 9, 10, 14},
                                     {0, 2, 4, 5, 7, 9, 10, 14},
                                     {0, 3, 4, 5, 8, 9, 10, 14}}};

Points all_points() {
  Points all(kTouchPoints);
  std::iota(all.begin(), all.end(), std::size_t{0});
  return all;
}

// `turn` counts sixths of a turn about z.
Points points_at(std::size_t tilt, std::size_t turn) {
  if (tilt > 0) return kTilted.at(turn);
  return turn == 0 ? all_points() : kUpright;
}

// +1 where +q turns the table about +axis, -1 about -axis, 0 about another line.
int sense_about(const Joint& joint, const Vec3& axis) {
  constexpr double kParallel = 1e-9;  // directions are stated, not computed
  const double along = joint.side * joint.direction.dot(axis);
  if (std::abs(std::abs(along) - 1.0) > kParallel) return 0;
  return along > 0.0 ? +1 : -1;
}

// Why the plan does not suit a machine; empty: it does.
std::string misfit(const Machine& machine) {
  for (const Joint& joint : machine.tool_chain()) {
    if (joint.rotary()) return fmt::format("{} turns the tool", to_char(joint.letter));
  }
  const auto& chain = machine.work_chain();
  if (chain.size() < 2 || chain[chain.size() - 2].letter != AxisLetter::A ||
      chain.back().letter != AxisLetter::C) {
    return "the table does not hang on A and C";
  }
  if (sense_about(chain[chain.size() - 2], Vec3::UnitX()) == 0) return "A is not along X";
  if (sense_about(chain.back(), Vec3::UnitZ()) == 0) return "C is not along Z";
  // A place along A changes nothing.
  if (!chain.back().offset.tail<2>().isZero(0.0)) return "the axes A and C do not cross";
  return {};
}

}  // namespace

const std::array<TouchPoint, kTouchPoints>& touch_points() {
  static const std::array<TouchPoint, kTouchPoints> kPoints = [] {
    const std::array<Vec3, 4> sides{Vec3::UnitX(), -Vec3::UnitX(), Vec3::UnitY(), -Vec3::UnitY()};
    std::array<TouchPoint, kTouchPoints> points;
    std::size_t k = 0;
    for (const auto& [x, y] : kCentres) {
      for (const Vec3& n : sides) {
        points.at(k++) = {Vec3(x, y, kTouchHeight) + kHalfWidth * n, n};
      }
      points.at(k++) = {Vec3(x, y, kTop), Vec3::UnitZ()};
    }
    return points;
  }();
  return kPoints;
}

double column_reach() {
  double reach = 0.0;
  for (const auto& [x, y] : kCentres) {
    reach = std::max(reach, Vec3(std::abs(x) + kHalfWidth, std::abs(y) + kHalfWidth, kTop).norm());
  }
  return reach;
}

Result<TouchPlan> touch_plan(const Machine& machine) {
  if (const std::string why = misfit(machine); !why.empty()) {
    return error(
        "machine-unsuited"_id,
        fmt::format("the touch-trigger calibration is of a table that A tilts and C turns: "
                    "on machine {} {}",
                    machine.name(), why),
        "machines that have one: ac-probe, zx-yac; others: frustum motion chase");
  }
  const auto& chain = machine.work_chain();
  const Joint& tilt = chain[chain.size() - 2];
  const Joint& turn = chain.back();
  TouchPlan plan{.table_offset = machine.table_offset()};
  const int tilt_sense = sense_about(tilt, Vec3::UnitX());
  for (const double degrees : kTilts) {
    const double q = tilt_sense * degrees * kRadPerDeg + 0.0;  // no negative zero
    plan.tilts.push_back({q, nominal_joint(tilt, q).rotation});
  }
  for (const double degrees : kTurns) {
    const double q = degrees * kRadPerDeg;
    plan.turns.push_back({q, nominal_joint(turn, q).rotation});
  }
  const bool forward = sense_about(turn, Vec3::UnitZ()) > 0;
  for (std::size_t i = 0; i < kTilts.size(); ++i) {
    for (std::size_t j = 0; j < kTurns.size(); ++j) {
      const std::size_t sixths = forward ? j : (kTurns.size() - j) % kTurns.size();
      for (const std::size_t k : points_at(i, sixths)) plan.touches.push_back({i, j, k});
    }
  }
  return plan;
}

std::string position_text(const TouchPlan& plan, std::size_t tilt, std::size_t turn) {
  return fmt::format("A = {:g} deg, C = {:g} deg", as_stated(plan.tilts[tilt].axis * kDegPerRad),
                     as_stated(plan.turns[turn].axis * kDegPerRad));
}

std::string point_text(std::size_t point) {
  constexpr std::array<const char*, 5> kFaces{"+X", "-X", "+Y", "-Y", "top"};
  return fmt::format("point {} ({} of column {})", point, kFaces.at(point % kFaces.size()),
                     point / kFaces.size() + 1);
}

std::string place_of(const TouchPlan& plan, const PlannedTouch& touch) {
  return fmt::format("{} at {}", point_text(touch.point),
                     position_text(plan, touch.tilt, touch.turn));
}

}  // namespace frustum::instruments

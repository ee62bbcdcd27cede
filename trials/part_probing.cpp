#include "trials/part_probing.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>

#include "core/decimal.hpp"
#include "instruments/approach.hpp"
#include "kinematics/model/chain.hpp"
#include "kinematics/model/inverse.hpp"
#include "metrology/cmm.hpp"
#include "metrology/fit/element.hpp"
#include "metrology/plan/strategy.hpp"
#include "metrology/probing/ball_contact.hpp"
#include "metrology/probing/stylus_collision.hpp"
#include "stock/solid/blank.hpp"
#include "trials/trial.hpp"

namespace frustum::trials {
namespace {

using kinematics::AxisLetter;
using kinematics::AxisPositions;
using kinematics::Machine;
using programs::TestPiece;

// Sine of how far a wall may lean over the stylus, whose ball is wider than its shank.
constexpr double kOverhang = 0.01;
constexpr double kAbove = 10.0;  // mm, between the ball and the highest of the blank

// The tool axis in the workpiece frame.
Vec3 tool_axis_at(const Machine& machine, const TestPiece& piece, const AxisPositions& pose) {
  return piece.placement.table_from_workpiece().rotation.transpose() *
         nominal_pose(machine, pose, 0.0).rotation.col(2);
}

std::string pose_text(const Machine& machine, const AxisPositions& pose) {
  std::string text;
  for (const auto letter : kinematics::kRotaryAxes) {
    if (machine.joint(letter) == nullptr) continue;
    text += fmt::format("{}{} = {:g} deg", text.empty() ? "" : ", ", to_char(letter),
                        as_stated(pose[letter] * kDegPerRad));
  }
  return text.empty() ? "its only pose" : text;
}

std::string place_of_point(const TestPiece& piece, const PartTouch& touch, std::size_t index) {
  return fmt::format("feature '{}', point {} at [{:.3f}, {:.3f}, {:.3f}]",
                     piece.plan.features[touch.feature].name, index + 1, touch.point.x(),
                     touch.point.y(), touch.point.z());
}

Vec3 linear_part(const AxisPositions& q) {
  return {q[AxisLetter::X], q[AxisLetter::Y], q[AxisLetter::Z]};
}

// The highest Z at which the blank is at a pose.
double top_of(const Machine& machine, const TestPiece& piece, const PartTouches& plan,
              const AxisPositions& pose, const Box& bounds) {
  double top = -HUGE_VAL;
  for (int corner = 0; corner < 8; ++corner) {
    Vec3 at;
    for (int k = 0; k < 3; ++k) at[k] = ((corner >> k) & 1) != 0 ? bounds.max[k] : bounds.min[k];
    const AxisPositions q = ball_at(machine, piece, pose, 0.0, at);
    top = std::max(top, q[AxisLetter::Z] - plan.origin[AxisLetter::Z]);
  }
  return top;
}

// The highest while the rotary axes turn, each in its own time, between zero and the poses.
double top_while_turning(const Machine& machine, const TestPiece& piece, const PartTouches& plan,
                         const Box& bounds) {
  constexpr double kStep = 5.0 * kRadPerDeg;
  std::vector<AxisPositions> places{{}};
  int turning = 0;
  for (const auto letter : kinematics::kRotaryAxes) {
    double low = 0.0, high = 0.0;
    for (const AxisPositions& pose : plan.poses) {
      low = std::min(low, pose[letter]);
      high = std::max(high, pose[letter]);
    }
    const int steps = static_cast<int>(std::ceil((high - low) / kStep));
    if (steps > 0) ++turning;
    std::vector<AxisPositions> with_axis;
    for (const AxisPositions& place : places) {
      for (int i = 0; i <= steps; ++i) {
        with_axis.push_back(place);
        with_axis.back()[letter] =
            steps == 0 ? low : std::lerp(low, high, static_cast<double>(i) / steps);
      }
    }
    places = std::move(with_axis);
  }
  double top = -HUGE_VAL, lowest = HUGE_VAL;
  for (const AxisPositions& place : places) {
    const double here = top_of(machine, piece, plan, place, bounds);
    top = std::max(top, here);
    lowest = std::min(lowest, here);
  }
  // Between two places a corner rises above both by less than this share of its way up and down.
  return top + turning * (1.0 - std::cos(0.5 * kStep)) * 2.0 * (top - lowest);
}

// Straight up from where the axes are.
AxisPositions lifted(const Machine& machine, const TestPiece& piece, const PartTouches& plan,
                     const PartTouch& touch, const Vec3& centre, AxisPositions q) {
  q[AxisLetter::Z] += plan.safe - words_of(machine, piece, plan, touch, centre).z();
  return q;
}

std::optional<Diagnostic> beyond_travel(const Machine& machine, const AxisPositions& q,
                                        const std::string& place) {
  if (within_travel(machine, q)) return std::nullopt;
  return error(
      "axis-overtravel"_id,
      fmt::format("{} cannot be probed: {}", place, fmt::join(travel_violations(machine, q), "; ")),
      "another pose (--at), another tool length, or less to be probed");
}

metrology::Stylus stylus_along(const Vec3& axis, double ball_radius) {
  metrology::Stylus stylus;
  stylus.direction = metrology::unit(axis);
  stylus.diameter = std::min(stylus.diameter, ball_radius);
  return stylus;
}

}  // namespace

AxisPositions upright_position(const Machine& machine, const TestPiece& piece) {
  const Vec3 up = piece.placement.table_from_workpiece().rotation.col(2);
  const auto solutions = orient(machine, up, {});
  if (!solutions) return {};
  const auto turned = [](const AxisPositions& q) {
    double sum = 0.0;
    for (const auto letter : kinematics::kRotaryAxes) sum += std::abs(q[letter]);
    return sum;
  };
  std::optional<AxisPositions> best;
  for (const auto& solution : *solutions) {
    AxisPositions q;
    for (const auto letter : kinematics::kRotaryAxes) q[letter] = solution.axes[letter];
    const auto reached = [&](const AxisPositions& at) {
      return std::ranges::all_of(kinematics::kRotaryAxes, [&](AxisLetter letter) {
        const kinematics::Joint* joint = machine.joint(letter);
        return joint == nullptr || joint->endless ||
               (at[letter] >= joint->travel.lo && at[letter] <= joint->travel.hi);
      });
    };
    if (reached(q) && (!best || turned(q) < turned(*best) - 1e-9)) best = q;
  }
  return best.value_or(AxisPositions{});
}

AxisPositions ball_at(const Machine& machine, const TestPiece& piece, const AxisPositions& pose,
                      double tool_length, const Vec3& centre) {
  return place_tip(machine, piece.placement.table_from_workpiece().point(centre), tool_length,
                   pose);
}

Vec3 words_of(const Machine& machine, const TestPiece& piece, const PartTouches& plan,
              const PartTouch& touch, const Vec3& centre) {
  return linear_part(ball_at(machine, piece, plan.poses[touch.pose], 0.0, centre)) -
         linear_part(plan.origin);
}

Vec3 centre_of(const PartTouches& plan, const PartTouch& touch, double reading) {
  return touch.point + (plan.ball_radius + reading) * touch.normal;
}

Result<PartTouches> part_touches(const Machine& machine, const TestPiece& piece,
                                 std::span<const AxisPositions> poses, const PartProbe& probe) {
  if (Diagnostics faults = metrology::check(piece.plan); has_error(faults)) return faults;
  const auto blank = stock::Blank::make(piece.blank, piece.blank_origin);
  if (!blank) return blank.error();
  const metrology::ProbeSettings& settings = piece.plan.probe;
  PartTouches plan{.poses = {poses.begin(), poses.end()},
                   .ball_radius = 0.5 * settings.ball_diameter,
                   .clearance = settings.clearance,
                   .reach = settings.reach};
  const auto offset = piece.work_offsets.find(1);
  plan.origin = place_tip(
      machine, offset != piece.work_offsets.end() ? offset->second : piece.placement.origin, 0.0,
      {});
  std::vector<Vec3> axes;
  for (const AxisPositions& pose : poses) {
    axes.push_back(tool_axis_at(machine, piece, pose));
    plan.safe = std::max(plan.safe, top_of(machine, piece, plan, pose, blank->bounds()));
  }
  plan.safe += plan.ball_radius + kAbove;
  plan.turning = std::max(plan.safe, top_while_turning(machine, piece, plan, blank->bounds()) +
                                         plan.ball_radius + kAbove);
  for (std::size_t f = 0; f < piece.plan.features.size(); ++f) {
    std::size_t index = 0;
    for (const auto& planned : metrology::planned_points(piece.plan.features[f])) {
      PartTouch touch{.feature = f,
                      .section = planned.section,
                      .point = planned.point,
                      .normal = planned.normal.normalized()};
      const auto reaching = std::ranges::find_if(
          axes, [&](const Vec3& axis) { return touch.normal.dot(axis) >= -kOverhang; });
      const std::string place = place_of_point(piece, touch, index++);
      if (reaching == axes.end()) {
        return error("point-unreachable"_id,
                     fmt::format("{}: the surface faces away from the stylus at {}", place,
                                 pose_text(machine, poses.front())),
                     "--at with poses that turn it up, \"A=0,C=0;A=-90,C=0\": each point is probed "
                     "at the first from which it is reached");
      }
      touch.pose = static_cast<std::size_t>(reaching - axes.begin());
      for (const double off : {plan.clearance, -plan.reach}) {
        const AxisPositions q = ball_at(machine, piece, plan.poses[touch.pose], probe.tool_length,
                                        centre_of(plan, touch, off));
        const AxisPositions up =
            lifted(machine, piece, plan, touch, centre_of(plan, touch, off), q);
        for (const AxisPositions& each : {q, up}) {
          if (auto problem = beyond_travel(machine, each, place)) return *std::move(problem);
        }
        AxisPositions turning = up;
        turning[AxisLetter::Z] += plan.turning - plan.safe;
        plan.can_turn = plan.can_turn && within_travel(machine, turning);
      }
      plan.touches.push_back(touch);
    }
  }
  return plan;
}

Result<PartReadings> part_readings(const Machine& machine,
                                   const kinematics::GeometricErrors& errors,
                                   const TestPiece& piece, const stock::Workpiece& part,
                                   const PartTouches& plan, const PartProbe& probe) {
  constexpr double kDone = 1e-11;  // mm: a few roundings of a coordinate
  constexpr int kMostSteps = 20;
  constexpr std::size_t kStops = 5, kContact = 2;
  // Over the place, down, on to the surface, back, up: from which sides the axes come.
  std::vector<instruments::TestPose> stops;
  for (const PartTouch& touch : plan.touches) {
    const AxisPositions& pose = plan.poses[touch.pose];
    const Vec3 out = centre_of(plan, touch, plan.clearance);
    const AxisPositions before = ball_at(machine, piece, pose, probe.tool_length, out);
    const AxisPositions over = lifted(machine, piece, plan, touch, out, before);
    const AxisPositions on =
        ball_at(machine, piece, pose, probe.tool_length, centre_of(plan, touch, 0.0));
    for (const AxisPositions& q : {over, before, on, before, over}) {
      stops.push_back({.at = q});
    }
  }
  if (!stops.empty()) {
    const AxisPositions start = stops.front().at.q;
    stops = instruments::with_approach(std::move(stops), start, errors);
  }
  const kinematics::ForwardChain actual(machine, errors, probe.tool_length);
  const Pose workpiece_from_table = piece.placement.table_from_workpiece().inverse();
  const WorkpieceProbe surface(part);
  PartReadings found;
  metrology::StylusFaults faults;
  std::size_t index = 0;
  const auto end_of_feature = [&](std::size_t feature) {
    if (auto warned = faults.warning_for(piece.plan.features[feature].name, index)) {
      found.warnings.push_back(*std::move(warned));
    }
    faults = {};
    index = 0;
  };
  for (std::size_t t = 0; t < plan.touches.size(); ++t) {
    const PartTouch& touch = plan.touches[t];
    if (t > 0 && touch.feature != plan.touches[t - 1].feature) {
      end_of_feature(plan.touches[t - 1].feature);
    }
    const AxisPositions& pose = plan.poses[touch.pose];
    kinematics::AxisState at = stops[kStops * t + kContact].at;
    double reading = 0.0;
    bool done = false;
    for (int step = 0; step < kMostSteps && !done; ++step) {
      const Vec3 commanded = centre_of(plan, touch, reading);
      at.q = ball_at(machine, piece, pose, probe.tool_length, commanded);
      const Vec3 ball =
          workpiece_from_table.point(actual.table_from_tool(at).point(probe.ball_off));
      const Vec3 off = ball - commanded;
      const metrology::BallApproach approach{touch.point + off, metrology::unit(touch.normal),
                                             plan.ball_radius, plan.clearance, plan.reach};
      const auto contact = metrology::touch_with_ball(surface, approach);
      if (contact.state != metrology::ContactState::contact) {
        return error("touch-missed"_id,
                     fmt::format("{}: {}", place_of_point(piece, touch, index),
                                 contact.state == metrology::ContactState::starts_inside
                                     ? "the ball would start inside the material"
                                     : fmt::format("no surface within {:g} mm behind its nominal "
                                                   "place",
                                                   plan.reach)),
                     "check errors, probe.clearance and probe.reach of the plan");
      }
      const double next = (contact.centre - touch.point - off).dot(touch.normal) - plan.ball_radius;
      done = std::abs(next - reading) < kDone;
      reading = next;
      if (done) {
        const Vec3 axis = tool_axis_at(machine, piece, pose);
        faults.note(
            stylus_fault(surface, stylus_along(axis, plan.ball_radius), approach, contact.centre),
            index);
      }
    }
    const Vec3 outward_in_tool = nominal_pose(machine, pose, 0.0).rotation.transpose() *
                                 (workpiece_from_table.rotation.transpose() * touch.normal);
    found.values.push_back(reading - instruments::pre_travel(probe.lobes, outward_in_tool));
    found.at.push_back(at);
    ++index;
  }
  if (!plan.touches.empty()) end_of_feature(plan.touches.back().feature);
  return found;
}

Result<metrology::Measurement> part_measurement(const TestPiece& piece, const PartTouches& plan,
                                                std::span<const double> readings) {
  const bool by_approach = piece.plan.probe.compensation == metrology::Compensation::approach;
  std::vector<metrology::FeaturePoints> features;
  for (const auto& feature : piece.plan.features) features.push_back({feature.name, {}, {}});
  for (std::size_t t = 0; t < plan.touches.size(); ++t) {
    const PartTouch& touch = plan.touches[t];
    Vec3 at = centre_of(plan, touch, readings[t]);
    if (by_approach) at -= plan.ball_radius * touch.normal;
    features[touch.feature].points.push_back(at);
    features[touch.feature].sections.push_back(touch.section);
  }
  return metrology::evaluate(
      piece.plan, features,
      by_approach ? metrology::PointMeaning::surface : metrology::PointMeaning::ball_centre);
}

}  // namespace frustum::trials

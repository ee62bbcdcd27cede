// Touch-trigger calibration of A and C: numbers computed apart, and what holds on any machine.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <nlohmann/json.hpp>

#include "core/random.hpp"
#include "instruments/instrument.hpp"
#include "instruments/table_maps.hpp"
#include "instruments/touch_test.hpp"
#include "tests/instruments/motion_numbers.hpp"

namespace frustum::instruments {
namespace {

using kinematics::AxisLetter;
using kinematics::GeometricErrors;
using kinematics::Machine;
using kinematics::shipped;

const json& numbers() {
  static const json kNumbers = json::parse(
      std::ifstream(std::string(FRUSTUM_SOURCE_DIR) + "/tests/data/touch_probing.json"));
  return kNumbers;
}

// um and urad, as the numbers have them, in mm and rad.
ErrorVector error_vector(const json& v) {
  ErrorVector out;
  for (Eigen::Index k = 0; k < 6; ++k) {
    out[k] = v[static_cast<std::size_t>(k)].get<double>() / (k < 3 ? kUmPerMm : kUradPerRad);
  }
  return out;
}
std::vector<ErrorVector> row_of(const json& rows) {
  std::vector<ErrorVector> out;
  for (const json& each : rows) out.push_back(error_vector(each));
  return out;
}
std::vector<std::vector<ErrorVector>> grid_of(const json& rows) {
  std::vector<std::vector<ErrorVector>> out;
  for (const json& each : rows) out.push_back(row_of(each));
  return out;
}
TableMaps maps_of(const json& maps) {
  return {.tilt = row_of(maps["A"]), .turn = grid_of(maps["C"])};
}

// Largest differences: um of translations, urad of rotations.
struct Worst {
  double um = 0.0;
  double urad = 0.0;
  void take(const ErrorVector& a, const ErrorVector& b) {
    const ErrorVector d = a - b;
    um = std::max(um, d.head<3>().cwiseAbs().maxCoeff() * kUmPerMm);
    urad = std::max(urad, d.tail<3>().cwiseAbs().maxCoeff() * kUradPerRad);
  }
};
Worst difference(const TableMaps& a, const TableMaps& b) {
  Worst worst;
  for (std::size_t i = 0; i < a.tilt.size(); ++i) {
    worst.take(a.tilt[i], b.tilt[i]);
    for (std::size_t j = 0; j < a.turn[i].size(); ++j) worst.take(a.turn[i][j], b.turn[i][j]);
  }
  return worst;
}

TableMaps scaled(TableMaps maps, double factor) {
  for (auto& each : maps.tilt) each *= factor;
  for (auto& row : maps.turn) {
    for (auto& each : row) each *= factor;
  }
  return maps;
}

// Errors that have these values where the plan stops.
GeometricErrors with_maps(const TouchPlan& plan, const TableMaps& maps) {
  std::vector<std::size_t> order(plan.tilts.size());
  for (std::size_t i = 0; i < order.size(); ++i) order[i] = i;
  std::ranges::sort(order, {}, [&](std::size_t i) { return plan.tilts[i].axis; });
  GeometricErrors errors;
  for (std::size_t k = 0; k < 6; ++k) {
    std::vector<std::pair<double, double>> points;
    kinematics::SurfaceTerm surface;
    for (const TablePosition& turn : plan.turns) surface.second_positions.push_back(turn.axis);
    const auto at = static_cast<Eigen::Index>(k);
    for (const std::size_t i : order) {
      points.emplace_back(plan.tilts[i].axis, maps.tilt[i][at]);
      surface.first_positions.push_back(plan.tilts[i].axis);
      for (const ErrorVector& each : maps.turn[i]) surface.values.push_back(each[at]);
    }
    errors[AxisLetter::A].component.at(k) = kinematics::ErrorFunction(
        {kinematics::TableTerm::of(points, kinematics::TableKind::linear, false)});
    errors[AxisLetter::C].component.at(k) = kinematics::ErrorFunction({surface});
  }
  return errors;
}

// Maps whose C has no mean over its positions.
TableMaps random_maps(const TouchPlan& plan, std::uint32_t draw) {
  const RandomKey key{.seed = 24, .draw = draw};
  std::uint64_t index = 0;
  const auto random = [&] {
    ErrorVector v;
    for (Eigen::Index k = 0; k < 6; ++k) v[k] = (k < 3 ? 0.004 : 1.5e-5) * normal(key, index++);
    return v;
  };
  TableMaps maps;
  for (std::size_t i = 0; i < plan.tilts.size(); ++i) {
    maps.tilt.push_back(random());
    std::vector<ErrorVector> row;
    ErrorVector mean = ErrorVector::Zero();
    for (std::size_t j = 0; j < plan.turns.size(); ++j) {
      row.push_back(random());
      mean += row.back() / static_cast<double>(plan.turns.size());
    }
    for (ErrorVector& each : row) each -= mean;
    maps.turn.push_back(std::move(row));
  }
  return maps;
}

struct Calibration {
  Machine machine;
  TouchPlan plan = *touch_plan(machine);

  [[nodiscard]] std::vector<double> readings(const GeometricErrors& errors,
                                             const TouchSetup& setup = {},
                                             const TouchProbe& probe = {}) const {
    const auto poses = touch_poses(machine, errors, plan, probe);
    return *touch_readings(machine, errors, plan, *poses, probe, setup);
  }
  [[nodiscard]] TableMaps identified(const GeometricErrors& errors,
                                     const TouchSetup& setup = {}) const {
    return identified_maps(plan, readings(errors, setup));
  }
  [[nodiscard]] TableMaps visible(const GeometricErrors& errors) const {
    return visible_maps(machine, errors, plan, *touch_poses(machine, errors, plan, {}));
  }
};

Calibration ac_probe() { return {shipped("ac-probe")}; }

TEST(TouchPlanReference, PointsAndTouches) {
  const Calibration c = ac_probe();
  ASSERT_EQ(numbers()["points"].size(), kTouchPoints);
  for (std::size_t k = 0; k < kTouchPoints; ++k) {
    const json& point = numbers()["points"][k];
    EXPECT_EQ(touch_points().at(k).place, vector_of(point["p_mm"])) << k;
    EXPECT_EQ(touch_points().at(k).normal, vector_of(point["n"])) << k;
  }
  std::vector<std::array<std::size_t, 3>> planned, expected;
  for (const PlannedTouch& t : c.plan.touches) planned.push_back({t.tilt, t.turn, t.point});
  for (const json& pose : numbers()["plan"]) {
    for (const json& k : pose["k"]) expected.push_back({pose["i"], pose["j"], k});
  }
  EXPECT_EQ(planned, expected);
  EXPECT_EQ(planned.size(), numbers()["total"].get<std::size_t>());
  for (std::size_t i = 0; i < 4; ++i) {
    EXPECT_NEAR(c.plan.tilts[i].axis * kDegPerRad, numbers()["A_deg"][i].get<double>(), 1e-12);
  }
  for (std::size_t j = 0; j < 6; ++j) {
    EXPECT_NEAR(c.plan.turns[j].axis * kDegPerRad, numbers()["C_deg"][j].get<double>(), 1e-12);
  }
}

// On the way in, from the ball centre up: a stylus not thicker than the ball, and a holder 100 mm
// above it.
TEST(TouchPlanLaws, StylusAndHolderAreClearOfTheColumns) {
  const json& geometry = numbers()["geometry"];
  const double half = geometry["half"], bottom = geometry["table_z"];
  const double height = geometry["height"], radius = geometry["ball_radius"];
  const double stylus = geometry["stylus"], holder = geometry["holder_radius"];
  constexpr double kRounding = 1e-9;
  const Calibration c = ac_probe();
  double nearest_holder = 1e9;
  for (const PlannedTouch& touch : c.plan.touches) {
    const TouchPoint& point = touch_points().at(touch.point);
    const Mat3 rotation = c.plan.rotation(touch);
    EXPECT_GE((rotation * point.normal).z(), -kRounding) << touch.point;
    for (double off = 0.0; off <= kTouchApproach; off += 2.0) {
      const Vec3 ball = rotation * (point.place + (radius + off) * point.normal);
      for (const json& centre : geometry["centres"]) {
        const Vec3 low(centre[0].get<double>() - half, centre[1].get<double>() - half, bottom);
        const Vec3 high = low + Vec3(2.0 * half, 2.0 * half, height);
        const auto distance = [&](double up) {
          const Vec3 p = rotation.transpose() * (ball + Vec3(0.0, 0.0, up));
          return (p - p.cwiseMax(low).cwiseMin(high)).norm();
        };
        for (double up = 0.0; up < 400.0; up += 0.5) {
          EXPECT_GE(distance(up), radius - kRounding) << touch.point << ' ' << up;
          if (up >= stylus) nearest_holder = std::min(nearest_holder, distance(up));
        }
      }
    }
  }
  EXPECT_GE(nearest_holder, holder);
}

TEST(TouchMapsReference, IdentifiedMaps) {
  const Calibration c = ac_probe();
  const GeometricErrors errors = with_maps(c.plan, maps_of(numbers()["maps_gauge_fixed"]));
  const TableMaps found = c.identified(errors);
  const json& expected = numbers()["identified_gauge_fixed"];
  const Worst off = difference(found, maps_of(expected));
  EXPECT_LT(off.um, 2e-6);
  EXPECT_LT(off.urad, 2e-6);
  const auto poses = grid_of(expected["poses"]);
  Worst of_poses;
  for (std::size_t i = 0; i < 4; ++i) {
    for (std::size_t j = 0; j < 6; ++j) of_poses.take(found.poses[i][j], poses[i][j]);
  }
  EXPECT_LT(of_poses.um, 2e-6);
  EXPECT_LT(of_poses.urad, 2e-6);
}

TEST(TouchMapsReference, WhatIsLeftIsOfSecondOrder) {
  const Calibration c = ac_probe();
  const TableMaps truth = maps_of(numbers()["maps_gauge_fixed"]);
  const json& expected = numbers()["roundtrip_worst_um_urad"];
  Worst before;
  for (const auto& [factor, name] : {std::pair{0.5, "gauge-fixed maps x 0.5"},
                                     {1.0, "gauge-fixed maps, linear LSQ (9)"},
                                     {2.0, "gauge-fixed maps x 2"},
                                     {4.0, "gauge-fixed maps x 4"},
                                     {8.0, "gauge-fixed maps x 8"}}) {
    const TableMaps maps = scaled(truth, factor);
    const Worst off = difference(c.identified(with_maps(c.plan, maps)), maps);
    // The maps of the numbers are rounded to 1e-6.
    EXPECT_NEAR(off.um, expected[name][0].get<double>(), 4e-6 * factor) << name;
    EXPECT_NEAR(off.urad, expected[name][1].get<double>(), 4e-6 * factor) << name;
    if (factor == 1.0) {
      EXPECT_LT(off.um, 0.001);
      EXPECT_LT(off.urad, 0.001);
    }
    if (factor > 1.0) {
      EXPECT_NEAR(off.um / before.um, 4.0, 0.2) << name;
      EXPECT_NEAR(off.urad / before.urad, 4.0, 0.2) << name;
    }
    before = off;
  }
}

// The inverse of the rotation of A belongs there.
TEST(TouchMapsReference, TheRotationOfATurnsBack) {
  const Calibration c = ac_probe();
  const TableMaps truth = maps_of(numbers()["maps_gauge_fixed"]);
  TableMaps wrong = c.identified(with_maps(c.plan, truth));
  for (std::size_t i = 0; i < 4; ++i) {
    const Mat3 twice = c.plan.tilts[i].rotation * c.plan.tilts[i].rotation;
    for (ErrorVector& each : wrong.turn[i]) {
      each.head<3>() = (twice * each.head<3>()).eval();
      each.tail<3>() = (twice * each.tail<3>()).eval();
    }
  }
  const Worst off = difference(wrong, truth);
  const json& expected =
      numbers()["roundtrip_worst_um_urad"]["(13) with D4(A) instead of its inverse"];
  EXPECT_NEAR(off.um, expected[0].get<double>(), 1e-5);
  EXPECT_NEAR(off.urad, expected[1].get<double>(), 1e-5);
}

TEST(TouchMapsReference, StandardDeviations) {
  const Calibration c = ac_probe();
  const TableMaps sd = standard_deviations(c.plan, numbers()["sigma_um"].get<double>() / kUmPerMm);
  const Worst off = difference(sd, {.tilt = row_of(numbers()["sd_A_analytic"]),
                                    .turn = grid_of(numbers()["sd_C_analytic"])});
  EXPECT_LT(off.um, 1e-6);
  EXPECT_LT(off.urad, 1e-6);
  const auto poses = grid_of(numbers()["sd_pose_analytic"]);
  Worst of_poses;
  for (std::size_t i = 0; i < 4; ++i) {
    for (std::size_t j = 0; j < 6; ++j) of_poses.take(sd.poses[i][j], poses[i][j]);
  }
  EXPECT_LT(of_poses.um, 1e-6);
  EXPECT_LT(of_poses.urad, 1e-6);
}

TEST(TouchMapsReference, NoiseScattersAsItIsPropagated) {
  constexpr std::uint32_t kRuns = 2000;
  const Calibration c = ac_probe();
  const double noise = numbers()["sigma_um"].get<double>() / kUmPerMm;
  const TableMaps truth = maps_of(numbers()["maps_gauge_fixed"]);
  const auto readings = c.readings(with_maps(c.plan, truth));
  const TableMaps exact = identified_maps(c.plan, readings);
  const TableMaps sd = standard_deviations(c.plan, noise);
  std::vector<ErrorVector> squares(4 + 24, ErrorVector::Zero());
  for (std::uint32_t run = 0; run < kRuns; ++run) {
    const TableMaps maps =
        identified_maps(c.plan, shown({.noise = noise, .seed = 7}, readings, run));
    for (std::size_t i = 0; i < 4; ++i) {
      squares[i] += (maps.tilt[i] - exact.tilt[i]).cwiseAbs2();
      for (std::size_t j = 0; j < 6; ++j) {
        squares[4 + 6 * i + j] += (maps.turn[i][j] - exact.turn[i][j]).cwiseAbs2();
      }
    }
  }
  for (std::size_t at = 0; at < squares.size(); ++at) {
    const ErrorVector& expected = at < 4 ? sd.tilt[at] : sd.turn[(at - 4) / 6][(at - 4) % 6];
    for (Eigen::Index k = 0; k < 6; ++k) {
      EXPECT_NEAR(std::sqrt(squares[at][k] / kRuns) / expected[k], 1.0, 0.1) << at << ' ' << k;
    }
  }
}

TEST(TouchMapsReference, NeglectedSquareness) {
  const Calibration c = ac_probe();
  const TableMaps truth = maps_of(numbers()["maps_gauge_fixed"]);
  GeometricErrors errors = with_maps(c.plan, truth);
  errors[AxisLetter::Y].location[5] = 1e-5;
  const Worst off = difference(c.identified(errors), truth);
  const json& expected =
      numbers()["roundtrip_worst_um_urad"]["linear axes with gamma_XY = 10 urad, ignored"];
  EXPECT_NEAR(off.um, expected[0].get<double>(), 1e-3);
  EXPECT_NEAR(off.urad, expected[1].get<double>(), 1e-3);
}

TEST(TouchMapsLaws, TheErrorAtZeroIsNotSeenAndTurnsWithTheTable) {
  const Calibration c = ac_probe();
  for (std::uint32_t draw = 0; draw < 20; ++draw) {
    const TableMaps truth = random_maps(c.plan, draw);
    const GeometricErrors errors = with_maps(c.plan, truth);
    const TableMaps found = c.identified(errors);
    const Worst direct = difference(found, truth);
    EXPECT_GT(direct.um, 0.1);
    TableMaps expected = truth;
    const ErrorVector e = truth.tilt[0] + truth.turn[0][0];
    for (std::size_t i = 0; i < 4; ++i) {
      for (const Eigen::Index from : {0, 3}) {
        const Vec3 part = e.segment<3>(from);
        expected.tilt[i].segment<3>(from) -= c.plan.tilts[i].rotation * Vec3(0.0, 0.0, part.z());
        for (std::size_t j = 0; j < 6; ++j) {
          expected.turn[i][j].segment<3>(from) -=
              c.plan.turns[j].rotation * Vec3(part.x(), part.y(), 0.0);
        }
      }
    }
    const Worst after = difference(found, expected);
    EXPECT_LT(after.um, 0.0015) << draw;
    EXPECT_LT(after.urad, 0.0015) << draw;
    const Worst by_room = difference(c.visible(errors), expected);
    EXPECT_LT(by_room.um, 1e-9) << draw;
    EXPECT_LT(by_room.urad, 1e-9) << draw;
  }
}

// Another sense of both axes, location errors, errors in the frame of the rotor.
TEST(TouchMapsLaws, EveryTableOfAAndCIsSeenTheSame) {
  const auto rotor = kinematics::machine_from_text(R"(
name = "rotor"
structure = "t-(C)-Z-Y-X-b-A-C-w"
rotary_error_frame = "rotor"
[axis.X]
travel = [-500, 500]
[axis.Y]
travel = [-500, 500]
[axis.Z]
travel = [-500, 500]
[axis.A]
travel = [-120, 120]
[axis.C]
endless = true
)");
  ASSERT_TRUE(rotor) << rotor.error().front().message;
  for (const Machine& machine : {shipped("ac-probe"), shipped("zx-yac"), *rotor}) {
    const Calibration c{machine};
    const GeometricErrors errors = errors_of(
        machine, {"EX0A=3um", "EZ0A=-4um", "EB0A=12urad", "EY0C=5um", "EA0C=-8urad", "EB0C=9urad",
                  "EXC=harmonic 1 4um", "EAC=harmonic 2 9urad", "EAA=linear 30urad",
                  "EYA=harmonic 1 5um phase 40deg", "EZC=harmonic 1 2um phase 20deg"});
    const Worst off = difference(c.identified(errors), c.visible(errors));
    EXPECT_LT(off.um, 0.002) << machine.name();
    EXPECT_LT(off.urad, 0.003) << machine.name();
    EXPECT_GT(difference(c.visible(errors), c.visible({})).um, 5.0) << machine.name();
  }
}

TEST(TouchMapsLaws, NothingIsFoundWhereNothingIs) {
  for (const char* name : {"ac-probe", "zx-yac"}) {
    const Calibration c{shipped(name)};
    const GeometricErrors none;
    for (const double reading : c.readings(none)) EXPECT_LT(std::abs(reading), 1e-9) << name;
    const Worst off = difference(c.identified(none), c.visible(none));
    EXPECT_LT(off.um, 1e-6) << name;
    EXPECT_LT(off.urad, 1e-6) << name;
  }
}

TEST(TouchMapsLaws, HowProbeAndArtefactAreMountedMattersLittle) {
  const Calibration c = ac_probe();
  const TableMaps truth = maps_of(numbers()["maps_gauge_fixed"]);
  const GeometricErrors errors = with_maps(c.plan, truth);
  // Readings that are longer by the same everywhere: pretravel.
  std::vector<double> readings = c.readings(errors);
  const TableMaps found = identified_maps(c.plan, readings);
  for (double& each : readings) each += 0.01;
  const Worst pretravel = difference(identified_maps(c.plan, readings), found);
  EXPECT_LT(pretravel.um, 0.002);
  EXPECT_LT(pretravel.urad, 0.01);
  const Worst near = difference(
      c.identified(errors, {.shift = {0.3, -0.3, 0.25}, .tilt = {6e-4, -6e-4, 5e-4}}), truth);
  EXPECT_LT(near.um, 0.02);
  EXPECT_LT(near.urad, 0.2);
  const Worst far = difference(
      c.identified(errors, {.shift = {1.2, -1.2, 1.0}, .tilt = {3e-3, -3e-3, 3e-3}}), truth);
  EXPECT_LT(far.um, 0.1);
  EXPECT_LT(far.urad, 1.0);
  EXPECT_GT(far.urad, near.urad);
  // A ball off the spindle's axis does matter: it stays while the table turns.
  const Worst off = difference(c.identified(errors, {.ball = {0.005, 0.0, 0.0}}), truth);
  EXPECT_GT(off.um, 1.0);
}

TEST(TouchMapsFaults, MachinesAndTouchesThatCannotBe) {
  EXPECT_EQ(touch_plan(shipped("iwf-bc")).error().front().id.text(), "machine-unsuited");
  EXPECT_EQ(touch_plan(shipped("three-axis")).error().front().id.text(), "machine-unsuited");
  EXPECT_EQ(touch_plan(shipped("swivel-head-table")).error().front().id.text(), "machine-unsuited");
  const Calibration c = ac_probe();
  EXPECT_EQ(touch_poses(c.machine, {}, c.plan, {.tool_length = 900.0}).error().front().id.text(),
            "axis-overtravel");
  const GeometricErrors far = errors_of(c.machine, {"EX0C=20mm"});
  const auto poses = touch_poses(c.machine, far, c.plan, {});
  EXPECT_EQ(touch_readings(c.machine, far, c.plan, *poses, {}, {}).error().front().id.text(),
            "touch-missed");
}

}  // namespace
}  // namespace frustum::instruments

#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <cmath>

#include "metrology/characteristic/best_shifted_line.hpp"
#include "step_part.hpp"
#include "synthetic.hpp"

namespace frustum::metrology {
namespace {

using step_part::part;
using step_part::Part;
using step_part::plan;

// Planes are met exactly; coordinates of 100 mm leave 1e-14 mm, slopes over 50 mm 1e-15 rad.
constexpr double kExactLine = 1e-7;  // um or urad

using Values = std::map<std::string, double>;

Values values_of(const Result<Measurement>& m) {
  EXPECT_TRUE(m) << (m ? "" : to_string(m.error().front()));
  Values values;
  if (!m) return values;
  for (const CharacteristicResult& c : m->characteristics) values[c.name] = c.value;
  return values;
}

void expect_values(const Values& found, const Values& wanted, double tolerance) {
  for (const auto& [name, value] : found) {
    const auto w = wanted.find(name);
    EXPECT_NEAR(value, w == wanted.end() ? 0.0 : w->second, tolerance) << name;
  }
  EXPECT_EQ(found.size(), plan().characteristics.size());
}

Values measured_values(const Part& body) { return values_of(measure(plan(), body)); }

Part with(const std::string& name, const step_part::Face& face) {
  Part changed = part();
  changed.faces.at(name) = face;
  return changed;
}

TEST(LineCharacteristic, AreZeroOnAPerfectPart) {
  const auto m = measure(plan(), part());
  expect_values(values_of(m), {}, kExactLine);
  const CharacteristicResult& c = m->characteristics[0];
  EXPECT_EQ(c.kind, "line_distance");
  EXPECT_EQ(c.unit, "um");
  EXPECT_DOUBLE_EQ(c.tolerance, 20.0);
  EXPECT_EQ(c.nominal, 0.0);
  EXPECT_TRUE(c.pass);
  EXPECT_EQ(m->characteristics[2].unit, "urad");
  EXPECT_DOUBLE_EQ(m->characteristics[2].tolerance, 200.0);
}

TEST(LineCharacteristicLaws, ARigidMotionOfThePartChangesNothing) {
  synthetic::Draws draws(51);
  Part flawed = part();
  flawed.faces.at("S_d") = part().faces.at("S_d").shifted(0.012);
  flawed.faces.at("B_d") = part().faces.at("B_d").shifted(-0.007);
  flawed.faces.at("E_c") = part().faces.at("E_c").shifted(0.005);
  const double half = std::sqrt(2.0);
  const Values wanted{{"dL", 12.0}, {"dH", -7.0}, {"dE", 5.0 * half}};
  for (int i = 0; i < 50; ++i) {
    const Pose lie{rotation_about(draws.direction(), draws.between(-0.02, 0.02)), draws.place(0.5)};
    const auto points = step_part::surface_points(plan(), flawed.moved(lie));
    expect_values(values_of(evaluate(plan(), points)), wanted, 1e-6);
  }
  // With a ball, whose centres are brought back along the planned normals: r e^2 / 2 a side, with
  // r = 1.5 mm and e = 1e-4 rad.
  for (int i = 0; i < 20; ++i) {
    const Pose lie{rotation_about(draws.direction(), 1e-4), draws.place(0.3)};
    expect_values(measured_values(flawed.moved(lie)), wanted, 4e-5);
  }
}

TEST(LineCharacteristic, SeeAShiftedSurfaceWithItsSign) {
  const Part p = part();
  expect_values(measured_values(with("S_d", p.faces.at("S_d").shifted(0.01))), {{"dL", 10.0}},
                kExactLine);
  expect_values(measured_values(with("S_c", p.faces.at("S_c").shifted(0.01))), {{"dL", 10.0}},
                kExactLine);
  expect_values(measured_values(with("S_b", p.faces.at("S_b").shifted(-0.01))), {{"dL0", -10.0}},
                kExactLine);
  expect_values(measured_values(with("B_d", p.faces.at("B_d").shifted(0.01))), {{"dH", 10.0}},
                kExactLine);
  expect_values(measured_values(with("B_c", p.faces.at("B_c").shifted(0.01))), {{"dH", -10.0}},
                kExactLine);
  const auto m = measure(plan(), with("S_d", p.faces.at("S_d").shifted(0.021)));
  ASSERT_TRUE(m);
  EXPECT_FALSE(m->characteristics[0].pass);
  const auto less = measure(plan(), with("S_d", p.faces.at("S_d").shifted(-0.021)));
  ASSERT_TRUE(less);
  EXPECT_FALSE(less->characteristics[0].pass);
}

TEST(LineCharacteristic, SeeATurnedSurfaceRightHanded) {
  const Part p = part();
  const double angle = 50e-6;
  // The ball is brought back along the line's own normal, so a turned line is met exactly; a wall
  // that is turned keeps its place at the pivot. tan and sin agree to 1e-13.
  const Vec3 middle(0, 30, 7.5);
  const auto turned = [&](const char* name, const Mat3& by, const Vec3& pivot) {
    return measured_values(with(name, p.faces.at(name).turned(by, pivot)));
  };
  expect_values(turned("S_d", rotation_z(angle), middle), {{"theta", 50.0}}, 1e-5);
  expect_values(turned("S_c", rotation_z(angle), {0, -30, 7.5}), {{"theta", -50.0}}, 1e-5);
  // y = 30 + angle (x - 20): at x = 0, where the distance is taken, 1 um less.
  expect_values(turned("S_d", rotation_z(angle), {20, 30, 7.5}), {{"theta", 50.0}, {"dL", -1.0}},
                1e-5);
  expect_values(turned("B_d", rotation_y(angle), {0, 35, 5}), {{"phi", 50.0}}, 1e-5);
  expect_values(turned("B_c", rotation_y(angle), {0, -35, 5}), {{"phi", -50.0}}, 1e-5);
  // Right-handed about Y is down along X: at x = 10 mm from the pivot 0.5 um up, read at x = 0.
  expect_values(turned("B_d", rotation_y(angle), {10, 35, 5}), {{"phi", 50.0}, {"dH", 0.5}}, 1e-5);
}

TEST(LineCharacteristic, DistanceIsTakenAtThePlannedPointOfTheFirst) {
  InspectionPlan p = plan();
  p.features[6].point.x() = 15.0;  // S_c
  std::get<LineStrategy>(p.features[6].strategy) = {-40.0, 10.0, 11};
  const Part body = with("S_d", part().faces.at("S_d").turned(rotation_z(40e-6), {0, 30, 7.5}));
  const Values values = values_of(measure(p, body));
  EXPECT_NEAR(values.at("dL"), 15.0 * 0.04, 1e-5);
  // The direction of a line has a sense that does not count.
  p = plan();
  p.features[7].axis = -p.features[7].axis;
  p.features[6].axis *= 3.0;
  expect_values(values_of(measure(p, body)), {{"theta", 40.0}}, 1e-5);
}

TEST(LineCharacteristic, ChamfersAreReadAtTheirHeightOverTheMeasuredFloors) {
  const double delta = 0.03;
  Part lowered = part();
  for (const char* name : {"F_a", "F_b"}) {
    lowered.faces.at(name) = part().faces.at(name).shifted(-delta);
  }
  // The frame sinks with the floors: a chamfer of 45 deg is wider by delta on both sides there.
  expect_values(measured_values(lowered), {{"dE", 2e3 * delta}}, kExactLine);
  // Without frame nothing changes at all.
  InspectionPlan as_probed = plan();
  for (PlannedCharacteristic& c : as_probed.characteristics) c.frame.clear();
  expect_values(values_of(measure(as_probed, lowered)), {}, kExactLine);
}

TEST(LineCharacteristic, TiltedFloorsTurnTheFrameAsTheRegressionOfTheirPointsSays) {
  // Unequal numbers of points: the floors weigh differently.
  InspectionPlan p = plan();
  std::get<GridStrategy>(p.features[1].strategy) = {{50, 0, 0}, {0, 4, 0}, 4, 2};
  Part tilted = part();
  tilted.faces.at("F_a") =
      part().faces.at("F_a").shifted(0.004).turned(rotation_x(60e-6), {0, -45, 0});
  tilted.faces.at("F_b") =
      part().faces.at("F_b").shifted(-0.009).turned(rotation_x(-90e-6), {0, 45, 0});
  // Plane z = c + s y through all points, by the normal equations.
  Eigen::Matrix2d normal = Eigen::Matrix2d::Zero();
  Eigen::Vector2d right = Eigen::Vector2d::Zero();
  for (const FeaturePoints& f : step_part::surface_points(p, tilted)) {
    if (f.feature[0] != 'F') continue;
    for (const Vec3& x : f.points) {
      const Eigen::Vector2d row(1.0, x.y());
      normal += row * row.transpose();
      right += x.z() * row;
    }
  }
  const Eigen::Vector2d plane = normal.ldlt().solve(right);
  const double slope = plane[1];
  EXPECT_GT(std::abs(slope), 100e-6);
  // dH: the floors c, d are 70 mm apart. dE: the chamfers sit at y = -20 and 20, where the frame
  // has risen by c - 20 s and c + 20 s: each loses that, of the difference nothing is left of s.
  expect_values(values_of(measure(p, tilted)),
                {{"dH", -1e3 * 70.0 * slope}, {"dE", -2e3 * plane[0]}}, 2e-3);
}

TEST(LineCharacteristic, ProfilesAreWhatThePointsDeviateAlongTheDirection) {
  const double angle = 80e-6;
  Part body = part();
  body.faces.at("S_d") = body.faces.at("S_d").shifted(0.01).turned(rotation_z(angle), {0, 30, 7.5});
  body.faces.at("S_c") = body.faces.at("S_c").shifted(0.003);
  const auto m = measure(plan(), body);
  ASSERT_TRUE(m);
  const CharacteristicResult& c = m->characteristics[0];
  ASSERT_EQ(c.profiles.size(), 2U);
  EXPECT_EQ(c.profiles[0].feature, "S_c");
  const LineProfile& d = c.profiles[1];
  EXPECT_EQ(d.feature, "S_d");
  EXPECT_NEAR(c.profiles[0].fit_offset, -0.003, 1e-9);  // outward is -Y
  EXPECT_NEAR(d.fit_offset, 0.01, 1e-9);
  EXPECT_NEAR(d.fit_slope, angle, 1e-11);
  ASSERT_EQ(d.position.size(), 11U);
  for (std::size_t i = 0; i < d.position.size(); ++i) {
    EXPECT_NEAR(d.position[i], -25.0 + 5.0 * static_cast<double>(i), 1e-3);
    EXPECT_NEAR(d.deviation[i], 0.01 + angle * d.position[i], 1e-9);
  }
}

TEST(LineCharacteristic, SayWhichPointsAreMissing) {
  auto points = step_part::surface_points(plan(), part());
  const auto without = [&](std::size_t index) {
    auto fewer = points;
    fewer.erase(fewer.begin() + static_cast<std::ptrdiff_t>(index));
    const auto m = evaluate(plan(), fewer);
    return m ? std::string() : to_string(m.error().front());
  };
  EXPECT_EQ(without(0),
            "error: frame 'R': feature 'F_a' has no points (hint: measure it, or take the "
            "characteristics in this frame out of the plan)");
  EXPECT_EQ(without(2),
            "error: frame 'R': feature 'S_a' has no points (hint: measure it, or take the "
            "characteristics in this frame out of the plan)");
  EXPECT_EQ(without(7),
            "error: characteristic 'dL': feature 'S_d' has no points (hint: measure the feature, "
            "or take the characteristic out of the plan)");
  for (Vec3& x : points[7].points) x = Vec3(1, 30, x.x());  // all at one place along the line
  const auto m = evaluate(plan(), points);
  ASSERT_FALSE(m);
  EXPECT_EQ(m.error().front().message,
            "characteristic 'dL': feature 'S_d': the points are at one place along the line");
}

TEST(InternalValue, UndoesTheUnitOfACharacteristic) {
  EXPECT_DOUBLE_EQ(internal_value(12.0, "um"), 0.012);
  EXPECT_DOUBLE_EQ(internal_value(12.0, "mm"), 12.0);
  EXPECT_DOUBLE_EQ(internal_value(30.0, "urad"), 30e-6);
  EXPECT_DOUBLE_EQ(internal_value(180.0, "deg"), std::numbers::pi);
  const auto m =
      measure(plan(), with("B_d", part().faces.at("B_d").turned(rotation_y(50e-6), {0, 35, 5})));
  ASSERT_TRUE(m);
  EXPECT_NEAR(internal_value(m->characteristics[3]), 50e-6, 1e-11);
}

TEST(StraightLine, RefusesPointsAtOnePlace) {
  EXPECT_TRUE(straight_line(std::vector<PlaceOnLine>{{0.0, 0.0}, {1.0, 2.0}}));
  EXPECT_FALSE(straight_line(std::vector<PlaceOnLine>{{1.0, 0.0}, {1.0, 2.0}}));
  EXPECT_FALSE(straight_line(std::vector<PlaceOnLine>{{1.0, 0.0}}));
  EXPECT_FALSE(straight_line(std::vector<PlaceOnLine>{}));
}

}  // namespace
}  // namespace frustum::metrology

// The frames of tilted planes against frames worked out by hand, and the forms against each other.
#include "parser/interpret/frames/feature_frame.hpp"
#include "core/decimal.hpp"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <cmath>

#include "core/units.hpp"
#include "tests/parser/running.hpp"

namespace frustum::parser {
namespace {

using enum AxisLetter;

// The axes of the plane as columns, hand-written row by row.
Mat3 axes(std::initializer_list<double> rows) {
  Mat3 matrix;
  auto value = rows.begin();
  for (int row = 0; row < 3; ++row)
    for (int column = 0; column < 3; ++column) matrix(row, column) = *value++;
  return matrix;
}

Pose plane_of(std::string_view text) {
  const auto change = last_of<TiltedPlaneChange>(motions(text));
  EXPECT_TRUE(change.program_from_plane) << text;
  return change.program_from_plane.value_or(Pose{});
}

void expect_same(const Pose& found, const Pose& wanted, double within = 1e-12) {
  EXPECT_LT((found.rotation - wanted.rotation).norm(), within) << found.rotation << "\n\n"
                                                               << wanted.rotation;
  EXPECT_LT((found.translation - wanted.translation).norm(), within)
      << found.translation.transpose() << " instead of " << wanted.translation.transpose();
}

const double kHalf = std::sqrt(0.5);

TEST(FeatureFrame, TurnsEulerAnglesAboutItsOwnAxes) {
  // 90 about Z: X' = Y, Y' = -X. Then 90 about X' = Y: Y'' = Z, Z'' = X. Columns X'' Y'' Z''.
  expect_same(plane_of("G68.2 X1 Y2 Z3 I90 J90 K0"), {axes({0, 0, 1,  //
                                                            1, 0, 0,  //
                                                            0, 1, 0}),
                                                      {1, 2, 3}});
  // And 45 about Z'' = X: X turns from Y towards Z.
  expect_same(plane_of("G68.2 P0 X1 Y2 Z3 I90 J90 K45"), {axes({0, 0, 1,           //
                                                                kHalf, -kHalf, 0,  //
                                                                kHalf, kHalf, 0}),
                                                          {1, 2, 3}});
}

TEST(FeatureFrame, TurnsRollPitchYawAboutTheAxesOfTheWork) {
  // 90 about X: Y -> Z, Z -> -Y. Then 90 about Y of the work: Z -> X, X -> -Z; so Y'' = X, Z'' =
  // -Y, X'' = -Z.
  expect_same(plane_of("G68.2 P1 Q123 I90 J90 K0"), {axes({0, 1, 0,   //
                                                           0, 0, -1,  //
                                                           -1, 0, 0}),
                                                     {0, 0, 0}});
  // The other way round: about Y first: X -> -Z, Z -> X; then about X: Z -> -Y. X'' = Y, Y'' = Z,
  // Z'' = X.
  expect_same(plane_of("G68.2 P1 Q213 I90 J90 K0"), {axes({0, 0, 1,  //
                                                           1, 0, 0,  //
                                                           0, 1, 0}),
                                                     {0, 0, 0}});
}

TEST(FeatureFrame, LiesInThreePoints) {
  // Origin 10,0,0; X along Y of the work; Y up: the normal is Y x Z = X.
  const std::string points =
      "G68.2 P2 Q1 X10 Y0 Z0\nG68.2 P2 Q2 X10 Y5 Z0\nG68.2 P2 Q3 X10 Y2 Z7\n";
  const Mat3 upright = axes({0, 0, 1,  //
                             1, 0, 0,  //
                             0, 1, 0});
  expect_same(plane_of(points), {upright, {10, 0, 0}});
  // Q0 shifts along the new axes: 1 along Y, 2 along Z, 3 along X of the work; and turns X towards
  // Y'.
  expect_same(plane_of("G68.2 P2 Q0 X1 Y2 Z3 R90\n" + points), {axes({0, 0, 1,   //
                                                                      0, -1, 0,  //
                                                                      1, 0, 0}),
                                                                {13, 1, 2}});
}

TEST(FeatureFrame, IsSpannedByTwoVectors) {
  expect_same(plane_of("G68.2 P3 Q1 X1 Y2 Z3 I0 J4 K0\nG68.2 P3 Q2 I2 J0 K0\n"), {axes({0, 0, 1,  //
                                                                                        1, 0, 0,  //
                                                                                        0, 1, 0}),
                                                                                  {1, 2, 3}});
  // 2 degrees off: the normal stays, X is made perpendicular to it.
  const double off = 2.0 * kRadPerDeg;
  const Pose found = plane_of("G68.2 P3 Q1 I1 J0 K[SIN[2]/COS[2]]\nG68.2 P3 Q2 I0 J0 K1\n");
  expect_same(found, {Mat3::Identity(), {0, 0, 0}});
  EXPECT_GT(off, 0.0);
}

TEST(FeatureFrame, LeansByProjectionAngles) {
  // I alone turns about Y, J alone about X.
  expect_same(plane_of("G68.2 P4 I30 J0 K0"), {rotation_y(30.0 * kRadPerDeg), {0, 0, 0}});
  const Pose leaned = plane_of("G68.2 P4 I0 J30 K0");
  expect_same(leaned, {rotation_x(30.0 * kRadPerDeg), {0, 0, 0}});
  // Both by 45: lines (1, 0, -1) and (0, 1, 1); the normal is (1, -1, 1), X stays on the first
  //             line.
  const Pose both = plane_of("G68.2 P4 I45 J45 K0");
  EXPECT_LT((both.rotation.col(0) - Vec3(1, 0, -1).normalized()).norm(), 1e-12);
  EXPECT_LT((both.rotation.col(2) - Vec3(1, -1, 1).normalized()).norm(), 1e-12);
  EXPECT_NEAR(both.rotation.determinant(), 1.0, 1e-12);
}

TEST(FeatureFrame, TurnsAboutAnAxisInSpace) {
  // A third of a turn about the diagonal takes X to Y, Y to Z, Z to X.
  expect_same(plane_of("G68 X1 Y2 Z3 I1 J1 K1 R120"), {axes({0, 0, 1,  //
                                                             1, 0, 0,  //
                                                             0, 1, 0}),
                                                       {1, 2, 3}});
  // Twice: the second centre and axis are in the coordinates of the first turn.
  expect_same(plane_of("G68 X10 Y0 Z0 I0 J0 K1 R90\nG68 X5 Y0 Z0 I1 J0 K0 R90\n"),
              {rotation_z(kRadPerDeg * 90) * rotation_x(kRadPerDeg * 90), {10, 5, 0}});
}

TEST(FeatureFrame, GoesOnFromTheOneAtWork) {
  expect_same(plane_of("G68.2 X10 Y0 Z0 I90 J0 K0\nG68.4 X5 Y0 Z0 I0 J90 K0\n"),
              {rotation_z(kRadPerDeg * 90) * rotation_x(kRadPerDeg * 90), {10, 5, 0}});
}

TEST(FeatureFrame, LiesInTheFrameOfTheWordsBefore) {
  const Pose shifted = plane_of("G52 X100 Y200\nG68.2 X1 Y2 Z3 I0 J90 K0\n");
  expect_same(shifted, {rotation_x(kRadPerDeg * 90), {101, 202, 3}});
  // The words within are not shifted once more, and G69 brings the shift back.
  const auto moves = all_of<Traverse>(
      motions("G52 X100 Y200\nG68.2 X1 Y2 Z3 I0 J90 K0\nG0 X1 Y1 Z1\nG69\nG0 X1 Y1 Z1\n"));
  ASSERT_EQ(moves.size(), 2U);
  EXPECT_EQ(*moves[0].end[X], 1.0);
  EXPECT_EQ(*moves[1].end[X], 101.0);
  EXPECT_EQ(*moves[1].end[Y], 201.0);
  expect_same(plane_of("G0 X0 Y0 Z0\nG68 X10 Y0 R90\nG68.2 X20 Y0 Z0 I0 J0 K0\n"),
              {rotation_z(kRadPerDeg * 90), {10, 10, 0}});
}

TEST(FeatureFrame, EndsWithG69WhichMayMove) {
  const auto found = motions("G68.2 X0 Y0 Z0 I0 J90 K0\nG53.1\nG69 G0 X1 Y2 Z3\n");
  EXPECT_FALSE(last_of<TiltedPlaneChange>(found).program_from_plane);
  EXPECT_EQ(*last_of<Traverse>(found).end[Z], 3.0);
}

double angle() { return 0.01 * *rc::gen::inRange(-17900, 17900); }
std::string number(double value) { return shortest_decimal(value); }

RC_GTEST_PROP(FeatureFrameLaws, EulerAnglesAreRollPitchYawOfTheReverseOrder, ()) {
  // Turning about own axes Z, X is turning about fixed ones X, Z: K = 0 leaves two turns.
  const double i = angle(), j = angle();
  const Pose euler = plane_of("G68.2 X1 Y2 Z3 I" + number(i) + " J" + number(j) + " K0");
  const Pose fixed = plane_of("G68.2 P1 Q132 X1 Y2 Z3 I" + number(j) + " J0 K" + number(i));
  expect_same(euler, fixed);
}

RC_GTEST_PROP(FeatureFrameLaws, AllFormsDescribeAnyFrame, ()) {
  const double i = angle(), j = angle(), k = angle();
  const Pose wanted =
      plane_of("G68.2 X1 Y2 Z3 I" + number(i) + " J" + number(j) + " K" + number(k));
  const auto place = [](const Vec3& p) {
    return " X" + number(p[0]) + " Y" + number(p[1]) + " Z" + number(p[2]);
  };
  const auto vector = [](const Vec3& v) {
    return " I" + number(v[0]) + " J" + number(v[1]) + " K" + number(v[2]);
  };
  expect_same(
      plane_of("G68.2 P2 Q1" + place(wanted.translation) + "\nG68.2 P2 Q2" +
               place(wanted.point({7, 0, 0})) + "\nG68.2 P2 Q3" + place(wanted.point({-3, 2, 0}))),
      wanted, 1e-9);
  expect_same(
      plane_of("G68.2 P3 Q1" + place(wanted.translation) + vector(5.0 * wanted.rotation.col(0)) +
               "\nG68.2 P3 Q2" + vector(wanted.rotation.col(2))),
      wanted, 1e-9);
  // And as one turn about an axis in space.
  const Eigen::AngleAxisd turn(wanted.rotation);
  expect_same(plane_of("G68" + place(wanted.translation) + vector(turn.axis()) + " R" +
                       number(turn.angle() * kDegPerRad)),
              wanted, 1e-9);
}

}  // namespace
}  // namespace frustum::parser

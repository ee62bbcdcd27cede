// Flank milling against poses and deviations that were computed apart from this code.
#include "programs/milling/flank_milling.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <nlohmann/json.hpp>
#include <numbers>

#include "programs/s_piece/control_points.hpp"
#include "programs/s_piece/s_piece.hpp"

namespace frustum::programs {
namespace {

nlohmann::json data() {
  std::ifstream in(std::string(FRUSTUM_SOURCE_DIR) + "/tests/data/s_piece.json");
  return nlohmann::json::parse(in)["s_piece"];
}

Vec3 vec(const nlohmann::json& of) {
  return {of[0].get<double>(), of[1].get<double>(), of[2].get<double>()};
}

SplineSurface flank() { return geometry(SPiece{})->flanks[0]; }

TEST(FlankMilling, TheSurfaceIsThatOfTheData) {
  const SplineSurface surface = flank();
  for (const auto& each : data()["points"]) {
    const SplinePoint p = surface.at(each["u"], each["v"]);
    EXPECT_NEAR((p.r - vec(each["point"])).norm(), 0.0, 1e-8) << each;
    EXPECT_NEAR((p.normal() - vec(each["normal"])).norm(), 0.0, 1e-8) << each;
  }
  const auto twist = data()["twist"];
  for (std::size_t i = 0; i < twist["u"].size(); ++i) {
    const double u = twist["u"][i];
    const double angle = angle_between(surface.at(u, 0).normal(), surface.at(u, 1).normal());
    EXPECT_NEAR(angle * kDegPerRad, twist["delta_deg"][i].get<double>(), 1e-5);
  }
}

TEST(FlankMilling, ToolPosesAreThoseOfTheData) {
  const SplineSurface surface = flank();
  for (std::size_t k = 0; k < kFlankMethodNames.size(); ++k) {
    for (const auto& each : data()["tool_positions"][std::string(kFlankMethodNames[k])]) {
      const FlankPose at = flank_pose(surface, {10.0, 2.0, static_cast<FlankMethod>(k)}, each["u"]);
      EXPECT_NEAR((at.pose.tip - vec(each["tip"])).norm(), 0.0, 1e-6) << each;
      EXPECT_NEAR((at.pose.axis - vec(each["axis"])).norm(), 0.0, 1e-8) << each;
      EXPECT_NEAR(at.shift, each["du"].get<double>(), 1e-8) << each;
    }
  }
}

TEST(FlankMilling, PathsAreAsLongAsThoseOfTheData) {
  for (std::size_t k = 0; k < kFlankMethodNames.size(); ++k) {
    const auto path = flank_path(flank(), {10.0, 2.0, static_cast<FlankMethod>(k)}, 15.0, 4000);
    const double expected =
        data()["nominal_deviation"][std::string(kFlankMethodNames[k])]["path_length"];
    EXPECT_NEAR(length_of(path), expected, 1e-3);
  }
}

TEST(FlankMilling, DeviationsOfTheContinuousPathAreThoseOfTheData) {
  const SplineSurface surface = flank();
  for (std::size_t k = 0; k < kFlankMethodNames.size(); ++k) {
    const FlankCutter cutter{10.0, 2.0, static_cast<FlankMethod>(k)};
    const auto expected =
        data()["nominal_deviation"][std::string(kFlankMethodNames[k])]["at_points"];
    std::size_t i = 0;
    for (const double v : {0.2, 0.5, 0.8}) {
      for (int j = 0; j < 49; j += 4) {
        const double um = flank_deviation(surface, cutter, 0.02 + 0.02 * j, v) * kUmPerMm;
        EXPECT_NEAR(um, expected[i++].get<double>(), 0.025) << kFlankMethodNames[k] << " " << j;
      }
    }
  }
}

// Two points overcut by R D^2 / 8 half way up, balanced ones by half of it, for any cutter.
TEST(FlankMilling, LawOvercutIsThatOfTheTwist) {
  const SplineSurface surface = flank();
  for (const double radius : {4.0, 10.0, 16.0}) {
    int counted = 0;
    for (double u = 0.02; u < 0.99; u += 0.01) {
      const double twist = angle_between(surface.at(u, 0).normal(), surface.at(u, 1).normal());
      if (twist < 4.0 * kRadPerDeg) continue;
      ++counted;
      const double law = -radius * twist * twist / 8.0;
      const FlankCutter two{radius, 2.0, FlankMethod::two_point};
      EXPECT_NEAR(flank_deviation(surface, two, u, 0.5), law, -0.01 * law) << u;
      const FlankCutter balanced{radius, 2.0, FlankMethod::balanced};
      EXPECT_NEAR(flank_deviation(surface, balanced, u, 0.5), 0.5 * law, -0.01 * law) << u;
    }
    EXPECT_GT(counted, 40);
  }
}

TEST(FlankMilling, TheThirdPointIsAsFarAsTheOthersForOtherRadiiAndHeights) {
  for (const double radius : {2.0, 6.0, 15.0, 25.0}) {
    for (const double height : {15.0, 60.0}) {
      SPiece piece;
      piece.height = {height};
      const SplineSurface surface = geometry(piece)->flanks[0];
      const FlankCutter cutter{radius, 1.0};
      for (double u = -0.05; u < 1.06; u += 0.05) {
        const FlankPose at = flank_pose(surface, cutter, u);
        const Vec3 ruling = surface.point(u, 1.0) - surface.point(u, 0.0);
        // Up the axis from the tip to the middle of both points.
        const double low = 0.5 * (1.0 - std::numbers::sqrt3 / 2.0);
        const Vec3 a = at.pose.tip + (low * ruling.norm() + 1.0) * at.pose.axis;
        const SplinePoint on = surface.at(u - at.shift, low);
        EXPECT_NEAR((a - on.r - radius * on.normal()).norm(), 0.0, 1e-9);
        const SplinePoint top = surface.at(u + at.shift, 1.0 - low);
        const Vec3 b = top.r + radius * top.normal();
        EXPECT_NEAR((b - a).normalized().cross(at.pose.axis).norm(), 0.0, 1e-12);
        EXPECT_NEAR(surface.nearest(0.5 * (a + b)).distance, radius, 1.1e-9) << u << " " << radius;
      }
    }
  }
}

TEST(FlankMilling, RefusesACutterThatDoesNotFitAndSaysWhichWould) {
  SPiece piece;
  piece.cutter = {90.0};
  const auto refused = geometry(piece);
  ASSERT_FALSE(refused);
  EXPECT_EQ(refused.error().front().id, "cutter-does-not-fit"_id);
  const NarrowestHollow hollow = narrowest_hollow(flank());
  EXPECT_NEAR(hollow.radius, 34.0, 1.0);
  EXPECT_NEAR(flank().at(hollow.u, 0.5).curvature_along_u(), -1.0 / hollow.radius, 1e-12);
  // The upper edge is more hollow. Principal curvatures, computed apart, make it 34.039 mm; along u
  // it is a little more.
  const NarrowestHollow edge = narrowest_hollow(flank(), 1.0);
  EXPECT_NEAR(edge.radius, 34.039, 0.1);
  piece.cutter = {2.0 * hollow.radius - 0.1};
  EXPECT_FALSE(geometry(piece));
  piece.cutter = {2.0 * edge.radius - 0.1};
  EXPECT_TRUE(geometry(piece));
}

TEST(FlankMilling, FlankBIsFlankATurned) {
  const auto shape = geometry(SPiece{});
  for (const double u : {0.0, 0.3, 1.0}) {
    const Vec3 a = shape->flanks[0].point(u, 0.4), b = shape->flanks[1].point(u, 0.4);
    EXPECT_NEAR((b - Vec3(-a.x(), -a.y(), a.z())).norm(), 0.0, 1e-13);
  }
}

std::string as_csv(const SGeometry& shape, bool with_b) {
  std::string text = "curve,x,y,z\n";
  for (std::size_t flank = 0; flank < (with_b ? 2u : 1u); ++flank) {
    const SplineSurface& surface = shape.flanks[flank];
    for (std::size_t i = 0; i < surface.net().size(); ++i) {
      const Vec3& p = surface.net()[i];
      text += std::string(flank == 0 ? "C" : "D") + (i < surface.columns() ? "0," : "1,") +
              std::to_string(p.x()) + "," + std::to_string(p.y()) + "," + std::to_string(p.z()) +
              "\n";
    }
  }
  return text;
}

TEST(ControlPoints, ReadBackGiveTheSamePiece) {
  const auto shape = geometry(SPiece{});
  for (const bool with_b : {false, true}) {
    const auto points = parse_control_points(as_csv(*shape, with_b));
    ASSERT_TRUE(points) << to_string(points.error().front());
    SPiece piece;
    piece.points = *points;
    const auto again = geometry(piece);
    ASSERT_TRUE(again);
    for (std::size_t k = 0; k < 2; ++k) EXPECT_EQ(again->flanks[k], shape->flanks[k]);
  }
}

TEST(ControlPoints, SaysWhatIsWrongAndWhere) {
  const auto fault = [](const std::string& text) {
    const auto points = parse_control_points("curve,x,y,z\n" + text, "s.csv");
    return points ? std::string() : to_string(points.error().front());
  };
  const std::string level = "C0,0,0,0\nC0,1,0,0\nC0,2,0,0\nC0,3,0,0\n";
  EXPECT_TRUE(fault("E0,1,2,3\n").starts_with("s.csv:2:1: error: there is no curve 'E0'"));
  EXPECT_TRUE(fault("C0,1,2,inf\n").starts_with("s.csv:2:8: error: z 'inf' is no finite number"));
  EXPECT_TRUE(fault(level + "C1,0,0,9\n").starts_with("s.csv:2:1: error: C0 has 4 points"));
  EXPECT_TRUE(fault(level + "C0,4,0,1\n").starts_with("s.csv:6:8: error: z = 1 mm, but C0 begins"));
  EXPECT_TRUE(fault(level + "C1,0,0,0\nC1,1,0,0\nC1,2,0,0\nC1,3,0,0\n")
                  .starts_with("s.csv:6:1: error: C1 is at z = 0 mm"));
}

}  // namespace
}  // namespace frustum::programs

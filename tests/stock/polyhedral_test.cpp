#include "stock/polyhedral/polyhedral.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <iostream>
#include <limits>
#include <numbers>
#include <string>
#include <vector>

#include "core/random.hpp"
#include "stock/polyhedral/polyhedral_sweep.hpp"
#include "stock/solid/workpiece.hpp"
#include "tests/law_count.hpp"

namespace frustum::stock {
namespace {

using cutter::Cutter;
using cutter::CutterSpec;
using cutter::CutterType;
using kinematics::ToolPath;
using kinematics::ToolPose;
using std::numbers::pi;

constexpr double kRadius = 6.0;

Cutter end_mill(CutterType type) {
  return cutter::Cutter::make(
             {.type = type, .diameter = {2.0 * kRadius}, .length = {60.0}, .flute_length = {14.0}})
      .value();
}

Blank box(double x, double y, double height) {
  return Blank::make(BoxShape{x, y, height}, Vec3::Zero()).value();
}

ToolPath path_through(const std::vector<ToolPose>& poses) {
  ToolPath path;
  path.poses = poses;
  path.blocks = {{.source_line = 1, .tool = 1}};
  for (std::uint32_t i = 0; i + 1 < poses.size(); ++i) path.segments.push_back({i, 0});
  return path;
}

// Facets, and a tolerance that falls with their square: half of what the facets stand off.
PolyhedralOptions with_facets(int facets) {
  const double sagitta = kRadius * (1.0 / std::cos(pi / facets) - 1.0);
  return {.facets = facets, .arc_facets = std::max(1, facets / 4), .tolerance = {sagitta / 2.0}};
}

PolyhedralWorkpiece polyhedral(const Blank& blank, const ToolPath& path, CutterType type,
                               const PolyhedralOptions& options) {
  auto cut = PolyhedralWorkpiece::cut(blank, path, {{1, end_mill(type)}}, options);
  if (!cut) ADD_FAILURE() << to_string(cut.error().front());
  return cut.value();
}

Workpiece ray_exact(const Blank& blank, const ToolPath& path, CutterType type) {
  return {blank, cutter::SweptCutter::sweep(path, {{1, end_mill(type)}}).value()};
}

double draw(std::uint32_t seed, std::uint64_t index, double lo, double hi) {
  return lo + (hi - lo) * uniform({.seed = seed}, index);
}

Ray random_ray(const BoundingBox& within, std::uint64_t k) {
  const double z = draw(1, k, -1.0, 1.0);
  const double a = draw(2, k, 0.0, 2.0 * pi);
  const double across = std::sqrt(1.0 - z * z);
  const Vec3 direction(across * std::cos(a), across * std::sin(a), z);
  Vec3 aim;
  for (int d = 0; d < 3; ++d) {
    aim[d] = draw(3, 3 * k + static_cast<std::uint64_t>(d), within.min[d], within.max[d]);
  }
  return {aim - 200.0 * direction, direction};
}

constexpr RaySpan kAll{0.0, 400.0};

// Distance from a point of one surface to the other along a direction, either way.
template <typename Solid>
double distance_along(const Solid& solid, const Vec3& point, const Vec3& direction) {
  const IntervalSet met = solid.material_along({point - 200.0 * direction, direction}, kAll);
  double nearest = std::numeric_limits<double>::infinity();
  for (const Interval& i : met.intervals()) {
    nearest = std::min({nearest, std::abs(i.lo - 200.0), std::abs(i.hi - 200.0)});
  }
  return nearest;
}

// Upper bound of the distance of a point of one surface from the other: along its normal, or,
// where an edge is near, along the best of a few directions.
template <typename Solid>
double distance_to(const Solid& solid, const SurfacePoint& from) {
  double nearest = distance_along(solid, from.point, from.normal);
  for (int k = 14; k < 27; ++k) {  // to the faces, edges and corners of a cube
    const Vec3 direction = Vec3(k / 9 - 1, k / 3 % 3 - 1, k % 3 - 1).normalized();
    nearest = std::min(nearest, distance_along(solid, from.point, direction));
  }
  return nearest;
}

struct Difference {
  double worst = 0.0;
  double rms = 0.0;
  int points = 0;
  // How far the polyhedral material reaches out of the true one along a ray.
  double excess = 0.0;
};

Difference difference(const Workpiece& exact, const PolyhedralWorkpiece& faceted, int rays) {
  Difference found;
  double squares = 0.0;
  const auto count = [&](double distance) {
    found.worst = std::max(found.worst, distance);
    squares += distance * distance;
    ++found.points;
  };
  // Faces that the cutter has not touched are equal, and would only dilute the mean.
  const BoundingBox bounds = exact.blank().bounds();
  const auto on_blank = [&](const Vec3& p) {
    return ((p - bounds.min).cwiseMin(bounds.max - p).array() < 1e-9).any();
  };
  for (int k = 0; k < rays; ++k) {
    const Ray ray = random_ray(bounds, static_cast<std::uint64_t>(k));
    const IntervalSet truth = exact.material_along(ray, kAll);
    const IntervalSet approximate = faceted.material_along(ray, kAll);
    const IntervalSet outside = approximate.minus(truth);
    for (const Interval& i : outside.intervals()) {
      found.excess = std::max(found.excess, i.length());
    }
    for (const Interval& i : truth.intervals()) {
      for (const auto& [s, tag] : {std::pair{i.lo, i.lo_tag}, std::pair{i.hi, i.hi_tag}}) {
        if (on_blank(ray.at(s))) continue;
        count(distance_to(faceted, exact.surface_at(ray, s, tag)));
      }
    }
    for (const Interval& i : approximate.intervals()) {
      for (const auto& [s, tag] : {std::pair{i.lo, i.lo_tag}, std::pair{i.hi, i.hi_tag}}) {
        if (on_blank(ray.at(s))) continue;
        count(distance_to(exact, faceted.surface_at(ray, s, tag)));
      }
    }
  }
  found.rms = std::sqrt(squares / std::max(1, found.points));
  return found;
}

double order(double coarse, double fine) { return std::log2(coarse / fine); }

void print(const std::string& line) { std::cout << line << std::endl; }

// Cuts with more and more facets, holds each against the rays, and checks the order at which the
// worst and the mean difference fall over the whole series.
void expect_second_order(const std::string& name, const Blank& blank, const ToolPath& path,
                         CutterType type, const std::vector<int>& series) {
  const Workpiece exact = ray_exact(blank, path, type);
  std::vector<Difference> found;
  for (const int facets : series) {
    const PolyhedralOptions options = with_facets(facets);
    const PolyhedralWorkpiece faceted = polyhedral(blank, path, type, options);
    found.push_back(difference(exact, faceted, 150));
    const Difference& now = found.back();
    print(fmt::format(
        "{}: facets {:3d}, hulls {:4d}, triangles {:6d}: worst {:.3e} mm, rms {:.3e} mm "
        "over {} points",
        name, facets, faceted.piece_count(), faceted.facet_count(), now.worst, now.rms,
        now.points));
    EXPECT_LT(now.worst, polyhedral_bound(options, {kRadius}).value) << facets;
    EXPECT_LT(now.excess, 1e-8) << "material that the true part lacks, facets " << facets;
    EXPECT_GT(now.points, 100);
  }
  const double doublings = std::log2(static_cast<double>(series.back()) / series.front());
  const double worst_order = order(found.front().worst, found.back().worst) / doublings;
  const double rms_order = order(found.front().rms, found.back().rms) / doublings;
  print(fmt::format("{}: order of the worst {:.2f}, of the rms {:.2f}", name, worst_order,
                    rms_order));
  testing::Test::RecordProperty(name + "_order_of_worst", fmt::format("{:.3f}", worst_order));
  testing::Test::RecordProperty(name + "_order_of_rms", fmt::format("{:.3f}", rms_order));
  EXPECT_NEAR(worst_order, 2.0, 0.3);
  EXPECT_NEAR(rms_order, 2.0, 0.3);
}

// The cutter feeds along X, turns in the feed direction and to the side, and sinks a little.
ToolPath five_axis_segment() {
  return path_through({{Vec3(-9, -1, 5), Vec3(-0.10, 0.02, 1.0).normalized()},
                       {Vec3(8, 1.5, 4), Vec3(-0.16, 0.08, 1.0).normalized()}});
}

TEST(PolyhedralReference, ConvergesToTheRaysAtSecondOrderForAFlatEndMillOnAFiveAxisStretch) {
  expect_second_order("flat_five_axis", box(30, 24, 10), five_axis_segment(), CutterType::flat,
                      proof::law_count<std::vector<int>>({16, 32, 64, 128}, {16, 32, 64}));
}

TEST(PolyhedralReference, ConvergesToTheRaysAtSecondOrderForABallEndMillOnAFiveAxisStretch) {
  expect_second_order("ball_five_axis", box(30, 24, 10), five_axis_segment(), CutterType::ball,
                      {16, 32, 64});
}

TEST(PolyhedralReference, ConvergesToTheRaysForSeveralStretchesThatCrossTheirOwnSweep) {
  // Over itself twice, at changing depth; the third segment turns the cutter, the fourth plunges.
  const Vec3 leaning = Vec3(-0.10, 0.05, 1.0).normalized();
  const Vec3 tilted = Vec3(-0.09, 0.03, 1.0).normalized();
  const ToolPath path = path_through({{Vec3(-20, -8, 6), leaning},
                                      {Vec3(10, 6, 5.2), leaning},
                                      {Vec3(12, -7, 6.3), tilted},
                                      {Vec3(-12, 8, 5.6), tilted},
                                      {Vec3(-12, 8, 3.1), tilted}});
  expect_second_order("crossing", box(40, 30, 10), path, CutterType::flat, {16, 32, 64});
}

// Programs, each with its cutter, against the rays with two numbers of facets.
struct Program {
  std::string name;
  CutterSpec cutter;
  std::vector<ToolPose> poses;
};
void PrintTo(const Program& program, std::ostream* out) { *out << program.name; }

std::vector<Program> programs_of_all_kinds() {
  const Vec3 up = Vec3::UnitZ();
  const auto at = [&](double x, double y, double z) { return ToolPose{Vec3(x, y, z), up}; };
  const CutterSpec flat{
      .type = CutterType::flat, .diameter = {12.0}, .length = {60.0}, .flute_length = {14.0}};
  const CutterSpec ball{
      .type = CutterType::ball, .diameter = {10.0}, .length = {60.0}, .flute_length = {14.0}};
  const CutterSpec bull{.type = CutterType::bull,
                        .diameter = {12.0},
                        .length = {60.0},
                        .flute_length = {14.0},
                        .corner_radius = {2.0}};
  const CutterSpec taper{.type = CutterType::taper,
                         .diameter = {6.0},
                         .length = {60.0},
                         .flute_length = {14.0},
                         .taper_angle = {10.0 * kRadPerDeg}};
  const CutterSpec lollipop{
      .type = CutterType::lollipop, .diameter = {8.0}, .length = {60.0}, .neck_diameter = {4.0}};
  const CutterSpec t_slot{
      .type = CutterType::t_slot, .diameter = {12.0}, .length = {60.0}, .flute_length = {4.0}};
  // A head, a cone inwards and a collar: three convex parts.
  const CutterSpec waisted{
      .type = CutterType::profile,
      .length = {60.0},
      .rows = {{0, 0, 0}, {4, 0, 0}, {4, 3, 0}, {2.5, 4, 0}, {2.5, 6, 0}, {6, 8, 0}, {6, 14, 0}}};
  std::vector<ToolPose> swarf;
  for (int i = 0; i <= 2; ++i) {
    const double phi = 0.05 * i;
    const Vec3 out(std::cos(phi), std::sin(phi), 0.0);
    swarf.push_back({34.0 * out - Vec3(34, 4, -1), (up - 0.26 * out).normalized()});
  }
  const Vec3 leaning = Vec3(-0.10, 0.05, 1.0).normalized(),
             tilted = Vec3(-0.07, 0.02, 1.0).normalized();
  return {
      {"slot", flat, {at(-9, 1, 5), at(9, 1, 5)}},
      {"pocket", flat, {at(-6, -4, 4), at(6, -4, 4), at(6, 4, 4), at(-6, 4, 4), at(-6, -4, 4)}},
      {"plunge", ball, {{Vec3(1, 0, 12), leaning}, {Vec3(1, 0, 12) - 8.0 * leaning, leaning}}},
      {"swarf", flat, swarf},
      {"crossing",
       flat,
       {{Vec3(-9, -6, 6), leaning},
        {Vec3(9, 5, 5.2), tilted},
        {Vec3(7, -6, 6), tilted},
        {Vec3(-8, 7, 5.6), leaning}}},
      {"ball", ball, {{Vec3(-9, -1, 5), leaning}, {Vec3(8, 2, 4), tilted}}},
      {"bull", bull, {{Vec3(-9, -1, 5), leaning}, {Vec3(8, 2, 4), tilted}}},
      {"taper", taper, {{Vec3(-9, -1, 3), leaning}, {Vec3(8, 2, 4), tilted}}},
      {"t_slot", t_slot, {at(-25, 1, 3), at(4, -2, 3), at(4, 2, 4)}},
      {"lollipop", lollipop, {{Vec3(-20, 1, 2), up}, {Vec3(6, -2, 2.5), leaning}}},
      {"waisted", waisted, {at(-25, 1, 2), at(5, -1, 2)}},
  };
}

class ProgramsReference : public ::testing::TestWithParam<Program> {};

TEST_P(ProgramsReference, ConvergeToTheRaysAtSecondOrder) {
  const Blank blank = box(30, 24, 10);
  const ToolPath path = path_through(GetParam().poses);
  const std::map<int, Cutter> tools = {{1, Cutter::make(GetParam().cutter).value()}};
  const Workpiece exact(blank, cutter::SweptCutter::sweep(path, tools).value());
  std::vector<Difference> found;
  for (const int facets : {12, 24}) {
    const PolyhedralOptions options = with_facets(facets);
    auto faceted = PolyhedralWorkpiece::cut(blank, path, tools, options);
    ASSERT_TRUE(faceted) << to_string(faceted.error().front());
    found.push_back(difference(exact, *faceted, 100));
    // The mean: beside an edge no direction of search need lead to the other surface's nearest
    // point.
    EXPECT_LT(found.back().rms, polyhedral_bound(options, {tools.at(1).body().max_radius()}).value);
    EXPECT_LT(found.back().excess, 1e-8) << "material that the true part lacks, facets " << facets;
    EXPECT_GT(found.back().points, 40);
  }
  const double rms_order = order(found[0].rms, found[1].rms);
  print(fmt::format("{}: rms {:.2e} to {:.2e} mm, worst {:.2e} to {:.2e}: order {:.2f}",
                    GetParam().name, found[0].rms, found[1].rms, found[0].worst, found[1].worst,
                    rms_order));
  EXPECT_NEAR(rms_order, 2.0, 0.7);
}

INSTANTIATE_TEST_SUITE_P(Kinds, ProgramsReference, ::testing::ValuesIn(programs_of_all_kinds()),
                         [](const auto& each) { return each.param.name; });

TEST(PolyhedralWorkpiece, RefusesAHollowCutterAndSaysWhoTakesIt) {
  const CutterSpec hollow{.type = CutterType::flat,
                          .diameter = {12.0},
                          .length = {60.0},
                          .flute_length = {14.0},
                          .end_angle = {2.0 * kRadPerDeg}};
  const auto cut = PolyhedralWorkpiece::cut(box(30, 24, 10), five_axis_segment(),
                                            {{1, Cutter::make(hollow).value()}}, {});
  ASSERT_FALSE(cut);
  EXPECT_EQ(to_string(cut.error().front()),
            ":1: error: the polyhedral engine cannot take tool T1: its generatrix is concave "
            "(hint: it takes bodies made of convex parts; the ray engine takes this one)");
}

TEST(PolyhedralReference, StraightSlotVolumeConvergesToTheClosedFormAtSecondOrder) {
  // Slot 5 mm deep, 20 mm between the ends of the tool's axis, all inside the block.
  const Blank blank = box(50, 30, 10);
  const ToolPath path =
      path_through({{Vec3(-10, 1, 5), Vec3::UnitZ()}, {Vec3(10, 1, 5), Vec3::UnitZ()}});
  const double removed = 5.0 * (2.0 * kRadius * 20.0 + pi * kRadius * kRadius);
  double before = 0.0;
  for (const int facets : {16, 32, 64, 128}) {
    const auto faceted = polyhedral(blank, path, CutterType::flat, with_facets(facets));
    const double off = blank.volume() - faceted.volume() - removed;
    print(fmt::format("slot: facets {:3d}: removed volume off by {:.4e} of {:.4f} mm^3", facets,
                      off, removed));
    EXPECT_GT(off, 0.0);  // circumscribed: too much, never too little
    if (before > 0.0) {
      EXPECT_NEAR(order(before, off), 2.0, 0.1);
    }
    before = off;
  }
  RecordProperty("slot_volume_error_128_mm3", fmt::format("{:.6f}", before));
}

TEST(PolyhedralWorkpiece, ARayThroughEdgesAndCornersCountsThemOnce) {
  const auto uncut = polyhedral(box(10, 10, 10), {}, CutterType::flat, {});
  EXPECT_EQ(uncut.facet_count(), 12U);
  EXPECT_DOUBLE_EQ(uncut.volume(), 1000.0);
  // Through the middle of the top, where the diagonals of the faces are; through two corners;
  // along an edge (in or out, but not half).
  const IntervalSet down = uncut.material_along({Vec3(0, 0, 50), -Vec3::UnitZ()}, kAll);
  ASSERT_EQ(down.intervals().size(), 1U);
  EXPECT_NEAR(down.intervals().front().lo, 40.0, 1e-12);
  EXPECT_NEAR(down.intervals().front().hi, 50.0, 1e-12);
  EXPECT_TRUE(uncut.surface_at({Vec3(0, 0, 50), -Vec3::UnitZ()}, 40.0, down.intervals()[0].lo_tag)
                  .normal.isApprox(Vec3::UnitZ()));
  const Vec3 diagonal = Vec3(1, 1, 1).normalized();
  const Ray through_corners{Vec3(-5, -5, 0) - 10.0 * diagonal, diagonal};
  EXPECT_NEAR(uncut.material_along(through_corners, kAll).length(), std::sqrt(300.0), 1e-7);
  const double along = uncut.material_along({Vec3(5, 5, 50), -Vec3::UnitZ()}, kAll).length();
  EXPECT_TRUE(std::abs(along) < 1e-6 || std::abs(along - 10.0) < 1e-6) << along;
  // Clipped to the span, and missed.
  const IntervalSet part = uncut.material_along({Vec3(1, 2, 50), -Vec3::UnitZ()}, {42.0, 47.0});
  EXPECT_DOUBLE_EQ(part.length(), 5.0);
  EXPECT_EQ(part.intervals().front().lo_tag, -1);
  EXPECT_TRUE(uncut.material_along({Vec3(1, 20, 50), -Vec3::UnitZ()}, kAll).empty());
}

TEST(PolyhedralWorkpiece, MergesStretchesOnOneStraightMotionIntoOneHull) {
  std::vector<ToolPose> poses;
  for (int i = 0; i <= 20; ++i) poses.push_back({Vec3(-10 + i, 1, 5), Vec3::UnitZ()});
  const auto many = polyhedral(box(50, 30, 10), path_through(poses), CutterType::flat, {});
  const auto one = polyhedral(box(50, 30, 10), path_through({poses.front(), poses.back()}),
                              CutterType::flat, {});
  EXPECT_EQ(many.piece_count(), 1U);
  EXPECT_NEAR(many.volume(), one.volume(), 1e-9);
}

TEST(PolyhedralWorkpiece, CornersOfAnArcDoNotMultiplyTheirDigits) {
  // A full turn there and back in 30 chords each. Where triangles of flat faces left vertices
  // behind, every union multiplied the digits of those of the one before: it did not end.
  std::vector<ToolPose> poses;
  for (int i = 0; i <= 60; ++i) {
    const double angle = 2.0 * pi * (i <= 30 ? i : 60 - i) / 30;
    poses.push_back({Vec3(10 * std::cos(angle), 10 * std::sin(angle), 5), Vec3::UnitZ()});
  }
  const auto ring = polyhedral(box(40, 40, 10), path_through(poses), CutterType::flat,
                               {.facets = 12, .tolerance = {0.01}});
  // Between the circles around and within the true ring and its chords, the regular dodecagons of
  // the cutter around it: the groove is at most this much wider than 4 to 16 mm.
  const double wider = kRadius * (1.0 / std::cos(pi / 12) - 1.0) + 10 * (1.0 - std::cos(pi / 30));
  const double removed = box(40, 40, 10).volume() - ring.volume();
  const double inner = 10 - kRadius, outer = 10 + kRadius;
  EXPECT_GT(
      removed,
      5 * pi * (std::pow(outer - 10 * (1.0 - std::cos(pi / 30)), 2) - std::pow(inner + 1e-9, 2)));
  EXPECT_LT(removed, 5 * pi * (std::pow(outer + wider, 2) - std::pow(inner - wider, 2)));
  // 30 chords make a few corners each; triangles left behind made thousands.
  EXPECT_LT(ring.facet_count(), 2500U);
}

TEST(PolyhedralWorkpiece, InscribesRoundBlanks) {
  const auto blank = Blank::make(FrustumShape{20.0, 10.0, 15.0}, Vec3(1, 2, 3)).value();
  const auto faceted = polyhedral(blank, {}, CutterType::flat, {.facets = 12});
  const double share = 12.0 / (2.0 * pi) * std::sin(2.0 * pi / 12.0);  // of the circle
  EXPECT_NEAR(faceted.volume(), share * blank.volume(), 1e-9);
}

TEST(PolyhedralWorkpiece, TakesALoftAsItIs) {
  const LoftShape steps{
      {{0, 30, 24}, {5, 30, 24}, {5, 20, 18}, {9, 12, 10}, {9, 14, 12}, {11, 14, 12}}};
  const auto blank = Blank::make(steps, Vec3(1, 2, 3)).value();
  const auto faceted = polyhedral(blank, {}, CutterType::flat, {});
  EXPECT_NEAR(faceted.volume(), blank.volume(), 1e-9);
  for (std::uint64_t k = 0; k < 200; ++k) {
    const Ray ray = random_ray(blank.bounds(), k);
    const IntervalSet exact = blank.along(ray, kAll);
    const IntervalSet met = faceted.material_along(ray, kAll);
    ASSERT_EQ(met.intervals().size(), exact.intervals().size()) << k;
    EXPECT_NEAR(met.length(), exact.length(), 1e-9) << k;
  }
}

TEST(PolyhedralWorkpiece, NothingIsLeftOfABlankThatTheCutterCoversWhole) {
  const ToolPath path =
      path_through({{Vec3(-9, 0, -1), Vec3::UnitZ()}, {Vec3(9, 0, -1), Vec3::UnitZ()}});
  const auto gone = polyhedral(box(6, 6, 5), path, CutterType::flat, {});
  EXPECT_EQ(gone.volume(), 0.0);
  EXPECT_TRUE(gone.material_along({Vec3(0, 0, 50), -Vec3::UnitZ()}, kAll).empty());
}

TEST(PolyhedralWorkpiece, RefusesWhatMakesNoSolidAndSaysWhatToDo) {
  const auto message = [](const PolyhedralOptions& options, int tool) {
    const auto cut = PolyhedralWorkpiece::cut(box(30, 24, 10), five_axis_segment(),
                                              {{tool, end_mill(CutterType::flat)}}, options);
    return cut ? std::string("no error") : to_string(cut.error().front());
  };
  EXPECT_EQ(message({.facets = 2}, 1),
            "error: 2 facets around the axis (hint: at least 3 make a solid)");
  EXPECT_EQ(message({.arc_facets = 0}, 1),
            "error: 0 facets on a quarter circle (hint: at least 1)");
  EXPECT_EQ(message({.tolerance = {0.0}}, 1),
            "error: facet tolerance 0 mm (hint: it must be a finite number above 0)");
  EXPECT_EQ(
      message({.tolerance = {1e-6}, .max_pieces = 100}, 1),
      ":1: error: the polyhedral sweep needs more than 100 hulls (hint: a facet tolerance above "
      "1e-06 mm needs fewer)");
  EXPECT_EQ(message({}, 2),
            ":1: error: tool T1 cuts but is not defined (hint: add tool.1 with type, diameter and "
            "length)");
}

}  // namespace
}  // namespace frustum::stock

// Proofs of surface points: every kind of cutter on every kind of motion; wrong points and wrong
// paths.
#include "stock/proof/certificate.hpp"
#include "core/ray.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <iostream>
#include <string>

#include "tests/cutter/cutter_kinds.hpp"
#include "tests/cutter/random_paths.hpp"
#include "tests/law_count.hpp"
#include "tests/stock/random_cuts.hpp"

namespace frustum::proof {
namespace {

using cutter::SweptCutter;
using kinematics::ToolPath;
using stock::Certificate;
using stock::Certifier;
using stock::SurfacePoint;
using stock::Verdict;
using stock::Workpiece;

Workpiece cut(const Kind& kind, ToolPath path) {
  return {stock::Blank::make(stock::BoxShape{40.0, 40.0, 40.0}, Vec3(0, 0, -20)).value(),
          *SweptCutter::sweep(std::move(path), {{1, kind.cutter}})};
}

// Ends of the material along random rays.
std::vector<SurfacePoint> points_of(const Workpiece& part, Draw& draw, int rays) {
  std::vector<SurfacePoint> points;
  const stock::BoundingBox bounds = part.blank().bounds();
  for (int k = 0; k < rays; ++k) {
    const Ray ray{draw.point(bounds.min, bounds.max), draw.direction()};
    const IntervalSet material = part.material_along(ray, {-200.0, 200.0});
    for (const Interval& i : material.intervals()) {
      points.push_back(part.surface_at(ray, i.lo, i.lo_tag));
      points.push_back(part.surface_at(ray, i.hi, i.hi_tag));
    }
  }
  return points;
}

struct Count {
  int points = 0, cut = 0, regular = 0, proven = 0, refuted = 0;
  std::size_t spans = 0, most_spans = 0;
  double worst_bound = 0.0;

  void add(const SurfacePoint& p, const Certificate& c) {
    ++points;
    if (p.segment) ++cut;
    if (c.verdict == Verdict::proven) ++proven;
    if (c.verdict == Verdict::refuted) ++refuted;
    if (c.regular) ++regular;
    spans += c.spans;
    most_spans = std::max(most_spans, c.spans);
    worst_bound = std::max(worst_bound, p.sweep_bound);
  }
  [[nodiscard]] std::string text() const {
    return fmt::format(
        "{} points, {} of them cut: {} proven, {} along their normal, {} refuted; "
        "{:.1f} spans each, at most {}; bound {:.2g} mm",
        points, cut, proven, regular, refuted, static_cast<double>(spans) / std::max(points, 1),
        most_spans, worst_bound);
  }
};

class CertificateLaws : public ::testing::TestWithParam<std::string> {};

TEST_P(CertificateLaws, ProveWhatTheEngineFindsAndRefuteWhatIsThreeBoundsBeside) {
  const Kind& kind = kind_named(GetParam());
  Count found, beside;
  for (const MotionFamily family : kMotionFamilies) {
    for (std::uint64_t seed = 0; seed < law_count(12U, 2U); ++seed) {
      Draw draw(seed, 31);
      const Workpiece part = cut(kind, random_path(family, draw));
      const Certifier certifier(part);
      for (const SurfacePoint& p : points_of(part, draw, 12)) {
        const Certificate c = certifier.certify(p);
        found.add(p, c);
        EXPECT_EQ(c.verdict, Verdict::proven)
            << to_string(family) << ' ' << seed << ": " << c.reason;
        if (!c.regular) continue;
        for (const double way : {-3.0, 3.0}) {
          SurfacePoint shifted = p;
          shifted.point += way * p.sweep_bound * p.normal;
          const Certificate wrong = certifier.certify(shifted);
          beside.add(shifted, wrong);
          EXPECT_FALSE(wrong.regular) << to_string(family) << ' ' << seed;
        }
      }
    }
  }
  std::cout << GetParam() << ": " << found.text() << "\n  three bounds beside: " << beside.text()
            << '\n';
  EXPECT_EQ(found.proven, found.points);
  EXPECT_GE(found.regular, found.points - found.points / 50);
  EXPECT_EQ(beside.refuted, beside.points);
}

std::vector<std::string> names() {
  std::vector<std::string> all;
  for (const Kind& kind : cutter_kinds()) all.push_back(kind.name);
  return all;
}
INSTANTIATE_TEST_SUITE_P(Kinds, CertificateLaws, ::testing::ValuesIn(names()),
                         [](const auto& about) { return about.param; });

// A slot along X, 8 mm deep and 10 mm wide.
ToolPath slot(double depth = 8.0, double end = 30.0) {
  return path_through(
      {{Vec3(-30, 0, 20 - depth), Vec3::UnitZ()}, {Vec3(end, 0, 20 - depth), Vec3::UnitZ()}});
}

SurfacePoint probe(const Workpiece& part, const Vec3& from, const Vec3& direction) {
  const auto met = part.first_surface({from, direction}, {0.0, 60.0});
  EXPECT_TRUE(met);
  return met.value_or(SurfacePoint{});
}

TEST(Certificate, FindsAWrongListOfStretches) {
  // Points of a slot, asked of a workpiece where the slot is deeper, or shorter, or later.
  const Kind& kind = kind_named("flat");
  const Workpiece part = cut(kind, slot());
  const SurfacePoint floor = probe(part, Vec3(1, 2, 30), -Vec3::UnitZ());
  const SurfacePoint wall = probe(part, Vec3(25, 0, 15), Vec3(-1.0, 1.0, 0.0).normalized());
  EXPECT_EQ(Certifier(part).certify(floor).verdict, Verdict::proven);
  EXPECT_EQ(Certifier(part).certify(wall).verdict, Verdict::proven);

  const Workpiece deeper = cut(kind, slot(8.001));
  EXPECT_EQ(Certifier(deeper).certify(floor).verdict, Verdict::refuted);
  EXPECT_EQ(Certifier(deeper).certify(wall).verdict, Verdict::proven);
  const Workpiece higher = cut(kind, slot(7.999));
  EXPECT_EQ(Certifier(higher).certify(floor).verdict, Verdict::refuted);
  const Workpiece shorter = cut(kind, slot(8.0, -20.0));
  EXPECT_NE(Certifier(shorter).certify(floor).verdict, Verdict::proven);
  const Certificate early = Certifier(part, {.first_excluded = 0}).certify(floor);
  EXPECT_EQ(early.verdict, Verdict::open);
  EXPECT_EQ(early.reason, "the path segment that is said to have made it has not cut");
}

TEST(Certificate, KnowsTheMomentThatWasAskedFor) {
  // A second segment cuts the first one's floor away; before it the floor was there.
  ToolPath both = path_through({{Vec3(-30, 0, 12), Vec3::UnitZ()},
                                {Vec3(30, 0, 12), Vec3::UnitZ()},
                                {Vec3(30, 0, 10), Vec3::UnitZ()},
                                {Vec3(-30, 0, 10), Vec3::UnitZ()}});
  const Workpiece part = cut(kind_named("flat"), both);
  const Ray down{Vec3(0, 0, 30), -Vec3::UnitZ()};
  const IntervalSet then = part.material_along(down, {0.0, 60.0}, 1);
  const Interval& left = then.intervals().front();
  const SurfacePoint floor = part.surface_at(down, left.lo, left.lo_tag);
  EXPECT_EQ(Certifier(part, {.first_excluded = 1}).certify(floor).verdict, Verdict::proven);
  EXPECT_EQ(Certifier(part).certify(floor).verdict, Verdict::refuted);
}

TEST(Certificate, SaysSoWhenTheSpansAreUsedUp) {
  const Workpiece part = cut(kind_named("ball"), slot());
  const SurfacePoint floor = probe(part, Vec3(1, 0.3, 30), -Vec3::UnitZ());
  const Certificate certificate = Certifier(part, {.most_spans = 1}).certify(floor);
  EXPECT_EQ(certificate.verdict, Verdict::open);
  EXPECT_EQ(certificate.reason, "line 1 was not shown to stay clear within 1 spans of time");
  EXPECT_EQ(Certifier(part).certify({}).reason, "it is no surface point with a bound");
}

TEST(Certificate, HoldsOnTheBlankItself) {
  const stock::BlankShape shapes[] = {
      stock::BoxShape{30.0, 20.0, 10.0}, stock::FrustumShape{15.0, 9.0, 12.0},
      stock::LoftShape{{{0.0, 20.0, 16.0}, {5.0, 18.0, 10.0}, {5.0, 12.0, 8.0}, {9.0, 6.0, 8.0}}}};
  for (const stock::BlankShape& shape : shapes) {
    const Workpiece part(stock::Blank::make(shape, Vec3(3, -2, 1)).value(),
                         *SweptCutter::sweep(path_through({{Vec3(0, 0, 90), Vec3::UnitZ()},
                                                           {Vec3(5, 0, 90), Vec3::UnitZ()}}),
                                             {{1, kind_named("flat").cutter}}));
    const Certifier certifier(part);
    Draw draw(5);
    Count count;
    for (const SurfacePoint& p : points_of(part, draw, 200)) {
      const Certificate c = certifier.certify(p);
      count.add(p, c);
      EXPECT_EQ(c.verdict, Verdict::proven) << p.point.transpose() << ": " << c.reason;
      EXPECT_LT(p.bound, 1e-11);
    }
    EXPECT_GT(count.points, 200);
    EXPECT_EQ(count.regular, count.points);
  }
}

TEST(SurfacePointBound, IsThePathsAndTheEnginesAndRounding) {
  ToolPath path = slot();
  path.bound = 2.5e-5;
  const Workpiece part = cut(kind_named("flat"), path);
  const SurfacePoint floor = probe(part, Vec3(1, 2, 30), -Vec3::UnitZ());
  EXPECT_GT(floor.sweep_bound, part.removed().accuracy());
  EXPECT_LT(floor.sweep_bound, part.removed().accuracy() + 1e-11);
  EXPECT_EQ(floor.bound, 2.5e-5 + floor.sweep_bound);
  EXPECT_LT(part.removed().accuracy(), 1e-6);
  // Concave cutters are less exact and say so.
  EXPECT_GT(cut(kind_named("hollow"), path).removed().accuracy(), 1e-5);
}

}  // namespace
}  // namespace frustum::proof

#include "stock/certificate.hpp"

#include <gtest/gtest.h>

#include <iostream>
#include <map>
#include <cstdlib>

#include "tests/cutter/cutter_kinds.hpp"
#include "tests/cutter/random_paths.hpp"
#include "tests/stock/random_cuts.hpp"

namespace frustum::proof {
namespace {

using stock::Certificate;
using stock::Certifier;
using stock::Ray;
using stock::SurfacePoint;
using stock::Verdict;
using stock::Workpiece;

[[maybe_unused]] Workpiece cut(const RandomCut& random) {
  return {random.blank, *cutter::SweptCutter::sweep(random.path, random.tools)};
}

// Ends of the material along random rays.
std::vector<SurfacePoint> points_of(const Workpiece& part, Draw& draw, int rays) {
  std::vector<SurfacePoint> points;
  const auto bounds = part.blank().bounds();
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
  std::size_t spans = 0, most = 0;
  void add(const SurfacePoint& p, const Certificate& c) {
    ++points;
    cut += p.stretch ? 1 : 0;
    regular += c.regular && c.verdict == Verdict::proven ? 1 : 0;
    proven += c.verdict == Verdict::proven ? 1 : 0;
    refuted += c.verdict == Verdict::refuted ? 1 : 0;
    spans += c.spans;
    most = std::max(most, c.spans);
  }
};

TEST(Certificate, Explore) {
  std::map<std::string, Count> counts;
  for (const Kind& kind : cutter_kinds()) {
 if (std::getenv("K") && kind.name != std::getenv("K")) continue;
    for (const MotionFamily family : kMotionFamilies) {
      for (int seed = 0; seed < 5; ++seed) {
        Draw draw(static_cast<std::uint64_t>(seed), 31);
        const auto blank = stock::Blank::make(stock::BoxShape{40, 40, 40}, Vec3(0, 0, -20)).value();
        const Workpiece part(blank, *cutter::SweptCutter::sweep(random_path(family, draw), {{1, kind.cutter}}));
        const Certifier certifier(part);
        for (const SurfacePoint& p : points_of(part, draw, 20)) {
          if (!p.stretch && std::getenv("K")) continue;
          const Certificate c = certifier.certify(p);
          counts[kind.name].add(p, c);
          counts[to_string(family)].add(p, c); if (std::getenv("V")) std::cout << to_string(family) << seed << " spans " << c.spans << " " << c.reason << " n " << p.normal.transpose() << " bound " << p.sweep_bound << std::endl;
          if (c.verdict == Verdict::refuted || (c.verdict == Verdict::open && draw.chance(0.05)))
            std::cout << kind.name << ' ' << to_string(family) << ' ' << seed << " n.z " << p.normal.transpose() << " cut " << p.stretch.has_value() << ": " << c.reason << " spans " << c.spans << " P " << p.point.transpose().format(Eigen::IOFormat(17)) << " bound " << p.sweep_bound << std::endl;
        }
      }
    }
  }
  for (const auto& [name, c] : counts)
    std::cout << name << ": points " << c.points << " cut " << c.cut << " regular " << c.regular << " proven " << c.proven << " refuted " << c.refuted << " spans " << c.spans << " most " << c.most << '\n';
}

}  // namespace
}  // namespace frustum::proof

#include "programs/step/step_path.hpp"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <limits>

namespace frustum::programs {
namespace {

constexpr double kClearance = 5.0;  // mm
constexpr double kAside = 1.0;      // mm beside the tool's flank, which runs along finished walls

// n . p <= limit
struct HalfSpace {
  Vec3 normal;
  double limit = 0.0;
};

std::vector<HalfSpace> faces_of(const stock::LoftSlab& slab, const Vec3& origin) {
  std::vector<HalfSpace> faces{{-Vec3::UnitZ(), -(origin.z() + slab.bottom.z)},
                               {Vec3::UnitZ(), origin.z() + slab.top.z}};
  const double height = slab.top.z - slab.bottom.z;
  const auto sides = [&](Eigen::Index k, double bottom, double top) {
    const double m = 0.5 * (top - bottom) / height;
    for (const double sign : {-1.0, 1.0}) {
      const Vec3 normal = sign * Vec3::Unit(k) - m * Vec3::UnitZ();
      const double at = sign * origin[k] + 0.5 * bottom - m * (origin.z() + slab.bottom.z);
      faces.push_back({normal, at});
    }
  };
  sides(0, slab.bottom.size_x, slab.top.size_x);
  sides(1, slab.bottom.size_y, slab.top.size_y);
  return faces;
}

// Largest u . p over a bounded convex body: one of its corners has it. -inf when the body is empty.
double furthest(const std::vector<HalfSpace>& body, const Vec3& u) {
  constexpr double kRounding = 1e-9;  // mm
  double most = -std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < body.size(); ++i) {
    for (std::size_t j = i + 1; j < body.size(); ++j) {
      for (std::size_t k = j + 1; k < body.size(); ++k) {
        Mat3 rows;
        rows << body[i].normal.transpose(), body[j].normal.transpose(), body[k].normal.transpose();
        // Planes that share a direction within 1e-9 have no corner here.
        if (std::abs(rows.determinant()) < 1e-9) continue;
        const Vec3 corner =
            rows.partialPivLu().solve(Vec3(body[i].limit, body[j].limit, body[k].limit));
        const bool inside = std::all_of(body.begin(), body.end(), [&](const HalfSpace& h) {
          return h.normal.dot(corner) <= h.limit + kRounding;
        });
        if (inside) most = std::max(most, u.dot(corner));
      }
    }
  }
  return most;
}

}  // namespace

StepRun step_run(const StepLine& line, double length, double tool_radius,
                 const stock::LoftShape& blank, const Vec3& blank_origin) {
  const Vec3& a = line.axis;
  const Vec3 across_axis = (line.feed - a * line.feed.dot(a)).normalized();
  StepRun run;
  std::vector<std::vector<HalfSpace>> bodies;
  double top = -std::numeric_limits<double>::infinity();
  for (const stock::LoftSlab& slab : stock::slabs_of(blank)) {
    bodies.push_back(faces_of(slab, blank_origin));
    top = std::max(top, furthest(bodies.back(), a));
  }
  run.clear = std::ceil(top + kClearance);
  // `sign` +1: the end of the pass, -1: its beginning.
  const auto clear_at = [&](double t, double sign) {
    const Vec3 tip = line.tip + sign * t * line.feed;
    const double flank = tool_radius + kAside;
    return std::all_of(bodies.begin(), bodies.end(), [&](std::vector<HalfSpace> body) {
      body.push_back({line.side, line.side.dot(tip) + flank});
      body.push_back({-line.side, -line.side.dot(tip) + flank});
      body.push_back({-a, -a.dot(tip) + kClearance});
      const Vec3 onward = sign * across_axis;
      return furthest(body, onward) <= onward.dot(tip) - tool_radius - kClearance;
    });
  };
  const auto distance = [&](double sign) {
    double t = std::ceil(0.5 * length + tool_radius + kClearance);
    constexpr double kFar = 2000.0;  // mm: beyond any blank that fits a machine
    while (t < kFar && !clear_at(t, sign)) t += 1.0;
    return t;
  };
  run.before = distance(-1.0);
  run.after = distance(1.0);
  return run;
}

}  // namespace frustum::programs

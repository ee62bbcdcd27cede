#include "metrology/fit/fixed_radius.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace frustum::metrology {
namespace {

double cost(const NormalisedPoints& local, const Vec3& centre, double radius) {
  double sum = 0.0;
  for (std::size_t i = 0; i < local.points.size(); ++i) {
    const double d = (local.points[i] - centre).norm() - radius;
    sum += local.weight(i) * d * d;
  }
  return sum;
}

Vec3 better(const NormalisedPoints& local, const Vec3& mean, const Vec3& centre, double radius) {
  Vec3 sum = Vec3::Zero();
  for (std::size_t i = 0; i < local.points.size(); ++i) {
    const Vec3 away = centre - local.points[i];
    sum += local.weight(i) * away / std::max(away.norm(), 1e-12);
  }
  return mean + radius / local.all_weights() * sum;
}

std::vector<Vec3> centres(const NormalisedPoints& local, const std::vector<Vec3>& directions,
                          double radius, std::size_t most) {
  Vec3 mean = Vec3::Zero();  // of thinned points it is not the origin
  for (std::size_t i = 0; i < local.points.size(); ++i) {
    mean += local.weight(i) / local.all_weights() * local.points[i];
  }
  std::vector<std::pair<double, Vec3>> found;
  // The far ones reach centres off the points, the near ones those among them.
  for (const double part : {1.0, 0.3}) {
    for (const Vec3& direction : directions) {
      constexpr int kSteps = 6;
      Vec3 centre = mean + part * radius * direction;
      for (int i = 0; i < kSteps; ++i) centre = better(local, mean, centre, radius);
      found.emplace_back(cost(local, centre, radius), centre);
    }
  }
  std::stable_sort(found.begin(), found.end(),
                   [](const auto& a, const auto& b) { return a.first < b.first; });
  std::vector<Vec3> chosen;
  for (const auto& candidate : found) {
    if (chosen.size() >= most) break;
    const Vec3& centre = candidate.second;
    const bool fresh = std::none_of(chosen.begin(), chosen.end(),
                                    [&](const Vec3& c) { return (c - centre).norm() < 0.1; });
    if (fresh) chosen.push_back(centre);
  }
  return chosen;
}

}  // namespace

std::vector<Vec3> circle_centres(const NormalisedPoints& local, const UnitVec3& normal,
                                 double radius, std::size_t most) {
  NormalisedPoints seen = local;
  for (Vec3& p : seen.points) p -= p.dot(normal.vec()) * normal.vec();
  constexpr int kDirections = 24;
  const auto [u, v] = tangents(normal);
  std::vector<Vec3> directions;
  for (int i = 0; i < kDirections; ++i) {
    const double turn = 2.0 * std::numbers::pi * i / kDirections;
    directions.emplace_back(std::cos(turn) * u + std::sin(turn) * v);
  }
  return centres(seen, directions, radius, most);
}

std::vector<Vec3> sphere_centres(const NormalisedPoints& local, double radius, std::size_t most) {
  constexpr int kDirections = 60;
  std::vector<Vec3> directions;
  for (int i = 0; i < kDirections; ++i) {
    const double z = 1.0 - (2.0 * i + 1.0) / kDirections;
    const double turn = std::numbers::pi * (3.0 - std::sqrt(5.0)) * i;  // the golden angle
    const double r = std::sqrt(1.0 - z * z);
    directions.emplace_back(r * std::cos(turn), r * std::sin(turn), z);
  }
  return centres(local, directions, radius, most);
}

}  // namespace frustum::metrology

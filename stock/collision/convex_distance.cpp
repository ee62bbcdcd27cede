#include "stock/collision/convex_distance.hpp"

#include <algorithm>
#include <optional>

namespace frustum::stock {
namespace {

using Weights = std::array<double, 3>;

// Of the point of a segment nearest to the origin.
std::array<double, 2> segment_weights(const Vec3& a, const Vec3& b) {
  const Vec3 along = b - a;
  const double square = along.squaredNorm();
  const double t = square > 0.0 ? std::clamp(-a.dot(along) / square, 0.0, 1.0) : 0.0;
  return {1.0 - t, t};
}

// Of a triangle without area: its best side.
Weights side_weights(const std::array<Vec3, 3>& p) {
  Weights best{};
  double nearest = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < 3; ++i) {
    const std::size_t j = (i + 1) % 3;
    const auto [s, t] = segment_weights(p[i], p[j]);
    const double distance = (s * p[i] + t * p[j]).squaredNorm();
    if (distance >= nearest) continue;
    nearest = distance;
    best = {};
    best[i] = s;
    best[j] = t;
  }
  return best;
}

Weights triangle_weights(const std::array<Vec3, 3>& p) {
  const Vec3 ab = p[1] - p[0], ac = p[2] - p[0];
  const Vec3 normal = ab.cross(ac);
  // Thinner than rounding can tell from a line.
  constexpr double kThin = 1e-12;
  const double longest = std::max(ab.squaredNorm(), ac.squaredNorm());
  if (normal.squaredNorm() <= kThin * kThin * longest * longest) return side_weights(p);
  const double u = p[1].cross(p[2]).dot(normal);
  const double v = p[2].cross(p[0]).dot(normal);
  const double w = p[0].cross(p[1]).dot(normal);
  if (u < 0.0 || v < 0.0 || w < 0.0) return side_weights(p);
  const double sum = u + v + w;
  if (!(sum > 0.0)) return side_weights(p);
  return {u / sum, v / sum, w / sum};
}

void keep(DifferenceSimplex& simplex, const std::array<int, 3>& of, const Weights& weights,
          int corners) {
  const auto before = simplex.corners;
  simplex.count = 0;
  for (int k = 0; k < corners; ++k) {
    const double weight = weights[static_cast<std::size_t>(k)];
    if (weight <= 0.0) continue;
    auto& corner = simplex.corners[static_cast<std::size_t>(simplex.count++)];
    corner = before[static_cast<std::size_t>(of[static_cast<std::size_t>(k)])];
    corner.weight = weight;
  }
}

// Whether the origin may be beyond the face, seen from the fourth corner.
bool is_beyond(const std::array<Vec3, 3>& face, const Vec3& fourth) {
  const Vec3 normal = (face[1] - face[0]).cross(face[2] - face[0]);
  const double origin = -face[0].dot(normal);
  const double inner = (fourth - face[0]).dot(normal);
  // A flat tetrahedron has no inside.
  constexpr double kFlat = 1e-12;
  const double size = normal.norm() * (fourth - face[0]).norm();
  return std::abs(inner) <= kFlat * size || origin * inner < 0.0;
}

bool reduce_tetrahedron(DifferenceSimplex& simplex) {
  constexpr std::array<std::array<int, 4>, 4> kFaces{
      {{0, 1, 2, 3}, {0, 1, 3, 2}, {0, 2, 3, 1}, {1, 2, 3, 0}}};
  const auto at = [&](int k) { return simplex.corners[static_cast<std::size_t>(k)].w; };
  double nearest = std::numeric_limits<double>::infinity();
  std::array<int, 3> best{};
  Weights weights{};
  for (const auto& face : kFaces) {
    const std::array<Vec3, 3> p{at(face[0]), at(face[1]), at(face[2])};
    if (!is_beyond(p, at(face[3]))) continue;
    const Weights own = triangle_weights(p);
    const double distance = (own[0] * p[0] + own[1] * p[1] + own[2] * p[2]).squaredNorm();
    if (distance >= nearest) continue;
    nearest = distance;
    best = {face[0], face[1], face[2]};
    weights = own;
  }
  if (nearest == std::numeric_limits<double>::infinity()) return false;
  keep(simplex, best, weights, 3);
  return true;
}

}  // namespace

bool DifferenceSimplex::has(const Vec3& w) const {
  return std::any_of(corners.begin(), corners.begin() + count,
                     [&w](const Corner& corner) { return corner.w == w; });
}

void DifferenceSimplex::add(const Vec3& on_a, const Vec3& on_b) {
  corners[static_cast<std::size_t>(count++)] = {on_a - on_b, on_a, on_b, 0.0};
}

bool DifferenceSimplex::reduce() {
  const std::array<Vec3, 3> p{corners[0].w, corners[1].w, corners[2].w};
  if (count == 1) {
    corners[0].weight = 1.0;
  } else if (count == 2) {
    const auto [s, t] = segment_weights(p[0], p[1]);
    keep(*this, {0, 1, 0}, {s, t, 0.0}, 2);
  } else if (count == 3) {
    keep(*this, {0, 1, 2}, triangle_weights(p), 3);
  } else {
    return reduce_tetrahedron(*this);
  }
  return true;
}

Vec3 DifferenceSimplex::nearest() const {
  Vec3 sum = Vec3::Zero();
  for (int k = 0; k < count; ++k) {
    const Corner& corner = corners[static_cast<std::size_t>(k)];
    sum += corner.weight * corner.w;
  }
  return sum;
}

Vec3 DifferenceSimplex::on_a() const {
  Vec3 sum = Vec3::Zero();
  for (int k = 0; k < count; ++k) {
    const Corner& corner = corners[static_cast<std::size_t>(k)];
    sum += corner.weight * corner.on_a;
  }
  return sum;
}

Vec3 DifferenceSimplex::on_b() const {
  Vec3 sum = Vec3::Zero();
  for (int k = 0; k < count; ++k) {
    const Corner& corner = corners[static_cast<std::size_t>(k)];
    sum += corner.weight * corner.on_b;
  }
  return sum;
}

}  // namespace frustum::stock

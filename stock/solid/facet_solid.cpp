#include "stock/solid/facet_solid.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace frustum::stock {
namespace {

constexpr double kEndless = std::numeric_limits<double>::infinity();

struct Flat {
  double u = 0.0, v = 0.0;
};

// Sign of a.u * b.v - a.v * b.u, exact but for underflow: rounding keeps the order of two products,
// and equal rounded products are separated by what was rounded off.
int turn(const Flat& a, const Flat& b) {
  const double left = a.u * b.v;
  const double right = a.v * b.u;
  if (left != right) return left > right ? 1 : -1;
  const double left_rest = std::fma(a.u, b.v, -left);
  const double right_rest = std::fma(a.v, b.u, -right);
  return left_rest > right_rest ? 1 : left_rest < right_rest ? -1 : 0;
}

// On which side of the line from a to b the ray passes, never 0 unless a == b: the ray represents
// one at (e, e^2) beside it, e > 0 as small as need be.
int side(const Flat& a, const Flat& b) {
  if (const int exact = turn(a, b)) return exact;
  if (a.v != b.v) return a.v > b.v ? 1 : -1;
  if (a.u != b.u) return b.u > a.u ? 1 : -1;
  return 0;
}

}  // namespace

// The plane across a ray, and the place along it.
struct FacetSolid::View {
  Vec3 origin, along, u, v;
  explicit View(const Ray& ray)
      : origin(ray.origin),
        along(ray.direction),
        u(perpendicular_to(ray.direction)),
        v(ray.direction.cross(u)) {}
  [[nodiscard]] Flat flat(const Vec3& p) const {
    const Vec3 from = p - origin;
    return {from.dot(u), from.dot(v)};
  }
};

namespace {

double squared_distance(const Vec3& min, const Vec3& max, const Vec3& p) {
  return (min - p).cwiseMax(p - max).cwiseMax(0.0).squaredNorm();
}

Vec3 nearest_on(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& p) {
  const Vec3 ab = b - a;
  const Vec3 ac = c - a;
  const double d1 = ab.dot(p - a);
  const double d2 = ac.dot(p - a);
  if (d1 <= 0.0 && d2 <= 0.0) return a;
  const double d3 = ab.dot(p - b);
  const double d4 = ac.dot(p - b);
  if (d3 >= 0.0 && d4 <= d3) return b;
  const double vc = d1 * d4 - d3 * d2;
  if (vc <= 0.0 && d1 >= 0.0 && d3 <= 0.0) return a + d1 / (d1 - d3) * ab;
  const double d5 = ab.dot(p - c);
  const double d6 = ac.dot(p - c);
  if (d6 >= 0.0 && d5 <= d6) return c;
  const double vb = d5 * d2 - d1 * d6;
  if (vb <= 0.0 && d2 >= 0.0 && d6 <= 0.0) return a + d2 / (d2 - d6) * ac;
  const double va = d3 * d6 - d5 * d4;
  if (va <= 0.0 && d4 - d3 >= 0.0 && d5 - d6 >= 0.0) {
    return b + (d4 - d3) / ((d4 - d3) + (d5 - d6)) * (c - b);
  }
  const double sum = va + vb + vc;
  if (!(sum > 0.0)) return a;  // no area; its edges belong to neighbours too
  return a + vb / sum * ab + vc / sum * ac;
}

}  // namespace

FacetSolid::FacetSolid(std::vector<Vec3> vertices, std::vector<Facet> facets)
    : vertices_(std::move(vertices)), facets_(std::move(facets)) {
  if (facets_.empty()) return;
  std::vector<Box> boxes(facets_.size());
  for (std::size_t f = 0; f < facets_.size(); ++f) {
    const auto& [a, b, c] = facets_[f];
    boxes[f].min = vertices_[a].cwiseMin(vertices_[b]).cwiseMin(vertices_[c]);
    boxes[f].max = vertices_[a].cwiseMax(vertices_[b]).cwiseMax(vertices_[c]);
    longest_facet_ = std::max(longest_facet_, (boxes[f].max - boxes[f].min).norm());
    bounds_ = f == 0 ? boxes[f] : united(bounds_, boxes[f]);
  }
  size_ = (bounds_.max - bounds_.min).norm();
  scene_ = BoxScene(boxes);
}

std::optional<FacetSolid::Crossing> FacetSolid::crossing(const View& view, std::uint32_t f) const {
  const auto& [ia, ib, ic] = facets_[f];
  const Flat a = view.flat(vertices_[ia]);
  const Flat b = view.flat(vertices_[ib]);
  const Flat c = view.flat(vertices_[ic]);
  const int sign = side(a, b);
  if (sign == 0 || side(b, c) != sign || side(c, a) != sign) return std::nullopt;
  // Weights of the corners; all three vanish only for facets seen edge-on, which are met at any
  // of their corners as well as at another within rounding.
  const double wa = std::abs(b.u * c.v - b.v * c.u);
  const double wb = std::abs(c.u * a.v - c.v * a.u);
  const double wc = std::abs(a.u * b.v - a.v * b.u);
  const double sum = wa + wb + wc;
  const double sa = (vertices_[ia] - view.origin).dot(view.along);
  const double sb = (vertices_[ib] - view.origin).dot(view.along);
  const double sc = (vertices_[ic] - view.origin).dot(view.along);
  const double s = sum > 0.0 ? (wa * sa + wb * sb + wc * sc) / sum : (sa + sb + sc) / 3.0;
  // Counter-clockwise in (u, v) faces along +d: the ray leaves there.
  return Crossing{s, sign < 0, static_cast<EndTag>(f)};
}

std::vector<FacetSolid::Crossing> FacetSolid::crossings(const Ray& ray) const {
  const View view(ray);
  std::vector<Crossing> met;
  scene_.along(ray, {-kEndless, kEndless}, [&](std::uint32_t f) {
    if (const auto found = crossing(view, f)) met.push_back(*found);
    return kEndless;
  });
  std::sort(met.begin(), met.end());
  return met;
}

std::optional<FacetSolid::Entry> FacetSolid::first_entry(const Ray& ray, RaySpan span) const {
  const View view(ray);
  std::optional<Crossing> first;
  // Seen edge-on, a facet is met anywhere in its box: its box begins at most its length beyond.
  const RaySpan wide{span.lo - longest_facet_, span.hi + longest_facet_};
  scene_.along(ray, wide, [&](std::uint32_t f) {
    const auto found = crossing(view, f);
    if (found && found->s >= span.lo && (!first || *found < *first) &&
        !normal(found->facet).isZero()) {
      first = found;
    }
    return first ? std::min(first->s, span.hi) + longest_facet_ : wide.hi;
  });
  if (!first || first->s > span.hi || !first->enters) return std::nullopt;
  return Entry{first->s, first->facet};
}

IntervalSet FacetSolid::along(const Ray& ray, RaySpan span) const {
  std::vector<Interval> material;
  int inside = 0;
  Interval run;
  for (const Crossing& crossing : crossings(ray)) {
    const int before = inside;
    inside += crossing.enters ? 1 : -1;
    if (before == 0 && inside == 1) {
      run.lo = crossing.s;
      run.lo_tag = crossing.facet;
    } else if (before == 1 && inside == 0) {
      run.hi = crossing.s;
      run.hi_tag = crossing.facet;
      material.push_back(run);
    }
  }
  return IntervalSet(std::move(material)).intersected(IntervalSet({{span.lo, span.hi}}));
}

bool FacetSolid::contains(const Vec3& point) const {
  if (facets_.empty()) return false;
  if (squared_distance(bounds_.min, bounds_.max, point) > 0.0) return false;
  // A direction that no one builds along; any would do.
  const Ray ray{point, Vec3(0.36, 0.48, 0.8)};
  return along(ray, {-2.0 * size_ - 1.0, 2.0 * size_ + 1.0}).contains(0.0);
}

Vec3 FacetSolid::normal(EndTag facet) const {
  const auto& [a, b, c] = facets_[static_cast<std::size_t>(facet)];
  const Vec3 area = (vertices_[b] - vertices_[a]).cross(vertices_[c] - vertices_[a]);
  const double length = area.norm();
  return length > 0.0 ? Vec3(area / length) : Vec3(Vec3::Zero());
}

Vec3 FacetSolid::nearest_on_facet(std::uint32_t f, const Vec3& point) const {
  const auto& [a, b, c] = facets_[f];
  return nearest_on(vertices_[a], vertices_[b], vertices_[c], point);
}

FacetSolid::Nearest FacetSolid::nearest(const Vec3& point) const {
  Nearest best{point, kEndless, -1};
  double least = kEndless;
  scene_.near(point, kEndless, [&](std::uint32_t f) {
    const Vec3 found = nearest_on_facet(f, point);
    const double squared = (found - point).squaredNorm();
    const bool tie = squared == least && static_cast<EndTag>(f) < best.facet;
    if (squared < least || tie) {
      least = squared;
      best.point = found;
      best.facet = static_cast<EndTag>(f);
    }
    return std::sqrt(least);
  });
  best.distance = std::sqrt(least);
  return best;
}

bool FacetSolid::is_within(const Vec3& point, double distance) const {
  bool found = false;
  scene_.near(point, distance, [&](std::uint32_t f) {
    if (!found) {
      found = (nearest_on_facet(f, point) - point).squaredNorm() <= distance * distance;
    }
    return found ? 0.0 : distance;
  });
  return found;
}

double FacetSolid::signed_distance(const Vec3& point) const {
  const double distance = nearest(point).distance;
  return contains(point) ? -distance : distance;
}

double FacetSolid::volume() const {
  if (facets_.empty()) return 0.0;
  // From the centre, so that little cancels.
  const Vec3 centre = 0.5 * (bounds_.min + bounds_.max);
  double six_fold = 0.0;
  for (const auto& [ia, ib, ic] : facets_) {
    six_fold +=
        (vertices_[ia] - centre).dot((vertices_[ib] - centre).cross(vertices_[ic] - centre));
  }
  return six_fold / 6.0;
}

}  // namespace frustum::stock

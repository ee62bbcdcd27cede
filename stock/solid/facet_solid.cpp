#include "stock/solid/facet_solid.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <tuple>
#include <utility>

namespace frustum::stock {
namespace {

// Fewer facets than this are not worth a box of their own.
constexpr std::uint32_t kLeaf = 4;

struct Flat {
  double u = 0.0, v = 0.0;
};

// Sign of a.u * b.v - a.v * b.u, exact but for underflow: rounding keeps the order of two products,
// and equal rounded products are told apart by what was rounded off.
int turn(const Flat& a, const Flat& b) {
  const double left = a.u * b.v;
  const double right = a.v * b.u;
  if (left != right) return left > right ? 1 : -1;
  const double left_rest = std::fma(a.u, b.v, -left);
  const double right_rest = std::fma(a.v, b.u, -right);
  return left_rest > right_rest ? 1 : left_rest < right_rest ? -1 : 0;
}

// On which side of the line from a to b the ray passes, never 0 unless a == b: the ray stands for
// one at (e, e^2) beside it, e > 0 as small as need be.
int side(const Flat& a, const Flat& b) {
  if (const int exact = turn(a, b)) return exact;
  if (a.v != b.v) return a.v > b.v ? 1 : -1;
  if (a.u != b.u) return b.u > a.u ? 1 : -1;
  return 0;
}

// The plane across a ray, and the place along it.
struct View {
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

// Whether the line of the ray passes the box, grown by `spare`.
bool line_meets(const Vec3& min, const Vec3& max, const Ray& ray, double spare) {
  double lo = -std::numeric_limits<double>::infinity();
  double hi = std::numeric_limits<double>::infinity();
  for (int k = 0; k < 3; ++k) {
    const double from = min[k] - spare - ray.origin[k];
    const double to = max[k] + spare - ray.origin[k];
    if (ray.direction[k] == 0.0) {
      if (from > 0.0 || to < 0.0) return false;
      continue;
    }
    const double a = from / ray.direction[k];
    const double b = to / ray.direction[k];
    lo = std::max(lo, std::min(a, b));
    hi = std::min(hi, std::max(a, b));
  }
  return lo <= hi;
}

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
    : vertices_(std::move(vertices)), facets_(std::move(facets)), order_(facets_.size()) {
  if (facets_.empty()) return;
  std::vector<Vec3> centres(facets_.size());
  for (std::uint32_t f = 0; f < facets_.size(); ++f) {
    order_[f] = f;
    const auto& [a, b, c] = facets_[f];
    centres[f] = (vertices_[a] + vertices_[b] + vertices_[c]) / 3.0;
  }
  nodes_.reserve(facets_.size());
  build(0, static_cast<std::uint32_t>(facets_.size()), centres);
  size_ = (nodes_.front().max - nodes_.front().min).norm();
}

std::uint32_t FacetSolid::build(std::uint32_t first, std::uint32_t last,
                                const std::vector<Vec3>& centres) {
  const auto here = static_cast<std::uint32_t>(nodes_.size());
  nodes_.emplace_back();
  Vec3 min = vertices_[facets_[order_[first]][0]];
  Vec3 max = min;
  Vec3 low = centres[order_[first]];
  Vec3 high = low;
  for (std::uint32_t k = first; k < last; ++k) {
    for (const std::uint32_t v : facets_[order_[k]]) {
      min = min.cwiseMin(vertices_[v]);
      max = max.cwiseMax(vertices_[v]);
    }
    low = low.cwiseMin(centres[order_[k]]);
    high = high.cwiseMax(centres[order_[k]]);
  }
  nodes_[here].min = min;
  nodes_[here].max = max;
  if (last - first <= kLeaf) {
    nodes_[here].first = first;
    nodes_[here].count = last - first;
    return here;
  }
  Eigen::Index axis = 0;
  (high - low).maxCoeff(&axis);
  const std::uint32_t middle = first + (last - first) / 2;
  std::nth_element(order_.begin() + first, order_.begin() + middle, order_.begin() + last,
                   [&](std::uint32_t a, std::uint32_t b) {
                     return std::pair(centres[a][axis], a) < std::pair(centres[b][axis], b);
                   });
  build(first, middle, centres);
  const std::uint32_t right = build(middle, last, centres);
  nodes_[here].first = right;
  return here;
}

std::vector<FacetSolid::Crossing> FacetSolid::crossings(const Ray& ray) const {
  if (nodes_.empty()) return {};
  const View view(ray);
  // Corners are projected with errors far below this; so no facet that they make the ray meet is
  // left out with its box.
  const double spare = 1e-12 * (size_ + (ray.origin - nodes_.front().min).norm());
  std::vector<Crossing> met;
  std::array<std::uint32_t, 64> open;  // the tree halves 2^32 facets at most 32 times
  std::size_t depth = 0;
  open[depth++] = 0;
  while (depth > 0) {
    const std::uint32_t at = open[--depth];
    const Node& node = nodes_[at];
    if (!line_meets(node.min, node.max, ray, spare)) continue;
    if (node.count == 0) {
      open[depth++] = node.first;
      open[depth++] = at + 1;
      continue;
    }
    for (std::uint32_t k = node.first; k < node.first + node.count; ++k) {
      const std::uint32_t f = order_[k];
      const auto& [ia, ib, ic] = facets_[f];
      const Flat a = view.flat(vertices_[ia]);
      const Flat b = view.flat(vertices_[ib]);
      const Flat c = view.flat(vertices_[ic]);
      const int sign = side(a, b);
      if (sign == 0 || side(b, c) != sign || side(c, a) != sign) continue;
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
      met.push_back({s, sign < 0, static_cast<EndTag>(f)});
    }
  }
  std::sort(met.begin(), met.end(), [](const Crossing& x, const Crossing& y) {
    // Where two solids touch, enter before leaving: no gap of no width.
    return std::tuple(x.s, !x.enters, x.facet) < std::tuple(y.s, !y.enters, y.facet);
  });
  return met;
}

std::optional<FacetSolid::Entry> FacetSolid::first_entry(const Ray& ray, RaySpan span) const {
  for (const Crossing& crossing : crossings(ray)) {
    if (crossing.s < span.lo || normal(crossing.facet).isZero()) continue;
    if (crossing.s > span.hi || !crossing.enters) return std::nullopt;
    return Entry{crossing.s, crossing.facet};
  }
  return std::nullopt;
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
  if (nodes_.empty()) return false;
  const Node& all = nodes_.front();
  if (squared_distance(all.min, all.max, point) > 0.0) return false;
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

FacetSolid::Nearest FacetSolid::nearest(const Vec3& point) const {
  Nearest best{point, std::numeric_limits<double>::infinity(), -1};
  if (nodes_.empty()) return best;
  double least = std::numeric_limits<double>::infinity();
  std::array<std::pair<double, std::uint32_t>, 64> open;
  std::size_t depth = 0;
  const auto far_of = [&](std::uint32_t n) {
    return squared_distance(nodes_[n].min, nodes_[n].max, point);
  };
  open[depth++] = {far_of(0), 0};
  while (depth > 0) {
    const auto [far, at] = open[--depth];
    if (far > least) continue;
    const Node& node = nodes_[at];
    if (node.count == 0) {
      std::pair<double, std::uint32_t> left{far_of(at + 1), at + 1};
      std::pair<double, std::uint32_t> right{far_of(node.first), node.first};
      if (left.first < right.first) std::swap(left, right);
      open[depth++] = left;
      open[depth++] = right;  // the nearer one first
      continue;
    }
    for (std::uint32_t k = node.first; k < node.first + node.count; ++k) {
      const std::uint32_t f = order_[k];
      const auto& [a, b, c] = facets_[f];
      const Vec3 found = nearest_on(vertices_[a], vertices_[b], vertices_[c], point);
      const double squared = (found - point).squaredNorm();
      const bool tie = squared == least && static_cast<EndTag>(f) < best.facet;
      if (squared < least || tie) {
        least = squared;
        best.point = found;
        best.facet = static_cast<EndTag>(f);
      }
    }
  }
  best.distance = std::sqrt(least);
  return best;
}

bool FacetSolid::is_within(const Vec3& point, double distance) const {
  if (nodes_.empty()) return false;
  std::array<std::uint32_t, 64> open;
  std::size_t depth = 0;
  open[depth++] = 0;
  while (depth > 0) {
    const std::uint32_t at = open[--depth];
    const Node& node = nodes_[at];
    if (squared_distance(node.min, node.max, point) > distance * distance) continue;
    if (node.count == 0) {
      open[depth++] = node.first;
      open[depth++] = at + 1;
      continue;
    }
    for (std::uint32_t k = node.first; k < node.first + node.count; ++k) {
      const auto& [a, b, c] = facets_[order_[k]];
      const Vec3 found = nearest_on(vertices_[a], vertices_[b], vertices_[c], point);
      if ((found - point).squaredNorm() <= distance * distance) return true;
    }
  }
  return false;
}

double FacetSolid::signed_distance(const Vec3& point) const {
  const double distance = nearest(point).distance;
  return contains(point) ? -distance : distance;
}

double FacetSolid::volume() const {
  if (nodes_.empty()) return 0.0;
  // From the centre, so that little cancels.
  const Vec3 centre = 0.5 * (nodes_.front().min + nodes_.front().max);
  double six_fold = 0.0;
  for (const auto& [ia, ib, ic] : facets_) {
    six_fold +=
        (vertices_[ia] - centre).dot((vertices_[ib] - centre).cross(vertices_[ic] - centre));
  }
  return six_fold / 6.0;
}

}  // namespace frustum::stock

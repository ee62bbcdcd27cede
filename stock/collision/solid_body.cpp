#include "stock/collision/solid_body.hpp"

#include <algorithm>
#include <array>
#include <numeric>
#include <utility>

namespace frustum::stock {
namespace {

// A box of the hierarchy, as convex_distance() asks for it.
struct BoxCorners {
  const Box& box;
  [[nodiscard]] Vec3 support(const Vec3& d) const {
    return {d.x() < 0.0 ? box.min.x() : box.max.x(), d.y() < 0.0 ? box.min.y() : box.max.y(),
            d.z() < 0.0 ? box.min.z() : box.max.z()};
  }
};

double extent(const Box& box) { return (box.max - box.min).squaredNorm(); }

std::vector<ConvexShape> parts_of(const BoxShape& shape) {
  const Vec3 half(0.5 * shape.size_x, 0.5 * shape.size_y, 0.0);
  return {ConvexShape::box({-half, half + shape.height * Vec3::UnitZ()})};
}
std::vector<ConvexShape> parts_of(const FrustumShape& shape) {
  return {ConvexShape::revolved(
      std::array{cutter::cone_zone(shape.bottom_radius, shape.top_radius, 0.0, shape.height)})};
}
std::vector<ConvexShape> parts_of(const LoftShape& shape) {
  std::vector<ConvexShape> parts;
  for (const LoftSlab& slab : slabs_of(shape)) {
    std::vector<Vec3> corners;
    for (const LoftSection& s : {slab.bottom, slab.top}) {
      for (const double x : {-0.5, 0.5}) {
        for (const double y : {-0.5, 0.5}) corners.emplace_back(x * s.size_x, y * s.size_y, s.z);
      }
    }
    parts.push_back(ConvexShape::hull(std::move(corners)));
  }
  return parts;
}
std::vector<ConvexShape> parts_of(const FacetSolid& mesh) {
  std::vector<ConvexShape> parts;
  parts.reserve(mesh.facets().size());
  for (const FacetSolid::Facet& f : mesh.facets()) {
    const auto at = [&](std::size_t k) { return mesh.vertices()[f.at(k)]; };
    parts.push_back(ConvexShape::hull({at(0), at(1), at(2)}));
  }
  return parts;
}

}  // namespace

SolidBody::SolidBody(std::vector<ConvexShape> parts, std::shared_ptr<const FacetSolid> closed)
    : parts_(std::move(parts)), closed_(std::move(closed)) {
  boxes_.reserve(parts_.size());
  for (const ConvexShape& part : parts_) boxes_.push_back(part.bounds());
  std::vector<std::uint32_t> order(parts_.size());
  std::iota(order.begin(), order.end(), 0U);
  nodes_.reserve(2 * parts_.size());
  build(order, 0, order.size());
}

std::uint32_t SolidBody::build(std::vector<std::uint32_t>& order, std::size_t begin,
                               std::size_t end) {
  const auto self = static_cast<std::uint32_t>(nodes_.size());
  nodes_.emplace_back();
  Box box = boxes_[order[begin]];
  for (std::size_t k = begin; k < end; ++k) box = united(box, boxes_[order[k]]);
  nodes_[self].box = box;
  if (end - begin == 1) {
    nodes_[self].first = order[begin];
    return self;
  }
  Eigen::Index axis = 0;
  (box.max - box.min).maxCoeff(&axis);
  const auto middle_of = [&](std::uint32_t part) {
    return boxes_[part].min[axis] + boxes_[part].max[axis];
  };
  const std::size_t middle = (begin + end) / 2;
  const auto at = [&](std::size_t k) { return order.begin() + static_cast<std::ptrdiff_t>(k); };
  std::nth_element(at(begin), at(middle), at(end), [&](std::uint32_t p, std::uint32_t q) {
    return std::pair(middle_of(p), p) < std::pair(middle_of(q), q);
  });
  const std::uint32_t first = build(order, begin, middle);
  const std::uint32_t second = build(order, middle, end);
  nodes_[self].first = first;
  nodes_[self].second = second;
  return self;
}

SolidBody SolidBody::of(const cutter::Body& body) {
  std::vector<ConvexShape> parts;
  for (const cutter::Profile& section : body.sections()) {
    parts.push_back(ConvexShape::revolved(section.zones()));
  }
  return SolidBody(std::move(parts));
}

SolidBody SolidBody::of(std::shared_ptr<const FacetSolid> mesh) {
  std::vector<ConvexShape> parts = parts_of(*mesh);
  return SolidBody(std::move(parts), std::move(mesh));
}

SolidBody SolidBody::of(const BlankShape& shape) {
  if (const auto* mesh = std::get_if<MeshShape>(&shape)) return of(mesh->solid);
  return SolidBody(std::visit(
      [](const auto& form) {
        if constexpr (std::is_same_v<std::decay_t<decltype(form)>, MeshShape>) {
          return std::vector<ConvexShape>();
        } else {
          return parts_of(form);
        }
      },
      shape));
}

Vec3 SolidBody::support(const Vec3& d) const {
  Vec3 best = parts_.front().support(d);
  double farthest = best.dot(d);
  for (std::size_t k = 1; k < parts_.size(); ++k) {
    const Vec3 point = parts_[k].support(d);
    const double far = point.dot(d);
    if (far <= farthest) continue;
    farthest = far;
    best = point;
  }
  return best;
}

class SolidBody::Search {
 public:
  Search(const SolidBody& a, const SolidBody& b, const Pose& a_from_b)
      : a_(a), b_(b), a_from_b_(a_from_b) {}

  [[nodiscard]] Separation nearest() {
    descend(0, 0);
    return best_;
  }

 private:
  [[nodiscard]] double apart(std::uint32_t i, std::uint32_t j) const {
    return convex_distance(BoxCorners{a_.nodes_[i].box}, BoxCorners{b_.nodes_[j].box}, a_from_b_,
                           best_.upper)
        .lower;
  }

  void descend(std::uint32_t i, std::uint32_t j) {
    const Node& p = a_.nodes_[i];
    const Node& q = b_.nodes_[j];
    if (p.is_leaf() && q.is_leaf()) {
      const Separation own =
          convex_distance(a_.parts_[p.first], b_.parts_[q.first], a_from_b_, best_.upper);
      // What is proven to be farther has not been followed to its end.
      if (own.lower > best_.upper) return;
      const double lower = std::min(best_.lower, own.lower);
      if (own.upper < best_.upper) best_ = own;
      best_.lower = lower;
      return;
    }
    const bool splits_a = q.is_leaf() || (!p.is_leaf() && extent(p.box) >= extent(q.box));
    std::array<std::pair<std::uint32_t, std::uint32_t>, 2> pairs{};
    if (splits_a) {
      pairs = {{{p.first, j}, {p.second, j}}};
    } else {
      pairs = {{{i, q.first}, {i, q.second}}};
    }
    double near = apart(pairs[0].first, pairs[0].second);
    double far = apart(pairs[1].first, pairs[1].second);
    if (far < near) {
      std::swap(near, far);
      std::swap(pairs[0], pairs[1]);
    }
    if (near < best_.upper) descend(pairs[0].first, pairs[0].second);
    if (far < best_.upper) descend(pairs[1].first, pairs[1].second);
  }

  const SolidBody& a_;
  const SolidBody& b_;
  const Pose& a_from_b_;
  Separation best_{.lower = std::numeric_limits<double>::infinity(),
                   .upper = std::numeric_limits<double>::infinity()};
};

Separation separation(const SolidBody& a, const SolidBody& b, const Pose& a_from_b) {
  if (a.is_convex() && b.is_convex()) {
    return convex_distance(a.parts_.front(), b.parts_.front(), a_from_b);
  }
  Separation found = SolidBody::Search(a, b, a_from_b).nearest();
  found.lower = std::min(found.lower, found.upper);
  if (found.upper == 0.0) return found;
  // One body inside the other: then every point of it is.
  const Vec3 of_b = a_from_b.point(b.parts_.front().support(Vec3::UnitX()));
  const Vec3 of_a = a.parts_.front().support(Vec3::UnitX());
  if (a.holds(of_b)) return {0.0, 0.0, found.normal, of_b, of_b};
  if (b.holds(a_from_b.inverse().point(of_a))) return {0.0, 0.0, found.normal, of_a, of_a};
  return found;
}

}  // namespace frustum::stock

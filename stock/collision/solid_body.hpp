// A body of convex parts, and how far two such bodies are from each other.
//
// Model    : parts are convex (box, body of revolution, slab of a loft, facet of a mesh) in a
//            hierarchy of boxes. Two bodies are compared from the roots down: pairs of boxes that
//            are farther apart than the nearest parts so far are left out. All of it is in double
//            precision, so that nothing is left out by rounding. A closed mesh is also met by what
//            is wholly inside it
// Units    : mm; frame: that of the body
// Shape    : about log(parts) boxes where bodies are apart
// Errors   : none
// Accuracy : as stock/collision/convex_distance.hpp of the nearest parts
// Threads  : const member functions may be called from any number of threads
#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "core/box.hpp"
#include "core/pose.hpp"
#include "cutter/body/body.hpp"
#include "stock/collision/convex_distance.hpp"
#include "stock/collision/convex_shape.hpp"
#include "stock/solid/blank.hpp"
#include "stock/solid/facet_solid.hpp"

namespace frustum::stock {

class SolidBody {
 public:
  // Precondition: at least one part.
  explicit SolidBody(std::vector<ConvexShape> parts,
                     std::shared_ptr<const FacetSolid> closed = nullptr);
  [[nodiscard]] static SolidBody of(const cutter::Body& body);
  // Precondition: closed, facing outwards.
  [[nodiscard]] static SolidBody of(std::shared_ptr<const FacetSolid> mesh);
  [[nodiscard]] static SolidBody of(const BlankShape& shape);

  [[nodiscard]] bool is_convex() const { return parts_.size() == 1; }
  [[nodiscard]] const Box& bounds() const { return nodes_.front().box; }
  // Of the convex hull of all parts.
  [[nodiscard]] Vec3 support(const Vec3& d) const;

  friend Separation separation(const SolidBody& a, const SolidBody& b, const Pose& a_from_b);

 private:
  struct Node {
    Box box{};
    std::uint32_t first = 0, second = 0;  // nodes; of a leaf: its part, and `second` is 0
    [[nodiscard]] bool is_leaf() const { return second == 0; }
  };
  class Search;
  std::uint32_t build(std::vector<std::uint32_t>& order, std::size_t begin, std::size_t end);
  [[nodiscard]] bool holds(const Vec3& point) const {
    return closed_ != nullptr && closed_->contains(point);
  }

  std::vector<ConvexShape> parts_;
  std::vector<Box> boxes_;  // of the parts
  std::vector<Node> nodes_{};
  std::shared_ptr<const FacetSolid> closed_;
};

// In the frame of a; `upper` is of the nearest parts.
[[nodiscard]] Separation separation(const SolidBody& a, const SolidBody& b, const Pose& a_from_b);

}  // namespace frustum::stock

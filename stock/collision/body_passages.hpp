// Where shanks and holders pass by the blank, segment by segment.
//
// Units: mm; frame: workpiece. Errors: none.
#pragma once

#include <compare>
#include <cstdint>
#include <functional>
#include <set>
#include <vector>

#include "core/interval_set.hpp"
#include "core/ray.hpp"
#include "kinematics/path/tool_path.hpp"
#include "stock/collision/collision.hpp"
#include "stock/solid/removal.hpp"
#include "stock/solid/workpiece.hpp"

namespace frustum::stock {

// mm of material within a body. What the body covers when it is shrunk by the margin it covers with
// the margin on both sides, or all that there is of the material.
inline constexpr double kEnough = 0.5 * kCollisionMargin;

struct BodyInBlock {
  std::uint32_t block = 0;
  CollisionBody body = CollisionBody::shank;
  auto operator<=>(const BodyInBlock&) const = default;
};

// One body on one segment, near a ray.
struct Passage {
  std::uint32_t segment = 0;
  const NonCuttingBody* body = nullptr;
  RaySpan span{};  // of the ray, within the box of all that the body covers
};

// What the body, shrunk by the margin, surely covers on a segment: standing bodies a quarter of a
// radius apart.
[[nodiscard]] IntervalSet core_along(const Ray& ray, const NonCuttingBody& body,
                                     const kinematics::ToolPath& path,
                                     const kinematics::PathSegment& segment);

// All passages that come near the blank. Their boxes are one scene a body, in which a ray finds
// them. Workpiece and bodies must outlive it.
class Passages {
 public:
  // But those that are `known` to collide.
  Passages(const Workpiece& workpiece, const std::vector<NonCuttingBody>& bodies,
           const std::set<BodyInBlock>& known);
  ~Passages();
  Passages(const Passages&) = delete;
  Passages& operator=(const Passages&) = delete;

  [[nodiscard]] bool empty() const;
  // But those of bodies that surely meet none of the pieces of material, each before the block that
  // takes it away; `pieces()` is asked for where that is worth it.
  using Pieces = std::function<const std::vector<RemovedPiece>&()>;
  [[nodiscard]] std::vector<Passage> near(const Ray& ray, RaySpan span, const Pieces& pieces) const;

 private:
  struct OfBody;
  void collect(const NonCuttingBody& body, const std::set<BodyInBlock>& known);

  const kinematics::ToolPath& path_;
  const Blank& blank_;
  std::vector<OfBody> bodies_;
};

}  // namespace frustum::stock

// Which boxes a ray may cross: a bounding volume hierarchy over swept stretches.
//
// Boxes are grown outwards to cover single-precision rounding, so that a box that the ray crosses is
// never missed; the answer is a list of candidates, never a coordinate.
// Units: mm. Valid range: coordinates within 10 m.
// Threads: candidates() may be called from any number of threads.
#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "core/pose.hpp"
#include "cutter/ray.hpp"

namespace frustum::cutter {

struct Box {
  Vec3 min = Vec3::Zero();
  Vec3 max = Vec3::Zero();
};

class CandidateTree {
 public:
  explicit CandidateTree(std::vector<Box> boxes);
  ~CandidateTree();
  CandidateTree(CandidateTree&&) noexcept;
  CandidateTree& operator=(CandidateTree&&) noexcept;
  CandidateTree(const CandidateTree&) = delete;
  CandidateTree& operator=(const CandidateTree&) = delete;

  // Indices of all boxes that the ray may cross within the span, ascending.
  [[nodiscard]] std::vector<std::uint32_t> candidates(const Ray& ray, RaySpan span) const;

 private:
  struct Scene;
  std::unique_ptr<Scene> scene_;
};

}  // namespace frustum::cutter

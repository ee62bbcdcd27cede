// How deep a shank or holder is in the material during a block.
//
// Model    : along each axis the longest overlap of a ray near a place where body and material
//            overlap, found by going from ray to ray as long as they have more, in ever smaller
//            steps; of the axes the one along which it is shortest
// Units    : mm; frame: workpiece
// Errors   : none
// Accuracy : along a ray that of Workpiece; of a body that stands deep in flat material rays are
//            half of `last_step` or less beside the longest
// Source   : ours
#pragma once

#include <vector>

#include "stock/collision/body_passages.hpp"

namespace frustum::stock {

// Of body and material along a ray.
struct Overlap {
  double length = 0.0;
  Vec3 point = Vec3::Zero();  // its middle
};

// Workpiece, timetable and bodies must outlive it.
class DepthSearch {
 public:
  DepthSearch(const Workpiece& workpiece, const Timetable& table,
              const std::vector<NonCuttingBody>& bodies, double first_step, double last_step)
      : workpiece_(workpiece),
        table_(table),
        bodies_(bodies),
        first_step_(first_step),
        last_step_(last_step) {}

  [[nodiscard]] Overlap depth_near(const BodyInBlock& body, const Vec3& place) const;
  // Of the three rays through the place alone.
  [[nodiscard]] Overlap depth_at(const BodyInBlock& body, const Vec3& place) const;

 private:
  [[nodiscard]] Overlap along(int axis, const BodyInBlock& key, const Vec3& place) const;
  [[nodiscard]] Overlap longest_along(int axis, const BodyInBlock& key, const Vec3& place) const;

  const Workpiece& workpiece_;
  const Timetable& table_;
  const std::vector<NonCuttingBody>& bodies_;
  double first_step_, last_step_;
};

}  // namespace frustum::stock

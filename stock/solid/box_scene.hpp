// Many boxes, and which of them a ray may cross or a point may be near to: candidates from Embree.
//
// Model    : Embree calculates in single precision. The boxes are given to it about their common
//            centre, scaled by a power of two into [-1, 1]^3, and enlarged by d = 2^-17 on every
//            side. A ray is cut down to the ball around all boxes before it is rounded, so that its
//            origin is within 2.5 of the centre and it is at most 3.5 long. What single precision
//            then moves, with u = 2^-24: the origin by 2.5 u, the ray's points by 3.5 u through its
//            direction, the planes of a box by 2.5 u + 3.5 (u + 4.3 u) in Embree's test, whose
//            reciprocal is off by 4.3 u (it is not the robust one for boxes of our own). The sum is
//            below 28 u < d / 4: no box that a ray crosses is left out. Where double precision
//            itself is too coarse (an origin more than 2^28 sizes away), all boxes are candidates
// Units    : mm
// Shape    : a hierarchy of boxes, built once; about log(boxes) to answer
// Errors   : none; std::bad_alloc when memory ends
// Accuracy : a superset: every box that the ray or the ball meets, and others up to 2^-16 of the
//            size of all away from it. The answer belongs to a test in double precision by whoever
//            asks. The order is not fixed
// Source   : Wald, Woop, Benthin, Johnson, Ernst 2014, ACM TOG 33(4) (Embree)
// Threads  : const member functions may be called from any number of threads
#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <type_traits>

#include "core/box.hpp"
#include "core/pose.hpp"
#include "core/ray.hpp"

namespace frustum::stock {

class BoxScene {
 public:
  BoxScene() = default;
  explicit BoxScene(std::span<const Box> boxes);

  [[nodiscard]] bool empty() const { return scene_ == nullptr; }

  // Calls visit(k) for every box k that the ray crosses within the span. What it returns is where
  // along the ray to stop: boxes that begin farther away may be left out from then on.
  template <typename Visit>
  void along(const Ray& ray, const RaySpan& span, Visit&& visit) const {
    walk_ray(ray, span, &call<std::remove_reference_t<Visit>>, &visit);
  }
  // Calls visit(k) for every box k within the distance of the point, near ones first as a rule.
  // What it returns is the distance within which to go on looking.
  template <typename Visit>
  void near(const Vec3& point, double distance, Visit&& visit) const {
    walk_ball(point, distance, &call<std::remove_reference_t<Visit>>, &visit);
  }

 private:
  using Visitor = double (*)(void* visit, std::uint32_t box);
  template <typename Visit>
  static double call(void* visit, std::uint32_t box) {
    return (*static_cast<Visit*>(visit))(box);
  }
  void walk_ray(const Ray& ray, const RaySpan& span, Visitor visitor, void* visit) const;
  void walk_ball(const Vec3& point, double distance, Visitor visitor, void* visit) const;

  class Scene;
  std::shared_ptr<const Scene> scene_{};  // never changes, so that copies share it
};

}  // namespace frustum::stock

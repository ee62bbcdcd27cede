#include "metrology/probing/ball_on_planes.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

namespace frustum::metrology {
namespace {

// A ray shifted by -r m reaches the plane after offset - r m . slope.
struct PlaneTravel {
  Vec3 normal;
  double offset;
  Vec3 slope;
};

PlaneTravel travel_to(const MaterialPlane& plane, const BallPath& path) {
  const Vec3 slope = plane.normal / path.outward.vec().dot(plane.normal);
  return {plane.normal, (path.start - plane.point).dot(slope), slope};
}

class LeastTravel {
 public:
  LeastTravel(const BallPath& path, std::span<const MaterialPlane> planes) : path_(path) {
    for (const MaterialPlane& plane : planes) planes_.push_back(travel_to(plane, path));
  }

  RestingBall found() {
    for (std::size_t i = 0; i < planes_.size(); ++i) {
      look(planes_[i].normal);
      for (std::size_t j = 0; j < i; ++j) {
        look_at_edge(planes_[i], planes_[j]);
        for (std::size_t k = 0; k < j; ++k) look_at_corner(planes_[i], planes_[j], planes_[k]);
      }
    }
    return best_;
  }

 private:
  // Directions that cannot be are not finite, and lose every comparison; those between planes that
  // are nearly the same may be any.
  void look(const Vec3& direction) {
    const Vec3 m = direction.normalized();
    double travel = -HUGE_VAL;
    for (const PlaneTravel& plane : planes_) {
      travel = std::max(travel, plane.offset - path_.radius * m.dot(plane.slope));
    }
    if (m.allFinite() && travel < best_.travel) best_ = {m, travel};
  }

  // Between both normals, where the rays to both planes are as long.
  void look_at_edge(const PlaneTravel& one, const PlaneTravel& other) {
    const Vec3 across = (other.normal - one.normal.dot(other.normal) * one.normal).normalized();
    const Vec3 apart = other.slope - one.slope;
    const double along = one.normal.dot(apart), beside = across.dot(apart);
    const double cosine = (other.offset - one.offset) / (path_.radius * std::hypot(along, beside));
    const double angle = std::atan2(beside, along) - std::acos(cosine);
    look(std::cos(angle) * one.normal + std::sin(angle) * across);
  }

  // Toward the centre that is as far from their common point as the ball is large.
  void look_at_corner(const PlaneTravel& a, const PlaneTravel& b, const PlaneTravel& c) {
    Mat3 slopes;
    slopes << a.slope.transpose(), b.slope.transpose(), c.slope.transpose();
    const Vec3 corner = slopes.inverse() * -Vec3(a.offset, b.offset, c.offset);  // from the start
    const double below = -path_.outward.vec().dot(corner);
    const double beside = (corner + below * path_.outward.vec()).squaredNorm();
    const double travel = below - std::sqrt(path_.radius * path_.radius - beside);
    look(-travel * path_.outward.vec() - corner);
  }

  BallPath path_;
  std::vector<PlaneTravel> planes_{};
  RestingBall best_{Vec3::UnitZ(), HUGE_VAL};
};

}  // namespace

RestingBall ball_on_planes(const BallPath& path, std::span<const MaterialPlane> planes) {
  return LeastTravel(path, planes).found();
}

}  // namespace frustum::metrology

// A surface of B-splines over the unit square, and the place on it that is nearest to a point.
//
// Model    : tensor product r(u, v) of clamped uniform B-splines over a net of points, cubic or of
//            the degree that fewer points allow; two rows make a ruled surface, straight in v.
//            Beyond 0 and 1 it goes on straight. The normal is r_v x r_u
// Units    : mm; u and v are numbers
// Shape    : a net of 2 x 2 points or more, row after row; u runs along a row
// Errors   : none; has_normals() tells nets that fold or have no area
// Accuracy : 1e-12 of the size of the net (tests/core/spline_surface_test.cpp)
// Source   : Piegl, Tiller 1997, The NURBS Book, A2.2, A2.3, 6.1
#pragma once

#include <array>
#include <cstddef>
#include <span>
#include <vector>

#include "core/pose.hpp"

namespace frustum {

// A point with derivatives.
struct SplinePoint {
  Vec3 r = Vec3::Zero();
  Vec3 u = Vec3::Zero(), v = Vec3::Zero();
  Vec3 uu = Vec3::Zero(), uv = Vec3::Zero(), vv = Vec3::Zero();

  [[nodiscard]] Vec3 normal() const { return v.cross(u).normalized(); }
  // Normal curvature along u (1/mm): above 0 where the surface bulges along its normal.
  [[nodiscard]] double curvature_along_u() const;
};

struct SplineFoot {
  double u = 0.0, v = 0.0;
  double distance = 0.0;  // mm, along the normal
  Vec3 normal = Vec3::UnitZ();
};

class SplineSurface {
 public:
  static constexpr std::size_t kMostDegree = 3;

  // Precondition: `net` has rows of `columns` points each; 2 rows and 2 columns or more.
  SplineSurface(std::vector<Vec3> net, std::size_t columns);
  // Between two curves of as many points each: v = 0 and v = 1.
  [[nodiscard]] static SplineSurface ruled(std::span<const Vec3> lower,
                                           std::span<const Vec3> upper);

  [[nodiscard]] SplinePoint at(double u, double v) const;
  [[nodiscard]] Vec3 point(double u, double v) const { return at(u, v).r; }
  // By Newton's method from the nearest of some samples, which must be nearer than the centres of
  // curvature.
  [[nodiscard]] SplineFoot nearest(const Vec3& point) const;

  [[nodiscard]] const std::vector<Vec3>& net() const { return net_; }
  [[nodiscard]] std::size_t columns() const { return columns_; }
  [[nodiscard]] std::size_t rows() const { return net_.size() / columns_; }
  // Whether the normal is defined at all samples, and does not turn by more than a right angle
  // from one to the next.
  [[nodiscard]] bool has_normals() const;
  // Each point of the net moved.
  [[nodiscard]] SplineSurface moved(const Pose& to_from) const;

  bool operator==(const SplineSurface& other) const {
    return columns_ == other.columns_ && net_ == other.net_;
  }

 private:
  // Of one span in v and one in u: [power of the way in v][power of the way in u].
  using Patch = std::array<std::array<Vec3, kMostDegree + 1>, kMostDegree + 1>;

  std::vector<Vec3> net_;
  std::size_t columns_;
  std::size_t spans_u_ = 1, spans_v_ = 1, degree_v_ = 1;
  std::vector<Patch> patches_{};
  // Where searches begin.
  std::size_t across_, along_;  // samples in v and in u
  std::vector<double> x_{}, y_{}, z_{};
};

}  // namespace frustum

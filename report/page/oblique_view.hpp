// Points in space as places of a drawing: seen from the front right above, without perspective.
//
// Units: mm in, pixels of the drawing out. Errors: none; points that are one still have a scale.
#pragma once

#include <vector>

#include "core/pose.hpp"
#include "report/chart/svg.hpp"

namespace frustum::report {

class ObliqueView {
 public:
  // All points fit into width x height, with a margin.
  ObliqueView(const std::vector<Vec3>& points, double width, double height, double margin);
  [[nodiscard]] SvgPoint at(const Vec3& point) const;

 private:
  [[nodiscard]] Eigen::Vector2d flat(const Vec3& p) const { return {right_.dot(p), up_.dot(p)}; }

  Vec3 back_ = Vec3(0.62, -1.0, 0.72).normalized();
  Vec3 right_ = Vec3::UnitZ().cross(back_).normalized();
  Vec3 up_ = back_.cross(right_);
  double scale_ = 1.0;
  Eigen::Vector2d middle_ = Eigen::Vector2d::Zero();  // of the drawing
  Eigen::Vector2d centre_ = Eigen::Vector2d::Zero();  // of the points
};

}  // namespace frustum::report

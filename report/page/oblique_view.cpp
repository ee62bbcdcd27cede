#include "report/page/oblique_view.hpp"

#include <algorithm>
#include <limits>

namespace frustum::report {

ObliqueView::ObliqueView(const std::vector<Vec3>& points, double width, double height,
                         double margin)
    : middle_(0.5 * width, 0.5 * height) {
  Eigen::Array2d low = Eigen::Array2d::Constant(std::numeric_limits<double>::infinity());
  Eigen::Array2d high = -low;
  for (const Vec3& p : points) {
    low = low.min(flat(p).array());
    high = high.max(flat(p).array());
  }
  const Eigen::Array2d size = (high - low).max(1e-6);  // a point still has a scale
  scale_ = std::min((width - 2.0 * margin) / size.x(), (height - 2.0 * margin) / size.y());
  centre_ = 0.5 * (low + high).matrix();
}

SvgPoint ObliqueView::at(const Vec3& point) const {
  const Eigen::Vector2d from_centre = scale_ * (flat(point) - centre_);
  return {middle_.x() + from_centre.x(), middle_.y() - from_centre.y()};
}

}  // namespace frustum::report

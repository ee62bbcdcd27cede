// Where a measured feature ends, and the median line that its sections give.
//
// Model    : points of the element in which a linear distance is largest: the ends of an axis or
//            line, the corners of a rectangle, two opposite points of a disc; the planned ends laid
//            onto the measured element. The median line is the row of centres of the least-squares
//            circles of the sections
// Units    : mm
// Shape    : one feature
// Errors   : fewer than two sections; a section whose circle cannot be fitted
// Accuracy : rounding of doubles
// Source   : ISO 1101 (extent of a toleranced feature), ISO 17450-3 (median line)
#pragma once

#include <vector>

#include "core/result.hpp"
#include "metrology/characteristic/fitted_feature.hpp"

namespace frustum::metrology {

// `toward`: in which the two points of a disc lie; any direction for other shapes.
[[nodiscard]] std::vector<Vec3> extremes(const PlannedFeature& planned, const Element& element,
                                         const Vec3& toward);

// The same for all directions at once: the rim of a disc, less than 0.1 % of its radius between
// points.
[[nodiscard]] std::vector<Vec3> outline(const PlannedFeature& planned, const Element& element);

// The centres of the sections, and the variance of each across the axis in those of a point.
struct MedianLine {
  std::vector<Vec3> centres{};
  std::vector<double> own{};
};
[[nodiscard]] Result<MedianLine> median_line(const FittedFeature& feature);

}  // namespace frustum::metrology

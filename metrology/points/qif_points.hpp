// Measured points of a QIF results document, by the feature that they were measured on.
//
// The document names for each measured feature its item, which has the name, and whole point sets,
// ranges of them or single points of them, counted from 1. Several measurements of a feature are
// joined in their order.
// Units  : mm, by the linear unit of the document (metres per unit)
// Errors : what is no XML or no QIF document, a reference to nothing, points in binary form, in a
//          coordinate system of their own, points that are centres of the ball where the surface is
//          asked for and the other way round, lists that are no numbers or not as many as `count`
//          says; without points; with line, column and element
// Source : QIF 3.0 (ISO 23952), QIFResults.xsd and Features.xsd
#pragma once

#include <string_view>
#include <vector>

#include "core/result.hpp"
#include "metrology/points/feature_points.hpp"

namespace frustum::metrology {

struct QifPoints {
  std::vector<FeaturePoints> features{};
  double unit = 1.0;  // of the document, mm
};

// Diagnostics name no file.
[[nodiscard]] Result<QifPoints> parse_qif_points(std::string_view bytes,
                                                 PointMeaning meaning = PointMeaning::surface);

}  // namespace frustum::metrology

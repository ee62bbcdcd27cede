// Files of measured points: CSV or columns separated by blanks.
//
// Accepted: "x y z" or "x,y,z" lines (mm); an optional first line that holds only the number of
//           points;
// an optional header such as feature,section,x,y,z (names in any order; feature and section may be
// left out); comments from # to the end of the line; blank lines.
// Units  : mm
// Errors : wrong number of columns, text where a number belongs, NaN or infinity, a count that does
//          not fit, an empty file: each with file, line and column
#pragma once

#include <filesystem>
#include <string_view>
#include <vector>

#include "core/result.hpp"
#include "metrology/cmm.hpp"

namespace frustum::metrology {

// All points of a file that has no features, in order.
[[nodiscard]] Result<std::vector<Vec3>> read_points(const std::filesystem::path& file);

// Points by feature, in order of appearance; without a feature column one entry with an empty name.
[[nodiscard]] Result<std::vector<FeaturePoints>> read_feature_points(
    const std::filesystem::path& file);
[[nodiscard]] Result<std::vector<FeaturePoints>> parse_feature_points(
    std::string_view text, const std::filesystem::path& file = {});

}  // namespace frustum::metrology

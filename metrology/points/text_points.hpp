// Points in a file of text: a table with or without a header, or an XYZIJK file of PC-DMIS.
//
// What is read is in point_file.hpp.
// Units  : mm out
// Errors : each with file, line and column
#pragma once

#include <filesystem>
#include <optional>
#include <string_view>
#include <vector>

#include "core/result.hpp"
#include "metrology/points/feature_points.hpp"
#include "metrology/points/length_unit.hpp"

namespace frustum::metrology {

struct FoundPoints {
  FeaturePoints feature{};
  std::vector<double> weights{};  // one a point, or none at all
};
[[nodiscard]] Result<std::vector<FoundPoints>> parse_text_points(
    std::string_view bytes, const std::filesystem::path& file,
    const std::optional<LengthUnit>& unit);

}  // namespace frustum::metrology

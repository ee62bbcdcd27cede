// Files of measured points: CSV, columns separated by blanks (XYZ), PLY, QIF.
//
// Text: "x y z" or "x,y,z" lines; an optional first line that holds only the number of points; an
//       optional header such as feature,section,x,y,z (names in any order, English or German:
//       column_heading.hpp; all but x, y and z may be left out; nominal and point columns are not
//       used); without a header "x y z i j k" too, where i j k has length 1. Directions are not
//       used. Decimal commas where semicolons or tabs separate the columns (table_form.hpp). Names
//       with a comma in quotes as RFC 4180 says, a ' before = + - @ is none of the name
//       (csv_field.hpp); comments from # to the end of the line; blank lines. Lines end with LF,
//       CR LF or CR; UTF-8 or UTF-16. XYZIJK: files of PC-DMIS (pcdmis_line.hpp). PLY (by the
//       extension .ply): the vertices, text or binary. QIF (.qif): the measured points of each
//       feature.
// Units  : mm, unless the file says otherwise: a comment "# unit: inch" before the first point, a
//          heading "x [inch]" at each of x, y and z, or the caller who knows. Points come out in mm
// Errors : wrong number of columns, text where a number belongs, decimal commas among points, NaN
//          or infinity, a count that does not fit, an unknown unit, two that contradict each other
//          (the caller's counts) or one that holds for some coordinates only, an empty file, a
//          directory, an encoding that is not read: each with file, line and column
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "core/result.hpp"
#include "metrology/points/feature_points.hpp"
#include "metrology/points/length_unit.hpp"

namespace frustum::metrology {

struct PointCloud {
  std::vector<Vec3> points{};     // mm
  std::vector<double> weights{};  // one a point, or none at all
};
// The points of a file in order, or those of one feature; an error when they are of several.
// `unit`: of a file that states no other.
[[nodiscard]] Result<PointCloud> read_point_cloud(const std::filesystem::path& file,
                                                  const std::optional<LengthUnit>& unit = {},
                                                  const std::optional<std::string>& feature = {});

// Points by feature, in order of appearance; without a feature column one entry with an empty name.
// Weights are refused: the evaluation of a plan has none.
[[nodiscard]] Result<std::vector<FeaturePoints>> read_feature_points(
    const std::filesystem::path& file, const std::optional<LengthUnit>& unit = {});
// Its bytes, for whoever keeps them beside the points.
[[nodiscard]] Result<std::string> read_point_bytes(const std::filesystem::path& file);
// What such a file holds; `file` names it, and its extension tells PLY and QIF from text. A QIF
// says what its points are: others than `meaning` are refused.
[[nodiscard]] Result<std::vector<FeaturePoints>> parse_feature_points(
    std::string_view text, const std::filesystem::path& file = {},
    const std::optional<LengthUnit>& unit = {}, PointMeaning meaning = PointMeaning::surface);

}  // namespace frustum::metrology

// Files of points as PC-DMIS reads and writes them (.xyz): a first line XYZIJK, then numbers that
// commas separate.
//
// Model    : 3 numbers a line: a point; 5: a point and two that mean nothing; 6: with its vector,
//            which is not used; 8: the same and two that mean nothing. 4 and 7 are circles with
//            their diameter: no points. METRIC in columns 11 to 16 of the first line: mm, else
//            inches
// Units    : mm per unit in, mm out
// Shape    : one line
// Errors   : point-columns, length-unit: each with its column
// Accuracy : as std::from_chars
// Source   : Hexagon, PC-DMIS help 2019.1 and 2023.1: "Notes on XYZ Files", "Importing an XYZ File
//            as CAD Data"
#pragma once

#include <string_view>
#include <vector>

#include "core/pose.hpp"
#include "core/result.hpp"
#include "metrology/points/length_unit.hpp"
#include "metrology/points/line_words.hpp"

namespace frustum::metrology {

[[nodiscard]] bool is_pcdmis_header(std::string_view line);
[[nodiscard]] Result<LengthUnit> pcdmis_unit(std::string_view header);
[[nodiscard]] Result<Vec3> pcdmis_point(const std::vector<Word>& words, double mm);

}  // namespace frustum::metrology

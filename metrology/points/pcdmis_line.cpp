#include "metrology/points/pcdmis_line.hpp"

#include <fmt/format.h>

#include <cmath>

#include "core/counted.hpp"

namespace frustum::metrology {
namespace {

constexpr std::string_view kKey = "XYZIJK";
constexpr std::size_t kMetricColumn = 10;  // counted from 0

Diagnostic at_column(Diagnostic d, int column) {
  d.column = column;
  return d;
}

}  // namespace

bool is_pcdmis_header(std::string_view line) { return line.starts_with(kKey); }

Result<LengthUnit> pcdmis_unit(std::string_view header) {
  const std::size_t word = header.find_first_not_of(" \t", kKey.size());
  if (word == std::string_view::npos) return *length_unit("inch");
  std::string_view rest = header.substr(word);
  rest = rest.substr(0, rest.find_last_not_of(" \t") + 1);
  if (rest == "METRIC" && word == kMetricColumn) return *length_unit("mm");
  return at_column(
      error("length-unit"_id, fmt::format("'{}' after XYZIJK does not state the unit", rest),
            "METRIC in columns 11 to 16 means mm, nothing there inches"),
      static_cast<int>(word) + 1);
}

Result<Vec3> pcdmis_point(const std::vector<Word>& words, double mm) {
  if (words.size() == 4 || words.size() == 7) {
    return at_column(
        error("point-columns"_id,
              fmt::format("{} numbers are a circle with its diameter, not a point", words.size()),
              "export its measured points"),
        words.back().column);
  }
  if (words.size() < 3 || words.size() > 8) {
    return at_column(
        error("point-columns"_id,
              fmt::format("{}, expected 3, 5, 6 or 8", counted(words.size(), "column")),
              "a line of an XYZIJK file holds x, y, z and perhaps i, j, k"),
        words.back().column);
  }
  Vec3 point = Vec3::Zero();
  for (std::size_t i = 0; i < words.size(); ++i) {
    const auto number = number_in(words[i].text);
    const double scale = i < 3 ? mm : 1.0;
    if (!number || !std::isfinite(scale * *number)) {
      return at_column(
          error("point-columns"_id, fmt::format("'{}' is not a finite number", words[i].text),
                "x, y, z and perhaps i, j, k expected here"),
          words[i].column);
    }
    if (i < 3) point[static_cast<Eigen::Index>(i)] = scale * *number;
  }
  return point;
}

}  // namespace frustum::metrology

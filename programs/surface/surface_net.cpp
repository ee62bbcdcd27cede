#include "programs/surface/surface_net.hpp"

#include <fmt/format.h>

#include <cmath>
#include <utility>

#include "core/csv.hpp"
#include "core/whole_file.hpp"

namespace frustum::programs {

Result<SplineSurface> parse_surface_net(std::string_view text, const std::filesystem::path& file) {
  const auto table = CsvTable::parse(text, file, {"row", "x", "y", "z"});
  if (!table) return table.error();
  constexpr double kFarthest = 5000.0;   // mm
  constexpr std::size_t kMost = 250000;  // points
  std::vector<Vec3> net;
  std::size_t columns = 0, rows = 0, in_row = 0;
  const auto short_row = [&](const CsvRow& row) {
    return table->about(
        row, 0, "net-rows"_id,
        fmt::format("row {} has {} points, row 0 has {}", rows - 1, in_row, columns),
        "all rows have as many");
  };
  for (const CsvRow& row : table->rows()) {
    const auto number = table->number(row, 0);
    if (!number) return number.error();
    if (*number == static_cast<double>(rows)) {
      if (rows == 1) columns = in_row;
      if (rows > 1 && in_row != columns) return short_row(row);
      ++rows;
      in_row = 0;
    } else if (rows == 0 || *number != static_cast<double>(rows - 1)) {
      return table->about(row, 0, "net-rows"_id,
                          fmt::format("row {:g} follows row {}", *number,
                                      rows == 0 ? std::string("none") : std::to_string(rows - 1)),
                          "rows count 0, 1, 2, ... one after the other");
    }
    Vec3 p = Vec3::Zero();
    for (std::size_t k = 0; k < 3; ++k) {
      const auto value = table->number(row, k + 1);
      if (!value) return value.error();
      if (std::abs(*value) > kFarthest) {
        return table->about(row, k + 1, "out-of-range"_id,
                            fmt::format("{:g} mm is farther than any test piece", *value),
                            fmt::format("at most {:g} mm", kFarthest));
      }
      p[static_cast<Eigen::Index>(k)] = *value;
    }
    net.push_back(p);
    ++in_row;
    if (net.size() > kMost) {
      return table->about(row, 0, "out-of-range"_id,
                          fmt::format("the net has more than {} points", kMost));
    }
  }
  if (rows < 2 || columns < 2 || in_row != columns) {
    if (rows >= 2 && columns >= 2) return short_row(table->rows().back());
    Diagnostic failure = error("net-rows"_id, "a net has two rows or more, of two points or more");
    failure.file = file.string();
    return failure;
  }
  return SplineSurface(std::move(net), columns);
}

Result<SplineSurface> read_surface_net(const std::filesystem::path& file) {
  const auto text = read_whole_file(file);
  if (!text) return text.error();
  return parse_surface_net(*text, file);
}

}  // namespace frustum::programs

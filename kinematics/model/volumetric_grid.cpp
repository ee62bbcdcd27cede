#include "kinematics/model/volumetric_grid.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "kinematics/model/number_table.hpp"

namespace frustum::kinematics {
namespace {

struct GridColumn {
  const char* name;
  bool angle;
  bool required;
};
constexpr std::array<GridColumn, 9> kColumns{{{"x", false, true},
                                              {"y", false, true},
                                              {"z", false, true},
                                              {"dx", false, true},
                                              {"dy", false, true},
                                              {"dz", false, true},
                                              {"da", true, false},
                                              {"db", true, false},
                                              {"dc", true, false}}};
constexpr const char* kColumnsHint =
    "the columns are x_mm,y_mm,z_mm,dx_um,dy_um,dz_um and perhaps da_urad,db_urad,dc_urad";

std::vector<double> distinct(std::vector<double> values) {
  std::sort(values.begin(), values.end());
  values.erase(std::unique(values.begin(), values.end()), values.end());
  return values;
}

std::size_t index_of(const std::vector<double>& positions, double value) {
  return static_cast<std::size_t>(std::lower_bound(positions.begin(), positions.end(), value) -
                                  positions.begin());
}

struct PlaceInGrid {
  std::size_t index = 0;
  double share = 0.0;
};
PlaceInGrid place_in(const std::vector<double>& positions, double q) {
  if (q <= positions.front()) return {0, 0.0};
  if (q >= positions.back()) return {positions.size() - 2, 1.0};
  const auto index = static_cast<std::size_t>(
      std::upper_bound(positions.begin(), positions.end(), q) - positions.begin() - 1);
  return {index, (q - positions[index]) / (positions[index + 1] - positions[index])};
}

}  // namespace

VolumetricGrid::VolumetricGrid(std::array<std::vector<double>, 3> positions,
                               std::vector<GridErrors> errors)
    : positions_(std::move(positions)), errors_(std::move(errors)) {}

std::array<std::size_t, 3> VolumetricGrid::size() const {
  return {positions_[0].size(), positions_[1].size(), positions_[2].size()};
}

GridErrors VolumetricGrid::at(const AxisPositions& q) const {
  const PlaceInGrid x = place_in(positions_[0], q[AxisLetter::X]);
  const PlaceInGrid y = place_in(positions_[1], q[AxisLetter::Y]);
  const PlaceInGrid z = place_in(positions_[2], q[AxisLetter::Z]);
  GridErrors sum;
  for (std::size_t corner = 0; corner < 8; ++corner) {
    const std::size_t i = corner >> 2U & 1U, j = corner >> 1U & 1U, k = corner & 1U;
    const double weight = (i != 0 ? x.share : 1.0 - x.share) * (j != 0 ? y.share : 1.0 - y.share) *
                          (k != 0 ? z.share : 1.0 - z.share);
    const std::size_t row = (x.index + i) * positions_[1].size() + y.index + j;
    const GridErrors& point = errors_[row * positions_[2].size() + z.index + k];
    sum.shift += weight * point.shift;
    sum.turn += weight * point.turn;
  }
  return sum;
}

Result<VolumetricGrid> VolumetricGrid::load(const std::filesystem::path& file) {
  const auto table = read_number_table(file);
  if (!table) return table.error();
  for (const NumberTable::Column& column : table->columns) {
    const auto* known = std::find_if(kColumns.begin(), kColumns.end(),
                                     [&](const GridColumn& c) { return column.name == c.name; });
    if (known == kColumns.end()) {
      return table->problem("unknown-column"_id, table->header_line, column.place,
                            fmt::format("unknown column '{}'", column.name), kColumnsHint);
    }
    if ((column.unit == UnitKind::angle) != known->angle) {
      return table->problem("error-grid"_id, table->header_line, column.place,
                            fmt::format("column '{}' must be {}", column.name,
                                        known->angle ? "an angle" : "a length"),
                            kColumnsHint);
    }
  }
  std::array<const NumberTable::Column*, 9> columns{};
  for (std::size_t c = 0; c < columns.size(); ++c) {
    columns[c] = table->column(kColumns[c].name);
    if (columns[c] == nullptr && kColumns[c].required) {
      return table->problem("error-grid"_id, table->header_line, 0,
                            fmt::format("column '{}' is missing", kColumns[c].name), kColumnsHint);
    }
  }
  std::array<std::vector<double>, 3> positions;
  for (std::size_t d = 0; d < 3; ++d) {
    positions[d] = distinct(columns[d]->values);
    if (positions[d].size() < 2) {
      return table->problem("error-grid"_id, 0, 0,
                            fmt::format("the grid has {} position(s) along {}", positions[d].size(),
                                        kColumns[d].name),
                            "at least two are needed");
    }
  }
  const std::size_t total = positions[0].size() * positions[1].size() * positions[2].size();
  if (total > 8 * table->lines.size() + 64) {
    return table->problem("error-grid"_id, 0, 0,
                          fmt::format("{} points do not fill the {} x {} x {} positions they name",
                                      table->lines.size(), positions[0].size(), positions[1].size(),
                                      positions[2].size()),
                          "give every combination of the positions once");
  }
  std::vector<GridErrors> errors(total);
  std::vector<int> line_of(total, 0);
  for (std::size_t row = 0; row < table->lines.size(); ++row) {
    std::size_t index = 0;
    for (std::size_t d = 0; d < 3; ++d) {
      index = index * positions[d].size() + index_of(positions[d], columns[d]->values[row]);
    }
    if (line_of[index] != 0) {
      return table->problem("error-grid"_id, table->lines[row], 1,
                            fmt::format("the point of line {} again", line_of[index]));
    }
    line_of[index] = table->lines[row];
    for (std::size_t d = 0; d < 3; ++d) {
      const auto i = static_cast<Eigen::Index>(d);
      errors[index].shift[i] = columns[3 + d]->values[row];
      if (columns[6 + d] != nullptr) errors[index].turn[i] = columns[6 + d]->values[row];
    }
  }
  const auto missing = std::find(line_of.begin(), line_of.end(), 0);
  if (missing != line_of.end()) {
    const auto index = static_cast<std::size_t>(missing - line_of.begin());
    const std::size_t nz = positions[2].size(), ny = positions[1].size();
    return table->problem(
        "error-grid"_id, 0, 0,
        fmt::format("the grid has no point at x {:g}, y {:g}, z {:g} mm",
                    positions[0][index / (ny * nz)], positions[1][index / nz % ny],
                    positions[2][index % nz]),
        fmt::format("{} x {} x {} positions need {} points", positions[0].size(), ny, nz, total));
  }
  return VolumetricGrid(std::move(positions), std::move(errors));
}

}  // namespace frustum::kinematics

#include "instruments/traces/pose_trace_file.hpp"

#include <fmt/format.h>

#include <cmath>

#include "core/counted.hpp"
#include "core/decimal.hpp"
#include "instruments/traces/trace_table.hpp"

namespace frustum::instruments {
namespace {

using kinematics::AxisLetter;

const std::vector<std::string>& pose_columns() {
  static const std::vector<std::string> kColumns{"A_deg", "B_deg", "C_deg", "x_um", "y_um", "z_um"};
  return kColumns;
}

std::string column_of(AxisLetter letter) { return fmt::format("{}_deg", to_char(letter)); }

Diagnostic missing_column(const TraceTable& table, const std::string& name) {
  return table.placed(error("missing-column"_id, fmt::format("there is no column {}", name)),
                      table.header_line());
}

// That a row is of the place of the test: within what files round to.
std::optional<Diagnostics> other_place(const TraceTable& table, std::size_t row,
                                       const std::string& column, double expected) {
  constexpr double kRounding = 1e-3;
  const auto stated = table.number(row, column);
  if (!stated) return stated.error();
  if (std::abs(*stated - expected) <= kRounding) return std::nullopt;
  return Diagnostics{table.placed(
      error("other-pose"_id,
            fmt::format("{} is {:g} where the test has {:g}", column, *stated, expected),
            "rows in the order of the test, one for each of its poses"),
      table.line(row))};
}

}  // namespace

Result<std::vector<Vec3>> read_pose_trace(const std::filesystem::path& file,
                                          const kinematics::Machine& machine,
                                          std::span<const TestPose> poses) {
  const auto table = TraceTable::read(file, pose_columns());
  if (!table) return table.error();
  for (const char* name : {"x_um", "y_um", "z_um"}) {
    if (!table->has(name)) return missing_column(*table, name);
  }
  if (table->rows() != poses.size()) {
    return table->placed(
        error("row-count"_id, fmt::format("{} for {}", counted(table->rows(), "row"),
                                          counted(poses.size(), "pose"))),
        table->header_line());
  }
  std::vector<Vec3> readings;
  for (std::size_t row = 0; row < table->rows(); ++row) {
    for (const AxisLetter letter : kinematics::kRotaryAxes) {
      if (machine.joint(letter) == nullptr || !table->has(column_of(letter))) continue;
      if (auto problem =
              other_place(*table, row, column_of(letter), poses[row].at.q[letter] * kDegPerRad)) {
        return *std::move(problem);
      }
    }
    Vec3 d;
    for (Eigen::Index k = 0; k < 3; ++k) {
      const auto um = table->number(row, pose_columns()[static_cast<std::size_t>(3 + k)]);
      if (!um) return um.error();
      d[k] = *um / kUmPerMm;
    }
    readings.push_back(d);
  }
  return readings;
}

std::string pose_csv(const kinematics::Machine& machine, std::span<const TestPose> poses,
                     std::span<const Vec3> readings) {
  std::string csv;
  std::vector<AxisLetter> rotary;
  for (const AxisLetter letter : kinematics::kRotaryAxes) {
    if (machine.joint(letter) == nullptr) continue;
    rotary.push_back(letter);
    csv += column_of(letter) + ",";
  }
  csv += "x_um,y_um,z_um\n";
  for (std::size_t i = 0; i < poses.size(); ++i) {
    for (const AxisLetter letter : rotary) {
      csv += shortest_decimal(as_stated(poses[i].at.q[letter] * kDegPerRad)) + ",";
    }
    const Vec3 um = readings[i] * kUmPerMm;
    csv += fmt::format("{},{},{}\n", shortest_decimal(um.x()), shortest_decimal(um.y()),
                       shortest_decimal(um.z()));
  }
  return csv;
}

Result<std::vector<std::vector<double>>> read_diagonal_trace(
    const std::filesystem::path& file, const std::map<std::string, LineTest>& lines) {
  const auto table = TraceTable::read(file, {"diagonal", "length_mm", "reading_um"});
  if (!table) return table.error();
  for (const char* name : {"diagonal", "reading_um"}) {
    if (!table->has(name)) return missing_column(*table, name);
  }
  std::map<std::string, std::vector<double>> found;
  for (std::size_t row = 0; row < table->rows(); ++row) {
    const std::string& signs = table->text(row, "diagonal");
    const auto line = lines.find(signs);
    if (line == lines.end() || found[signs].size() == line->second.poses.size()) {
      return table->placed(
          error("other-pose"_id,
                line == lines.end()
                    ? fmt::format("the test has no diagonal {}", signs)
                    : fmt::format("diagonal {} has more points than the test", signs)),
          table->line(row));
    }
    if (table->has("length_mm")) {
      if (auto problem = other_place(*table, row, "length_mm",
                                     line->second.poses[found[signs].size()].parameter)) {
        return *std::move(problem);
      }
    }
    const auto um = table->number(row, "reading_um");
    if (!um) return um.error();
    found[signs].push_back(*um / kUmPerMm);
  }
  std::vector<std::vector<double>> readings;
  for (const auto& [signs, line] : lines) {
    if (found[signs].size() != line.poses.size()) {
      return table->placed(
          error("row-count"_id, fmt::format("diagonal {} has {} points of {}", signs,
                                            found[signs].size(), line.poses.size())),
          table->header_line());
    }
    readings.push_back(found[signs]);
  }
  return readings;
}

}  // namespace frustum::instruments

#include "instruments/traces/touch_trace_file.hpp"

#include <fmt/format.h>

#include <cmath>
#include <optional>

#include "core/decimal.hpp"
#include "core/units.hpp"
#include "instruments/traces/trace_table.hpp"

namespace frustum::instruments {
namespace {

constexpr double kSamePosition = 0.01 * kRadPerDeg;  // an axis that is indexed, not interpolated
const std::vector<std::string> kPlaces{"A_deg", "C_deg", "point"};
const std::vector<std::string> kTouched{"x_mm", "y_mm", "z_mm"};
const std::vector<std::string> kBall{"ball_x_mm", "ball_y_mm", "ball_z_mm"};
// As Fanuc's DPRNT writes them, which has neither small letters nor underlines.
const std::vector<std::string> kPrinted{"A", "C", "POINT", "BALLX", "BALLY", "BALLZ"};

std::vector<std::string> joined(std::vector<std::string> first,
                                const std::vector<std::string>& second) {
  first.insert(first.end(), second.begin(), second.end());
  return first;
}

TouchPoint turned_point(const TouchPlan& plan, const PlannedTouch& touch) {
  const TouchPoint& point = touch_points().at(touch.point);
  const Mat3 rotation = plan.rotation(touch);
  return {rotation * point.place, rotation * point.normal};
}

// Numbers of one row, by the columns.
struct Row {
  double tilt = 0.0, turn = 0.0;  // rad
  double point = 0.0;
  Vec3 place = Vec3::Zero();
};

Result<Row> row_of(const TraceTable& table, std::size_t row,
                   const std::vector<std::string>& columns) {
  std::vector<double> numbers;
  for (const std::string& column : columns) {
    const auto number = table.number(row, column);
    if (!number) return number.error();
    numbers.push_back(*number);
  }
  return Row{.tilt = numbers[0] * kRadPerDeg,
             .turn = numbers[1] * kRadPerDeg,
             .point = numbers[2],
             .place = {numbers[3], numbers[4], numbers[5]}};
}

std::optional<std::size_t> planned(const TouchPlan& plan, const Row& row) {
  for (std::size_t t = 0; t < plan.touches.size(); ++t) {
    const PlannedTouch& touch = plan.touches[t];
    if (static_cast<double>(touch.point) == row.point &&
        std::abs(plan.tilts[touch.tilt].axis - row.tilt) < kSamePosition &&
        std::abs(plan.turns[touch.turn].axis - row.turn) < kSamePosition) {
      return t;
    }
  }
  return std::nullopt;
}

}  // namespace

Result<std::vector<double>> read_touches(const std::filesystem::path& file, const TouchPlan& plan,
                                         double ball_radius) {
  const auto table =
      TraceTable::read(file, joined(joined(joined(kPlaces, kTouched), kBall), kPrinted));
  if (!table) return table.error();
  const bool printed = table->has(kPrinted.front());
  // Where the machine logs the centre of the ball.
  const bool of_ball = printed || (table->has(kBall.front()) && !table->has(kTouched.front()));
  const std::vector<std::string> columns =
      printed ? kPrinted : joined(kPlaces, of_ball ? kBall : kTouched);
  for (const std::string& column : columns) {
    if (table->has(column)) continue;
    return table->placed(error("missing-column"_id, fmt::format("column {} is missing", column),
                               fmt::format("columns: {}, and {} or {}", fmt::join(kPlaces, ", "),
                                           fmt::join(kTouched, ", "), fmt::join(kBall, ", "))),
                         table->header_line());
  }
  std::vector<std::optional<double>> readings(plan.touches.size());
  for (std::size_t r = 0; r < table->rows(); ++r) {
    const auto row = row_of(*table, r, columns);
    if (!row) return row.error();
    const auto at = planned(plan, *row);
    if (!at) {
      return table->placed(
          error("touch-unplanned"_id,
                fmt::format("the plan has no touch of point {:g} at A = {:g} deg, C = {:g} deg",
                            row->point, row->tilt * kDegPerRad, row->turn * kDegPerRad),
                "the plan: touches.csv of frustum motion touch --out"),
          table->line(r));
    }
    const PlannedTouch& touch = plan.touches[*at];
    if (readings[*at]) {
      return table->placed(
          error("given-twice"_id, fmt::format("{} is touched twice", place_of(plan, touch))),
          table->line(r));
    }
    const TouchPoint nominal = turned_point(plan, touch);
    const Vec3 off = row->place - (of_ball ? ball_radius : 0.0) * nominal.normal - nominal.place;
    if (!(off.norm() <= kTouchApproach)) {
      return table->placed(
          error("touch-far"_id,
                fmt::format("{} is {:.4g} mm from its nominal place ({:.3f}, {:.3f}, {:.3f})",
                            place_of(plan, touch), off.norm(), nominal.place.x(), nominal.place.y(),
                            nominal.place.z()),
                "mm in machine coordinates, counted from the crossing of the axes A and C"),
          table->line(r));
    }
    readings[*at] = off.dot(nominal.normal);
  }
  return all_readings(*table, readings,
                      [&](std::size_t t) { return place_of(plan, plan.touches[t]); });
}

std::string touch_csv(const TouchPlan& plan, const std::vector<double>& readings) {
  std::string csv = fmt::format("{}\n", fmt::join(joined(kPlaces, kTouched), ","));
  for (std::size_t t = 0; t < plan.touches.size(); ++t) {
    const PlannedTouch& touch = plan.touches[t];
    const TouchPoint nominal = turned_point(plan, touch);
    const Vec3 p = nominal.place + readings[t] * nominal.normal;
    // 1e-9 mm: rounding stays below what the maps show.
    csv += fmt::format("{},{},{},{},{},{}\n",
                       shortest_decimal(as_stated(plan.tilts[touch.tilt].axis * kDegPerRad)),
                       shortest_decimal(as_stated(plan.turns[touch.turn].axis * kDegPerRad)),
                       touch.point, fixed_decimal(p.x(), 9), fixed_decimal(p.y(), 9),
                       fixed_decimal(p.z(), 9));
  }
  return csv;
}

}  // namespace frustum::instruments

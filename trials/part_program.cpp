#include "trials/part_program.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <optional>

#include "core/decimal.hpp"
#include "core/units.hpp"
#include "instruments/traces/trace_table.hpp"
#include "kinematics/model/chain.hpp"

namespace frustum::trials {
namespace {

using kinematics::AxisLetter;
using kinematics::AxisPositions;
using kinematics::Machine;

std::vector<AxisLetter> rotary_axes_of(const Machine& machine) {
  std::vector<AxisLetter> letters;
  for (const auto letter : kinematics::kRotaryAxes) {
    if (machine.joint(letter) != nullptr) letters.push_back(letter);
  }
  return letters;
}

std::string name_of_touch(const programs::TestPiece& piece, const PartTouches& plan,
                          std::size_t point) {
  return fmt::format("point {} (feature '{}')", point,
                     piece.plan.features[plan.touches[point].feature].name);
}

// Columns of a log; `printed`: as Fanuc prints them.
std::vector<std::string> log_columns(const Machine& machine, bool printed) {
  std::vector<std::string> columns;
  for (const auto letter : rotary_axes_of(machine)) {
    columns.push_back(fmt::format("{}{}", to_char(letter), printed ? "" : "_deg"));
  }
  for (const char* column : {"point", "ball_x_mm", "ball_y_mm", "ball_z_mm"}) {
    if (!printed) columns.emplace_back(column);
  }
  for (const char* column : {"POINT", "BALLX", "BALLY", "BALLZ"}) {
    if (printed) columns.emplace_back(column);
  }
  return columns;
}

// The ball's centre in the workpiece frame, of X, Y and Z as they are logged.
Vec3 logged_centre(const Machine& machine, const programs::TestPiece& piece,
                   const PartTouches& plan, const PartTouch& touch, const Vec3& words) {
  AxisPositions q = plan.poses[touch.pose];
  for (Eigen::Index k = 0; k < 3; ++k) {
    const AxisLetter letter = kinematics::kLinearAxes[static_cast<std::size_t>(k)];
    q[letter] = plan.origin[letter] + words[k];
  }
  return piece.placement.table_from_workpiece().inverse().point(
      nominal_pose(machine, q, 0.0).translation);
}

}  // namespace

Result<instruments::ProbingProgram> part_program(const Machine& machine,
                                                 const programs::TestPiece& piece,
                                                 const PartTouches& plan) {
  constexpr double kAlong = 1e-9;
  const auto rotary = rotary_axes_of(machine);
  const kinematics::GeometricErrors none;
  const kinematics::ForwardChain nominal(machine, none, 0.0);
  for (const AxisPositions& pose : plan.poses) {
    if ((nominal.bed_from_tool(pose).rotation.col(2) - Vec3::UnitZ()).norm() < kAlong) continue;
    return error(
        "tool-tilted"_id,
        "no probing program: a rotary axis tilts the tool, so that X, Y and Z of a program "
        "without tool centre point control depend on the length of the probe",
        "--at with poses at which the tool is along Z");
  }
  if (!plan.can_turn) {
    return error("axis-overtravel"_id,
                 fmt::format("no probing program: while the rotary axes turn the blank comes up to "
                             "Z {:.3f} of the program, and Z has not the travel to stay above it",
                             plan.turning),
                 "other poses (--at), a shorter probe, or another place of the part");
  }
  instruments::ProbingProgram program{
      .title = "THE PART IS PROBED WHERE IT WAS CUT",
      .origin = "ORIGIN OF THE PROGRAM THAT CUT THE PART. TOOL LENGTH: TO THE CENTRE OF THE BALL",
      .name = "probe",
      .number = 5008,
      .safe = plan.safe,
      .turning = plan.turning,
      .back = plan.clearance};
  for (const auto letter : rotary) program.rotary += to_char(letter);
  for (std::size_t t = 0; t < plan.touches.size(); ++t) {
    const PartTouch& touch = plan.touches[t];
    instruments::ProgrammedTouch programmed{
        .point = t,
        .approach = words_of(machine, piece, plan, touch, centre_of(plan, touch, plan.clearance)),
        .end = words_of(machine, piece, plan, touch, centre_of(plan, touch, -plan.reach))};
    for (const auto letter : rotary) {
      programmed.turned.push_back(plan.poses[touch.pose][letter]);
    }
    program.touches.push_back(std::move(programmed));
  }
  return program;
}

std::string part_log(const Machine& machine, const programs::TestPiece& piece,
                     const PartTouches& plan, std::span<const double> readings) {
  std::string csv = fmt::format("{}\n", fmt::join(log_columns(machine, false), ","));
  for (std::size_t t = 0; t < plan.touches.size(); ++t) {
    const PartTouch& touch = plan.touches[t];
    for (const auto letter : rotary_axes_of(machine)) {
      csv += shortest_decimal(as_stated(plan.poses[touch.pose][letter] * kDegPerRad)) + ",";
    }
    const Vec3 ball = words_of(machine, piece, plan, touch, centre_of(plan, touch, readings[t]));
    csv += fmt::format("{},{},{},{}\n", t, fixed_decimal(ball.x(), 9), fixed_decimal(ball.y(), 9),
                       fixed_decimal(ball.z(), 9));
  }
  return csv;
}

Result<std::vector<double>> read_part_log(const std::filesystem::path& file, const Machine& machine,
                                          const programs::TestPiece& piece,
                                          const PartTouches& plan) {
  constexpr double kSamePosition = 0.01;  // deg: an axis that is indexed, not interpolated
  const auto rotary = rotary_axes_of(machine);
  std::vector<std::string> known = log_columns(machine, false);
  const auto printed_columns = log_columns(machine, true);
  known.insert(known.end(), printed_columns.begin(), printed_columns.end());
  const auto table = instruments::TraceTable::read(file, known);
  if (!table) return table.error();
  const bool printed = table->has("POINT");
  const auto columns = log_columns(machine, printed);
  for (const std::string& column : columns) {
    if (table->has(column)) continue;
    return table->placed(error("missing-column"_id, fmt::format("column {} is missing", column),
                               fmt::format("columns: {}", fmt::join(columns, ", "))),
                         table->header_line());
  }
  std::vector<std::optional<double>> readings(plan.touches.size());
  for (std::size_t r = 0; r < table->rows(); ++r) {
    std::vector<double> numbers;
    for (const std::string& column : columns) {
      const auto number = table->number(r, column);
      if (!number) return number.error();
      numbers.push_back(*number);
    }
    const double point = numbers[rotary.size()];
    const auto place = static_cast<std::size_t>(std::max(point, 0.0));
    bool is_planned = static_cast<double>(place) == point && place < plan.touches.size();
    for (std::size_t k = 0; is_planned && k < rotary.size(); ++k) {
      const AxisPositions& pose = plan.poses[plan.touches[place].pose];
      is_planned = std::abs(pose[rotary[k]] * kDegPerRad - numbers[k]) < kSamePosition;
    }
    if (!is_planned) {
      return table->placed(
          error("touch-unplanned"_id,
                fmt::format("the plan has no point {:g} with the rotary axes there", point),
                "the plan: touches.csv of frustum motion probe --out, with the same --at"),
          table->line(r));
    }
    const PartTouch& touch = plan.touches[place];
    if (readings[place]) {
      return table->placed(error("given-twice"_id, fmt::format("{} is touched twice",
                                                               name_of_touch(piece, plan, place))),
                           table->line(r));
    }
    const std::size_t at = rotary.size() + 1;
    const Vec3 words(numbers[at], numbers[at + 1], numbers[at + 2]);
    const Vec3 off =
        logged_centre(machine, piece, plan, touch, words) - centre_of(plan, touch, 0.0);
    if (!(off.norm() <= std::max(plan.clearance, plan.reach))) {
      return table->placed(
          error("touch-far"_id,
                fmt::format("{} is {:.4g} mm from its nominal place",
                            name_of_touch(piece, plan, place), off.norm()),
                "mm to the centre of the ball, counted from G54 of the part's program"),
          table->line(r));
    }
    readings[place] = off.dot(touch.normal);
  }
  return instruments::all_readings(*table, readings,
                                   [&](std::size_t t) { return name_of_touch(piece, plan, t); });
}

Diagnostics touches_apart(const programs::TestPiece& piece, const PartTouches& plan,
                          std::span<const double> readings) {
  constexpr double kLeast = 0.05, kScatters = 50.0;
  const auto median_of = [](std::vector<double> values) {
    const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
    std::ranges::nth_element(values, middle);
    return *middle;
  };
  Diagnostics remarks;
  for (std::size_t f = 0; f < piece.plan.features.size(); ++f) {
    std::vector<double> own, apart;
    for (std::size_t t = 0; t < plan.touches.size(); ++t) {
      if (plan.touches[t].feature == f) own.push_back(readings[t]);
    }
    if (own.size() < 3) continue;
    const double middle = median_of(own);
    for (const double each : own) apart.push_back(std::abs(each - middle));
    const double limit = std::max(kLeast, kScatters * median_of(apart));
    for (std::size_t t = 0; t < plan.touches.size(); ++t) {
      const double off = readings[t] - middle;
      if (plan.touches[t].feature != f || std::abs(off) <= limit) continue;
      remarks.push_back(
          warning("touch-apart"_id,
                  fmt::format("{} is {:.3f} mm from where the others of its feature are",
                              name_of_touch(piece, plan, t), off),
                  "clean the surface and probe it again"));
    }
  }
  return remarks;
}

}  // namespace frustum::trials

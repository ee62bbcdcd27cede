#include "app/motion/touch_report.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "app/view/text_table.hpp"
#include "core/decimal.hpp"
#include "core/made_by.hpp"
#include "core/toml_document.hpp"
#include "instruments/traces/touch_trace_file.hpp"

namespace frustum::app {
namespace {

using instruments::ErrorVector;
using instruments::TableMaps;
using instruments::TablePosition;
using instruments::TouchPlan;

constexpr std::array<const char*, 6> kComponents{"x um",   "y um",   "z um",
                                                 "a urad", "b urad", "c urad"};
constexpr std::array<char, 6> kDirections{'X', 'Y', 'Z', 'A', 'B', 'C'};

double shown(const ErrorVector& v, std::size_t k) {
  return v[static_cast<Eigen::Index>(k)] * (k < 3 ? kUmPerMm : kUradPerRad);
}

std::vector<double> row_of(const ErrorVector& v) {
  std::vector<double> row;
  for (std::size_t k = 0; k < kComponents.size(); ++k) row.push_back(shown(v, k));
  return row;
}

Lists rows_of(const std::vector<ErrorVector>& vectors) {
  Lists rows;
  for (const ErrorVector& each : vectors) rows.push_back(row_of(each));
  return rows;
}

std::vector<Lists> grid_of(const std::vector<std::vector<ErrorVector>>& grid) {
  std::vector<Lists> rows;
  for (const auto& each : grid) rows.push_back(rows_of(each));
  return rows;
}

Document document_of(const TableMaps& maps) {
  return {{"A", rows_of(maps.tilt)}, {"C", grid_of(maps.turn)}, {"poses", grid_of(maps.poses)}};
}

std::vector<double> positions_of(const std::vector<TablePosition>& positions) {
  std::vector<double> degrees;
  for (const TablePosition& each : positions) degrees.push_back(as_stated(each.axis * kDegPerRad));
  return degrees;
}

// Root mean square over the positions of C.
ErrorVector over_turn(const std::vector<ErrorVector>& row) {
  ErrorVector squares = ErrorVector::Zero();
  for (const ErrorVector& each : row) squares += each.cwiseAbs2();
  return (squares / static_cast<double>(row.size())).cwiseSqrt();
}

// --- tables --------------------------------------------------------------------------------------

// Rows of a table: which map, its position, six values.
using Rows = std::vector<std::vector<std::string>>;

void add_row(Rows& rows, std::string map, std::string position, const ErrorVector& v) {
  std::vector<std::string> cells{std::move(map), std::move(position)};
  for (std::size_t k = 0; k < kComponents.size(); ++k) {
    cells.push_back(fixed_decimal(shown(v, k), 3));
  }
  rows.push_back(std::move(cells));
}

Rows value_rows(const TouchPlan& plan, const TableMaps& maps) {
  Rows rows;
  const auto tilts = positions_of(plan.tilts), turns = positions_of(plan.turns);
  for (std::size_t i = 0; i < tilts.size(); ++i) {
    add_row(rows, "A", fmt::format("A {:g}", tilts[i]), maps.tilt[i]);
  }
  for (std::size_t i = 0; i < tilts.size(); ++i) {
    for (std::size_t j = 0; j < turns.size(); ++j) {
      add_row(rows, "C", fmt::format("A {:g}, C {:g}", tilts[i], turns[j]), maps.turn[i][j]);
    }
  }
  return rows;
}

// Of C the root mean square over its positions.
Rows spread_rows(const TouchPlan& plan, const TableMaps& maps) {
  Rows rows;
  const auto tilts = positions_of(plan.tilts);
  for (std::size_t i = 0; i < tilts.size(); ++i) {
    add_row(rows, "A", fmt::format("A {:g}", tilts[i]), maps.tilt[i]);
  }
  for (std::size_t i = 0; i < tilts.size(); ++i) {
    add_row(rows, "C", fmt::format("A {:g}, all C", tilts[i]), over_turn(maps.turn[i]));
  }
  return rows;
}

void add_table(MotionAnswer& answer, const std::string& heading, const Rows& rows) {
  std::vector<std::string> headings{"map", "deg"};
  report::MotionTable page{.heading = heading, .columns = {"map", "position, deg"}, .rows = rows};
  for (const char* each : kComponents) {
    headings.emplace_back(each);
    page.columns.push_back(std::string(">") + each);
  }
  TextTable table(headings);
  for (const auto& row : rows) table.row(row);
  answer.text += "\n" + heading + "\n" + table.text();
  answer.page.tables.push_back(std::move(page));
}

// --- charts --------------------------------------------------------------------------------------

report::TraceLine line_of(std::string name, std::vector<double> along,
                          const std::vector<ErrorVector>& values,
                          const std::vector<ErrorVector>& sd, std::size_t k) {
  report::TraceLine line{.name = std::move(name), .along = std::move(along), .dots = true};
  for (std::size_t i = 0; i < values.size(); ++i) {
    line.value.push_back(shown(values[i], k));
    line.half_width.push_back(2.0 * shown(sd[i], k));
  }
  return line;
}

void draw(MotionAnswer& answer, const TouchPlan& plan, const TouchFindings& found) {
  const auto tilts = positions_of(plan.tilts), turns = positions_of(plan.turns);
  for (const std::size_t from : {std::size_t{0}, std::size_t{3}}) {
    report::TraceChart chart{
        .title = from == 0 ? "Errors of A, translations" : "Errors of A, rotations",
        .along_title = "A, °",
        .value_title = from == 0 ? "µm" : "µrad"};
    for (std::size_t k = from; k < from + 3; ++k) {
      chart.lines.push_back(line_of(fmt::format("E{}A", kDirections.at(k)), tilts,
                                    found.identified.tilt, found.sd.tilt, k));
    }
    answer.page.charts.push_back(std::move(chart));
  }
  for (std::size_t k = 0; k < kDirections.size(); ++k) {
    report::TraceChart chart{.title = fmt::format("E{}C, at each position of A", kDirections.at(k)),
                             .along_title = "C, °",
                             .value_title = k < 3 ? "µm" : "µrad"};
    for (std::size_t i = 0; i < tilts.size(); ++i) {
      chart.lines.push_back(line_of(fmt::format("A {:g}°", tilts[i]), turns,
                                    found.identified.turn[i], found.sd.turn[i], k));
    }
    answer.page.charts.push_back(std::move(chart));
  }
}

// --- the error file ------------------------------------------------------------------------------

std::string decimals_text(const std::vector<double>& numbers) {
  std::string text;
  for (const double each : numbers) {
    text += (text.empty() ? "" : ", ") + fixed_decimal(each, 6);
  }
  return "[" + text + "]";
}

std::string degrees_text(const std::vector<double>& numbers) {
  std::string text;
  for (const double each : numbers) text += (text.empty() ? "" : ", ") + shortest_decimal(each);
  return "[" + text + "]";
}

// The maps as errors that every other command takes.
std::string error_file(const kinematics::Machine& machine, const TouchPlan& plan,
                       const TableMaps& maps) {
  std::vector<std::size_t> rising(plan.tilts.size());
  for (std::size_t i = 0; i < rising.size(); ++i) rising[i] = i;
  std::ranges::sort(rising, {}, [&](std::size_t i) { return plan.tilts[i].axis; });
  const auto tilts = positions_of(plan.tilts);
  std::vector<double> first;
  for (const std::size_t i : rising) first.push_back(tilts[i]);
  std::vector<double> second = positions_of(plan.turns);
  second.push_back(360.0);  // once round, C is where it was
  std::string out = fmt::format(
      "# {}\n# The errors at A = C = 0 are zero by definition: the table there is the reference.\n"
      "title     = \"Errors of A and C, identified at indexed positions\"\n"
      "machine   = {}\nstructure = {}\n",
      made_by(), toml_text(machine.name()), toml_text(machine.structure()));
  for (std::size_t k = 0; k < kDirections.size(); ++k) {
    std::vector<double> values;
    for (const std::size_t i : rising) values.push_back(shown(maps.tilt[i], k));
    out += fmt::format(
        "\n[errors.E{}A]\ntable = {}\nvalues = {}\nposition_unit = \"deg\"\nvalue_unit = \"{}\"\n",
        kDirections.at(k), degrees_text(first), decimals_text(values), k < 3 ? "um" : "urad");
  }
  for (std::size_t k = 0; k < kDirections.size(); ++k) {
    out += fmt::format(
        "\n[errors.E{}C]\nsurface = [\"A\", \"C\"]\nfirst = {}\nsecond = {}\nvalue_unit = "
        "\"{}\"\nvalues = [\n",
        kDirections.at(k), degrees_text(first), degrees_text(second), k < 3 ? "um" : "urad");
    for (const std::size_t i : rising) {
      std::vector<double> values;
      for (const ErrorVector& each : maps.turn[i]) values.push_back(shown(each, k));
      values.push_back(values.front());
      out += "  " + decimals_text(values) + ",\n";
    }
    out += "]\n";
  }
  return out;
}

// Largest difference of translations, um, and of rotations, urad.
std::array<double, 2> largest_difference(const TableMaps& a, const TableMaps& b) {
  std::array<double, 2> largest{};
  const auto take = [&](const ErrorVector& one, const ErrorVector& other) {
    const ErrorVector d = (one - other).cwiseAbs();
    largest[0] = std::max(largest[0], d.head<3>().maxCoeff() * kUmPerMm);
    largest[1] = std::max(largest[1], d.tail<3>().maxCoeff() * kUradPerRad);
  };
  for (std::size_t i = 0; i < a.tilt.size(); ++i) {
    take(a.tilt[i], b.tilt[i]);
    for (std::size_t j = 0; j < a.turn[i].size(); ++j) take(a.turn[i][j], b.turn[i][j]);
  }
  return largest;
}

// What was touched, and where.
void add_touches(MotionAnswer& answer, const TouchPlan& plan, const std::vector<double>& readings) {
  Document& doc = answer.document;
  doc["touches"] = static_cast<std::uint64_t>(plan.touches.size());
  Lists planned;
  for (const auto& touch : plan.touches) {
    planned.push_back({static_cast<double>(touch.tilt), static_cast<double>(touch.turn),
                       static_cast<double>(touch.point)});
  }
  doc["plan"] = planned;  // A, C, point, each counted from 0
  doc["reading_um"] = in_um(readings);
  answer.files["touches.csv"] = touch_csv(plan, readings);
  answer.text += fmt::format("{} touches of three columns at {} positions of A and {} of C\n",
                             plan.touches.size(), plan.tilts.size(), plan.turns.size());
}

}  // namespace

void add_touch_findings(MotionAnswer& answer, const kinematics::Machine& machine,
                        const TouchPlan& plan, const TouchFindings& found) {
  Document& doc = answer.document;
  doc["A_deg"] = positions_of(plan.tilts);
  doc["C_deg"] = positions_of(plan.turns);
  if (!found.readings.empty()) add_touches(answer, plan, found.readings);
  doc["identified"] = document_of(found.identified);
  doc["sd"] = document_of(found.sd);

  add_table(answer, "Identified errors", value_rows(plan, found.identified));
  const bool noisy = found.sd.tilt.front().maxCoeff() > 0.0;
  if (noisy) {
    add_table(answer, "Standard deviation, propagated from the noise of a touch",
              spread_rows(plan, found.sd));
  }
  if (found.scatter) {
    doc["repeat"] = static_cast<std::uint64_t>(found.runs);
    doc["scatter"] = document_of(*found.scatter);
    add_table(answer, fmt::format("Standard deviation of {} calibrations", found.runs),
              spread_rows(plan, *found.scatter));
  }
  if (found.visible) {
    const auto [um, urad] = largest_difference(found.identified, *found.visible);
    doc["visible"] = document_of(*found.visible);
    doc["largest_difference"] = Document{{"um", um}, {"urad", urad}};
    answer.text += fmt::format(
        "\nlargest difference from the machine's own errors of A and C: {} um, {} urad\n",
        fixed_decimal(um, 4), fixed_decimal(urad, 4));
  }
  constexpr const char* kGauge =
      "Zero at A = C = 0: the error there is not seen, its part across the axis of C turns with "
      "the table. Errors of the linear axes and of the ball in the spindle appear as errors of A "
      "and C.";
  answer.text += fmt::format("{}\n", kGauge);
  answer.page.tables.front().note = kGauge;
  draw(answer, plan, found);
  answer.files["errors.toml"] = error_file(machine, plan, found.identified);
}

}  // namespace frustum::app

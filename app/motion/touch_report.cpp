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

using report::Wording;

constexpr std::array<const char*, 6> kComponents{"x", "y", "z", "a", "b", "c"};
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

void add_row(Rows& rows, std::string map, std::string position, const ErrorVector& v,
             const Wording& words) {
  std::vector<std::string> cells{std::move(map), std::move(position)};
  for (std::size_t k = 0; k < kComponents.size(); ++k) {
    cells.push_back(k < 3 ? shown_um(v[static_cast<Eigen::Index>(k)], words)
                          : words.number(fixed_decimal(shown(v, k), 3)));
  }
  rows.push_back(std::move(cells));
}

Rows value_rows(const TouchPlan& plan, const TableMaps& maps, const Wording& words) {
  Rows rows;
  const auto tilts = positions_of(plan.tilts), turns = positions_of(plan.turns);
  for (std::size_t i = 0; i < tilts.size(); ++i) {
    add_row(rows, "A", "A " + words.general(tilts[i]), maps.tilt[i], words);
  }
  for (std::size_t i = 0; i < tilts.size(); ++i) {
    for (std::size_t j = 0; j < turns.size(); ++j) {
      add_row(rows, "C", "A " + words.general(tilts[i]) + ", C " + words.general(turns[j]),
              maps.turn[i][j], words);
    }
  }
  return rows;
}

// Of C the root mean square over its positions.
Rows spread_rows(const TouchPlan& plan, const TableMaps& maps, const Wording& words) {
  Rows rows;
  const auto tilts = positions_of(plan.tilts);
  for (std::size_t i = 0; i < tilts.size(); ++i) {
    add_row(rows, "A", "A " + words.general(tilts[i]), maps.tilt[i], words);
  }
  for (std::size_t i = 0; i < tilts.size(); ++i) {
    add_row(rows, "C", words("A {0}, all C", words.general(tilts[i])), over_turn(maps.turn[i]),
            words);
  }
  return rows;
}

void add_table(MotionAnswer& answer, const std::string& heading, const Rows& rows) {
  const Wording& words = answer.words;
  std::vector<std::string> headings{words("map"), "deg"};
  report::MotionTable page{
      .heading = heading, .columns = {words("map"), words("position, deg")}, .rows = rows};
  for (std::size_t k = 0; k < kComponents.size(); ++k) {
    headings.push_back(std::string(kComponents.at(k)) + " " +
                       std::string(words.unit(k < 3 ? "um" : "urad")));
    page.columns.push_back(">" + headings.back());
  }
  TextTable table(headings);
  for (const auto& row : rows) table.row(row);
  answer.text += "\n" + heading + "\n" + table.text();
  answer.page.tables.push_back(std::move(page));
}

// --- charts --------------------------------------------------------------------------------------

report::TraceLine line_of(std::string name, std::vector<double> along,
                          const std::vector<ErrorVector>& values,
                          const std::vector<ErrorVector>& sd, std::size_t k, const Wording& words) {
  report::TraceLine line{.name = std::move(name), .along = std::move(along), .dots = true};
  const char* const unit = k < 3 ? "um" : "urad";
  for (std::size_t i = 0; i < values.size(); ++i) {
    line.value.push_back(words.shown(shown(values[i], k), unit));
    line.half_width.push_back(words.shown(2.0 * shown(sd[i], k), unit));
  }
  return line;
}

void draw(MotionAnswer& answer, const TouchPlan& plan, const TouchFindings& found) {
  const Wording& words = answer.words;
  const auto tilts = positions_of(plan.tilts), turns = positions_of(plan.turns);
  for (const std::size_t from : {std::size_t{0}, std::size_t{3}}) {
    report::TraceChart chart{
        .title = from == 0 ? words("Errors of A, translations") : words("Errors of A, rotations"),
        .along_title = "A, °",
        .value_title = from == 0 ? words.symbol("um") : "µrad"};
    for (std::size_t k = from; k < from + 3; ++k) {
      chart.lines.push_back(line_of(fmt::format("E{}A", kDirections.at(k)), tilts,
                                    found.identified.tilt, found.sd.tilt, k, words));
    }
    answer.page.charts.push_back(std::move(chart));
  }
  for (std::size_t k = 0; k < kDirections.size(); ++k) {
    report::TraceChart chart{
        .title = words("{0}, at each position of A", fmt::format("E{}C", kDirections.at(k))),
        .along_title = "C, °",
        .value_title = k < 3 ? words.symbol("um") : "µrad"};
    for (std::size_t i = 0; i < tilts.size(); ++i) {
      chart.lines.push_back(line_of("A " + words.general(tilts[i]) + "°", turns,
                                    found.identified.turn[i], found.sd.turn[i], k, words));
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
  answer.text += answer.words("{0} touches of three columns at {1} positions of A and {2} of C",
                              plan.touches.size(), plan.tilts.size(), plan.turns.size()) +
                 "\n";
}

}  // namespace

void add_touch_findings(MotionAnswer& answer, const kinematics::Machine& machine,
                        const TouchPlan& plan, const TouchFindings& found) {
  const Wording& words = answer.words;
  Document& doc = answer.document;
  doc["A_deg"] = positions_of(plan.tilts);
  doc["C_deg"] = positions_of(plan.turns);
  if (!found.readings.empty()) add_touches(answer, plan, found.readings);
  doc["identified"] = document_of(found.identified);
  doc["sd"] = document_of(found.sd);

  add_table(answer, words("Identified errors"), value_rows(plan, found.identified, words));
  const bool noisy = found.sd.tilt.front().maxCoeff() > 0.0;
  if (noisy) {
    add_table(answer, words("Standard deviation, propagated from the noise of a touch"),
              spread_rows(plan, found.sd, words));
  }
  if (found.scatter) {
    doc["repeat"] = static_cast<std::uint64_t>(found.runs);
    doc["scatter"] = document_of(*found.scatter);
    add_table(answer, words("Standard deviation of {0} calibrations", found.runs),
              spread_rows(plan, *found.scatter, words));
  }
  if (found.visible) {
    const auto [um, urad] = largest_difference(found.identified, *found.visible);
    doc["visible"] = document_of(*found.visible);
    doc["largest_difference"] = Document{{"um", um}, {"urad", urad}};
    answer.text +=
        "\n" +
        words("largest difference from the machine's own errors of A and C: {0} {2}, {1} urad",
              shown_um(um / kUmPerMm, words, 4), words.number(fixed_decimal(urad, 4)),
              words.unit("um")) +
        "\n";
  }
  const std::string gauge = words(
      "Zero at A = C = 0: the error there is not seen, its part across the axis of C turns with "
      "the table. Errors of the linear axes and of the ball in the spindle appear as errors of A "
      "and C.");
  answer.text += gauge + "\n";
  answer.page.tables.front().note = gauge;
  draw(answer, plan, found);
  answer.files["errors.toml"] = error_file(machine, plan, found.identified);
}

}  // namespace frustum::app

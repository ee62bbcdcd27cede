#include "instruments/traces/line_trace_file.hpp"

#include <fmt/format.h>

#include <array>
#include <cmath>
#include <map>
#include <string>

#include "core/counted.hpp"
#include "core/decimal.hpp"
#include "core/units.hpp"
#include "instruments/traces/trace_table.hpp"

namespace frustum::instruments {
namespace {

// Targets within a nanometre are one.
constexpr double kSameTarget = 1e-6;

// By direction, by target, by run.
using ByRun = std::map<double, double>;
using ByTarget = std::map<double, ByRun>;

double grid_of(double target) { return std::round(target / kSameTarget) * kSameTarget; }

std::optional<Diagnostic> incomplete(const TraceTable& table, const ByTarget& up,
                                     const ByTarget& down) {
  const std::array<std::pair<std::string_view, const ByTarget*>, 2> sides{
      {{"up", &up}, {"down", &down}}};
  for (const auto& [name, side] : sides) {
    if (!side->empty()) continue;
    return table.placed(
        error("direction-missing"_id, fmt::format("the file has no rows of direction {}", name),
              "ISO 230-2 compares both directions of approach"),
        table.header_line());
  }
  const std::size_t runs = up.begin()->second.size();
  for (const auto& [name, side] : sides) {
    const ByTarget& other = side == &up ? down : up;
    for (const auto& [target, values] : *side) {
      if (!other.contains(target)) {
        return table.placed(error("target-missing"_id,
                                  fmt::format("target {:g} mm was measured {} only", target, name)),
                            table.header_line());
      }
      if (values.size() == runs) continue;
      return table.placed(
          error("too-few-runs"_id, fmt::format("target {:g} mm has {} {}, the first has {}", target,
                                               counted(values.size(), "run"), name, runs)),
          table.header_line());
    }
  }
  return std::nullopt;
}

Deviations rows_of(const ByTarget& side) {
  Deviations rows;
  for (const auto& [target, values] : side) {
    std::vector<double>& row = rows.emplace_back();
    for (const auto& [run, deviation] : values) row.push_back(deviation);
  }
  return rows;
}

}  // namespace

Result<LineTrace> read_line_trace(const std::filesystem::path& file) {
  const std::vector<std::string> columns{"run", "direction", "target_mm", "deviation_um"};
  const auto table = TraceTable::read(file, columns);
  if (!table) return table.error();
  for (const std::string& column : columns) {
    if (table->has(column)) continue;
    return table->placed(error("missing-column"_id, fmt::format("column {} is missing", column),
                               fmt::format("columns: {}", fmt::join(columns, ", "))),
                         table->header_line());
  }
  ByTarget up, down;
  for (std::size_t row = 0; row < table->rows(); ++row) {
    const std::string& direction = table->text(row, "direction");
    if (direction != "up" && direction != "down") {
      return table->placed(
          error("unknown-choice"_id, fmt::format("'{}' is no direction", direction), "up, down"),
          table->line(row));
    }
    const auto run = table->number(row, "run");
    if (!run) return run.error();
    const auto target = table->number(row, "target_mm");
    if (!target) return target.error();
    const auto deviation = table->number(row, "deviation_um");
    if (!deviation) return deviation.error();
    ByRun& runs = (direction == "up" ? up : down)[grid_of(*target)];
    if (!runs.try_emplace(*run, *deviation / kUmPerMm).second) {
      return table->placed(
          error("given-twice"_id,
                fmt::format("run {:g} {} has a second value at {:g} mm", *run, direction, *target)),
          table->line(row));
    }
  }
  if (const auto problem = incomplete(*table, up, down)) return *problem;
  LineTrace trace{.up = rows_of(up), .down = rows_of(down)};
  for (const auto& [target, runs] : up) trace.targets.push_back(target);
  return trace;
}

std::string line_csv(std::span<const double> targets, const Deviations& up,
                     const Deviations& down) {
  std::string csv = "run,direction,target_mm,deviation_um\n";
  const std::size_t runs = up.empty() ? 0 : up.front().size();
  for (std::size_t run = 0; run < runs; ++run) {
    const auto row = [&](const char* direction, std::size_t i, const Deviations& deviations) {
      csv += fmt::format("{},{},{},{}\n", run + 1, direction, shortest_decimal(targets[i]),
                         shortest_decimal(deviations[i][run] * kUmPerMm));
    };
    for (std::size_t i = 0; i < targets.size(); ++i) row("up", i, up);
    for (std::size_t i = targets.size(); i-- > 0;) row("down", i, down);
  }
  return csv;
}

}  // namespace frustum::instruments

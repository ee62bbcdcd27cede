// Measured deviations of positioning along an axis.
//
// Text   : columns run, direction (up, down), target_mm, deviation_um (trace_table.hpp), rows in
//          any order
// Units  : as the columns say; out: mm
// Errors : a direction that is none or missing, a target measured twice in a run, targets with
//          different numbers of runs: with file and line
#pragma once

#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "core/result.hpp"
#include "instruments/positioning.hpp"

namespace frustum::instruments {

struct LineTrace {
  std::vector<double> targets{};  // mm, increasing
  Deviations up{}, down{};        // mm
};

[[nodiscard]] Result<LineTrace> read_line_trace(const std::filesystem::path& file);

// Such a file; lists by target, values by run, mm.
[[nodiscard]] std::string line_csv(std::span<const double> targets, const Deviations& up,
                                   const Deviations& down);

}  // namespace frustum::instruments

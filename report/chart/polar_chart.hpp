// The chart of a roundness tester: deviations drawn outward from a reference circle, magnified; one
// colour a section, the scale beside it, nothing written over a trace.
//
// Units: rad and mm in, um on the chart. Errors: none; points that are not finite are left out.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "metrology/measurement.hpp"
#include "report/wording.hpp"

namespace frustum::report {

struct PolarPoint {
  double angle = 0.0;      // rad
  double deviation = 0.0;  // um
  bool follows = true;     // on the point before; false at the first and after a gap
};
// The points of one round about the axis: a section, or a turn of a helix.
using PolarRound = std::vector<PolarPoint>;
[[nodiscard]] std::vector<PolarRound> polar_rounds(
    const metrology::CharacteristicResult& characteristic);

// Enough points for a chart.
[[nodiscard]] bool has_polar_chart(const metrology::CharacteristicResult& characteristic);
// A <figure>: name, peak to valley, division, a key where there are several rounds, the drawing.
[[nodiscard]] std::string polar_figure(const metrology::CharacteristicResult& characteristic,
                                       const Wording& words = Wording());

// A trace about the nominal circle; dashed: fitted.
struct PolarTrace {
  std::string name{};
  PolarRound points{};
  bool dashed = false;
};
// A <figure> of several traces over one another, in the shown unit of um: range, division, key,
// drawing.
[[nodiscard]] std::string polar_traces_figure(const std::string& title,
                                              const std::vector<PolarTrace>& traces,
                                              const Wording& words = Wording());

}  // namespace frustum::report

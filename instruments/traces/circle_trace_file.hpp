// Measured traces of a circular test, as bar programs export them.
//
// Text   : columns run (ccw, cw), angle_deg or time_s, radial_um (or reading_um),
//          radial_mm or length_mm (trace_table.hpp); comments "# run ccw", "# plane XY", "# radius
//          150", "# feed 1000", "# temperature 20". A file holds one run or both; two files hold
//          one each. Angles of a cw run fall. A bar knows no angle: times are spread evenly over
//          the capture arc; or, where the recording has its feed-in and feed-out (`marks`), over
//          the way between them, which is the capture with its overshoot
// Units  : as the columns say; out: mm, rad
// Errors : a run that is not said or there twice, angles that go back, gaps, deviations beyond the
//          bar's stroke (a wrong unit), a length without nominal, statements that contradict each
//          other, a recording without its marks, or with marks that nobody expects, or that takes
//          another time than its feed says: with file and line
#pragma once

#include <filesystem>
#include <optional>
#include <span>
#include <vector>

#include "core/result.hpp"
#include "instruments/signature.hpp"
#include "kinematics/model/axes.hpp"

namespace frustum::instruments {

struct CircleTraceWords {
  std::optional<Plane> plane{};
  std::optional<double> length{};  // nominal, mm
  kinematics::AxisRange capture{0.0, 360.0 * kRadPerDeg};
  double stroke = 1.0;  // of the bar, to either side, mm
  // The run begins and ends where the bar has come in to its length and goes out again, with an
  // overshoot (rad) before and after the capture: half a turn in XY, else 2 deg.
  bool marks = false;
  std::optional<double> overshoot{};
  // The test turns a rotary axis: it has no plane, and a run that is not said is ccw where its
  // angles rise, else cw.
  bool of_rotary_axis = false;
};

struct CircleTraces {
  Plane plane = Plane::XY;
  double length = 0.0;
  std::optional<double> feed{};         // mm/min
  std::optional<double> temperature{};  // degC
  std::vector<CircleTrace> traces{};    // ccw first
};

// What the words say goes before what is missing in the files; both must agree.
[[nodiscard]] Result<CircleTraces> read_circle_traces(std::span<const std::filesystem::path> files,
                                                      const CircleTraceWords& words);

}  // namespace frustum::instruments

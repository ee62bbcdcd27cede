// Everything that a report of one run shows: filled by whoever ran it, read by every writer here.
//
// Plain values; writers neither compute results nor judge them. Empty parts are left out of the
// output.
// Units: mm, mm3 and seconds, except where a member says otherwise; axis values are mm for linear
//        and
// degrees for rotary axes, because that is what people read.
// Errors: none; numbers that are not finite are written as "no value", never as NaN.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "core/diagnostic.hpp"
#include "cutter/body/cutter_spec.hpp"
#include "metrology/measurement.hpp"
#include "report/evidence.hpp"
#include "report/wording.hpp"

namespace frustum::report {

struct InjectedError {
  std::string name{};     // "EB0C"
  std::string written{};  // as the user wrote it: "30 urad"
  std::string meaning{};  // "tilt of axis C about Y"
};

struct AxisRange {
  double low = 0.0;
  double high = 0.0;
  [[nodiscard]] double width() const { return high - low; }
};

// One axis over the abscissa of its trace.
struct AxisSeries {
  std::string axis{};  // the letter: "X", "B"
  bool rotary = false;
  std::vector<double> values{};  // mm, or deg for a rotary axis; as many as the trace's abscissa
  // Over the whole operation, when that is known better than from the values above.
  std::optional<AxisRange> range{};
};

enum class Abscissa { cone_angle, block };

// Where the axes are during one operation ("cone", "cylinder").
struct AxisTrace {
  std::string operation{};
  Abscissa abscissa_kind = Abscissa::cone_angle;
  std::vector<double> abscissa{};  // deg for the cone angle, a count for blocks
  std::vector<AxisSeries> axes{};
};

// The stated range of a series, or the range of its finite values; nothing when it has none.
[[nodiscard]] std::optional<AxisRange> range_of(const AxisSeries& series);

// A picture of the finished surface in the workpiece frame; a closed triangle mesh,
// counter-clockwise seen from outside.
struct SurfacePicture {
  std::vector<std::array<float, 3>> vertices{};           // mm
  std::vector<std::array<std::uint32_t, 3>> triangles{};  // indices into vertices
  // Per vertex, mm, positive where material is left; nothing where no nominal surface is known.
  // Either empty or as long as `vertices`.
  std::vector<std::optional<float>> deviation{};
  // Per vertex, unit, out of the material, for shading; zero where several faces meet. Empty or as
  // long as `vertices`.
  std::vector<std::array<float, 3>> normals{};

  [[nodiscard]] bool empty() const { return vertices.empty() || triangles.empty(); }
  // True when every index and the lengths of `deviation` and `normals` fit and every coordinate is
  // finite.
  [[nodiscard]] bool is_valid() const;
};

struct Volumes {
  std::optional<double> blank{};     // mm3
  std::optional<double> finished{};  // mm3
  std::optional<double> removed{};   // mm3
};

struct Collision {
  std::uint32_t line = 0;  // of the NC program; 0 when unknown
  std::string text{};
};

// The bodies of machine and fixtures, and how near two that move against each other come.
struct MachineBodies {
  std::size_t bodies = 0;  // that machine file and job state; 0: no collision was looked for
  std::optional<double> smallest_distance{};  // mm; 0: they meet
  std::string first{}, second{};              // the two
  std::uint32_t line = 0;                     // of the NC program
  std::string file{};                         // of a subprogram's own file
};
// "Machine collisions were not looked for: ...", or what was found.
[[nodiscard]] std::string machine_bodies_text(const MachineBodies& bodies,
                                              const Wording& words = Wording());

// A block that an axis limit kept below its feed.
struct SlowedBlock {
  std::uint32_t line = 0;
  std::string axis{};            // the letter
  double programmed_feed = 0.0;  // mm/min
  double reached_feed = 0.0;     // mm/min, mean over the block
};

struct Timing {
  std::string name{};
  double seconds = 0.0;
};

// One entry of the numbers budget: what an approximation promises and what it reached.
struct BudgetEntry {
  std::string name{};             // "tool path chord"
  double bound = 0.0;             // in `unit`
  std::optional<double> worst{};  // in `unit`, when it was observed
  std::string unit{};             // "um", "nm"
};

// How near the measured points are to the true surface: bounds of all, proofs for a sample.
struct PointBounds {
  std::size_t points = 0;
  double worst_bound = 0.0;  // mm, of all points
  std::size_t sampled = 0;
  std::size_t proven = 0;
  std::size_t regular = 0;  // proven along their own normal, not on an edge
  std::size_t refuted = 0;
};

struct RunReport {
  ReportStyle style{};  // of the page and of the text on a terminal alone
  std::string title{};
  Evidence evidence{};
  std::string version{};    // of the program that made the report; left out when empty
  std::string machine{};    // "IWF, C on B, tilting table"
  std::string structure{};  // "t-(C)-Z-Y-b-X-B-C-w"
  std::string program{};    // file name of the NC program
  cutter::ToolList tools{};
  std::vector<InjectedError> errors{};
  metrology::Measurement measurement{};
  std::vector<AxisTrace> traces{};
  SurfacePicture surface{};
  Volumes volumes{};
  std::vector<Collision> collisions{};
  std::optional<MachineBodies> machine_bodies{};  // nothing: no program was run
  std::optional<double> cycle_time{};             // s, of the program on the machine
  std::vector<SlowedBlock> slowed{};              // those that lose most time first
  std::vector<Timing> timings{};                  // in the order in which the work was done
  std::vector<BudgetEntry> budget{};
  std::optional<PointBounds> bounds{};
  Diagnostics diagnostics{};  // of the run; the measurement has its own
  std::vector<std::string> notes{};
  std::vector<std::string> files{};  // written so far, for the terminal summary

  // Every characteristic within its tolerance, no collision, no diagnostic of Severity::error.
  [[nodiscard]] bool passes() const;
  // uncertain when nothing else is wrong than characteristics too near their limits.
  [[nodiscard]] metrology::Verdict verdict() const;
};

}  // namespace frustum::report

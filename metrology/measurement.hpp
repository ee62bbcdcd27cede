// What a measurement says: points, fitted elements, characteristics with verdicts.
//
// It comes from the virtual CMM or from real CMM points: nothing here tells which. Plain values;
// JSON is written by report/.
// Units  : mm and rad inside; a characteristic's value, nominal, tolerance and uncertainty are in
//          its own `unit`
// Errors : none
#pragma once

#include <array>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "core/diagnostic.hpp"
#include "core/pose.hpp"
#include "metrology/non_negative.hpp"
#include "metrology/touch.hpp"

namespace frustum::metrology {

// One probed point in the datum frame, ball radius already compensated.
struct MeasuredPoint {
  Vec3 point = Vec3::Zero();   // mm
  Vec3 normal = Vec3::Zero();  // unit, outward from the material: the fitted element's
  double deviation = 0.0;      // mm, signed along `normal` from the fitted element
  std::size_t section = 0;  // which section (circle, generatrix, row) of the strategy it belongs to
};

// A feature and the element fitted to its points.
struct MeasuredFeature {
  std::string name{};
  std::string kind{};  // "plane", "cylinder", ...
  std::vector<MeasuredPoint> points{};
  // What the probe touched for each of them, in the workpiece frame of the plan and without the
  // machine's errors; empty where the points come from elsewhere.
  std::vector<Touch> touches{};
  // Stable names of interfaces.md: point, axis (3 numbers), radius (mm), half_angle (rad).
  std::map<std::string, std::vector<double>> parameters{};
  // mm, of each point: what the plan says that the cutter leaves where the machine makes no error;
  // empty where it says nothing.
  std::vector<double> geometric{};
  double form = 0.0;  // mm, peak to valley of the residuals
  double rms = 0.0;   // mm
  // mm: how far the two ways to compensate the ball set a point apart at most, along the normal;
  // only the virtual CMM knows its approaches.
  double compensation_difference = 0.0;
};

// A measured line as compared with another one, for plots: what its surface lacks or has too much.
struct LineProfile {
  std::string feature{};
  std::vector<double> position{};   // mm along the lines, from the planned point of the first line
  std::vector<double> deviation{};  // mm, from the planned line, in the direction measured
  double fit_offset = 0.0;          // mm, the least-squares line at position 0
  double fit_slope = 0.0;           // rad (mm per mm)
};

// amplitude cos(order angle - phase)
struct Harmonic {
  int order = 0;           // undulations per revolution
  double amplitude = 0.0;  // mm
  double phase = 0.0;      // rad
};

// ISO 14253-1 knows the third: within the uncertainty of the limit.
enum class Verdict { pass, fail, uncertain };
inline constexpr std::array<std::string_view, 3> kVerdictNames{"pass", "fail", "uncertain"};
[[nodiscard]] std::string_view name_of(Verdict verdict);

// What a Monte Carlo simulation of the measuring errors says, in the unit of its characteristic.
struct SimulatedUncertainty {
  double low = 0.0;  // of the interval that holds the true value in 95 % of measurements
  double high = 0.0;
  double standard = 0.0;
  std::size_t draws = 0;
  bool stable = false;  // to the digits asked for, or as exact as that without noise
};

// How often an interval and value +- U hold the true value, as far as that is proven. not_stated:
// no accuracy of the real machine is, so there is neither.
enum class Coverage { of_95, at_least_95, not_proven, not_stated };
inline constexpr std::array<std::string_view, 4> kCoverageNames{"95 %", "at least 95 %",
                                                                "not proven", "not stated"};
[[nodiscard]] std::string_view name_of(Coverage coverage);

// Where the true value is in 95 % of measurements, in the unit of its characteristic.
struct TrueValueInterval {
  double low = 0.0;
  double high = 0.0;
  Coverage coverage = Coverage::of_95;
};

// The value of what is beside the seam of a contour.
struct SeamlessValue {
  double value = 0.0;   // in the unit of its characteristic
  double at = 0.0;      // rad, of the seam
  double within = 0.0;  // rad to either side
};

struct CharacteristicResult {
  std::string name{};
  std::string kind{};
  std::vector<std::string> features{};  // toleranced, datums, as the plan names them
  std::vector<std::size_t> sections{};  // of the first, where the plan names them
  std::string frame{};                  // where it names one
  std::string parameter{};  // of a form, as the plan states it: "t", "p", "v", "q"; else empty
  bool floating = false;    // a profile whose planned geometry was laid into its points
  double value = 0.0;
  // In `unit`: what the cutter leaves where the machine makes no error, where the plan knows it.
  std::optional<double> geometric{};
  std::string unit{};  // "um", "deg", "urad", "mm"
  // For characteristics that have one (half angle). 0 for those that compare lines: their value is
  // a deviation of either sign.
  std::optional<double> nominal{};
  double tolerance = 0.0;  // in `unit`: limit of the value, or of |value - nominal|
  // In `unit`: value +- this holds the true value as `coverage` says; to the far end of the
  // interval. Of values of either sign without simulation twice the standard uncertainty.
  double expanded_uncertainty = 0.0;
  double standard_uncertainty = 0.0;                // in `unit`
  std::optional<TrueValueInterval> interval{};      // where the accuracy of the CMM is stated
  std::optional<SimulatedUncertainty> simulated{};  // where the plan asks for it
  // A real machine measured, or made the mesh that was measured, and nothing is stated of it.
  bool is_accuracy_unknown = false;
  bool pass = false;
  bool uncertain = false;  // not passed for the uncertainty alone
  [[nodiscard]] Verdict verdict() const;
  // Nothing where the machine makes no error.
  [[nodiscard]] std::optional<Coverage> coverage() const;
  // An interval that is corrected for a known bias does not; true where there is none.
  [[nodiscard]] bool is_value_in_interval() const;
  // The deviations that made the value, for plots: angle about the axis (rad) against deviation
  // (mm).
  std::vector<double> plot_angle{};
  std::vector<double> plot_deviation{};
  std::vector<LineProfile> profiles{};  // of characteristics that compare lines: first, second
  std::vector<Harmonic> harmonics{};    // of the plotted deviations, where the plan asks for them
  std::optional<SeamlessValue> without_seam{};  // where the plan names a seam
  // What the value is the size of, where its interval is found by that; kind none for values of
  // either sign, and for others whose shape is not estimated.
  NonNegative measurand{};
  NonNegative spread{};  // the same of all that are not of either sign, for linear propagation
};

// In mm or rad, from the unit of a characteristic: "um", "mm", "deg", "urad". Any other text means
// that the value is in mm or rad already.
[[nodiscard]] double internal_value(double value, std::string_view unit);
[[nodiscard]] double internal_value(const CharacteristicResult& characteristic);
// Whether that is rad.
[[nodiscard]] bool is_angle(const CharacteristicResult& characteristic);

// The degrees of freedom of the workpiece that one datum took: of kDegreeNames.
struct DatumShare {
  std::string feature{};
  std::vector<std::string> degrees{};
};

struct Measurement {
  std::string title{};
  // Where the datum system sits in the workpiece frame of the plan: workpiece_from_datum.
  Pose workpiece_from_datum{};
  std::vector<DatumShare> datums{};         // in order of precedence
  std::vector<std::string> free_degrees{};  // that no datum took: they stay as planned
  std::vector<MeasuredFeature> features{};
  std::vector<CharacteristicResult> characteristics{};
  Diagnostics diagnostics{};

  [[nodiscard]] bool passes() const {
    for (const CharacteristicResult& c : characteristics) {
      if (!c.pass) return false;
    }
    return true;
  }
  // fail when one fails, else uncertain when one is.
  [[nodiscard]] Verdict verdict() const;
  // Place in `characteristics`.
  [[nodiscard]] std::optional<std::size_t> find(std::string_view characteristic) const;
};

}  // namespace frustum::metrology

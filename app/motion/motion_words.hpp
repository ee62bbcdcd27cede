// What the command line says of a motion test, and the machine, errors and set-up that it means.
//
// Units  : mm and degrees in the words, set-up errors um; mm and rad inside
// Errors : what cannot be read, naming the option; axes that the machine lacks or that the test
//          moves
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "app/job/error_sources.hpp"
#include "app/view/console.hpp"
#include "core/result.hpp"
#include "instruments/instrument.hpp"
#include "instruments/observability.hpp"
#include "instruments/probe_lobes.hpp"
#include "instruments/setup_errors.hpp"
#include "kinematics/model/machine.hpp"
#include "report/progress.hpp"
#include "report/wording.hpp"

namespace frustum::app {

// The NC program of a test, which is written, or (of a test file) run.
struct ProgramWords {
  std::string file{};
  std::string dialect{};
  std::string form{};  // tcp (default), axes
  double feed = 1000.0;
  bool run = false;        // else it is written, where a file or a dialect is given
  bool servo_lag = false;  // while it runs

  [[nodiscard]] bool written() const { return !run && (!file.empty() || !dialect.empty()); }
};

// The pre-travel of a touch-trigger probe (instruments/probe_lobes.hpp).
struct LobeWords {
  std::string constant{};   // "5um"
  std::string amplitude{};  // "1um"
  double phase = 0.0;       // degrees
};

struct MotionWords : AnswerOptions {
  bool in_file = false;                  // they are keys of a test file
  report::Progress* progress = nullptr;  // of whoever waits; null: nobody is told
  std::string machine{};
  ErrorWords errors{};
  kinematics::ErrorList of_file{};  // errors of a test file, which those words override
  std::string setup{};              // "ball=10,-5,3;table_ball=6,-4,2;length=2"
  double tool_length = 0.0;
  std::string at{};         // held axes: "A=-90"
  bool ball_known = false;  // the spindle ball's offset, for what is identified
  std::string noise{}, resolution{};
  std::uint64_t seed = 1;
  double stroke = 1.0;  // of a bar, to either side, mm
  // Of a test that is run at a feed; its unit is that of the test.
  std::optional<double> feed{};
  std::string dynamics = "off";  // or quasi_static, linear: with a feed
  bool jerk = false;             // the time law limits jerk, too
  ProgramWords nc{};
  std::string out{};
  report::ReportStyle style{};  // of the page and the text

  // What the user has written: "--tool-length", or in a test file "tool_length".
  [[nodiscard]] std::string option(std::string_view key) const;
};

struct MotionSetup {
  kinematics::Machine machine;
  std::vector<kinematics::ErrorEntry> entries{};
  kinematics::GeometricErrors errors{};
  instruments::SetupErrors setup{};
  instruments::Instrument instrument{};
  double tool_length = 0.0;
  report::Wording words{};
};
[[nodiscard]] Result<MotionSetup> motion_setup(const MotionWords& words);
// Of --setup; a length of 0 or more with its unit, 0 for an empty text; of --pretravel and --lobe.
[[nodiscard]] Result<instruments::SetupErrors> setup_errors_of(const std::string& text,
                                                               const std::string& option);
[[nodiscard]] Result<double> length_of_words(const std::string& text, const std::string& option);
[[nodiscard]] Result<instruments::ProbeLobes> lobes_of(const LobeWords& words,
                                                       bool in_file = false);

[[nodiscard]] instruments::SpindleBall spindle_ball_of(const MotionWords& words);

// The feed per second, in mm or degrees; refused: none above 0, and one that nothing asks for.
[[nodiscard]] Result<std::optional<double>> feed_per_second(const MotionWords& words);

// `option` below: as MotionWords::option says it.

// Held axes; those that the test moves are refused.
[[nodiscard]] Result<kinematics::AxisPositions> held_axes(
    const kinematics::Machine& machine, const std::string& text, const std::string& option,
    std::span<const kinematics::AxisLetter> moved);
// "A=-90,C=0;A=0,C=60"
[[nodiscard]] Result<std::vector<kinematics::AxisPositions>> pose_list(
    const kinematics::Machine& machine, const std::string& text, const std::string& option);
// "X=-200:200,Y=-150:150"
[[nodiscard]] Result<std::map<kinematics::AxisLetter, kinematics::AxisRange>> box_of(
    const std::string& text, const std::string& option);
[[nodiscard]] Result<Vec3> place_of(const std::string& text, const std::string& option);
// Degrees to rad; nothing for an empty text.
[[nodiscard]] Result<std::optional<std::vector<double>>> angle_list(const std::string& text,
                                                                    const std::string& option);
// Of a stroke that is none.
[[nodiscard]] std::optional<Diagnostic> no_stroke(double stroke, const std::string& option);
// With the key of a test file that it is about, where the option is one.
[[nodiscard]] Diagnostics at_option(Diagnostics problems, const std::string& option);
[[nodiscard]] Diagnostic at_option(Diagnostic problem, const std::string& option);
// A word that is none of those known.
[[nodiscard]] Diagnostic unknown_word(const std::string& option, const std::string& word,
                                      const std::vector<std::string>& known);

}  // namespace frustum::app

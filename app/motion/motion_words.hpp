// What the command line says of a motion test, and the machine, errors and set-up that it means.
//
// Units  : mm and degrees in the words, set-up errors um; mm and rad inside
// Errors : what cannot be read, naming the option; axes that the machine lacks or that the test
//          moves
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "app/job/error_sources.hpp"
#include "app/view/console.hpp"
#include "core/result.hpp"
#include "instruments/instrument.hpp"
#include "instruments/observability.hpp"
#include "instruments/setup_errors.hpp"
#include "kinematics/model/machine.hpp"

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

struct MotionWords : AnswerOptions {
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
};

struct MotionSetup {
  kinematics::Machine machine;
  std::vector<kinematics::ErrorEntry> entries{};
  kinematics::GeometricErrors errors{};
  instruments::SetupErrors setup{};
  instruments::Instrument instrument{};
  double tool_length = 0.0;
};
[[nodiscard]] Result<MotionSetup> motion_setup(const MotionWords& words);

[[nodiscard]] instruments::SpindleBall spindle_ball_of(const MotionWords& words);

// The feed per second, in mm or degrees; refused: none above 0, and one that nothing asks for.
[[nodiscard]] Result<std::optional<double>> feed_per_second(const MotionWords& words);

// Held axes; linear ones are refused where the test moves them.
enum class LinearAxes { moved, held };
[[nodiscard]] Result<kinematics::AxisPositions> held_axes(const kinematics::Machine& machine,
                                                          const std::string& text,
                                                          LinearAxes linear);
// "A=-90,C=0;A=0,C=60"
[[nodiscard]] Result<std::vector<kinematics::AxisPositions>> pose_list(
    const kinematics::Machine& machine, const std::string& text);
// "X=-200:200,Y=-150:150"
[[nodiscard]] Result<std::map<kinematics::AxisLetter, kinematics::AxisRange>> box_of(
    const std::string& text);
[[nodiscard]] Result<Vec3> place_of(const std::string& text, const std::string& option);
// Degrees to rad; nothing for an empty text.
[[nodiscard]] Result<std::optional<std::vector<double>>> angle_list(const std::string& text);
// Of a stroke that is none.
[[nodiscard]] std::optional<Diagnostic> no_stroke(double stroke);
// A word among those that are known.
[[nodiscard]] Diagnostic unknown_word(const std::string& option, const std::string& word,
                                      const std::vector<std::string>& known);

}  // namespace frustum::app

// Canonical motions: what an NC program commands, in program coordinates, knowing no machine.
//
// Units: mm, rad, mm/min; positions are in the active work offset's program coordinates unless the
// motion says machine coordinates. Inch programs, incremental and modal words are already resolved.
// Axis words that a block does not give keep their last value; words never given are absent, so
// that a consumer can tell "not programmed" from zero.
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "core/pose.hpp"

namespace frustum::parser {

enum class AxisLetter : std::uint8_t { X, Y, Z, A, B, C };  // NOLINT: the letters of the programs
inline constexpr std::array kAxisLetters{AxisLetter::X, AxisLetter::Y, AxisLetter::Z,
                                         AxisLetter::A, AxisLetter::B, AxisLetter::C};
inline constexpr std::array kLinearAxes{AxisLetter::X, AxisLetter::Y, AxisLetter::Z};
inline constexpr std::array kRotaryAxes{AxisLetter::A, AxisLetter::B, AxisLetter::C};
[[nodiscard]] constexpr char to_char(AxisLetter axis) {
  return "XYZABC"[static_cast<std::size_t>(axis)];
}
[[nodiscard]] constexpr bool is_rotary(AxisLetter axis) { return axis >= AxisLetter::A; }

// Where a motion comes from in the text.
struct SourcePlace {
  std::uint32_t line = 0;    // 1-based line of the file
  std::uint32_t column = 0;  // 1-based column of the first word that matters
  // Of a subprogram that has a file of its own; null: the file of the main program.
  std::shared_ptr<const std::string> file{};
  // Line of the main program that was at work: this one, or the call that led to this one.
  std::uint32_t main_line = 0;
};

// A target in program coordinates: mm for X Y Z, rad for A B C; absent where never programmed.
class AxisTarget {
 public:
  [[nodiscard]] const std::optional<double>& operator[](AxisLetter axis) const {
    return values_[static_cast<std::size_t>(axis)];
  }
  std::optional<double>& operator[](AxisLetter axis) {
    return values_[static_cast<std::size_t>(axis)];
  }
  bool operator==(const AxisTarget&) const = default;

 private:
  std::array<std::optional<double>, 6> values_{};
};

enum class Coordinates : std::uint8_t { program, machine };  // machine: G53, G28
enum class FeedMode : std::uint8_t { per_minute, inverse_time, per_revolution };
enum class Plane : std::uint8_t { xy, zx, yz };
enum class SpindleDirection : std::uint8_t { off, clockwise, counterclockwise };

struct Feed {
  // Above zero; zero where the program gives none and the control has one of its own. mm/min
  // (deg/min for purely rotary moves); 1/min with inverse_time; mm with per_revolution.
  double value = 0.0;
  FeedMode mode = FeedMode::per_minute;
  // Threads: the axes follow the angle of the spindle from its mark on; with per_revolution.
  bool synchronised = false;
};

// G0. With tool-centre-point control on, `tool_axis` may give the direction (G43.5 vector words).
struct Traverse {
  AxisTarget end{};
  std::optional<UnitVec3> tool_axis{};
  Coordinates coordinates = Coordinates::program;
};
// G28: the named axes go to the machine's home position, by rapid; G30: to its second reference
//      point, or the
// third or fourth. A point that the program itself has stored (G28.1, G30.1) is a Traverse instead.
struct HomeReturn {
  std::array<bool, 6> axes{};  // indexed by AxisLetter
  int point = 1;
};
// G1.
struct LinearFeed {
  AxisTarget end{};
  std::optional<UnitVec3> tool_axis{};
  Coordinates coordinates = Coordinates::program;
  Feed feed{};
};
// G2/G3: `center` in program coordinates; `turns` > 0 counterclockwise seen from the plane's
// positive normal (XY: +Z, ZX: +Y, YZ: +X), |turns| = number of started revolutions (1 for an
// ordinary arc or a full circle). The third axis moves linearly (helix), rotary axes too.
struct ArcFeed {
  AxisTarget end{};
  Vec3 center = Vec3::Zero();
  Plane plane = Plane::xy;
  int turns = 1;
  std::optional<UnitVec3> tool_axis{};
  Feed feed{};
};
// G38.2 to G38.5: a feed that ends where the probe meets the part, or (away) leaves it, at `end` at
// the latest. Where there is a part no program knows: what knows none goes to `end`.
struct Probe {
  AxisTarget end{};
  std::optional<UnitVec3> tool_axis{};
  Feed feed{};
  bool away = false;
  bool must_meet = true;  // else the control stops with an alarm
};
struct Dwell {
  double seconds = 0.0;
};
// M6: the tool of that number is now in the spindle.
struct ToolChange {
  int tool = 0;
  // The control says that the axes are where they were before; else only the builder knows.
  bool axes_stay = false;
};
// G43, G44, G43.4, G43.5, G49. `offset_number` is the H word (0: none given); `length` is set where
// the program or its tool table gives the length itself (G43.1, G10 L1), and goes before what the
// setup has under that number.
enum class LengthCompensation : std::uint8_t { off, length, tool_centre_point };
// The further edges of a tool (D2 of Sinumerik) have offset numbers of their own: edge 2 of tool 7
// has 10007.
constexpr int kEdgeOffsets = 10'000;
struct CompensationChange {
  LengthCompensation mode = LengthCompensation::off;
  bool tool_vectors = false;  // G43.5: I J K give the tool axis
  int offset_number = 0;
  std::optional<double> length{};  // mm
  // G44: the setup's length is subtracted from the words instead of added; a `length` has its sign.
  bool negative = false;
};
// G54..G59: 1..6, G59.1..G59.3: 7..9, G54.1 P1: 101.
constexpr int kExtendedWorkOffset = 100;
struct WorkOffsetChange {
  int number = 1;
};
// G10 L2, L20, #5221=..: the program places a work offset. `origin` are the positions of X, Y and Z
// without tool, with the rotary axes at zero, at which the words are zero; an absent one stays as
// the setup has it. Turns and rotary offsets are resolved in the motions. A setting of the offset
// in force counts at once.
struct WorkOffsetSetting {
  int number = 1;
  std::array<std::optional<double>, 3> origin{};  // mm
};
// "G54", "G59.1", "G54.1 P1".
[[nodiscard]] std::string work_offset_name(int number);
// How the tool axis goes from one programmed orientation to the next under tool-centre-point
// control: the rotary axes linear (G43.4, ORIAXES, PATHCTRL AXIS), or the vector on the great
// circle (ORIVECT, PATHCTRL VECTOR).
enum class OrientationPath : std::uint8_t { rotary_axes, great_circle };
struct OrientationPathChange {
  OrientationPath path = OrientationPath::rotary_axes;
};
// How a rotary axis turns to a programmed position: to that very value, or to that angle, the
// shortest way (M126, DC()), or always in one direction (ACP(), ACN()), by less than a full turn.
enum class RotaryPath : std::uint8_t { as_programmed, shortest, positive, negative };
struct RotaryPathChange {
  RotaryPath path = RotaryPath::as_programmed;
  std::array<bool, 3> axes{true, true, true};  // A, B, C: whose path it is; the others keep theirs
};
// G68.2, CYCLE800, PLANE SPATIAL: words are from now on coordinates of this frame; absent: G69.
struct TiltedPlaneChange {
  std::optional<Pose> program_from_plane{};
};
// G53.1, PLANE .. TURN: the rotary axes bring the tool axis to the normal of the tilted plane.
struct AlignToPlane {};
struct SpindleChange {
  SpindleDirection direction = SpindleDirection::off;
  double speed = 0.0;  // 1/min
};
struct CoolantChange {
  bool flood = false;
};
enum class StopKind : std::uint8_t { program_stop, optional_stop, program_end };
struct Stop {
  StopKind kind = StopKind::program_end;
};
// How much an event says of the simulation's truth. known: a comment, or a word that changes
// nothing which is simulated. builder: a word that only the machine's builder knows, passed over.
// assumed: the program depends on something that a control decides by its parameters; the text says
// which way it was taken.
enum class EventGrade : std::uint8_t { known, builder, assumed };
// A comment or a known word that is not simulated; never silence.
struct Event {
  std::string name{};  // "comment", "message", "G61", ...
  std::string text{};
  EventGrade grade = EventGrade::known;
};

using Command = std::variant<Traverse, HomeReturn, LinearFeed, ArcFeed, Probe, Dwell, ToolChange,
                             CompensationChange, WorkOffsetChange, WorkOffsetSetting,
                             OrientationPathChange, RotaryPathChange, TiltedPlaneChange,
                             AlignToPlane, SpindleChange, CoolantChange, Stop, Event>;

struct Motion {
  SourcePlace place{};
  Command command{};
};

using MotionSink = std::function<void(Motion&&)>;

}  // namespace frustum::parser

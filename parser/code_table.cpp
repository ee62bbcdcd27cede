#include "parser/code_table.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>
#include <vector>

#include "parser/block.hpp"
#include "parser/expression.hpp"
#include "parser/modal_state.hpp"

namespace frustum::parser {
namespace {

constexpr std::uint8_t of(Dialect dialect) {
  return static_cast<std::uint8_t>(1U << static_cast<unsigned>(dialect));
}
constexpr std::uint8_t kFanuc = of(Dialect::fanuc);
constexpr std::uint8_t kLinuxcnc = of(Dialect::linuxcnc);
constexpr std::uint8_t kSinumerik = of(Dialect::sinumerik);
constexpr std::uint8_t kHeidenhain = of(Dialect::heidenhain);
constexpr std::uint8_t kCldata = of(Dialect::cldata);
constexpr std::uint8_t kRs274 = kFanuc | kLinuxcnc;
constexpr std::uint8_t kIso = kRs274 | kSinumerik;
constexpr std::uint8_t kMachines = kIso | kHeidenhain;
constexpr std::uint8_t kAll = kMachines | kCldata;

template <typename Value>
constexpr Code modal(std::uint8_t dialects, char letter, int tenths, CodeGroup group, Value value,
                     LetterSet arguments = {}) {
  return {dialects, letter, tenths, group, static_cast<std::uint8_t>(value), arguments, false, {}};
}
template <typename Value>
constexpr Code named(std::uint8_t dialects, std::string_view word, CodeGroup group, Value value,
                     LetterSet arguments = {}) {
  return {dialects, kNamedWord, 0, group, static_cast<std::uint8_t>(value), arguments, false, word};
}
constexpr Code passed(std::uint8_t dialects, char letter, int tenths,
                      CodeGroup group = CodeGroup::event, LetterSet arguments = {}) {
  return {dialects, letter, tenths, group, 0, arguments, true, {}};
}
constexpr Code passed(std::uint8_t dialects, std::string_view word,
                      CodeGroup group = CodeGroup::event) {
  return {dialects, kNamedWord, 0, group, 0, {}, true, word};
}

constexpr LetterSet kOffsetWord{"H"};
constexpr LetterSet kCallWords{"PL"};
constexpr LetterSet kSmoothingWords{"PQR"};

using enum CodeGroup;
constexpr std::array kCodes{
    modal(kIso, 'G', 0, motion, MotionMode::traverse),
    modal(kIso, 'G', 10, motion, MotionMode::linear),
    modal(kIso, 'G', 20, motion, MotionMode::arc_clockwise),
    modal(kIso, 'G', 30, motion, MotionMode::arc_counterclockwise),
    modal(kRs274, 'G', 800, cycle, 0),
    modal(kRs274, 'G', 730, motion, MotionMode::peck_short),
    modal(kRs274, 'G', 740, motion, MotionMode::tap_left),
    modal(kRs274, 'G', 810, motion, MotionMode::drill),
    modal(kRs274, 'G', 820, motion, MotionMode::drill_dwell),
    modal(kRs274, 'G', 830, motion, MotionMode::peck),
    modal(kRs274, 'G', 840, motion, MotionMode::tap),
    modal(kRs274, 'G', 850, motion, MotionMode::bore),
    modal(kRs274, 'G', 860, motion, MotionMode::bore_stop),
    modal(kRs274, 'G', 870, motion, MotionMode::bore_back),
    modal(kRs274, 'G', 880, motion, MotionMode::bore_manual),
    modal(kRs274, 'G', 890, motion, MotionMode::bore_dwell),
    modal(kFanuc, 'G', 40, non_modal, NonModal::dwell, LetterSet("PXU")),
    modal(kLinuxcnc, 'G', 40, non_modal, NonModal::dwell, LetterSet("P")),
    modal(kSinumerik, 'G', 40, non_modal, NonModal::dwell),
    modal(kRs274, 'G', 280, non_modal, NonModal::home, kAxisWords),
    modal(kIso, 'G', 530, non_modal, NonModal::machine_coordinates),
    modal(kFanuc, 'G', 531, non_modal, NonModal::align),
    modal(kRs274, 'G', 920, non_modal, NonModal::shift_to_place, kAxisWords),
    modal(kRs274, 'G', 921, non_modal, NonModal::shift_off),
    modal(kLinuxcnc, 'G', 922, non_modal, NonModal::shift_suspend),
    modal(kLinuxcnc, 'G', 923, non_modal, NonModal::shift_resume),
    modal(kRs274, 'G', 520, non_modal, NonModal::shift, kAxisWords),
    modal(kFanuc, 'G', 680, tilted_plane, TiltWord::turn, LetterSet("XYZR")),
    modal(kIso, 'G', 170, plane, Plane::xy),
    modal(kIso, 'G', 180, plane, Plane::zx),
    modal(kIso, 'G', 190, plane, Plane::yz),
    modal(kRs274, 'G', 200, unit, LengthUnit::inch),
    modal(kRs274, 'G', 210, unit, LengthUnit::millimetre),
    modal(kSinumerik, 'G', 700, unit, LengthUnit::inch_but_feeds),
    modal(kSinumerik, 'G', 710, unit, LengthUnit::millimetre),
    modal(kSinumerik, 'G', 7000, unit, LengthUnit::inch),
    modal(kSinumerik, 'G', 7100, unit, LengthUnit::millimetre),
    modal(kIso, 'G', 400, radius_compensation, 0),
    modal(kFanuc, 'G', 430, length_compensation, LengthWord::length, kOffsetWord),
    modal(kFanuc, 'G', 434, length_compensation, LengthWord::tool_centre_point, kOffsetWord),
    modal(kFanuc, 'G', 435, length_compensation, LengthWord::tool_vectors, kOffsetWord),
    modal(kFanuc, 'G', 490, length_compensation, LengthWord::off),
    modal(kLinuxcnc, 'G', 430, length_compensation, LengthWord::length_only, kOffsetWord),
    modal(kLinuxcnc, 'G', 490, length_compensation, LengthWord::length_only_off),
    modal(kLinuxcnc, 'M', 4280, tool_tip, TipWord::on),
    modal(kLinuxcnc, 'M', 4290, tool_tip, TipWord::off),
    modal(kIso, 'G', 540, work_offset, 1),
    modal(kIso, 'G', 550, work_offset, 2),
    modal(kIso, 'G', 560, work_offset, 3),
    modal(kIso, 'G', 570, work_offset, 4),
    modal(kRs274, 'G', 580, work_offset, 5),
    modal(kRs274, 'G', 590, work_offset, 6),
    modal(kLinuxcnc, 'G', 591, work_offset, 7),
    modal(kLinuxcnc, 'G', 592, work_offset, 8),
    modal(kLinuxcnc, 'G', 593, work_offset, 9),
    modal(kSinumerik, 'G', 5000, work_offset, 0),
    modal(kSinumerik, 'G', 5050, work_offset, 5),
    modal(kSinumerik, 'G', 5060, work_offset, 6),
    modal(kFanuc, 'G', 682, tilted_plane, TiltWord::euler, LetterSet("XYZIJK")),
    modal(kFanuc, 'G', 690, tilted_plane, TiltWord::off),
    modal(kIso, 'G', 900, distance, DistanceMode::absolute),
    modal(kIso, 'G', 910, distance, DistanceMode::incremental),
    modal(kRs274, 'G', 901, arc_distance, DistanceMode::absolute),
    modal(kRs274, 'G', 911, arc_distance, DistanceMode::incremental),
    modal(kIso, 'G', 930, feed_mode, FeedMode::inverse_time),
    modal(kIso, 'G', 940, feed_mode, FeedMode::per_minute),
    modal(kIso, 'G', 950, feed_mode, FeedMode::per_revolution),
    passed(kFanuc, 'G', 51, CodeGroup::event, kSmoothingWords),  // look-ahead contour control
    passed(kFanuc, 'G', 80, CodeGroup::event, kSmoothingWords),  // look-ahead control
    passed(kFanuc | kSinumerik, 'G', 90),                        // exact stop on this block
    passed(kFanuc, 'G', 150),                                    // cancels what is refused: polar,
    passed(kFanuc, 'G', 500),                                    // scaling,
    passed(kFanuc, 'G', 501),                                    // mirror image,
    passed(kFanuc, 'G', 670),                                    // modal macro calls
    passed(kSinumerik, 'G', 600, path_control),
    passed(kRs274, 'G', 610, path_control),
    passed(kRs274, 'G', 611, path_control),
    passed(kRs274, 'G', 640, path_control, kSmoothingWords),
    passed(kSinumerik, 'G', 640, path_control),
    passed(kSinumerik, 'G', 6410, path_control),
    passed(kSinumerik, 'G', 6420, path_control),
    passed(kSinumerik, 'G', 6430, path_control),
    passed(kSinumerik, 'G', 6440, path_control),
    passed(kSinumerik, 'G', 6450, path_control),
    passed(kSinumerik, 'G', 6010),  // when an exact stop is reached
    passed(kSinumerik, 'G', 6020),
    passed(kSinumerik, 'G', 6030),
    modal(kRs274, 'G', 960, speed_mode, SpeedWord::surface, LetterSet("D")),
    modal(kRs274, 'G', 970, speed_mode, SpeedWord::revolutions),
    passed(kSinumerik, 'G', 970),
    passed(kLinuxcnc, 'G', 80),  // X is a radius
    modal(kRs274, 'G', 980, retract, RetractWord::initial),
    modal(kRs274, 'G', 990, retract, RetractWord::level),
    modal(kMachines, 'M', 0, stop, StopKind::program_stop),
    modal(kMachines, 'M', 10, stop, StopKind::optional_stop),
    modal(kMachines, 'M', 20, stop, StopKind::program_end),
    modal(kMachines, 'M', 300, stop, StopKind::program_end),
    modal(kSinumerik, 'M', 170, stop, StopKind::program_end),
    modal(kMachines, 'M', 30, spindle, SpindleDirection::clockwise),
    modal(kMachines, 'M', 40, spindle, SpindleDirection::counterclockwise),
    modal(kMachines, 'M', 50, spindle, SpindleDirection::off),
    modal(kIso, 'M', 60, tool_change, 0),
    passed(kHeidenhain, 'M', 60),         // the change itself is TOOL CALL
    passed(kMachines, 'M', 70, coolant),  // mist
    modal(kMachines, 'M', 80, coolant, CoolantWord::flood),
    modal(kMachines, 'M', 90, coolant, CoolantWord::off),
    passed(kMachines, 'M', 100),                                      // clamp
    passed(kMachines, 'M', 110),                                      // unclamp
    passed(kMachines, 'M', 190, CodeGroup::event, LetterSet("RPQ")),  // orient the spindle
    passed(kRs274, 'M', 480),                                         // overrides on
    passed(kRs274, 'M', 490),                                         // overrides off
    passed(kLinuxcnc, 'M', 500, CodeGroup::event, LetterSet("P")),
    passed(kLinuxcnc, 'M', 510, CodeGroup::event, LetterSet("P")),
    passed(kLinuxcnc, 'M', 520, CodeGroup::event, LetterSet("P")),
    passed(kLinuxcnc, 'M', 530, CodeGroup::event, LetterSet("P")),
    modal(kRs274, 'M', 600, stop, StopKind::program_stop),
    passed(kLinuxcnc, 'M', 620, CodeGroup::event, LetterSet("P")),  // outputs
    passed(kLinuxcnc, 'M', 630, CodeGroup::event, LetterSet("P")),
    passed(kLinuxcnc, 'M', 640, CodeGroup::event, LetterSet("P")),
    passed(kLinuxcnc, 'M', 650, CodeGroup::event, LetterSet("P")),
    passed(kLinuxcnc, 'M', 660, CodeGroup::event, LetterSet("PELQ")),  // wait on an input
    passed(kLinuxcnc, 'M', 670, CodeGroup::event, LetterSet("EQ")),
    passed(kLinuxcnc, 'M', 680, CodeGroup::event, LetterSet("EQ")),
    modal(kLinuxcnc, 'M', 700, saved_modes, SavedModesWord::save),
    modal(kLinuxcnc, 'M', 710, saved_modes, SavedModesWord::drop),
    modal(kLinuxcnc, 'M', 720, saved_modes, SavedModesWord::restore),
    modal(kLinuxcnc, 'M', 730, saved_modes, SavedModesWord::save_for_call),
    modal(kRs274, 'M', 980, subprogram, SubprogramWord::call, kCallWords),
    modal(kFanuc, 'G', 650, subprogram, SubprogramWord::macro),
    modal(kRs274, 'M', 990, subprogram, SubprogramWord::leave),

    named(kSinumerik, "SUPA", non_modal, NonModal::machine_coordinates),
    named(kSinumerik, "TRAORI", tool_tip, TipWord::on),
    named(kSinumerik, "TRAFOOF", tool_tip, TipWord::off),
    named(kSinumerik, "ORIAXES", orientation_path, OrientationPath::rotary_axes),
    named(kSinumerik, "ORIVECT", orientation_path, OrientationPath::great_circle),
    named(kSinumerik, "ORIPLANE", orientation_path, OrientationPath::great_circle),
    named(kSinumerik, "CYCLE800", tilted_plane, TiltWord::swivel, LetterSet("XYZABCQduvw")),
    named(kSinumerik, "CYCLE800()", tilted_plane, TiltWord::off),
    passed(kSinumerik, "ORIWKS"),  // directions are of the workpiece, as they always are here
    passed(kSinumerik, "STOPRE"),
    passed(kSinumerik, "FFWON"),
    passed(kSinumerik, "FFWOF"),
    passed(kSinumerik, "SOFT"),
    passed(kSinumerik, "BRISK"),
    passed(kSinumerik, "COMPON"),
    passed(kSinumerik, "COMPCURV"),
    passed(kSinumerik, "COMPCAD"),
    passed(kSinumerik, "COMPOF"),
    passed(kSinumerik, "UPATH"),
    passed(kSinumerik, "SPATH"),
    passed(kSinumerik, "DIAMOF"),
    passed(kSinumerik, "CFTCP"),
    passed(kSinumerik, "CFC"),
    passed(kSinumerik, "CFIN"),
    passed(kSinumerik, "KONT"),
    passed(kSinumerik, "NORM"),
    passed(kSinumerik, "FNORM"),

    named(kHeidenhain, "BEGIN PGM MM", unit, LengthUnit::millimetre),
    named(kHeidenhain, "BEGIN PGM INCH", unit, LengthUnit::inch),
    named(kHeidenhain, "END PGM", stop, StopKind::program_end),
    named(kHeidenhain, "STOP", stop, StopKind::program_stop),
    named(kHeidenhain, "L", motion, MotionMode::linear),
    named(kHeidenhain, "L FMAX", motion, MotionMode::traverse),
    named(kHeidenhain, "LN", motion, MotionMode::linear),
    named(kHeidenhain, "LN FMAX", motion, MotionMode::traverse),
    named(kHeidenhain, "CC", non_modal, NonModal::pole, LetterSet("XY")),
    named(kHeidenhain, "C DR-", motion, MotionMode::arc_clockwise),
    named(kHeidenhain, "C DR+", motion, MotionMode::arc_counterclockwise),
    named(kHeidenhain, "CR DR-", motion, MotionMode::arc_clockwise),
    named(kHeidenhain, "CR DR+", motion, MotionMode::arc_counterclockwise),
    named(kHeidenhain, "TOOL CALL", tool_change, 0),
    named(kHeidenhain, "F AUTO", feed_source, 0),
    named(kHeidenhain, "R0", radius_compensation, 0),
    named(kHeidenhain, "CYCL DEF 247", work_offset, 0, LetterSet("P")),
    named(kHeidenhain, "DWELL", non_modal, NonModal::dwell, LetterSet("P")),
    named(kHeidenhain, "PLANE SPATIAL", tilted_plane, TiltWord::spatial, LetterSet("ABCd")),
    named(kHeidenhain, "PLANE RESET", tilted_plane, TiltWord::off, LetterSet("d")),
    named(kHeidenhain, "FUNCTION TCPM", tool_tip, TipWord::on),
    named(kHeidenhain, "FUNCTION RESET TCPM", tool_tip, TipWord::off),
    named(kHeidenhain, "PATHCTRL AXIS", orientation_path, OrientationPath::rotary_axes),
    named(kHeidenhain, "PATHCTRL VECTOR", orientation_path, OrientationPath::great_circle),
    modal(kHeidenhain, 'M', 910, non_modal, NonModal::machine_coordinates),
    modal(kHeidenhain, 'M', 1260, rotary_path, RotaryPath::shortest),
    modal(kHeidenhain, 'M', 1270, rotary_path, RotaryPath::as_programmed),
    modal(kHeidenhain, 'M', 1280, tool_tip, TipWord::on),
    modal(kHeidenhain, 'M', 1290, tool_tip, TipWord::off),
    modal(kHeidenhain, 'M', 1360, feed_mode, FeedMode::per_revolution),
    modal(kHeidenhain, 'M', 1370, feed_mode, FeedMode::per_minute),
    passed(kHeidenhain, 'M', 900),   // corners at a constant speed
    passed(kHeidenhain, 'M', 1070),  // no stop at oversized tools
    passed(kHeidenhain, 'M', 1080),

    named(kCldata, "UNITS/MM", unit, LengthUnit::millimetre),
    named(kCldata, "UNITS/INCHES", unit, LengthUnit::inch),
    named(kCldata, "MULTAX/ON", length_compensation, LengthWord::tool_vectors, kOffsetWord),
    named(kCldata, "MULTAX/OFF", length_compensation, LengthWord::length, kOffsetWord),
    named(kCldata, "LOADTL", tool_change, 0),
    named(kCldata, "SPINDL/CLW", spindle, SpindleDirection::clockwise),
    named(kCldata, "SPINDL/CCLW", spindle, SpindleDirection::counterclockwise),
    named(kCldata, "SPINDL/OFF", spindle, SpindleDirection::off),
    named(kCldata, "COOLNT/ON", coolant, CoolantWord::flood),
    named(kCldata, "COOLNT/OFF", coolant, CoolantWord::off),
    named(kCldata, "FEDRAT/MMPM", feed_mode, FeedMode::per_minute),
    named(kCldata, "FEDRAT/MMPR", feed_mode, FeedMode::per_revolution),
    named(kCldata, "GOTO", motion, MotionMode::linear),
    named(kCldata, "GODLTA", motion, MotionMode::linear),
    named(kCldata, "RAPID GOTO", motion, MotionMode::traverse),
    named(kCldata, "RAPID GODLTA", motion, MotionMode::traverse),
    named(kCldata, "CIRCLE-", motion, MotionMode::arc_clockwise),
    named(kCldata, "CIRCLE+", motion, MotionMode::arc_counterclockwise),
    named(kCldata, "plane XY", plane, Plane::xy),
    named(kCldata, "plane ZX", plane, Plane::zx),
    named(kCldata, "plane YZ", plane, Plane::yz),
    named(kCldata, "FROM", non_modal, NonModal::start, LetterSet("XYZabc")),
    named(kCldata, "GOHOME", non_modal, NonModal::home),
    named(kCldata, "DELAY", non_modal, NonModal::dwell, LetterSet("P")),
    named(kCldata, "DELAY REV", non_modal, NonModal::dwell),
    named(kCldata, "STOP", stop, StopKind::program_stop),
    named(kCldata, "OPSTOP", stop, StopKind::optional_stop),
    named(kCldata, "END", stop, StopKind::program_end),
    named(kCldata, "FINI", stop, StopKind::program_end),
};
static_assert(kCodes.size() < 255, "rows are counted in a byte");

// A code, or a range of codes, or a word, that would change the part and that is not simulated.
struct RefusedCode {
  std::uint8_t dialects;
  char letter;
  int first_tenths;
  int last_tenths;
  std::string_view remedy;
};
constexpr std::array kRefused{
    RefusedCode{kIso, 'G', 50, 59, "write splines as short G1 blocks"},
    RefusedCode{kRs274, 'G', 100, 109, "give offsets in the job, not in the program"},
    RefusedCode{kFanuc, 'G', 160, 169, "write positions in X and Y"},
    RefusedCode{kRs274, 'G', 281, 309, "return to home with G28"},
    RefusedCode{kRs274, 'G', 310, 389, "leave threading and probing out of the simulated program"},
    RefusedCode{kSinumerik, 'G', 330, 359, "leave threading out of the simulated program"},
    RefusedCode{kIso, 'G', 410, 429, "program the path of the tool centre and use G40"},
    RefusedCode{kFanuc, 'G', 431, 439, "use G43 H, G43.4 H or G43.5 H"},
    RefusedCode{kLinuxcnc, 'G', 431, 439, "use G43 H, and M428 for tool-tip control"},
    RefusedCode{kFanuc, 'G', 510, 519, "write the positions out, in G54 to G59"},
    RefusedCode{kFanuc, 'G', 541, 549, "use G54 to G59"},
    RefusedCode{kFanuc, 'G', 591, 599, "use G54 to G59"},
    RefusedCode{kFanuc, 'G', 660, 669, "call subprograms with M98 P"},
    RefusedCode{kFanuc, 'G', 681, 689,
                "write the positions out, or use G68.2 X Y Z I J K for a tilted plane"},
    RefusedCode{kRs274, 'G', 750, 769, "write the cycle out as G0 and G1 blocks"},
    RefusedCode{kSinumerik, 'G', 740, 759, "move to the positions with SUPA and D0"},
    RefusedCode{kSinumerik, 'G', 1100, 1129, "write positions in X, Y and Z"},
    RefusedCode{kSinumerik, 'G', 5070, 5990, "use G54 to G57, G505 and G506"},
    RefusedCode{kLinuxcnc, 'G', 70, 70, "give X as a radius"},
    RefusedCode{kSinumerik, 'G', 960, 969, "give the spindle speed in revolutions per minute"},
    RefusedCode{kLinuxcnc, 'M', 4300, 4300, "use M428 (tool tip) or M429 (axes)"},
    RefusedCode{kHeidenhain, 'M', 890, 899, "write the cycle out as L blocks"},
    RefusedCode{kHeidenhain, 'M', 920, 929, "use M91, the machine's own coordinates"},
    RefusedCode{kHeidenhain, 'M', 970, 1039, "write the path out as L and C blocks"},
    RefusedCode{kHeidenhain, 'M', 1090, 1120,
                "give the feed of the tool tip, without M109 to M112"},
    RefusedCode{kHeidenhain, 'M', 1160, 1180, "give the feed of the tool tip with M128 instead"},
    RefusedCode{kHeidenhain, 'M', 1300, 1309, "program in the tilted plane, or use PLANE RESET"},
    RefusedCode{kHeidenhain, 'M', 1380, 1449, "use FUNCTION TCPM or M128"},
};

struct RefusedWord {
  std::uint8_t dialects;
  std::string_view word;
  std::string_view remedy;
};
constexpr std::string_view kNoFrames = "write the positions out, in G54 to G57 or with CYCLE800";
constexpr std::string_view kNoFlow = "write the blocks out in the order in which they run";
constexpr std::array kRefusedWords{
    RefusedWord{kSinumerik, "TRANS", kNoFrames},
    RefusedWord{kSinumerik, "ATRANS", kNoFrames},
    RefusedWord{kSinumerik, "ROT", kNoFrames},
    RefusedWord{kSinumerik, "AROT", kNoFrames},
    RefusedWord{kSinumerik, "ROTS", kNoFrames},
    RefusedWord{kSinumerik, "SCALE", kNoFrames},
    RefusedWord{kSinumerik, "MIRROR", kNoFrames},
    RefusedWord{kSinumerik, "AMIRROR", kNoFrames},
    RefusedWord{kSinumerik, "ORIMKS", "give directions in the workpiece frame: ORIWKS"},
    RefusedWord{kSinumerik, "ORIEULER", "give directions by A3= B3= C3="},
    RefusedWord{kSinumerik, "ORIRPY", "give directions by A3= B3= C3="},
    RefusedWord{kSinumerik, "REPEATB", kNoFlow},
    RefusedWord{kSinumerik, "CASE", kNoFlow},
    RefusedWord{kSinumerik, "CALL", kNoFlow},
    RefusedWord{kSinumerik, "EXTCALL", kNoFlow},
    RefusedWord{kSinumerik, "PROC", kNoFlow},
    RefusedWord{kSinumerik, "DEF", "use R parameters: R1=2.5"},
    RefusedWord{kSinumerik, "CIP", "write the arc with G2 or G3"},
    RefusedWord{kSinumerik, "CT", "write the arc with G2 or G3"},
    RefusedWord{kSinumerik, "DIAMON", "give X as a radius: DIAMOF"},
    RefusedWord{kHeidenhain, "CT", "write the arc with CC and C, or with CR"},
    RefusedWord{kHeidenhain, "CP", "write positions in X, Y and Z"},
    RefusedWord{kHeidenhain, "LP", "write positions in X, Y and Z"},
    RefusedWord{kHeidenhain, "CTP", "write positions in X, Y and Z"},
    RefusedWord{kHeidenhain, "CHF", "write the chamfer as an L block"},
    RefusedWord{kHeidenhain, "RND", "write the rounding as C or CR"},
    RefusedWord{kHeidenhain, "APPR", "write the approach as L and C blocks"},
    RefusedWord{kHeidenhain, "DEP", "write the departure as L and C blocks"},
    RefusedWord{kHeidenhain, "CYCL", "write the cycle out as L blocks"},
    RefusedWord{kHeidenhain, "SPL", "write splines as short L blocks"},
    RefusedWord{kCldata, "CYCLE", "write the cycle out as GOTO records"},
    RefusedWord{kCldata, "CUTCOM", "let the CAM system write the path of the tool tip"},
    RefusedWord{kCldata, "TRANS", "let the CAM system write the path where the part is"},
    RefusedWord{kCldata, "ROTATE", "give tool vectors in GOTO after MULTAX/ON"},
    RefusedWord{kCldata, "ORIGIN", "set the work offset in the job"},
    RefusedWord{kCldata, "COPY", "write the path out"},
    RefusedWord{kCldata, "TRACUT", "write the path out"},
    RefusedWord{kCldata, "CALSUB", "write the path out"},
    RefusedWord{kCldata, "RETRCT", "write the retract as a GOTO record"},
    RefusedWord{kCldata, "MOVARC", "write the arc as CIRCLE and GOTO"},
    RefusedWord{kCldata, "TLAXIS", "give the tool vector in GOTO after MULTAX/ON"},
};

// Direct access by ten times the number: 1 + row of kCodes, 0 for none.
constexpr int kTenthsEnd = 10'000;
using CodeIndex = std::array<std::uint8_t, kTenthsEnd>;
constexpr CodeIndex index_of(Dialect dialect, char letter) {
  CodeIndex positions{};
  for (std::size_t i = 0; i < kCodes.size(); ++i) {
    if (kCodes[i].letter == letter && (kCodes[i].dialects & of(dialect)) != 0) {
      positions[static_cast<std::size_t>(kCodes[i].tenths)] = static_cast<std::uint8_t>(i + 1);
    }
  }
  return positions;
}
constexpr std::array kGCodes{index_of(Dialect::fanuc, 'G'), index_of(Dialect::linuxcnc, 'G'),
                             index_of(Dialect::sinumerik, 'G')};
constexpr std::array kMCodes{index_of(Dialect::fanuc, 'M'), index_of(Dialect::linuxcnc, 'M'),
                             index_of(Dialect::sinumerik, 'M'), index_of(Dialect::heidenhain, 'M')};

// Ten times the number when that is whole (RS-274 forgives 1e-4), else -1.
int tenths_of(double number) {
  const double tenths = number * 10.0;
  const double nearest = std::round(tenths);
  if (std::abs(tenths - nearest) > 1e-3 || nearest < 0.0 || nearest >= kTenthsEnd) return -1;
  return static_cast<int>(nearest);
}

template <std::size_t N>
const Code* find_in(const std::array<CodeIndex, N>& indices, Dialect dialect, int tenths) {
  const auto slot = static_cast<std::size_t>(dialect);
  if (slot >= N) return nullptr;
  const std::uint8_t position = indices[slot][static_cast<std::size_t>(tenths)];
  return position == 0 ? nullptr : &kCodes[position - 1U];
}

}  // namespace

std::string Code::name() const {
  if (letter == kNamedWord) return std::string(word);
  return letter + decimal_text(static_cast<double>(tenths) / 10.0);
}

const Code* find_code(Dialect dialect, char letter, double number) {
  const int tenths = tenths_of(number);
  if (tenths < 0) return nullptr;
  return letter == 'G' ? find_in(kGCodes, dialect, tenths) : find_in(kMCodes, dialect, tenths);
}

const Code* find_code(Dialect dialect, std::string_view word) {
  for (const Code& code : kCodes) {
    if (code.word == word && (code.dialects & of(dialect)) != 0 && code.letter == kNamedWord)
      return &code;
  }
  return nullptr;
}

double row_of(const Code& code) { return static_cast<double>(&code - kCodes.data()); }
const Code& code_at(double row) { return kCodes.at(static_cast<std::size_t>(row)); }

std::string_view remedy_for(Dialect dialect, char letter, double number) {
  const int tenths = tenths_of(number);
  for (const RefusedCode& code : kRefused) {
    if (code.letter == letter && code.first_tenths <= tenths && tenths <= code.last_tenths &&
        (code.dialects & of(dialect)) != 0)
      return code.remedy;
  }
  return {};
}

std::string_view remedy_for(Dialect dialect, std::string_view word) {
  for (const RefusedWord& refused : kRefusedWords) {
    if (refused.word == word && (refused.dialects & of(dialect)) != 0) return refused.remedy;
  }
  return {};
}

std::string known_words(Dialect dialect) {
  std::string names;
  for (const Code& code : kCodes) {
    if (code.letter != kNamedWord || (code.dialects & of(dialect)) == 0) continue;
    if (!names.empty()) names += ' ';
    names += code.name();
  }
  return names;
}

std::string codes_near(Dialect dialect, char letter, double number) {
  constexpr std::size_t kShown = 5;
  std::vector<const Code*> codes;
  for (const Code& code : kCodes) {
    if (code.letter == letter && (code.dialects & of(dialect)) != 0) codes.push_back(&code);
  }
  const auto distance = [&](const Code* code) { return std::abs(code->tenths - 10.0 * number); };
  std::sort(codes.begin(), codes.end(), [&](const Code* a, const Code* b) {
    return std::pair(distance(a), a->tenths) < std::pair(distance(b), b->tenths);
  });
  codes.resize(std::min(codes.size(), kShown));
  std::sort(codes.begin(), codes.end(),
            [](const Code* a, const Code* b) { return a->tenths < b->tenths; });
  std::string names;
  for (const Code* code : codes) names += (names.empty() ? "" : " ") + code->name();
  return names;
}

}  // namespace frustum::parser

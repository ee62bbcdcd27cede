// What an NC program has set so far and what stays set: the modes, tool, spindle and feed.
//
// The defaults are the state every program starts in: no motion mode, G17, G21, G90, G91.1, G94,
// G49, G54, no feed, no tool chosen, spindle and coolant off.
// Units: mm, rad, mm/min, 1/min.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <vector>

#include "parser/interpret/state/control_data.hpp"
#include "parser/interpret/state/drilling_cycle.hpp"
#include "parser/interpret/state/feature_words.hpp"
#include "parser/interpret/state/hole_cycle.hpp"
#include "parser/interpret/state/program_frame.hpp"
#include "parser/interpret/state/program_position.hpp"
#include "parser/interpret/state/programmed_frame.hpp"
#include "parser/language/letter_set.hpp"
#include "parser/language/modes.hpp"
#include "parser/motion.hpp"

namespace frustum::parser {

using ToolOffset = std::array<double, kAxisLetters.size()>;  // along the axes

// Whether the tool's length counts, and whether the control guides the tool's tip: two switches, in
// Fanuc's G43.4 thrown together.
struct Compensation {
  bool length = false;
  bool tip = false;
  bool tool_vectors = false;
  int offset_number = 0;
  // The tip control works without a length too: the tip is where the spindle ends.
  bool tip_without_length = false;
  bool negative = false;  // G44: what the number has is subtracted
  // Of the tool, along the axes, as it adds to them, where the program or its tool table gives
  // them; else only the setup knows.
  std::optional<ToolOffset> tool_offset{};

  // What is added to the positions of the axes; none where only the setup knows.
  [[nodiscard]] std::optional<ToolOffset> offset() const {
    if (!length) return ToolOffset{};
    return tool_offset;
  }
  [[nodiscard]] LengthCompensation mode() const {
    if (tip) return LengthCompensation::tool_centre_point;
    return length ? LengthCompensation::length : LengthCompensation::off;
  }
  bool operator==(const Compensation&) const = default;
};

// An F word: a purely rotary move reads it in deg/min, whatever the unit of lengths.
struct FeedWord {
  double as_written = 0.0;
  double scaled = 0.0;  // in mm/min when per minute
};

// The words of the canned cycle at work, in mm and seconds. Steps count from `initial` and from the
// level.
struct CannedCycle {
  MotionMode last = MotionMode::none;
  std::optional<double> initial{};  // depth before the first hole, as far as it is known
  std::optional<HeightBeforeTool> untold_change{};  // has come since, and no event has reported it
  std::optional<double> level{};
  std::optional<double> bottom{};
  bool level_is_step = false;
  bool bottom_is_step = false;
  std::optional<double> peck{};
  std::optional<double> dwell{};
  std::optional<double> shift_u{};
  std::optional<double> shift_v{};
  std::optional<double> back{};
  bool depth_by_i = false;  // G81 of Fagor: Z is where feeding begins, I the bottom
};

// M29: taps are rigid. Lines of what has come between it and its first hole; 0: nothing.
struct RigidMode {
  bool on = false;
  bool has_tapped = false;
  std::uint32_t axes_moved = 0;
  std::uint32_t speed_given = 0;
};

// G16: what the words of the plane's axes have said last, as radius and angle.
struct PolarMode {
  std::optional<double> radius{};
  double angle = 0.0;
  bool from_here = false;  // the radius counts from where the tool is, not from the origin
};

// Where a move in the plane has ended, and in which direction.
struct Heading {
  Vec3 at = Vec3::Zero();
  Vec3 along = Vec3::Zero();
};

// What polar positions count from, and those of LP and CP; with radius and angle as they were
// written last.
struct Pole {
  Vec3 at = Vec3::Zero();
  Plane plane = Plane::xy;
  bool given = true;  // else the origin represents it
  std::optional<double> radius{};
  std::optional<double> angle{};
};

// RNDM= and FRCM=: roundings of all corners, and their feed; zero where there is none.
struct ModalCorner {
  double radius = 0.0;
  double feed = 0.0;
};

// What T means beside M6: the tool of the next change; or, after a change without one, that of the
// change before.
enum class ToolOrder : std::uint8_t { before_change, not_known, behind_change };

struct ModalState {
  MotionMode motion = MotionMode::none;
  MotionMode before_cycle = MotionMode::none;  // the last motion that was no canned cycle
  Plane plane = Plane::xy;
  LengthUnit unit = LengthUnit::millimetre;
  bool unit_is_known = false;  // by a word of the program, the control's settings, or as assumed
  bool diameter = false;       // G7: X words are twice the position
  DistanceMode distance = DistanceMode::absolute;
  DistanceMode arc_distance = DistanceMode::incremental;
  bool centres_are_known = false;  // G90.1, G91.1 or an arc has been
  FeedMode feed_mode = FeedMode::per_minute;
  std::optional<FeedWord> feed{};
  bool feed_was_given = false;  // by any F, also F0
  Compensation compensation{};
  std::optional<ToolSide> tool_side{};  // G41, G42; absent: G40
  std::optional<int> radius_number{};   // the last D of a radius compensation
  std::optional<int> length_number{};   // the last H, where it is in force by itself
  int work_offset = 1;
  // Of the work offset in force: its origin, as far as the program knows it, and from it and the
  // tool the frame between the words' frame and the axes: the turn, the tool's offset along X and
  // Y, the rotary offsets.
  WorkOffset datum{};
  ProgrammedFrame offset_frame{};
  std::optional<int> selected_tool{};
  ToolOrder tool_order = ToolOrder::before_change;
  int tool = 0;                                        // in the spindle
  int tool_edge = 1;                                   // D of Sinumerik, above zero
  double tool_oversize = 0.0;                          // mm of its radius (DR of TOOL CALL)
  double tool_lengthening = 0.0;                       // mm: the tip stays so much higher (DL)
  std::optional<FeedWord> tool_feed{};                 // of TOOL CALL, for F AUTO
  RotaryPath rotary_path = RotaryPath::as_programmed;  // M126
  std::array<RotaryPath, 3> announced_rotary_paths{};  // of A, B, C: the last ones in the motions
  // Rotary axes that went the shorter way: where they stand, in full turns, the machine knows.
  std::array<bool, 3> loose{};
  // ORIMKS: directions of the tool are the machine's, whatever frame the words are in.
  OrientationReference orientation_reference = OrientationReference::workpiece;
  OrientationPath orientation_path = OrientationPath::rotary_axes;
  bool tilted = false;
  Pose tilt{};                            // of the tilted plane
  std::optional<FeatureWords> feature{};  // G68.2 over several blocks, until its last
  std::optional<PolarMode> polar{};       // G16
  ProgrammedFrame programmed_frame{};
  std::array<double, 6> local_shift{};  // of its shift, the part of G52, where that is apart
  ProgramFrame program_frame{};         // of Sinumerik, which is its word frame
  bool shift_was_added = false;         // to that, by ATRANS
  AxisTarget machine_place{};           // of the last words in machine coordinates
  AxisTarget way_home{};                // the place that the last G28 or G30 went by
  LetterSet placed_in_other_frame{};    // axes that no absolute word has placed since it changed
  std::optional<ProgrammedFrame> frame_below{};  // of the words before G68.2: that plane is in it
  std::optional<Pole> pole{};                    // CC, G110 to G112
  bool pole_lost = false;                        // it was one of another frame
  std::optional<Heading> heading{};              // of the last move
  std::optional<CannedCycle> cycle{};
  RigidMode rigid_mode{};
  HoleCycle hole_cycle{};
  std::vector<Vec3> point_pattern{};        // PATTERN DEF: X, Y, and how much higher the surface is
  std::optional<DrillingCycle> drilling{};  // MCALL
  bool retract_to_initial = true;           // G98; G99: to R
  SpindleDirection spindle = SpindleDirection::off;
  double spindle_speed = 0.0;
  bool surface_speed = false;  // G96: S is a cutting speed, which the spindle follows
  bool flood = false;
  ModalCorner corner{};
  std::optional<UnitVec3> tool_axis{};  // the last tool vector, until a rotary word replaces it

  [[nodiscard]] bool tool_centre_point() const { return compensation.tip; }
};

}  // namespace frustum::parser

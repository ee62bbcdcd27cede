// The words that several dialects share.
//
// Units : none
// Errors: none
#pragma once

#include <array>

#include "parser/dialects/code.hpp"
#include "parser/language/modes.hpp"
#include "parser/motion.hpp"

namespace frustum::parser {

// Of all machine controls.
inline constexpr std::array kMachineCodes{
    modal('M', 0, CodeGroup::stop, StopKind::program_stop),
    modal('M', 10, CodeGroup::stop, StopKind::optional_stop),
    modal('M', 20, CodeGroup::stop, StopKind::program_end),
    modal('M', 300, CodeGroup::stop, StopKind::program_end),
    modal('M', 30, CodeGroup::spindle, SpindleDirection::clockwise),
    modal('M', 40, CodeGroup::spindle, SpindleDirection::counterclockwise),
    modal('M', 50, CodeGroup::spindle, SpindleDirection::off),
    passed('M', 70, CodeGroup::coolant),  // mist
    modal('M', 80, CodeGroup::coolant, CoolantWord::flood),
    modal('M', 90, CodeGroup::coolant, CoolantWord::off),
    passed('M', 100),                                      // clamp
    passed('M', 110),                                      // unclamp
    passed('M', 190, CodeGroup::event, LetterSet("RPQ")),  // orient the spindle
};

// Spindle stop and coolant off beside a move, where the builder of the machine says when they
// count: after it, as most have it.
inline constexpr std::array kStopsBehindMove{50, 90};

// Of those that speak G code.
inline constexpr std::array kIsoCodes{
    modal('G', 0, CodeGroup::motion, MotionMode::traverse),
    modal('G', 10, CodeGroup::motion, MotionMode::linear),
    modal('G', 20, CodeGroup::motion, MotionMode::arc_clockwise),
    modal('G', 30, CodeGroup::motion, MotionMode::arc_counterclockwise),
    modal('G', 530, CodeGroup::non_modal, NonModal::machine_coordinates),
    modal('G', 170, CodeGroup::plane, Plane::xy),
    modal('G', 180, CodeGroup::plane, Plane::zx),
    modal('G', 190, CodeGroup::plane, Plane::yz),
    modal('G', 400, CodeGroup::radius_compensation, RadiusWord::off),
    modal('G', 540, CodeGroup::work_offset, 1),
    modal('G', 550, CodeGroup::work_offset, 2),
    modal('G', 560, CodeGroup::work_offset, 3),
    modal('G', 570, CodeGroup::work_offset, 4),
    modal('G', 900, CodeGroup::distance, DistanceMode::absolute),
    modal('G', 910, CodeGroup::distance, DistanceMode::incremental),
    modal('G', 930, CodeGroup::feed_mode, FeedMode::inverse_time),
    modal('G', 940, CodeGroup::feed_mode, FeedMode::per_minute),
    modal('G', 950, CodeGroup::feed_mode, FeedMode::per_revolution),
    modal('M', 60, CodeGroup::tool_change, 0),
};

constexpr LetterSet kCallWords{"PL"};
constexpr LetterSet kSmoothingWords{"PQR"};
// Of Fanuc and LinuxCNC.
inline constexpr std::array kRs274Codes{
    modal('G', 800, CodeGroup::cycle, 0),
    modal('G', 730, CodeGroup::motion, MotionMode::peck_short),
    modal('G', 740, CodeGroup::motion, MotionMode::tap_left),
    modal('G', 810, CodeGroup::motion, MotionMode::drill),
    modal('G', 820, CodeGroup::motion, MotionMode::drill_dwell),
    modal('G', 830, CodeGroup::motion, MotionMode::peck),
    modal('G', 840, CodeGroup::motion, MotionMode::tap),
    modal('G', 850, CodeGroup::motion, MotionMode::bore),
    modal('G', 860, CodeGroup::motion, MotionMode::bore_stop),
    modal('G', 870, CodeGroup::motion, MotionMode::bore_back),
    modal('G', 880, CodeGroup::motion, MotionMode::bore_manual),
    modal('G', 890, CodeGroup::motion, MotionMode::bore_dwell),
    modal('G', 280, CodeGroup::non_modal, NonModal::home, kAxisWords),
    modal('G', 920, CodeGroup::non_modal, NonModal::shift_to_place, kAxisWords),
    modal('G', 921, CodeGroup::non_modal, NonModal::shift_off),
    modal('G', 520, CodeGroup::non_modal, NonModal::shift, kAxisWords),
    modal('G', 200, CodeGroup::unit, LengthUnit::inch),
    modal('G', 210, CodeGroup::unit, LengthUnit::millimetre),
    modal('G', 580, CodeGroup::work_offset, 5),
    modal('G', 590, CodeGroup::work_offset, 6),
    modal('G', 901, CodeGroup::arc_distance, DistanceMode::absolute),
    modal('G', 911, CodeGroup::arc_distance, DistanceMode::incremental),
    passed('G', 610, CodeGroup::path_control),
    passed('G', 611, CodeGroup::path_control),
    passed('G', 640, CodeGroup::path_control, kSmoothingWords),
    modal('G', 960, CodeGroup::speed_mode, SpeedWord::surface, LetterSet("D")),
    modal('G', 970, CodeGroup::speed_mode, SpeedWord::revolutions),
    modal('G', 980, CodeGroup::retract, RetractWord::initial),
    modal('G', 990, CodeGroup::retract, RetractWord::level),
    passed('M', 480),  // overrides on
    passed('M', 490),  // overrides off
    modal('M', 600, CodeGroup::stop, StopKind::program_stop),
    modal('M', 980, CodeGroup::subprogram, SubprogramWord::call, kCallWords),
    modal('M', 990, CodeGroup::subprogram, SubprogramWord::leave),
};

}  // namespace frustum::parser

#include "parser/code_table.hpp"

#include <fmt/format.h>

#include <array>
#include <cmath>

#include "parser/expression.hpp"
#include "parser/modal_state.hpp"

namespace frustum::parser {
namespace {

template <typename Value>
constexpr Code modal(char letter, int tenths, CodeGroup group, Value value,
                     LetterSet arguments = {}) {
  return {letter, tenths, group, static_cast<std::uint8_t>(value), arguments, false};
}
constexpr Code passed(char letter, int tenths, CodeGroup group = CodeGroup::event,
                      LetterSet arguments = {}) {
  return {letter, tenths, group, 0, arguments, true};
}

constexpr LetterSet kDwellWords{"PXU"};
constexpr LetterSet kOffsetWord{"H"};
constexpr LetterSet kCallWords{"PL"};
constexpr LetterSet kSmoothingWords{"PQR"};

using enum CodeGroup;
constexpr std::array kCodes{
    modal('G', 0, motion, MotionMode::traverse),
    modal('G', 10, motion, MotionMode::linear),
    modal('G', 20, motion, MotionMode::arc_clockwise),
    modal('G', 30, motion, MotionMode::arc_counterclockwise),
    modal('G', 800, cycle, 0),
    modal('G', 40, non_modal, NonModal::dwell, kDwellWords),
    modal('G', 280, non_modal, NonModal::home, kAxisWords),
    modal('G', 530, non_modal, NonModal::machine_coordinates),
    modal('G', 170, plane, Plane::xy),
    modal('G', 180, plane, Plane::zx),
    modal('G', 190, plane, Plane::yz),
    modal('G', 200, unit, LengthUnit::inch),
    modal('G', 210, unit, LengthUnit::millimetre),
    modal('G', 400, radius_compensation, 0),
    modal('G', 430, length_compensation, LengthWord::length, kOffsetWord),
    modal('G', 434, length_compensation, LengthWord::tool_centre_point, kOffsetWord),
    modal('G', 435, length_compensation, LengthWord::tool_vectors, kOffsetWord),
    modal('G', 490, length_compensation, LengthWord::off),
    modal('G', 540, work_offset, 1),
    modal('G', 550, work_offset, 2),
    modal('G', 560, work_offset, 3),
    modal('G', 570, work_offset, 4),
    modal('G', 580, work_offset, 5),
    modal('G', 590, work_offset, 6),
    modal('G', 900, distance, DistanceMode::absolute),
    modal('G', 910, distance, DistanceMode::incremental),
    modal('G', 901, arc_distance, DistanceMode::absolute),
    modal('G', 911, arc_distance, DistanceMode::incremental),
    modal('G', 930, feed_mode, FeedMode::inverse_time),
    modal('G', 940, feed_mode, FeedMode::per_minute),
    passed('G', 51, CodeGroup::event, kSmoothingWords),  // look-ahead contour control
    passed('G', 80, CodeGroup::event, kSmoothingWords),  // look-ahead control
    passed('G', 90),                                     // exact stop on this block
    passed('G', 150),                                    // cancels what is refused: polar words,
    passed('G', 500),                                    // scaling,
    passed('G', 501),                                    // mirror image,
    passed('G', 670),                                    // modal macro calls,
    passed('G', 690),                                    // rotation
    passed('G', 610, path_control),
    passed('G', 611, path_control),
    passed('G', 640, path_control, kSmoothingWords),
    passed('G', 970),
    passed('G', 980),
    passed('G', 990),
    modal('M', 0, stop, StopKind::program_stop),
    modal('M', 10, stop, StopKind::optional_stop),
    modal('M', 20, stop, StopKind::program_end),
    modal('M', 300, stop, StopKind::program_end),
    modal('M', 30, spindle, SpindleDirection::clockwise),
    modal('M', 40, spindle, SpindleDirection::counterclockwise),
    modal('M', 50, spindle, SpindleDirection::off),
    modal('M', 60, tool_change, 0),
    passed('M', 70, coolant),  // mist
    modal('M', 80, coolant, CoolantWord::flood),
    modal('M', 90, coolant, CoolantWord::off),
    passed('M', 100),  // clamp
    passed('M', 110),  // unclamp
    passed('M', 190),  // orient the spindle
    passed('M', 480),  // overrides on
    passed('M', 490),  // overrides off
    modal('M', 980, subprogram, SubprogramWord::call, kCallWords),
    modal('M', 990, subprogram, SubprogramWord::leave),
};

constexpr std::array kRefused{
    RefusedCode{'G', 50, 59, "write splines as short G1 blocks"},
    RefusedCode{'G', 100, 109, "give offsets in the job, not in the program"},
    RefusedCode{'G', 160, 169, "write positions in X and Y"},
    RefusedCode{'G', 281, 309, "return to home with G28"},
    RefusedCode{'G', 310, 389, "leave threading and probing out of the simulated program"},
    RefusedCode{'G', 410, 429, "program the path of the tool centre and use G40"},
    RefusedCode{'G', 431, 439, "use G43 H, G43.4 H or G43.5 H"},
    RefusedCode{'G', 510, 529, "write the positions out, in G54 to G59"},
    RefusedCode{'G', 541, 549, "use G54 to G59"},
    RefusedCode{'G', 591, 599, "use G54 to G59"},
    RefusedCode{'G', 650, 669, "call subprograms with M98 P"},
    RefusedCode{'G', 680, 689, "write the positions out, or use G43.4 with tool vectors"},
    RefusedCode{'G', 730, 769, "write the cycle out as G0 and G1 blocks"},
    RefusedCode{'G', 810, 899, "write the cycle out as G0 and G1 blocks"},
    RefusedCode{'G', 920, 929, "use a work offset, G54 to G59"},
    RefusedCode{'G', 950, 950, "give the feed per minute with G94"},
    RefusedCode{'G', 960, 960, "give the spindle speed in revolutions per minute"},
};

// Direct access by ten times the number: 1 + index into kCodes, 0 for none.
constexpr int kTenthsEnd = 1000;
using CodeIndex = std::array<std::uint8_t, kTenthsEnd>;
constexpr CodeIndex index_of(char letter) {
  CodeIndex positions{};
  for (std::size_t i = 0; i < kCodes.size(); ++i) {
    if (kCodes[i].letter == letter) {
      positions[static_cast<std::size_t>(kCodes[i].tenths)] = static_cast<std::uint8_t>(i + 1);
    }
  }
  return positions;
}
constexpr CodeIndex kGCodes = index_of('G');
constexpr CodeIndex kMCodes = index_of('M');

// Ten times the number when that is whole (RS-274 forgives 1e-4), else -1.
int tenths_of(double number) {
  const double tenths = number * 10.0;
  const double nearest = std::round(tenths);
  if (std::abs(tenths - nearest) > 1e-3 || nearest < 0.0 || nearest >= kTenthsEnd) return -1;
  return static_cast<int>(nearest);
}

struct LetterUse {
  char letter;
  std::string_view use;
};
constexpr std::string_view kNeedsMotion = "axis words need a motion word (G0, G1, G2, G3) or G28";
constexpr std::string_view kNeedsVectors =
    "I J K give the centre of G2 and G3 along the axes of the plane (G17 I J, G18 I K, G19 J K), "
    "and "
    "the tool vector of G0 and G1 after G43.4 or G43.5";
constexpr std::array kLetterUses{
    LetterUse{'A', kNeedsMotion},
    LetterUse{'B', kNeedsMotion},
    LetterUse{'C', kNeedsMotion},
    LetterUse{'D', "cutter radius compensation is not simulated; leave D out"},
    LetterUse{'H', "H belongs to G43, G43.4 and G43.5"},
    LetterUse{'I', kNeedsVectors},
    LetterUse{'J', kNeedsVectors},
    LetterUse{'K', kNeedsVectors},
    LetterUse{'L', "L belongs to M98"},
    LetterUse{'P', "P belongs to G4, G2, G3, M98, G5.1, G8 and G64"},
    LetterUse{'Q', "Q belongs to G5.1, G8 and G64"},
    LetterUse{'R', "R belongs to G2 and G3"},
    LetterUse{'U', "U belongs to G4"},
    LetterUse{'X', kNeedsMotion},
    LetterUse{'Y', kNeedsMotion},
    LetterUse{'Z', kNeedsMotion},
};

}  // namespace

std::string Code::name() const { return letter + decimal_text(static_cast<double>(tenths) / 10.0); }

const Code* find_code(char letter, double number) {
  const int tenths = tenths_of(number);
  if (tenths < 0) return nullptr;
  const CodeIndex& positions = letter == 'G' ? kGCodes : kMCodes;
  const std::uint8_t position = positions[static_cast<std::size_t>(tenths)];
  return position == 0 ? nullptr : &kCodes[position - 1U];
}

const RefusedCode* find_refused(char letter, double number) {
  const int tenths = tenths_of(number);
  for (const RefusedCode& code : kRefused) {
    if (code.letter == letter && code.first_tenths <= tenths && tenths <= code.last_tenths)
      return &code;
  }
  return nullptr;
}

std::string known_codes(char letter) {
  std::string names;
  for (const Code& code : kCodes) {
    if (code.letter != letter) continue;
    if (!names.empty()) names += ' ';
    names += code.name();
  }
  return names;
}

std::string_view letter_use(char letter) {
  for (const LetterUse& use : kLetterUses) {
    if (use.letter == letter) return use.use;
  }
  return {};
}

}  // namespace frustum::parser

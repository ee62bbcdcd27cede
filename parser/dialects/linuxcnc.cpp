// LinuxCNC, that is RS-274/NGC.
#include "core/units.hpp"
#include "parser/dialects/dialect_rules.hpp"
#include "parser/dialects/shared_codes.hpp"

#include <array>
#include <numbers>

namespace frustum::parser {
namespace {

using enum CodeGroup;

constexpr LetterSet kLinuxCncOffsetWord{"H"};
constexpr std::array kLinuxCncCodes{
    modal('G', 40, non_modal, NonModal::dwell, LetterSet("P")),
    modal('G', 50, motion, MotionMode::cubic_spline),
    modal('G', 51, motion, MotionMode::quadratic_spline),
    modal('G', 52, motion, MotionMode::nurbs),
    modal('G', 53, motion, MotionMode::nurbs_end),
    modal('G', 62, motion, MotionMode::nurbs_by_knots),
    modal('G', 922, non_modal, NonModal::shift_suspend),
    modal('G', 923, non_modal, NonModal::shift_resume),
    modal('G', 410, radius_compensation, RadiusWord::left, LetterSet("D")),
    modal('G', 420, radius_compensation, RadiusWord::right, LetterSet("D")),
    modal('G', 411, radius_compensation, RadiusWord::left_by_diameter, LetterSet("DL")),
    modal('G', 421, radius_compensation, RadiusWord::right_by_diameter, LetterSet("DL")),
    modal('G', 430, length_compensation, LengthWord::length_only, kLinuxCncOffsetWord),
    modal('G', 431, length_compensation, LengthWord::dynamic, kAxisWords),
    modal('G', 432, length_compensation, LengthWord::additional, kAxisWords | kLinuxCncOffsetWord),
    modal('G', 100, non_modal, NonModal::data, LetterSet("LPRXYZABCIJQ")),
    modal('G', 281, non_modal, NonModal::keep_home),
    modal('G', 300, non_modal, NonModal::second_home, kAxisWords),
    modal('G', 301, non_modal, NonModal::keep_second_home),
    modal('G', 490, length_compensation, LengthWord::length_only_off),
    modal('G', 330, motion, MotionMode::thread),
    modal('G', 331, motion, MotionMode::rigid_tap),
    modal('G', 382, motion, MotionMode::probe_towards),
    modal('G', 383, motion, MotionMode::probe_towards_if_any),
    modal('G', 384, motion, MotionMode::probe_away),
    modal('G', 385, motion, MotionMode::probe_away_if_any),
    modal('G', 760, motion, MotionMode::thread_cycle),
    modal('M', 4280, tool_tip, TipWord::on),
    modal('M', 4290, tool_tip, TipWord::off),
    modal('G', 591, work_offset, 7),
    modal('G', 592, work_offset, 8),
    modal('G', 593, work_offset, 9),
    modal('G', 70, diameter, DiameterWord::diameter),
    modal('G', 80, diameter, DiameterWord::radius),
    passed('M', 500, CodeGroup::event, LetterSet("P")),
    passed('M', 510, CodeGroup::event, LetterSet("P")),
    passed('M', 520, CodeGroup::event, LetterSet("P")),
    passed('M', 530, CodeGroup::event, LetterSet("P")),
    modal('M', 610, tool_change, ToolWord::is, LetterSet("Q")),
    passed('M', 620, CodeGroup::event, LetterSet("P")),  // outputs
    passed('M', 630, CodeGroup::event, LetterSet("P")),
    passed('M', 640, CodeGroup::event, LetterSet("P")),
    passed('M', 650, CodeGroup::event, LetterSet("P")),
    passed('M', 660, CodeGroup::event, LetterSet("PELQ")),  // wait on an input
    passed('M', 670, CodeGroup::event, LetterSet("EQ")),
    passed('M', 680, CodeGroup::event, LetterSet("EQ")),
    modal('M', 700, saved_modes, SavedModesWord::save),
    modal('M', 710, saved_modes, SavedModesWord::drop),
    modal('M', 720, saved_modes, SavedModesWord::restore),
    modal('M', 730, saved_modes, SavedModesWord::save_for_call),
};

// M100 to M199 are the user's own.
constexpr auto kUserCodes = [] {
  std::array<Code, 100> codes{};
  for (std::size_t i = 0; i < codes.size(); ++i) {
    codes[i] = passed('M', 1000 + 10 * static_cast<int>(i), CodeGroup::event, LetterSet("PQ"));
  }
  return codes;
}();

constexpr LetterSet kToolAxes = kAxisWords | LetterSet("RIJQ");
constexpr std::array kLinuxCncDataWords{
    DataWord{0, DataInput::tool_table, LetterSet()},
    DataWord{1, DataInput::tool, kToolAxes},
    DataWord{2, DataInput::work_offset, kAxisWords | LetterSet("R")},
    DataWord{10, DataInput::tool_here, kToolAxes},
    DataWord{11, DataInput::tool_at_fixture, kToolAxes},
    DataWord{20, DataInput::offset_here, kAxisWords},
};

// What would change the part and is not simulated.
constexpr std::array kLinuxCncRefusedCodes{
    RefusedCode{'G', 433, 439, "use G43 H, and M428 for tool-tip control"},
    RefusedCode{'G', 171, 171, "U V W are not simulated; use G17"},
    RefusedCode{'G', 181, 181, "U V W are not simulated; use G18"},
    RefusedCode{'G', 191, 191, "U V W are not simulated; use G19"},
    RefusedCode{'G', 700, 729, "write the passes of the lathe cycle as G0 and G1 blocks"},
    RefusedCode{'M', 4300, 4300, "use M428 (tool tip) or M429 (axes)"},
};
constexpr std::string_view kLinuxCncNeedsMotion =
    "axis words need a motion word (G0, G1, G2, G3) or G28";
constexpr std::string_view kLinuxCncNeedsArc =
    "I J K give the centre of G2 and G3 along the axes of the plane (G17 I J, G18 I K, G19 J K)";

constexpr std::array kLinuxCncLetters{
    LetterUse{'A', kLinuxCncNeedsMotion},
    LetterUse{'B', kLinuxCncNeedsMotion},
    LetterUse{'C', kLinuxCncNeedsMotion},
    LetterUse{'D', "D belongs to G41, G42, G41.1, G42.1 and G96"},
    LetterUse{'E', "E belongs to G76 and M66 to M68"},
    LetterUse{'H', "H belongs to G43, G43.2 and G76"},
    LetterUse{'I', kLinuxCncNeedsArc},
    LetterUse{'J', kLinuxCncNeedsArc},
    LetterUse{'K', kLinuxCncNeedsArc},
    LetterUse{'L', "L belongs to canned cycles, G5.2, G10 and M98"},
    LetterUse{'P', "P belongs to G4, G2, G3, G5, G5.2, G10, G64, M98 and M100 to M199"},
    LetterUse{'Q', "Q belongs to G5, G64, G10, M61 and M100 to M199"},
    LetterUse{'R', "R belongs to G2, G3 and G10"},
    LetterUse{'X', kLinuxCncNeedsMotion},
    LetterUse{'Y', kLinuxCncNeedsMotion},
    LetterUse{'Z', kLinuxCncNeedsMotion},
};
constexpr std::array kLinuxCncDwell{DwellWord{'P', DwellUnit::seconds}};
constexpr std::array<std::string_view, 2> kLinuxCncFiles{"{}.ngc", "{}.nc"};

// Two thousandths of the diagonal of a square of 1: 0.01 mm or 0.001 in; a hundred times as much
// while it is below 0.1 % of the radius. What R may lack, and the least radius, is 0.00005 in.
constexpr ArcTolerance arc_tolerance(double least_step) {
  constexpr double kReach = 0.00005 * kMmPerInch;
  const double absolute = 2.0 * least_step * std::numbers::sqrt2;
  return {absolute, 0.001, 100.0 * absolute, kReach, kReach};
}

constexpr DialectRules kLinuxCncRules{
    .dialect = Dialect::linuxcnc,
    .codes = {kLinuxCncCodes, kUserCodes, kMachineCodes, kIsoCodes, kRs274Codes},
    .refused_codes = kLinuxCncRefusedCodes,
    .vector_letters = "abc",
    .dwell = kLinuxCncDwell,
    .dwell_hint = "give P in seconds",
    .home_without_axes_is_all = true,
    .tool_change_keeps_place = true,
    .feed_precedes_unit = true,
    .arcs = arc_tolerance(0.01),
    .arcs_in_inches = arc_tolerance(0.001 * kMmPerInch),
    .always_claimed = LetterSet("FST"),
    .letters = kLinuxCncLetters,
    .known_letters = "A B C F G H I J K L M N O P Q R S T X Y Z",
    .parameters = {.locals = 30,
                   .named_locals = true,
                   .unset_is_zero = true,
                   .values_may_be_unknown = true,
                   .last = 5601},
    .cycles = {.retract_to_initial = false,
               .words_end_with_their_g_word = true,
               .feed_out_to_clearance = true,
               .start_from_initial = true,
               .rises_before_it_goes = true},
    .radius = {.entry = EntryRule::beside_its_end,
               .entry_may_be_arc = true,
               .entry_comes_first = true,
               .straight_below = 0.05,
               .source = RadiusSource::d_or_tool_in_spindle,
               .in_yz = false,
               .may_be_repeated = false,
               .ends_with_program = true,
               .any_move_leaves = true},
    .polar_words = LetterSet("pq"),
    .data_words = kLinuxCncDataWords,
    .runs_into_programs = true,
    .faults_count_when_run = true,
    .file_names = kLinuxCncFiles,
};

}  // namespace

const DialectRules& linuxcnc_rules() { return kLinuxCncRules; }

}  // namespace frustum::parser

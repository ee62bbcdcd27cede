// A dialect as data: its words, and the few rules by which it differs beyond them.
//
// Units: none.
// Errors: none.
#pragma once

#include <array>
#include <optional>
#include <span>
#include <string_view>

#include "parser/arc.hpp"
#include "parser/dialect.hpp"
#include "parser/dialects/code.hpp"
#include "parser/dialects/radius_rules.hpp"
#include "parser/language/modes.hpp"
#include "parser/language/parameters.hpp"

namespace frustum::parser {

enum class DwellUnit : std::uint8_t {
  seconds,
  milliseconds_without_point,  // seconds when written with a decimal point
  revolutions
};
struct DwellWord {
  char letter;
  DwellUnit unit;
};

// What a letter belongs to, for the hint when nothing in the block uses it.
struct LetterUse {
  char letter;
  std::string_view use;
};

// How canned cycles differ.
struct CycleRules {
  bool retract_to_initial = true;            // before the first G98 or G99
  bool words_end_with_their_g_word = false;  // G83 after G81 needs its own R and Z
  bool feed_out_to_clearance = false;        // taps and G89 leave by feed all the way
  // Q shifts the tool of G76 and G87 along the plane's first axis; G87 then bores up from R to Z.
  bool tool_shift_by_q = false;
  // R and the depth are steps or places by the mode of the block that gives them, whatever the mode
  // at a later hole.
  bool words_keep_their_mode = false;
  bool cancel_brings_motion_back = false;  // after G80 the G0 to G3 before the cycle is in force
  // Each block begins at the depth before the first hole: with G98 the move to the next hole goes
  // up there.
  bool start_from_initial = false;
  // Below R the tool rises before it goes to the first hole, not above it.
  bool rises_before_it_goes = false;
  // When the operator has drawn the tool out of the hole of G88, it is at R.
  bool hand_retract_ends_at_r = false;
};

// How polar positions are written.
struct PolarRules {
  bool about_pole = false;      // else about the origin, in G17
  bool origin_is_pole = false;  // while none is given
  // Left out, radius and angle stay as they were written last; where the tool is elsewhere that is
  // an error.
  bool words_stay = false;
  std::string_view radius{};
  std::string_view angle{};
  std::string_view pole{};  // the word that gives one
};

// What G10 sets, by its L word.
enum class DataInput : std::uint8_t {
  tool_table,       // L0: it is read again
  tool,             // the offsets, radius R, angles I J and orientation Q of tool P
  tool_here,        // so that the tool is where the words say
  tool_at_fixture,  // the same, in the last work offset (G59.3)
  work_offset,      // the origin of offset P, turned by R
  offset_here,      // so that the axes are where the words say
  extended_offset,  // G54.1 P
  length,           // R of offset number P
  length_wear,
  radius,
  radius_wear
};
struct DataWord {
  int number;  // L
  DataInput input;
  LetterSet words;  // beside L and P
};

struct DialectRules {
  Dialect dialect = Dialect::fanuc;
  // Its own codes and those it shares (shared_codes.hpp).
  std::array<std::span<const Code>, 5> codes{};
  // What a word is in a block that has I and L.
  std::span<const Code> codes_beside_l{};
  std::span<const RefusedCode> refused_codes{};
  std::span<const RefusedWord> refused_words{};
  // What only a lathe has: the program is none of a mill.
  std::span<const std::string_view> turning_words{};
  // The three letters of the tool vector, and how the dialect spells them.
  std::string_view vector_letters{};
  std::string_view vector_spelling{};
  std::string_view vector_hint{};  // how the tool-tip control is switched on
  std::span<const DwellWord> dwell{};
  std::string_view dwell_hint{};
  // A tool change brings the length of its tool: TOOL CALL, T D M6, LOADTL.
  bool tool_brings_length = false;
  // Machine coordinates still carry the tool length and the tool-tip control.
  bool machine_coordinates_keep_length = false;
  bool home_without_axes_is_all = false;
  // After a tool change the axes are where they were before it (RS274/NGC, NIST 6556, 3.6.3); else
  // Z is where the machine's builder has it.
  bool tool_change_keeps_place = false;
  // M6 may come before any T: the tool that the operator has prepared.
  bool first_tool_may_be_prepared = false;
  // Before G20 or G21 the unit is what the control was left in: mm is taken, unless it is known.
  bool unit_may_be_missing = false;
  // F beside G20 or G21 counts in the unit before the block.
  bool feed_precedes_unit = false;
  // Inches a minute that F1 of an inch program is.
  double inch_feed = 1.0;
  // The feed of a tool call is in force from there on; F AUTO takes it up again.
  bool tool_brings_feed = false;
  // A tool has a name beside its number: "5" is not tool 5.
  bool tools_are_named_beside_numbers = false;
  // M words, by ten times their numbers, that count when the move of their block is done.
  std::span<const int> words_behind_move{};
  ArcTolerance arcs{};
  std::optional<ArcTolerance> arcs_in_inches{};  // where the unit of the program matters
  // Arcs without centre words or radius turn about the last pole (CC).
  bool arcs_turn_about_pole = false;
  // While a hole cycle is on, each move names the top of a hole.
  bool holes_at_moves = false;
  // Words of their own round or break the corner between two moves.
  bool inserts_corners = false;
  // The motion in force before the program gives one.
  MotionMode first_motion = MotionMode::none;
  LetterSet always_claimed{};  // words that have a meaning in every block
  // Words that a block of G0 to G3 may have without a meaning where they are zero.
  LetterSet idle_at_zero{};
  // M words that are in no table are of the machine's builder.
  bool unknown_m_words_are_builders = false;
  // M7 and M8 may be in one block.
  bool mist_beside_flood = false;
  // Of several words of the motion group in a block the last one counts.
  bool last_motion_counts = false;
  // Before the first motion word G0 is in force.
  bool starts_with_rapid = false;
  // A step of an axis that nothing has placed counts from zero, as an assumption.
  bool steps_may_begin = false;
  // H and D are words of their own: the number of the length in force, and of the next radius.
  bool offset_numbers_stand_alone = false;
  // The words count from where the program was before the length changed: it adds to the moves.
  bool length_adds_to_moves = false;
  // G52 is a shift of its own, within that of G92.
  bool local_shift_is_apart = false;
  // An arc with neither centre nor radius is a straight move; beside a radius the centre words do
  // not count.
  bool arcs_may_lack_centre = false;
  // F of an arc is the speed in its plane, and in G93 that over the radius (arc_feed.hpp).
  bool arc_feed_is_in_plane = false;
  // Whether I J K are steps or the centre itself, the first arc shows.
  bool first_arc_shows_centre = false;
  // A cutting move before the first F goes on, with a feed that is not known (0).
  bool feed_may_be_missing = false;
  // Words of a move that round or break the corner at its end; cycles have parameters under their
  // letters.
  LetterSet corner_words{};
  std::span<const LetterUse> letters{};
  std::string_view known_letters{};
  ParameterRules parameters{};
  CycleRules cycles{};
  RadiusRules radius{};
  LetterSet polar_words{};
  PolarRules polar{};
  // A thread has its lead in the centre word of the axis that it runs along.
  bool leads_by_axis = false;
  // Arcs may lead on from the move before.
  bool arcs_lead_on = false;
  std::span<const DataWord> data_words{};
  // The word of the way per revolution of a thread (G33).
  char thread_lead = 'K';
  // A parameter that is written counts at once, not from the next change of work offset on.
  bool parameters_count_at_once = false;
  // The word of the work offset in force brings what has been written to it.
  bool offset_loads_again = false;
  // G10 in G91 adds to what is there.
  bool data_follow_distance_mode = false;
  // A new tilted plane begins without programmable frame.
  bool planes_end_frames = false;
  // The number of a program, O100, that is met on the way is its title: what follows is run on.
  bool runs_into_programs = false;
  // Statements that do not belong together are wrong where the program runs into them, not before.
  bool faults_count_when_run = false;
  // Subprograms are programs with a head of their own, or files without; every end of a program
  // returns from one.
  bool subprograms_are_programs = false;
  // A program that is called has a file of its own, which the word of its end (END PGM) returns
  // from. Labels and the unit belong to their file, and M2 and M30 have no place in one that is
  // called.
  bool calls_whole_files = false;
  // How a subprogram's name becomes the name of a file beside the program: "{}.ngc".
  std::span<const std::string_view> file_names{};
};

// One file each: fanuc.cpp, linuxcnc.cpp, ...
[[nodiscard]] const DialectRules& fanuc_rules();
[[nodiscard]] const DialectRules& linuxcnc_rules();
[[nodiscard]] const DialectRules& sinumerik_rules();
[[nodiscard]] const DialectRules& heidenhain_rules();
[[nodiscard]] const DialectRules& cldata_rules();

[[nodiscard]] const DialectRules& rules_of(Dialect dialect);
// Empty for unknown letters.
[[nodiscard]] std::string_view letter_use(const DialectRules& rules, char letter);

}  // namespace frustum::parser

#include "lint/check_help.hpp"

#include <array>

namespace frustum::lint {
namespace {

using enum Check;

struct Row {
  Check check;
  CheckHelp help;
};

// In the order of the checks.
constexpr std::array kHelp{
    Row{program_error,
        {"The control stops with an alarm at a block that it cannot read or run: a word that it "
         "does not know, a bracket that is not closed, a value that the word does not take.",
         "Mend the block as the hint of the finding says."}},
    Row{missing_subprogram,
        {"A call (M98, G65, o-word, CALL) names a subprogram that is neither in the program nor "
         "in a file beside it or in the folders that are searched.",
         "Define the subprogram, or name its folder by --search."}},
    Row{missing_label,
        {"A jump or repeat names a block number or label that the program does not have; the "
         "control stops there.",
         "Give the block that is meant the number or label."}},
    Row{recursion,
        {"Subprograms call each other until the control has no further level.",
         "Leave out the call, or end it by a condition."}},
    Row{endless_loop,
        {"A loop or jump comes so often that it is taken for one without end, or repeats have "
         "run so many blocks again that the checks end; what is behind them is not checked.",
         "Correct the condition of the loop; let a long program go on by --most-repeats."}},
    Row{too_many_errors,
        {"After 1000 blocks that cannot be run the rest of the program is not checked, for the "
         "text is likely to be another dialect's or no program.",
         "Mend the errors and check again, or name the dialect by --dialect."}},
    Row{unused_subprogram,
        {"A subprogram is in the program and nothing calls it: a call is missing, or goes to "
         "another number.",
         "Call it, or leave it out."}},
    Row{unused_label,
        {"No jump, repeat or call names the label: it may be misspelt where it is wanted.",
         "Name it, or leave it out."}},
    Row{unreachable_code,
        {"Blocks are after the end of the program or subprogram and nothing jumps to them: the "
         "control does not run them.",
         "Leave them out, or move the end after them."}},
    Row{duplicate_number,
        {"A jump goes to a block number that several blocks have; which one the control takes "
         "depends on where it searches first.",
         "Give the blocks numbers of their own."}},
    Row{no_program_end,
        {"The program runs off the end of its text. Controls stop with an alarm there or begin "
         "the next program.",
         "End it with M30 or M2."}},
    Row{parameter_unset,
        {"An expression reads a parameter that the program has not set: it is vacant or counts "
         "as 0, or has what another program left.",
         "Set the parameter before."}},
    Row{vacant_word,
        {"The parameter of a word is vacant, so that the control leaves the word out and the "
         "axis stays where it is.",
         "Set the parameter before, if the word is wanted."}},
    Row{not_simulated,
        {"The word is known and changes nothing that is simulated: what it does at the machine "
         "is not checked.",
         "None is needed."}},
    Row{builder_word,
        {"Only the machine's builder knows what the word does. It is passed over; if it moves an "
         "axis or changes a tool, all that follows is checked from a wrong state.",
         "Name it under [controller] words of the machine, if it moves nothing."}},
    Row{assumed,
        {"Parameters of the control or its options decide what the block does. The finding says "
         "what was taken.",
         "Write the block so that all controls read it alike, or look the parameter up."}},
    Row{decimal_point,
        {"A length or angle has no decimal point. Controls read such a number as it is written "
         "or in increments of 0.001 mm: a factor of a thousand.",
         "Write the point, or say how the control counts by --decimal-point or [controller] "
         "decimal_point."}},
    Row{feed_missing,
        {"A cutting move comes before any feed is given, with a feed of zero, or in inverse time "
         "without an F of its own. The control stops, or takes the feed of the program before.",
         "Give F on the block or before, above zero."}},
    Row{feed_high,
        {"The feed is above 40000 mm/min, or above 5 mm per revolution: as a rule it is written "
         "in another unit or mode than the one in force.",
         "Look for G20 and G21, or for a G95 that was left on."}},
    Row{feed_low,
        {"The feed is below 3 mm/min: as a rule it is in inches a minute and read in "
         "millimetres.",
         "Give G20, or F times 25.4."}},
    Row{inverse_time_speed,
        {"In inverse time (G93) F is the number of times a minute that the block is run. A feed "
         "in mm/min that is left in G93 moves the axes as fast as they can.",
         "Give G94 before, or F for the time of the block."}},
    Row{spindle_off,
        {"A tool that does not turn is driven into the part: after M5, a tool change, or M3 "
         "without S.",
         "Give S and M3 or M4 before the cut."}},
    Row{spindle_hand,
        {"The job's tool cuts with the backs of its edges: M4 with a right-hand cutter, or M3 with "
         "a left-hand one.",
         "Turn the spindle the other way, or state the hand of the tool."}},
    Row{tool_missing,
        {"The program cuts with what happens to be in the spindle.",
         "Call the tool at the beginning of the program."}},
    Row{length_missing,
        {"The tool is in the spindle and its length is not compensated: the spindle nose is at "
         "the programmed point, and the tool is deeper by its length.",
         "Give G43 H and the tool's number after the tool change; D or TOOL CALL with other "
         "controls."}},
    Row{length_of_other_tool,
        {"The length that is put in force belongs to another tool than the one in the spindle: "
         "the tip is off by the difference of both.",
         "Give the number of the tool in the spindle, or name the tool table that has the length "
         "on purpose."}},
    Row{arc_radii,
        {"The centre is not equally far from the start and the end of an arc. Controls stop "
         "beyond a limit of their own, and below it end the arc with a jog.",
         "Correct the centre or the end; give one digit more in the post-processor."}},
    Row{arc_full_by_radius,
        {"An arc that is given by its radius ends at its start: there are any number of such "
         "circles, and controls make none or stop.",
         "Give the centre by I J K."}},
    Row{arc_nearly_full,
        {"The end of an arc is a little before its start, so that it goes round nearly a full "
         "turn where a short arc or a line was meant.",
         "Give G2 for G3 or a line, or suppress arcs that short in the post-processor."}},
    Row{arc_tiny,
        {"The radius is below 0.01 mm: such arcs come from rounding and make the control slow or "
         "stop.",
         "Give a line in its place."}},
    Row{arc_huge,
        {"The radius is above 10 m: the arc is a line to all purposes, and rounding of its "
         "centre moves it.",
         "Give a line in its place."}},
    Row{radius_gouge,
        {"The tool, with the radius by which it is compensated, is larger than a corner or arc "
         "of the contour: it cuts away what is to stay, or the control stops.",
         "Take a smaller tool, or correct the contour."}},
    Row{radius_compensation,
        {"Radius compensation begins or ends where a control cannot: without a diameter, at an "
         "arc, in a move that is too short, or it is still on at the end.",
         "As the hint of the finding says; diameters are given by --tool-diameter, --tools or "
         "--job."}},
    Row{short_segments,
        {"Cutting moves are shorter than 0.005 mm: the control cannot read ahead far enough, "
         "slows down and marks the surface.",
         "Filter points in the CAM system, or give a larger tolerance."}},
    Row{tip_control_off,
        {"Rotary and linear axes cut together and the control does not follow the tool tip: it "
         "leaves the programmed line by the lever between tip and rotary axis.",
         "Switch the tip control on (G43.4, M428, TRAORI, M128), or let the post-processor write "
         "axis positions in inverse time."}},
    Row{rotary_with_length,
        {"A rotary axis turns under a tool length with the tip control off: the tip is elsewhere "
         "after it.",
         "Switch the tip control on, or change the offset after the turn."}},
    Row{end_tip_control,
        {"The tip control is on when the program ends: the next program, or the operator, moves "
         "with it.",
         "Switch it off before the end: G49, M429, TRAFOOF, M129."}},
    Row{end_incremental,
        {"G91 is in force when the program ends; on many controls it is for the next program, "
         "which then goes from where the axes are.",
         "Give G90 before the end."}},
    Row{end_inverse_time,
        {"G93 is in force when the program ends; on many controls the next program's feeds count "
         "as inverse times.",
         "Give G94 before the end."}},
    Row{end_tilted_plane,
        {"The coordinates are tilted when the program ends: the next program or a move by hand "
         "goes another way than it says.",
         "Cancel it before the end: G69, CYCLE800(), PLANE RESET."}},
    Row{end_shifted_frame,
        {"A shift, turn or scale of the coordinates is in force when the program ends; on many "
         "controls it stays for the next program.",
         "Cancel it before the end: G52 X0 Y0 Z0, G69, G92.1, TRANS."}},
    Row{end_spindle,
        {"The spindle turns when the program ends; not every control stops it at M30.",
         "Give M5 before the end."}},
    Row{end_coolant,
        {"The coolant runs when the program ends; not every control stops it at M30.",
         "Give M9 before the end."}},
    Row{end_no_retract,
        {"The last move of the program is a cut: the tool is left in the part, and the next move "
         "of whoever comes begins there.",
         "Lift the tool off by a rapid or home move before the end."}},
    Row{setup_assumed,
        {"A tool length or work offset that the program uses is not given and taken as zero, so "
         "that travels are checked at the wrong place.",
         "Give --tool-length, --offset or --job."}},
    Row{unknown_axis,
        {"The program moves an axis that the machine does not have: it is written for another "
         "one.",
         "Post-process the program for this machine."}},
    Row{unreachable_orientation,
        {"No positions of the rotary axes bring the tool into the direction that the program "
         "gives.",
         "Take another clamping or another machine."}},
    Row{machine_refuses,
        {"The controller of the machine cannot make the move.",
         "As the hint of the finding says."}},
    Row{over_travel,
        {"X, Y or Z is beyond its travel at the end of a move or on its way; the control stops "
         "there, with the tool in the part.",
         "Move the part on the table, take another tool or a larger machine."}},
    Row{rotary_over_travel,
        {"A rotary axis is beyond its travel at the end of a move or on its way.",
         "Take the other solution of the rotary axes, or another clamping."}},
    Row{axis_too_slow,
        {"To keep the programmed feed an axis would have to go faster than it can; the machine "
         "slows down, and the cut is not as planned.",
         "Lower F, or keep away from the pole."}},
    Row{rapid_in_material,
        {"A rapid move goes through the stock that is still there at that time.",
         "Retract before the move, or cut there by feed."}},
    Row{body_in_material,
        {"The shank or the holder of a tool is in the stock during a cut.",
         "Take a longer tool or a slimmer holder, or another way to the place."}},
    Row{machine_collision,
        {"Two bodies that the machine file or the job states, or one of them and the tool or the "
         "blank, meet while the axes move.",
         "Take another way to the place, another clamping, or a longer tool."}},
    Row{unknown_suppression,
        {"A comment that is to suppress findings names no check, so that it suppresses nothing.",
         "Write an id as frustum check --list has it."}},
    Row{unused_suppression,
        {"A comment suppresses findings that are no longer there; it would hide one that comes "
         "back.",
         "Leave the comment out."}},
};

constexpr bool help_in_order() {
  for (std::size_t i = 0; i < kHelp.size(); ++i) {
    if (kHelp[i].check != static_cast<Check>(i)) return false;
  }
  return true;
}
static_assert(help_in_order());

}  // namespace

CheckHelp help_of(Check check) { return kHelp.at(static_cast<std::size_t>(check)).help; }

}  // namespace frustum::lint

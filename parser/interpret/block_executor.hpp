// Carries out one block after another: the modal state, the position, the parameters, and the
// motions that follow from them.
//
// Order within a block, RS-274's: comments; parameters; units (LinuxCNC: behind F); feed mode; F; S; T; M6; M3 M4 M5; M7
// M8 M9; words that are only events; G4; plane; compensation; work offset; distance mode; G28 or
// the motion; M words that count behind it; stops and calls.
// Units: writes mm, rad, mm/min; reads what the block's G20 or G21 says. G20 scales X Y Z, arc
// centres, R and F; never rotary words, tool vectors, or the F of a purely rotary move.
// Errors: with line, column and hint; the file is left to the caller. Nothing of the block that
// failed is to be relied on.
#pragma once

#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "core/result.hpp"
#include "parser/arc.hpp"
#include "parser/dialects/dialect_rules.hpp"
#include "parser/interpret/cycles/canned_cycle.hpp"
#include "parser/interpret/cycles/threading_cycle.hpp"
#include "parser/interpret/filters/corner_insertion.hpp"
#include "parser/interpret/filters/radius_compensation.hpp"
#include "parser/interpret/moves/spline.hpp"
#include "parser/interpret/state/block_words.hpp"
#include "parser/interpret/state/control_data.hpp"
#include "parser/interpret/state/modal_state.hpp"
#include "parser/interpret/state/program_position.hpp"
#include "parser/interpret/state/system_parameters.hpp"
#include "parser/language/block.hpp"
#include "parser/language/parameters.hpp"
#include "parser/motion.hpp"

namespace frustum::parser {

// The largest program number of a call, and how often one call repeats.
constexpr int kMaxProgramNumber = 99'999'999;
constexpr int kMaxRepeats = 99'999;

using MotionSink = std::function<void(Motion&&)>;

// Where the program goes after a block.
struct NextBlock {
  bool moved = false;
};
struct EndProgram {};
struct LeaveSubprogram {
  std::uint32_t column = 0;
  std::optional<std::uint32_t> block_number{};  // where the caller goes on
  bool of_file = false;                         // the end of a whole program (END PGM)
};
// A whole program, in a file of its own.
struct CallFile {
  std::string name{};
  std::uint32_t column = 0;
};
struct CallSubprogram {
  std::uint32_t program = 0;
  bool counted = false;  // L was given
  std::uint32_t count = 1;
  std::uint32_t column = 0;
  std::optional<std::vector<double>>
      arguments{};     // of a macro: #1, #2, ...; vacant where not given
  bool modal = false;  // G66: not now, but after each block that moves
};
struct EndModalCall {};  // G67
using Flow =
    std::variant<NextBlock, EndProgram, LeaveSubprogram, CallSubprogram, CallFile, EndModalCall>;

class BlockExecutor {
 public:
  struct Done {};
  BlockExecutor(const BlockExecutor&) = delete;  // its parameters look at its state
  BlockExecutor& operator=(const BlockExecutor&) = delete;
  BlockExecutor(Dialect dialect, const AxisTarget& start, ControlData data, const MotionSink& sink);

  [[nodiscard]] Result<Flow> execute(const Block& block);
  void report_comments(const Block& block);
  // The value of one of the block's expressions.
  [[nodiscard]] Result<double> value_of(const Block& block, ExpressionRange range);
  [[nodiscard]] const ModalState& state() const { return state_; }
  [[nodiscard]] Parameters& parameters() { return parameters_; }
  // Whether the last block has moved an axis.
  [[nodiscard]] bool moved() const { return moved_; }
  // How many motions have gone out.
  [[nodiscard]] std::uint64_t motions() const { return motions_; }
  // #1 to #33 of the macro at work.
  [[nodiscard]] std::vector<double> local_values() const;
  using Outcome = Result<Done>;
  // The program ends without a word that says so.
  [[nodiscard]] Outcome end_of_text();
  // A call of a subprogram and its end; modes saved by M73 come back.
  void enter_call();
  void leave_call();
  // The program that a call of the cycle runs from now on (CYCL DEF 12).
  void set_called_program(std::string name);
  // The file that the blocks from now on are of, as SourcePlace::file has it.
  void read_from(std::shared_ptr<const std::string> file) { file_ = std::move(file); }
  // The run ends here: no motion waits for the block behind it any more.
  void settle() { corners_.release(to_radius_); }
  // After a block that could not be carried out: the axes that it names are where it says, as far as that is
  // plain, and not known otherwise.
  void pass_over(const Block& block);
  // The modes of G words and the frame come back at the end of the call at work (SAVE).
  void keep_modes_for_call() {
    saved_modes_.back() = {state_, true, true, saved_modes_.back().unit};
  }

 private:
  // What of the block moves axes, and how.
  struct Movement {
    NonModal non_modal = NonModal::none;
    MotionMode motion = MotionMode::none;  // none: no move, the words only set modes
    std::uint32_t column = 0;              // of the word the motion is reported at
  };

  // Looking: what the block asks for, given the modes.
  [[nodiscard]] MotionMode motion_of(const BlockWords& words) const;
  [[nodiscard]] Result<Movement> movement_of(const BlockWords& words) const;
  [[nodiscard]] bool guides_tip(const BlockWords& words) const;
  [[nodiscard]] Result<Compensation> compensation_after(const BlockWords& words) const;
  [[nodiscard]] LetterSet motion_words(const BlockWords& words, const Movement& movement) const;
  [[nodiscard]] Outcome check_claims(const BlockWords& words, const Movement& movement) const;
  [[nodiscard]] Result<int> whole(const BlockWords& words, char letter, int least, int most) const;

  [[nodiscard]] Outcome check_radius_compensation(const BlockWords& words,
                                                  const Movement& movement) const;

  // Doing.
  [[nodiscard]] Result<Flow> carry_out(const Block& block);
  [[nodiscard]] Result<double> radius_for(const BlockWords& words);
  [[nodiscard]] Outcome set_radius_compensation(const BlockWords& words);
  void switch_radius_off(std::uint32_t column);
  [[nodiscard]] Outcome end_radius_compensation(const SourcePlace& place);
  [[nodiscard]] AxisTarget leaving_contour(const BlockWords& words, AxisTarget end);
  [[nodiscard]] Outcome set_parameters(const Block& block);
  [[nodiscard]] Outcome set_numbered(std::uint32_t column, int index, double value);
  void report_events(const BlockWords& words);
  void restore_modes(std::uint32_t column);
  [[nodiscard]] Outcome keep_modes(const BlockWords& words);
  [[nodiscard]] Outcome set_feed(const BlockWords& words);
  [[nodiscard]] double feed_scale(FeedMode mode) const;
  [[nodiscard]] Result<std::optional<BlockWords>> words_behind_move(BlockWords& words,
                                                                    const Movement& movement) const;
  [[nodiscard]] Outcome set_behind_move(const BlockWords& words);
  [[nodiscard]] Outcome set_tool(const BlockWords& words);
  [[nodiscard]] Outcome check_tool_exists(int tool, std::uint32_t column) const;
  void set_spindle_and_coolant(const BlockWords& words, bool speed);
  [[nodiscard]] Outcome dwell(const BlockWords& words);
  [[nodiscard]] Outcome set_frames(const BlockWords& words);
  [[nodiscard]] Outcome set_compensation(const BlockWords& words);
  [[nodiscard]] Outcome change_compensation(const BlockWords& words, const Compensation& next);
  [[nodiscard]] Outcome set_work_offset(const BlockWords& words);
  [[nodiscard]] Outcome set_tilted_plane(const BlockWords& words);
  [[nodiscard]] Outcome set_plane(const BlockWords& words);
  [[nodiscard]] Outcome turn_to_plane(const BlockWords& words);
  [[nodiscard]] Outcome set_feature(const BlockWords& words);
  [[nodiscard]] Outcome check_feature(const Movement& movement) const;
  [[nodiscard]] Outcome turn_in_space(const BlockWords& words);
  [[nodiscard]] Outcome tilt(const GivenCode& code, const Pose& plane, bool within);
  [[nodiscard]] Outcome set_scaling(const BlockWords& words);
  [[nodiscard]] Outcome set_mirror(const BlockWords& words);
  void set_polar_mode(const BlockWords& words);
  void set_paths(const BlockWords& words);
  [[nodiscard]] Outcome align(std::uint32_t column);
  [[nodiscard]] Outcome set_pole(const BlockWords& words);
  [[nodiscard]] Outcome set_start(const BlockWords& words);
  void change_programmed_frame(const ProgrammedFrame& next);
  [[nodiscard]] Outcome shift_words(const BlockWords& words, NonModal how);
  [[nodiscard]] Outcome turn_words(const BlockWords& words);
  [[nodiscard]] Outcome change_program_frame(const BlockWords& words);
  [[nodiscard]] Result<ProgramFrame> frame_of(const BlockWords& words, FrameWord word) const;
  [[nodiscard]] Result<ProgramFrame> scaling_of(const BlockWords& words) const;
  void set_program_frame(const ProgramFrame& next);
  [[nodiscard]] Result<Pose> plane_below(const BlockWords& words) const;
  [[nodiscard]] Outcome check_programmed_frame(const Movement& movement) const;

  // What lies between words and axes, and positions that follow it (block_datum.cpp).
  using ToolOffset = std::array<double, kAxisLetters.size()>;
  void place_datum(const WorkOffset& datum);
  [[nodiscard]] Result<WorkOffset> datum_of(int number, std::uint32_t column) const;
  [[nodiscard]] Outcome select_work_offset(int number, std::uint32_t column);
  [[nodiscard]] Outcome replace_datum(std::uint32_t column);
  [[nodiscard]] Outcome tell_origin(int number, std::uint32_t column);
  [[nodiscard]] AxisTarget axis_positions() const;
  [[nodiscard]] std::string why_axis_unknown(AxisLetter axis) const;
  [[nodiscard]] DiagnosticId axis_unknown_id(AxisLetter axis) const;
  void follow_datum(const ModalState& before, const AxisTarget& axes, PositionLoss loss);
  void arrive(const AxisTarget& axes);
  [[nodiscard]] Result<std::optional<ToolOffset>> tool_offset_of(const BlockWords& words,
                                                                 const Compensation& next) const;
  [[nodiscard]] Result<ToolOffset> given_tool_offset(const BlockWords& words) const;

  // G10 (block_data.cpp).
  [[nodiscard]] Outcome set_data(const BlockWords& words);
  [[nodiscard]] Outcome set_work_offset_data(const BlockWords& words, const DataWord& data);
  [[nodiscard]] Outcome set_offset_here(const BlockWords& words);
  [[nodiscard]] Outcome set_tool_data(const BlockWords& words, const DataWord& data);
  [[nodiscard]] Outcome set_offset_memory(const BlockWords& words, const DataWord& data);
  [[nodiscard]] Outcome set_tool_offsets(const BlockWords& words, DataInput input, Tool& tool);

  // Reference points and machine coordinates (block_points.cpp).
  [[nodiscard]] Outcome keep_point(std::size_t point, std::uint32_t column);
  [[nodiscard]] Outcome go_home(const BlockWords& words, std::size_t point);
  [[nodiscard]] Outcome check_home(const BlockWords& words);
  [[nodiscard]] Outcome come_from_home(const BlockWords& words);
  void go_to_axis_positions(const AxisTarget& point, LetterSet named, std::uint32_t column);
  void return_to_point(std::size_t point, LetterSet axes, std::uint32_t column);
  [[nodiscard]] Outcome move(const BlockWords& words, const Movement& movement);
  [[nodiscard]] Outcome move_in_machine_coordinates(const BlockWords& words,
                                                    const Movement& movement);
  [[nodiscard]] Outcome move_straight(const BlockWords& words, const Movement& movement);
  [[nodiscard]] Outcome move_along_arc(const BlockWords& words, const Movement& movement);
  [[nodiscard]] Result<double> lead_of(const BlockWords& words, const Movement& movement,
                                       char letter) const;
  [[nodiscard]] char lead_letter(const BlockWords& words) const;
  [[nodiscard]] Result<double> lead_along_way(const BlockWords& words, double lead,
                                              const AxisTarget& before) const;
  [[nodiscard]] Outcome move_along_thread(const BlockWords& words, const Movement& movement);
  [[nodiscard]] Outcome tap_rigidly(const BlockWords& words, const Movement& movement);
  [[nodiscard]] Result<ThreadingCycle> threading_cycle(const BlockWords& words,
                                                       const Movement& movement) const;
  [[nodiscard]] Outcome cut_thread(const BlockWords& words, const Movement& movement);
  [[nodiscard]] Outcome probe(const BlockWords& words, const Movement& movement);
  [[nodiscard]] Outcome check_spline(const BlockWords& words, const Movement& movement) const;
  [[nodiscard]] Outcome move_along_spline(const BlockWords& words, const Movement& movement);
  [[nodiscard]] Outcome move_along_cubic(const BlockWords& words, const Movement& movement);
  [[nodiscard]] Outcome move_along_quadratic(const BlockWords& words, const Movement& movement);
  [[nodiscard]] Outcome add_nurbs_point(const BlockWords& words, const Movement& movement);
  [[nodiscard]] Outcome move_along_nurbs(const BlockWords& words, const Movement& movement);
  [[nodiscard]] Outcome trace_spline(const BlockWords& words, const Movement& movement,
                                     std::span<const ControlPoint> points, int order);
  [[nodiscard]] Outcome check_open_nurbs(const Movement& movement) const;
  [[nodiscard]] std::optional<Diagnostic> spline_without_end() const;
  [[nodiscard]] Vec2 place_in_plane() const;
  [[nodiscard]] Outcome set_cycle(const BlockWords& words, const Movement& movement,
                                  AxisLetter depth_axis);
  [[nodiscard]] Outcome run_cycle(const BlockWords& words, const Movement& movement);
  // Where the tool is at a depth of the hole, on its axis or shifted.
  using PlaceInHole = std::function<Vec3(double depth, bool shifted)>;
  void drill(const std::vector<CycleStep>& steps, std::uint32_t column, const PlaceInHole& place,
             const Feed& feed, const Feed& feed_out);
  [[nodiscard]] Outcome set_hole_cycle(const BlockWords& words);
  [[nodiscard]] Outcome set_deep_hole(const BlockWords& words, HoleWord word);
  [[nodiscard]] Outcome make_hole(const BlockWords& words, const Movement& movement);
  [[nodiscard]] Outcome call_hole_cycle(const BlockWords& words);
  [[nodiscard]] Result<double> drilling_dwell(const BlockWords& words, char letter,
                                              bool turns) const;
  [[nodiscard]] Result<int> drilling_modes(const BlockWords& words) const;
  [[nodiscard]] Result<DrillingCycle> drilling_heights(const BlockWords& words) const;
  [[nodiscard]] Outcome set_pecks(const BlockWords& words, DrillingCycle& cycle) const;
  [[nodiscard]] Outcome set_tap(const BlockWords& words, DrillingCycle& cycle) const;
  [[nodiscard]] Result<std::optional<SpindleDirection>> drilling_direction(
      const BlockWords& words) const;
  [[nodiscard]] Result<DrillingCycle> drilling_cycle_of(const BlockWords& words) const;
  [[nodiscard]] Outcome call_drilling_cycle(const BlockWords& words);
  [[nodiscard]] Outcome drill_here(const DrillingCycle& cycle, std::uint32_t column);
  void drill_from_top(const Vec3& top, const std::optional<Vec3>& from, bool turns,
                      std::uint32_t column);
  [[nodiscard]] Result<CallSubprogram> called_program(const BlockWords& words) const;
  [[nodiscard]] const Word* macro_word(const Block& block) const;
  [[nodiscard]] Result<Flow> call_macro(const Block& block, const Word& code);
  [[nodiscard]] Result<bool> set_system_variable(std::uint32_t column, int index, double value);
  [[nodiscard]] Result<Flow> finish(const BlockWords& words);

  [[nodiscard]] double unit_scale() const;
  [[nodiscard]] Vec3 vector_of(const BlockWords& words, std::string_view letters) const;
  [[nodiscard]] double scaled(AxisLetter axis, double value) const;
  [[nodiscard]] Outcome set_target(const BlockWords& words, AxisLetter axis);
  [[nodiscard]] Outcome set_targets(const BlockWords& words);
  [[nodiscard]] Outcome set_polar_target(const BlockWords& words);
  [[nodiscard]] Outcome set_place_in_plane(const BlockWords& words);
  [[nodiscard]] Outcome check_polar_arc(const BlockWords& words) const;
  [[nodiscard]] Outcome set_pole_in_plane(const BlockWords& words, NonModal from);
  void lose_pole();
  [[nodiscard]] Result<Pole> pole_for(std::uint32_t column) const;
  [[nodiscard]] Outcome set_target_about_pole(const BlockWords& words);
  [[nodiscard]] Outcome check_place_about_pole(const BlockWords& words, const Pole& pole,
                                               double radius, double angle) const;
  [[nodiscard]] Outcome turn_about_pole(const BlockWords& words, const Movement& movement,
                                        ArcWords& arc) const;
  [[nodiscard]] Result<Vec3> point_between(const BlockWords& words, const Movement& movement,
                                           const Vec3& start, const Vec3& end) const;
  [[nodiscard]] Outcome move_through_point(const BlockWords& words, const Movement& movement);
  [[nodiscard]] Outcome cut_into_chords(const BlockWords& words, const Movement& movement,
                                        const AxisTarget& before, const Vec3& arm,
                                        const Vec3& centre, const Vec3& turn, Feed feed);
  [[nodiscard]] Outcome check_turned_angle(const BlockWords& words, const ArcWords& arc) const;
  [[nodiscard]] Outcome lead_on(const Movement& movement, ArcWords& arc) const;
  void keep_heading(const AxisTarget& before);
  [[nodiscard]] AxisTarget end_of(const BlockWords& words) const;
  [[nodiscard]] Result<RotaryPath> rotary_path_of(const BlockWords& words, char letter) const;
  [[nodiscard]] Outcome announce_rotary_paths(const BlockWords& words, std::uint32_t column);
  [[nodiscard]] Outcome check_orientation_reference(const BlockWords& words) const;
  [[nodiscard]] Outcome check_tool_length(const Movement& movement) const;
  [[nodiscard]] Outcome set_tool_axis(const BlockWords& words);
  [[nodiscard]] Result<Feed> feed_for(const BlockWords& words, const Movement& movement,
                                      bool linear) const;
  void leave_program_coordinates(LetterSet axes, PositionLoss loss);
  void forget(LetterSet axes, PositionLoss loss);
  [[nodiscard]] Diagnostic fail(std::uint32_t column, DiagnosticId id, std::string message,
                                std::string hint) const;
  [[nodiscard]] Diagnostic fail(std::uint32_t column, const Diagnostic& found) const;
  [[nodiscard]] Diagnostic in_this_block(Diagnostic diagnostic) const;
  void emit(std::uint32_t column, Command command);
  [[nodiscard]] Outcome insert_corner(const BlockWords& words);
  void pass_to_radius(Motion&& motion);
  void send(Motion&& motion);

  const DialectRules& rules_;
  const MotionSink& sink_;
  std::uint64_t motions_ = 0;
  ControlData data_;
  std::map<int, std::array<std::optional<double>, 3>>
      programmed_offsets_{};  // as the motions have them
  ModalState state_;
  ProgramPosition position_;
  // Modes that M70 and M73 keep, of the main program and each call.
  struct SavedModes {
    std::optional<ModalState> state{};
    bool comes_back = false;
    bool of_g_words = false;                   // feed, spindle and coolant stay as they are
    LengthUnit unit = LengthUnit::millimetre;  // at the call
  };
  std::vector<SavedModes> saved_modes_{1};
  SystemParameters system_{rules_.dialect, state_, position_, data_};
  Parameters parameters_;
  const Block* block_ = nullptr;  // at work
  std::shared_ptr<const std::string> file_{};
  bool moved_ = false;  // the block has moved an axis
  CornerInsertion corners_{};
  const CornerInsertion::Sink to_radius_ = [this](Motion&& motion) {
    pass_to_radius(std::move(motion));
  };
  RadiusCompensation radius_{};
  const RadiusCompensation::Sink to_sink_ = [this](Motion&& motion) { send(std::move(motion)); };
  SourcePlace radius_place_{};  // where it was switched on
  // Behind G40, where the tool is in the plane, until a move in it.
  AxisTarget radius_exit_{};
  bool arc_waits_for_exit_ = false;
  // The control points since G5.2.
  struct Nurbs {
    SourcePlace place{};
    int order = 0;
    std::vector<ControlPoint> points{};
  };
  std::optional<Nurbs> nurbs_{};
  // From where the last G5 ended to the first control point of the next, if that follows.
  std::optional<Vec2> spline_leads_{};
  std::optional<Diagnostic> failure_{};  // of a motion that could not be made
};

}  // namespace frustum::parser

// What a block asks for and the order in which it is carried out. Feed, tool and spindle are in block_modes.cpp, the
// frames in block_frames.cpp, the moves in block_moves.cpp.
#include "parser/interpret/block_executor.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <optional>
#include <string_view>
#include <utility>
#include <vector>

namespace frustum::parser {
namespace {

constexpr LetterSet kMoveWords{"XYZABCIJKRabcpquvw"};

LetterSet centre_letters(Plane plane) {
  constexpr std::array kLetters{LetterSet("IJ"), LetterSet("IK"), LetterSet("JK")};
  return kLetters.at(static_cast<std::size_t>(plane));
}

LetterSet letters_of_spline(MotionMode mode) {
  switch (mode) {
    case MotionMode::cubic_spline:
      return kAxisWords | LetterSet("IJPQ");
    case MotionMode::quadratic_spline:
      return kAxisWords | LetterSet("IJ");
    case MotionMode::nurbs:
      return kAxisWords | LetterSet("PL");
    default:
      return {};
  }
}

}  // namespace

BlockExecutor::BlockExecutor(Dialect dialect, const AxisTarget& start, ControlData data,
                             const MotionSink& sink)
    : rules_(rules_of(dialect)),
      sink_(sink),
      data_(std::move(data)),
      position_(start),
      parameters_(rules_.parameters, &system_) {
  state_.retract_to_initial = rules_.cycles.retract_to_initial;
  place_datum(data_.work_offset(state_.work_offset));
  for (const auto& [number, offset] : data_.work_offsets) {
    for (std::size_t i = 0; i < 3; ++i) {
      programmed_offsets_[number].at(i) = offset.origin[kAxisLetters.at(i)];
    }
  }
}

Result<Flow> BlockExecutor::execute(const Block& block) {
  auto flow = carry_out(block);
  auto failure = std::exchange(failure_, std::nullopt);
  // What has been made before a mistake counts.
  if (!flow || failure) corners_.release(to_radius_);
  if (flow && failure) return *std::move(failure);
  return flow;
}

Result<Flow> BlockExecutor::carry_out(const Block& block) {
  block_ = &block;
  moved_ = false;
  if (const Word* macro = macro_word(block)) {
    report_comments(block);
    return call_macro(block, *macro);
  }
  auto words = read_words(block, parameters_, rules_.dialect);
  if (!words) return std::move(words).error();
  const auto movement = movement_of(*words);
  if (!movement) return movement.error();
  const auto behind_move = words_behind_move(*words, *movement);
  if (!behind_move) return behind_move.error();
  if (auto done = check_claims(*words, *movement); !done) return std::move(done).error();

  if (auto done = check_radius_compensation(*words, *movement); !done) {
    return std::move(done).error();
  }
  if (auto done = insert_corner(*words); !done) return std::move(done).error();
  report_comments(block);
  if (const GivenCode& raised = words->operator[](CodeGroup::raised_error);
      raised.code != nullptr) {
    return fail(raised.column, "program-alarm"_id,
                fmt::format("the program stops with {}", words->text_of('E')),
                "look at the conditions before this block");
  }
  if (auto done = set_parameters(block); !done) return std::move(done).error();
  const LengthUnit unit = words->value_or(CodeGroup::unit, state_.unit);
  if (!rules_.feed_precedes_unit) state_.unit = unit;
  const bool dwells = movement->non_modal == NonModal::dwell;
  // F and S of a dwell are its time where the dialect says so.
  const auto of_dwell = [&](char letter) {
    return dwells && std::any_of(rules_.dwell.begin(), rules_.dwell.end(),
                                 [letter](const DwellWord& word) { return word.letter == letter; });
  };
  if (!of_dwell('F')) {
    if (auto done = set_feed(*words); !done) return std::move(done).error();
  }
  state_.unit = unit;
  if (rules_.parameters_count_at_once) data_.unit = unit;
  state_.diameter = words->value_or(CodeGroup::diameter, state_.diameter ? DiameterWord::diameter
                                                                         : DiameterWord::radius) ==
                    DiameterWord::diameter;
  const bool any_speed = words->has('S') && !of_dwell('S');
  if (any_speed && (*words)['S'].value < 0.0) {
    return fail((*words)['S'].column, "value-negative"_id,
                fmt::format("{} is negative", words->text_of('S')),
                "give the direction by M3 or M4 and a speed that is not negative");
  }
  state_.surface_speed =
      words->value_or(CodeGroup::speed_mode,
                      state_.surface_speed ? SpeedWord::surface : SpeedWord::revolutions) ==
      SpeedWord::surface;
  const bool speed = any_speed && !state_.surface_speed;
  if (any_speed && state_.surface_speed) {
    emit((*words)['S'].column, Event{"surface_speed", words->text_of('S')});
  } else if (speed) {
    state_.spindle_speed = (*words)['S'].value;
  }
  if (auto done = keep_modes(*words); !done) return std::move(done).error();
  if (auto done = set_tool(*words); !done) return std::move(done).error();
  set_spindle_and_coolant(*words, speed);
  report_events(*words);
  if (dwells) {
    if (auto done = dwell(*words); !done) return std::move(done).error();
  }
  if (auto done = set_frames(*words); !done) return std::move(done).error();
  if (auto done = move(*words, *movement); !done) return std::move(done).error();
  auto drilled =
      rules_.dialect == Dialect::sinumerik ? call_drilling_cycle(*words) : call_hole_cycle(*words);
  if (!drilled) return std::move(drilled).error();
  if (*behind_move) {
    if (auto done = set_behind_move(**behind_move); !done) return std::move(done).error();
  }
  return finish(*words);
}

MotionMode BlockExecutor::motion_of(const BlockWords& words) const {
  const MotionMode behind_cancel =
      rules_.cycles.cancel_brings_motion_back ? state_.before_cycle : MotionMode::none;
  return words.value_or(CodeGroup::motion,
                        words.has(CodeGroup::cycle) ? behind_cancel : state_.motion);
}

Result<BlockExecutor::Movement> BlockExecutor::movement_of(const BlockWords& words) const {
  const auto non_modal = words.value_or(CodeGroup::non_modal, NonModal::none);
  const MotionMode mode = motion_of(words);
  const GivenCode& motion_code = words[CodeGroup::motion];
  const GivenCode& non_modal_code = words[CodeGroup::non_modal];
  const LetterSet move_words = words.given() & kMoveWords;

  if (non_modal == NonModal::home || non_modal == NonModal::second_home) {
    if (motion_code.code != nullptr && mode != MotionMode::traverse) {
      return fail(motion_code.column, "axis-words-shared"_id,
                  fmt::format("{} and {} both use the axis words", non_modal_code.code->name(),
                              motion_code.code->name()),
                  "write two blocks");
    }
    if ((words.given() & kAxisWords).empty() && !rules_.home_without_axes_is_all) {
      const std::string name = non_modal_code.code->name();
      return fail(non_modal_code.column, "axes-missing"_id, name + " names no axis",
                  fmt::format("give the axes to send home, for example G91 {} Z0", name));
    }
    return Movement{non_modal, MotionMode::none, non_modal_code.column};
  }
  if (non_modal == NonModal::skip || non_modal == NonModal::check_home ||
      non_modal == NonModal::from_home) {
    if (motion_code.code != nullptr && mode != MotionMode::traverse) {
      return fail(motion_code.column, "axis-words-shared"_id,
                  fmt::format("{} and {} both use the axis words", non_modal_code.code->name(),
                              motion_code.code->name()),
                  "write two blocks");
    }
    if ((words.given() & kAxisWords).empty()) {
      const std::string name = non_modal_code.code->name();
      return fail(non_modal_code.column, "axes-missing"_id, name + " names no axis",
                  fmt::format("give the end of the move, for example {} Z0", name));
    }
    const bool skips = non_modal == NonModal::skip;
    return Movement{non_modal, skips ? MotionMode::probe_towards_if_any : MotionMode::none,
                    non_modal_code.column};
  }
  if (non_modal != NonModal::none && non_modal != NonModal::machine_coordinates &&
      motion_code.code == nullptr) {
    return Movement{non_modal, MotionMode::none, non_modal_code.column};
  }
  if (non_modal == NonModal::machine_coordinates) {
    const std::string name = non_modal_code.code->name();
    if (mode != MotionMode::traverse && mode != MotionMode::linear) {
      return fail(non_modal_code.column, "machine-coordinates"_id,
                  name + " without a straight move",
                  "machine coordinates belong to a straight move, for example G53 G0 Z0");
    }
    if ((words.given() & kAxisWords).empty()) {
      return fail(non_modal_code.column, "axes-missing"_id, name + " names no axis",
                  "give the axes to move, for example Z0");
    }
    if (words.value_or(CodeGroup::distance, state_.distance) == DistanceMode::incremental) {
      return fail(non_modal_code.column, "machine-coordinates"_id, name + " in G91",
                  "machine coordinates need G90");
    }
    return Movement{non_modal, mode, non_modal_code.column};
  }
  for (const CodeGroup group :
       {CodeGroup::tilted_plane, CodeGroup::program_frame, CodeGroup::scaling, CodeGroup::mirror,
        CodeGroup::hole_cycle, CodeGroup::drilling_cycle, CodeGroup::corner}) {
    const Code* frame = words[group].code;
    if (frame != nullptr && !frame->arguments.empty()) {
      return Movement{non_modal, MotionMode::none, non_modal_code.column};
    }
  }
  const bool of_nurbs = mode == MotionMode::nurbs || mode == MotionMode::nurbs_end;
  if (motion_code.code != nullptr && of_nurbs) {
    return Movement{non_modal, mode, motion_code.column};
  }
  const GivenCode& length = words[CodeGroup::length_compensation];
  const bool axes_of_tool =
      length.code != nullptr && !(length.code->arguments & kAxisWords).empty();
  if (axes_of_tool && motion_code.code == nullptr) {
    return Movement{non_modal, MotionMode::none, non_modal_code.column};
  }
  // Without an end the arc about the pole goes once round.
  const bool circle =
      rules_.arcs_turn_about_pole && motion_code.code != nullptr &&
      (mode == MotionMode::arc_clockwise || mode == MotionMode::arc_counterclockwise);
  if (move_words.empty() && !circle)
    return Movement{non_modal, MotionMode::none, non_modal_code.column};
  const std::uint32_t column =
      motion_code.code != nullptr ? motion_code.column : words[words.first_of(move_words)].column;
  return Movement{non_modal, mode, column};
}

LetterSet BlockExecutor::motion_words(const BlockWords& words, const Movement& movement) const {
  switch (movement.motion) {
    default:
      // R Q P: depths and dwell; L K: how many; I J K: the shift of G87.
      return is_cycle(movement.motion) ? kAxisWords | LetterSet("RQPLIJK") : LetterSet{};
    case MotionMode::thread:
      if (rules_.leads_by_axis) return kAxisWords | LetterSet("IJK");
      return rules_.thread_lead == 'K' ? kAxisWords | LetterSet("K") : kAxisWords;
    case MotionMode::rigid_tap:
      return kLinearWords | LetterSet("K");
    case MotionMode::thread_cycle:
      return kLinearWords | LetterSet("PIJKRQHEL");
    case MotionMode::probe_towards:
    case MotionMode::probe_towards_if_any:
    case MotionMode::probe_away:
    case MotionMode::probe_away_if_any:
      return kAxisWords;
    case MotionMode::traverse:
    case MotionMode::linear: {
      const bool vectors = guides_tip(words) && movement.non_modal != NonModal::machine_coordinates;
      LetterSet letters = kAxisWords | rules_.polar_words;
      if (vectors) letters = letters | LetterSet(rules_.vector_letters);
      if (movement.motion == MotionMode::linear) letters.add('t');
      return letters;
    }
    case MotionMode::cubic_spline:
    case MotionMode::quadratic_spline:
    case MotionMode::nurbs:
    case MotionMode::nurbs_end:
      return letters_of_spline(movement.motion);
    case MotionMode::arc_through:
    case MotionMode::arc_tangential: {
      LetterSet letters = kAxisWords;
      letters = letters | (movement.motion == MotionMode::arc_through ? LetterSet("uvw")
                                                                      : rules_.polar_words);
      return guides_tip(words) ? letters | LetterSet(rules_.vector_letters) : letters;
    }
    case MotionMode::arc_clockwise:
    case MotionMode::arc_counterclockwise: {
      const LetterSet letters = kAxisWords | LetterSet("RPet") | rules_.polar_words |
                                centre_letters(words.value_or(CodeGroup::plane, state_.plane));
      // Where I J K are the tool vector, an arc has them for its centre.
      const bool vectors = guides_tip(words) && rules_.vector_letters != "IJK";
      return vectors ? letters | LetterSet(rules_.vector_letters) : letters;
    }
  }
}

BlockExecutor::Outcome BlockExecutor::check_claims(const BlockWords& words,
                                                   const Movement& movement) const {
  LetterSet claimed = rules_.always_claimed;
  LetterSet twice;
  const auto claim = [&](LetterSet letters) {
    twice = twice | (claimed & letters);
    claimed = claimed | letters;
  };
  for (std::uint64_t groups = words.groups(); groups != 0; groups &= groups - 1) {
    const Code* code = words[static_cast<CodeGroup>(std::countr_zero(groups))].code;
    if (!code->event) claim(code->arguments);
  }
  for (const GivenCode& event : words.events()) claim(event.code->arguments);
  claim(motion_words(words, movement));

  if (const char letter = words.first_of(words.given() & twice); letter != 0) {
    return fail(words[letter].column, "word-ambiguous"_id,
                fmt::format("{} could belong to two words of the block", words.text_of(letter)),
                "write two blocks");
  }
  const char letter = words.first_of(words.given().without(claimed));
  if (letter == 0) return Done{};
  const std::string_view use = letter_use(rules_, letter);
  if (use.empty()) {
    return fail(words[letter].column, "unknown-word"_id, "unknown word " + words.text_of(letter),
                fmt::format("known are the letters {}", rules_.known_letters));
  }
  return fail(words[letter].column, "word-unused"_id,
              fmt::format("{} has no meaning in this block", words.text_of(letter)),
              std::string(use));
}

Result<int> BlockExecutor::whole(const BlockWords& words, char letter, int least, int most) const {
  const GivenWord& word = words[letter];
  const double nearest = std::round(word.value);
  // RS-274 forgives 1e-4 in numbers that have to be whole.
  if (std::abs(word.value - nearest) > 1e-4) {
    return fail(word.column, "not-whole"_id,
                fmt::format("{} is not a whole number", words.text_of(letter)),
                fmt::format("give {} without decimals", words.name_of(letter)));
  }
  if (nearest < least || nearest > most) {
    return fail(word.column, "out-of-range"_id,
                fmt::format("{} is out of range", words.text_of(letter)),
                fmt::format("{} goes from {} to {}", words.name_of(letter), least, most));
  }
  return static_cast<int>(nearest);
}

BlockExecutor::Outcome BlockExecutor::set_parameters(const Block& block) {
  if (block.assignments.empty()) return Done{};
  // All are computed before the first is set: a block reads what the blocks before it left.
  const ExpressionContext context{block.steps, block.names, parameters_};
  std::vector<std::pair<int, double>> values;
  for (const Assignment& setting : block.assignments) {
    const auto value = evaluate(context, setting.value);
    if (!value) return in_this_block(value.error().front());
    int index = 0;
    if (setting.name && system_.keeps(block.names[*setting.name])) {
      return fail(setting.column, "parameter-read-only"_id,
                  fmt::format("parameter #<{}> can only be read", block.names[*setting.name]),
                  "it tells the position, a mode or what a call gave back; use a name of your own");
    }
    if (setting.name && !setting.defines && !parameters_.can_set(block.names[*setting.name])) {
      return fail(setting.column, "parameter-undefined"_id,
                  fmt::format("{} is not defined", block.names[*setting.name]),
                  "define it before: DEF REAL and its name; parameters are R0 to R999");
    }
    if (!setting.name) {
      const auto number = evaluate(context, setting.index);
      if (!number) return in_this_block(number.error().front());
      const auto checked = Parameters::index_of(*number, rules_.parameters);
      if (!checked) {
        return fail(setting.column, checked.error().front());
      }
      index = *checked;
    }
    values.emplace_back(index, *value);
  }
  for (std::size_t i = 0; i < values.size(); ++i) {
    const auto& name = block.assignments[i].name;
    if (const auto kind = block.assignments[i].defines) {
      parameters_.define(block.names[*name], *kind, values[i].second);
    } else if (name) {
      parameters_.set(block.names[*name], values[i].second);
    } else {
      const std::uint32_t column = block.assignments[i].column;
      auto done = set_numbered(column, values[i].first, values[i].second);
      if (!done) return done;
    }
  }
  return Done{};
}

BlockExecutor::Outcome BlockExecutor::set_numbered(std::uint32_t column, int index, double value) {
  const auto written = is_vacant(value) ? ParameterWrite::not_kept
                                        : write_parameter(data_, rules_.dialect, index, value);
  if (written == ParameterWrite::read_only) {
    return fail(column, "parameter-read-only"_id,
                fmt::format("parameter #{} can only be read", index),
                "it tells the tool or the position; use another parameter");
  }
  if (written == ParameterWrite::done) {
    return rules_.parameters_count_at_once ? replace_datum(column) : Outcome{Done{}};
  }
  const auto kept = set_system_variable(column, index, value);
  if (!kept) return kept.error();
  if (!*kept) parameters_.set(index, value);
  return Done{};
}

Result<double> BlockExecutor::value_of(const Block& block, ExpressionRange range) {
  block_ = &block;
  auto value = evaluate({block.steps, block.names, parameters_}, range);
  if (!value) return in_this_block(value.error().front());
  return value;
}

Result<CallSubprogram> BlockExecutor::called_program(const BlockWords& words) const {
  const GivenCode& code = words[CodeGroup::subprogram];
  CallSubprogram call{0, false, 1, code.column, {}};
  if (!words.has('P')) {
    return fail(code.column, "word-missing"_id, code.code->name() + " without P",
                fmt::format("name the subprogram, for example {} P2000", code.code->name()));
  }
  const auto program = whole(words, 'P', 1, kMaxProgramNumber);
  if (!program) return program.error();
  call.program = static_cast<std::uint32_t>(*program);
  call.column = words['P'].column;
  if (words.has('L')) {
    const auto count = whole(words, 'L', 0, kMaxRepeats);
    if (!count) return count.error();
    call.counted = true;
    call.count = static_cast<std::uint32_t>(*count);
  }
  return call;
}

Result<Flow> BlockExecutor::finish(const BlockWords& words) {
  const GivenCode& stop = words[CodeGroup::stop];
  if (stop.code != nullptr) {
    const auto kind = static_cast<StopKind>(stop.code->value);
    const bool called = rules_.calls_whole_files && file_ != nullptr;
    if (kind == StopKind::program_end && called) {
      if (stop.code->letter == kNamedWord) return Flow{LeaveSubprogram{stop.column, {}, true}};
      return fail(stop.column, "call-end"_id, stop.code->name() + " in a program that is called",
                  "end it with END PGM, which goes back to the caller");
    }
    if (kind == StopKind::program_end) {
      auto done = end_radius_compensation(block_->place_of(stop.column));
      if (!done) return std::move(done).error();
      if (auto failure = spline_without_end()) return *failure;
    }
    emit(stop.column, Stop{kind});
    if (kind == StopKind::program_end) return Flow{EndProgram{}};
  }
  if (words.has(CodeGroup::hole_call) && !state_.hole_cycle.program.empty()) {
    return Flow{CallFile{state_.hole_cycle.program, words[CodeGroup::hole_call].column}};
  }
  const GivenCode& subprogram = words[CodeGroup::subprogram];
  const auto word = words.value_or(CodeGroup::subprogram, SubprogramWord::none);
  if (word == SubprogramWord::leave) {
    LeaveSubprogram leave{subprogram.column};
    if (words.has('P') && subprogram.code->arguments.has('P')) {
      const auto number = whole(words, 'P', 1, kMaxProgramNumber);
      if (!number) return number.error();
      leave.column = words['P'].column;
      leave.block_number = static_cast<std::uint32_t>(*number);
    }
    return Flow{leave};
  }
  if (word == SubprogramWord::end_modal) return Flow{EndModalCall{}};
  if (word == SubprogramWord::none) return Flow{NextBlock{moved_}};

  auto call = called_program(words);
  if (!call) return call.error();
  return Flow{*std::move(call)};
}

Diagnostic BlockExecutor::fail(std::uint32_t column, DiagnosticId id, std::string message,
                               std::string hint) const {
  Diagnostic diagnostic = error(id, std::move(message), std::move(hint));
  diagnostic.column = static_cast<int>(column);
  return in_this_block(std::move(diagnostic));
}

Diagnostic BlockExecutor::fail(std::uint32_t column, const Diagnostic& found) const {
  Diagnostic diagnostic = error(found.id, found.message, found.hint);
  diagnostic.column = static_cast<int>(column);
  return in_this_block(std::move(diagnostic));
}

Diagnostic BlockExecutor::in_this_block(Diagnostic diagnostic) const {
  const SourcePlace place = block_->place_of(static_cast<std::uint32_t>(diagnostic.column));
  diagnostic.line = static_cast<int>(place.line);
  diagnostic.column = static_cast<int>(place.column);
  return diagnostic;
}

void BlockExecutor::emit(std::uint32_t column, Command command) {
  moved_ = moved_ || std::holds_alternative<Traverse>(command) ||
           std::holds_alternative<LinearFeed>(command) ||
           std::holds_alternative<ArcFeed>(command) || std::holds_alternative<HomeReturn>(command);
  SourcePlace place = block_->place_of(column);
  place.file = file_;
  Motion motion{std::move(place), std::move(command)};
  if (!rules_.inserts_corners) return pass_to_radius(std::move(motion));
  auto failure = corners_.take(std::move(motion), to_radius_);
  if (failure && !failure_) failure_ = std::move(failure);
}

void BlockExecutor::pass_to_radius(Motion&& motion) {
  if (!radius_.is_on()) return send(std::move(motion));
  auto failure = radius_.take(std::move(motion), to_sink_);
  if (failure && !failure_) failure_ = std::move(failure);
}

void BlockExecutor::send(Motion&& motion) {
  if (!state_.programmed_frame.is_identity()) state_.programmed_frame.place(motion.command);
  if (!state_.offset_frame.is_identity()) state_.offset_frame.place(motion.command);
  ++motions_;
  sink_(std::move(motion));
}

void BlockExecutor::pass_over(const Block& block) {
  block_ = &block;
  for (const Word& word : block.words) {
    if (!kAxisWords.has(word.letter)) continue;
    const auto axis = static_cast<AxisLetter>(std::string_view("XYZABC").find(word.letter));
    const bool absolute =
        word.measure == Measure::absolute ||
        (word.measure == Measure::modal && state_.distance == DistanceMode::absolute);
    if (absolute && word.expression.empty()) {
      position_.set(axis, scaled(axis, word.number));
    } else {
      forget(LetterSet({&word.letter, 1}), PositionLoss::mistake);
    }
  }
}

}  // namespace frustum::parser

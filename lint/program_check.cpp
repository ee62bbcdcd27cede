#include "lint/program_check.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <optional>
#include <string_view>
#include <utility>

#include "lint/arc_checks.hpp"
#include "lint/cutting_checks.hpp"
#include "lint/end_checks.hpp"
#include "lint/parameter_reads.hpp"
#include "lint/program_structure.hpp"
#include "lint/rotary_checks.hpp"
#include "lint/run_errors.hpp"
#include "lint/travel_check.hpp"

namespace frustum::lint {
namespace {

using parser::Motion;
using parser::SourcePlace;

// Blocks that cannot be run, after which the rest of the program says little.
constexpr std::uint64_t kMostErrors = 1'000;

// Whether what runs next may be what has run: a jump, the end of a loop, M99 in the main program.
bool comes_round(const parser::BlockAhead& ahead) {
  using enum parser::FlowKind;
  const parser::Block& block = ahead.block;
  if (block.flow) {
    const parser::FlowKind kind = block.flow->kind;
    return kind == jump || kind == choice || kind == end_loop;
  }
  return ahead.calls == 0 &&
         std::any_of(block.words.begin(), block.words.end(), [](const parser::Word& word) {
           return word.letter == 'M' && word.number == 99.0;
         });
}

class ProgramCheck {
 public:
  ProgramCheck(const parser::Program& program, const CheckOptions& options)
      : program_(program),
        findings_(program.file, options.disabled),
        reads_(program.dialect),
        run_(options.run),
        most_turns_(options.most_turns) {
    if (options.machine != nullptr) travel_.emplace(*options.machine, options.setup, findings_);
    run_.watch = [this](const parser::BlockAhead& ahead) { return see(ahead); };
    run_.go_on = [this](Diagnostic&& error) { return go_on(error); };
  }

  CheckReport check() {
    wrong_lines_ = check_structure(program_, findings_);
    const auto summary = parser::interpret(
        program_, [this](Motion&& motion) { see(motion); }, run_);
    if (!summary) {
      for (const Diagnostic& error : summary.error()) report(error);
    }
    short_segments_.finish(findings_);
    if (travel_) travel_->finish();
    // The modes at the end say something only of a program that came there.
    if (state_.place.line == 0) state_.place = last_block_;
    if (summary && !broken_off_) check_end(state_, summary->state, program_.dialect, findings_);
    return {findings_.sorted(), findings_.left_out(), blocks_, motions_};
  }

 private:
  bool see(const parser::BlockAhead& ahead) {
    ++blocks_;
    last_block_ = {ahead.block.line, 1, ahead.file};
    reads_.see(ahead, findings_);
    if (!comes_round(ahead)) return true;
    SourcePlace place = ahead.block.place_of(ahead.block.flow ? ahead.block.flow->column : 1);
    place.file = ahead.file;
    const auto key = FindingList::key_of(place);
    if (++turns_[key] <= most_turns_) return true;
    findings_.raise(Check::endless_loop, key, place, [&] {
      return Words{fmt::format("reached {} times: does this loop end?", most_turns_),
                   "look for a condition that never changes; the checks end here"};
    });
    broken_off_ = true;
    return false;
  }

  bool go_on(const Diagnostic& error) {
    // Where the axes are is no longer sure.
    state_.position = {};
    report(error);
    broken_off_ = ++errors_ > kMostErrors;
    return !broken_off_;
  }

  void report(const Diagnostic& error) {
    if (follows_from_an_earlier_one(error)) return;
    const bool main_file = error.file == program_.file;
    if (main_file && wrong_lines_.contains(static_cast<std::uint32_t>(error.line))) return;
    SourcePlace place{static_cast<std::uint32_t>(error.line),
                      static_cast<std::uint32_t>(error.column), nullptr};
    if (!main_file) place.file = std::make_shared<const std::string>(error.file);
    findings_.raise(check_of(error, Check::program_error), error, place, error.severity);
  }

  void see(const Motion& motion) {
    ++motions_;
    if (const auto* event = std::get_if<parser::Event>(&motion.command)) see(*event, motion.place);
    check_length_number(motion, state_, findings_);
    check_rotary_with_length(motion, state_, program_.dialect, findings_);
    if (const auto move = cutting_move(motion, state_)) {
      check_spindle(*move, state_, findings_);
      check_tool(*move, state_, program_.dialect, findings_);
      check_feed(*move, findings_);
      check_arc(*move, findings_);
      check_tip_control(*move, state_, program_.dialect, findings_);
      short_segments_.see(*move);
    }
    if (travel_) travel_->see(motion);
    state_.follow(motion);
  }

  void see(const parser::Event& event, const SourcePlace& place) {
    // What the interpreter says for itself.
    constexpr std::array<std::string_view, 9> kTold{
        "comment", "message", "block_delete", "surface_speed",      "BEGIN PGM",
        "PARTNO",  "debug",   "structure",    "radius_compensation"};
    if (std::find(kTold.begin(), kTold.end(), event.name) != kTold.end()) return;
    // The first line of a cycle of Klartext; what the others say is simulated.
    if (event.name.starts_with("CYCL DEF") && event.name != "CYCL DEF 32") return;
    if (event.name == "vacant") {
      findings_.raise(Check::vacant_word, FindingList::key_of(place), place, [&] {
        return Words{fmt::format("the parameter of {} is vacant: the word is left out", event.text),
                     "set the parameter before, if the word is wanted"};
      });
      return;
    }
    findings_.raise(Check::not_simulated, FindingList::key_of(event.name), place, [&] {
      const std::string text = event.text.empty() ? "" : fmt::format(" ({})", event.text);
      return Words{fmt::format("{}{} is known and not simulated", event.name, text), ""};
    });
  }

  const parser::Program& program_;
  FindingList findings_;
  MotionState state_{};
  ParameterReads reads_;
  ShortSegments short_segments_{};
  std::optional<TravelCheck> travel_{};
  parser::InterpreterOptions run_;
  std::uint64_t most_turns_;
  WrongLines wrong_lines_{};
  std::map<FindingList::Key, std::uint64_t> turns_{};
  SourcePlace last_block_{1, 1, nullptr};
  std::uint64_t errors_ = 0;
  std::uint64_t blocks_ = 0;
  std::uint64_t motions_ = 0;
  bool broken_off_ = false;
};

}  // namespace

std::size_t CheckReport::count(Severity severity) const {
  return static_cast<std::size_t>(
      std::count_if(findings.begin(), findings.end(),
                    [severity](const Finding& f) { return f.severity == severity; }));
}

CheckReport check_program(const parser::Program& program, const CheckOptions& options) {
  return ProgramCheck(program, options).check();
}

}  // namespace frustum::lint

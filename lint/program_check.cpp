#include "lint/program_check.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "lint/arc_checks.hpp"
#include "lint/cutting_checks.hpp"
#include "lint/decimal_points.hpp"
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

// A subprogram without what its callers give may go round and round.
constexpr std::uint64_t kTurnsAlone = 1'000;
constexpr std::uint64_t kRepeatsAlone = 100'000;

// What a motion on a machine costs, and each of the positions that are looked at, in blocks.
constexpr std::uint64_t kCostOfMotion = 8;

// A block of more motions than this, by the repeats of a cycle, counts like a loop.
constexpr std::uint64_t kMotionsOfBlock = 1'000;

// Blocks that run again, which a program may have without end.
class Repeats {
 public:
  struct Jump {
    SourcePlace from{};
    std::uint64_t count = 0;  // so often
  };
  // A jump back to this block, if it is one.
  [[nodiscard]] std::optional<Jump> see(const parser::BlockAhead& ahead) {
    Way& way = way_of(ahead);
    const std::uint32_t line = ahead.block.line;
    std::optional<Jump> jump;
    if (line <= way.line) {
      jump = Jump{way.place, ++jumps_[FindingList::key_of(way.place)]};
    }
    runs_again_ = line <= way.farthest;
    motions_ = 0;
    if (runs_again_) ++blocks_;
    way.line = line;
    way.farthest = std::max(way.farthest, line);
    way.place = ahead.block.place_of(ahead.block.flow ? ahead.block.flow->column : 1);
    way.place.file = ahead.file;
    return jump;
  }
  // Of a motion, beyond that of its block.
  void add_cost(std::uint64_t blocks) {
    const bool many = ++motions_ > kMotionsOfBlock;
    if (many || runs_again_) blocks_ += blocks + (many ? 1 : 0);
  }
  [[nodiscard]] std::uint64_t blocks() const { return blocks_; }

 private:
  // Of one file at one depth of calls.
  struct Way {
    std::uint32_t line = 0;
    std::uint32_t farthest = 0;
    SourcePlace place{};
  };
  Way& way_of(const parser::BlockAhead& ahead) {
    if (last_ == nullptr || ahead.file != file_ || ahead.calls != calls_) {
      file_ = ahead.file;
      calls_ = ahead.calls;
      last_ = &ways_[{file_ ? *file_ : std::string(), calls_}];
    }
    return *last_;
  }

  std::map<std::pair<std::string, std::size_t>, Way> ways_{};
  std::map<FindingList::Key, std::uint64_t> jumps_{};
  std::shared_ptr<const std::string> file_{};
  std::size_t calls_ = 0;
  Way* last_ = nullptr;
  bool runs_again_ = false;
  std::uint64_t motions_ = 0;  // of the block
  std::uint64_t blocks_ = 0;
};

class ProgramCheck {
 public:
  ProgramCheck(const parser::Program& program, const CheckOptions& options)
      : program_(program),
        findings_(program, disabled_of(options), options.most_places),
        reads_(program.dialect),
        points_(program.dialect == parser::Dialect::fanuc && !options.decimal_point_is_known),
        options_(options),
        run_(options.run),
        most_turns_(options.most_turns),
        most_repeats_(options.most_repeats) {
    state_.position = options.home;
    if (options.machine != nullptr && !options.subprogram) {
      travel_.emplace(*options.machine, options.setup, program.dialect, findings_);
    }
    if (options.subprogram) {
      most_turns_ = std::min(most_turns_, kTurnsAlone);
      most_repeats_ = std::min(most_repeats_, kRepeatsAlone);
      // The unit is its callers'.
      if (!run_.control.unit) run_.control.unit = parser::LengthUnit::millimetre;
    }
    run_.watch = [this](const parser::BlockAhead& ahead) { return see(ahead); };
    run_.go_on = [this](Diagnostic&& error) { return go_on(error); };
  }

  CheckReport check() {
    wrong_lines_ = check_structure(program_, findings_);
    const auto summary = parser::interpret(
        program_, [this](Motion&& motion) { see(motion); }, run_);
    if (!summary && !broken_off_) {
      for (const Diagnostic& error : summary.error()) report(error);
    }
    short_segments_.finish(findings_);
    points_.finish(findings_);
    if (travel_) travel_->finish();
    // The modes at the end say something only of a program that came there.
    if (state_.place.line == 0) state_.place = last_block_;
    if (summary && !broken_off_) check_end(state_, summary->state, program_.dialect, findings_);
    if (summary && !broken_off_ && errors_ == 0 && options_.look_further && !options_.subprogram) {
      look_further();
    }
    judge_suppressions();
    return {findings_.sorted(), findings_.left_out(), blocks_, motions_, std::move(opened_)};
  }

 private:
  static std::set<Check> disabled_of(const CheckOptions& options) {
    std::set<Check> disabled = options.disabled;
    for (const CheckInfo& info : all_checks()) {
      if (options.subprogram && !needs_no_caller(info.check)) disabled.insert(info.check);
    }
    return disabled;
  }

  void look_further() {
    looked_further_ = true;
    for (Finding& found : options_.look_further()) {
      SourcePlace place{found.line, found.column, nullptr};
      if (!found.file.empty()) place.file = std::make_shared<const std::string>(found.file);
      findings_.raise(
          found.check, FindingList::key_of(place), place,
          [&] {
            return Words{found.message, found.hint};
          },
          found.severity);
    }
  }

  void judge_suppressions() {
    for (const Suppression& each : findings_.suppressions().all()) {
      const auto key = FindingList::key_of(each.place) * 64 + each.place.column;
      if (!each.check) {
        findings_.raise(Check::unknown_suppression, FindingList::key_of(each.id) ^ key, each.place,
                        [&] { return words_of_unknown(each); });
      } else if (!each.used && could_be_used(*each.check)) {
        findings_.raise(Check::unused_suppression, FindingList::key_of(each.id) ^ key, each.place,
                        [&] {
                          return Words{fmt::format("there is no {} to suppress here", each.id),
                                       "leave the comment out"};
                        });
      }
    }
  }
  static Words words_of_unknown(const Suppression& comment) {
    if (comment.id.empty()) {
      return {"the comment names no check", "frustum: ignore ID, one or several of --list"};
    }
    return {fmt::format("the comment suppresses '{}', which is no check", comment.id),
            check_meant_by(comment.id)};
  }
  // Not, where it was not looked for.
  [[nodiscard]] bool could_be_used(Check check) const {
    const Needs needs = info_of(check).needs;
    return findings_.wants(check) && !broken_off_ && check != Check::unused_suppression &&
           check != Check::unknown_suppression &&
           (needs == Needs::nothing || (needs == Needs::machine && travel_.has_value()) ||
            (needs == Needs::job && looked_further_));
  }

  bool see(const parser::BlockAhead& ahead) {
    ++blocks_;
    last_block_ = {ahead.block.line, 1, ahead.file};
    if (ahead.file != nullptr && ahead.file != last_opened_) {
      last_opened_ = ahead.file;
      opened_.insert(*last_opened_);
    }
    reads_.see(ahead, findings_);
    points_.see(ahead);
    const auto jump = repeats_.see(ahead);
    if (jump && jump->count > most_turns_) {
      findings_.raise(Check::endless_loop, FindingList::key_of(jump->from), jump->from, [&] {
        return Words{fmt::format("reached {} times: does this loop end?", most_turns_),
                     "look for a condition that never changes; the checks end here"};
      });
      broken_off_ = true;
    } else if (repeats_.blocks() > most_repeats_) {
      findings_.raise(
          Check::endless_loop, FindingList::key_of(last_block_), last_block_,
          [&] {
            return Words{
                fmt::format("loops and repeats have run {} blocks again: the checks end here",
                            most_repeats_),
                "a longer program is checked with a greater --most-repeats"};
          },
          Severity::warning);
      broken_off_ = true;
    }
    return !broken_off_;
  }

  bool go_on(const Diagnostic& error) {
    // Where the axes are is no longer sure.
    state_.position = {};
    report(error);
    if (++errors_ < kMostErrors) return true;
    findings_.raise(Check::too_many_errors, 0, last_block_, [] {
      return Words{fmt::format("{} blocks could not be run: the checks end here", kMostErrors),
                   "mend what is above and check again; is it the right --dialect?"};
    });
    broken_off_ = true;
    return false;
  }

  void report(const Diagnostic& error) {
    if (follows_from_an_earlier_one(error)) return;
    // What a subprogram is given alone decides of its other mistakes.
    if (options_.subprogram && error.id != "unknown-word"_id) return;
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
    check_length_number(motion, state_, program_.dialect, findings_);
    check_rotary_with_length(motion, state_, program_.dialect, findings_);
    if (const auto move = cutting_move(motion, state_)) {
      check_spindle(*move, state_, findings_);
      check_tool(*move, state_, program_.dialect, findings_);
      check_feed(*move, findings_);
      check_arc(*move, findings_);
      check_tip_control(*move, state_, program_.dialect, findings_);
      short_segments_.see(*move);
    }
    const std::uint64_t before = travel_ ? travel_->samples() : 0;
    if (travel_) travel_->see(motion);
    repeats_.add_cost(travel_ ? kCostOfMotion + travel_->samples() - before : 0);
    state_.follow(motion);
  }

  void see(const parser::Event& event, const SourcePlace& place) {
    // What the interpreter says for itself.
    constexpr std::array<std::string_view, 9> kTold{
        "comment", "message", "block_delete", "surface_speed",      "BEGIN PGM",
        "PARTNO",  "debug",   "structure",    "radius_compensation"};
    if (std::find(kTold.begin(), kTold.end(), event.name) != kTold.end()) return;
    // The end of a subprogram is none of a main program.
    if (options_.subprogram && event.name == "M99") return;
    // The first line of a cycle of Klartext; what the others say is simulated.
    if (event.name.starts_with("CYCL DEF") && event.name != "CYCL DEF 32") return;
    if (event.grade == parser::EventGrade::builder) {
      findings_.raise(Check::builder_word, FindingList::key_of(event.name), place, [&] {
        return Words{.message = fmt::format("{} is a word of the machine's builder, passed over",
                                            event.name),
                     .hint = "name it under [controller] words of the machine, if it moves nothing",
                     .alike = event.name};
      });
      return;
    }
    if (event.name == "decimal point") {
      if (!options_.decimal_point_is_known) points_.told(event, place);
      return;
    }
    if (event.grade == parser::EventGrade::assumed) {
      findings_.raise(Check::assumed, FindingList::key_of(event.name), place, [&] {
        return Words{.message = fmt::format("{}: taken that {}", event.name, event.text),
                     .alike = event.name};
      });
      return;
    }
    if (event.name == "vacant") {
      findings_.raise(Check::vacant_word, FindingList::key_of(place), place, [&] {
        return Words{fmt::format("the parameter of {} is vacant: the word is left out", event.text),
                     "set the parameter before, if the word is wanted"};
      });
      return;
    }
    findings_.raise(Check::not_simulated, FindingList::key_of(event.name), place, [&] {
      const std::string text = event.text.empty() ? "" : fmt::format(" ({})", event.text);
      return Words{.message = fmt::format("{}{} is known and not simulated", event.name, text),
                   .alike = event.name};
    });
  }

  const parser::Program& program_;
  FindingList findings_;
  MotionState state_{};
  ParameterReads reads_;
  DecimalPoints points_;
  ShortSegments short_segments_{};
  std::optional<TravelCheck> travel_{};
  const CheckOptions& options_;
  parser::InterpreterOptions run_;
  std::uint64_t most_turns_;
  std::uint64_t most_repeats_;
  Repeats repeats_{};
  WrongLines wrong_lines_{};
  SourcePlace last_block_{1, 1, nullptr};
  std::set<std::string> opened_{};
  std::shared_ptr<const std::string> last_opened_{};
  std::uint64_t errors_ = 0;
  std::uint64_t blocks_ = 0;
  std::uint64_t motions_ = 0;
  bool broken_off_ = false;
  bool looked_further_ = false;
};

}  // namespace

std::size_t CheckReport::count(Severity severity) const {
  return static_cast<std::size_t>(
      std::count_if(findings.begin(), findings.end(), [severity](const Finding& f) {
        return f.severity == severity && f.suppressed == Suppressed::no;
      }));
}

void CheckReport::cut_short() {
  std::map<std::pair<Check, Severity>, std::size_t> listed;
  std::erase_if(findings, [&](const Finding& finding) {
    if (finding.suppressed != Suppressed::no) return false;
    if (listed[{finding.check, finding.severity}]++ < kMostPlaces) return false;
    ++left_out[finding.check];
    return true;
  });
}

CheckReport check_program(const parser::Program& program, const CheckOptions& options) {
  return ProgramCheck(program, options).check();
}

}  // namespace frustum::lint

#include "lint/travel_check.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <set>
#include <string>
#include <utility>

#include "core/golden_section.hpp"
#include "core/units.hpp"
#include "kinematics/controller/controller.hpp"
#include "kinematics/model/inverse.hpp"
#include "lint/cutting_checks.hpp"
#include "lint/run_errors.hpp"

namespace frustum::lint {
namespace {

using kinematics::AxisPositions;
using kinematics::BlockMotion;
using kinematics::Joint;
using parser::AxisLetter;
using parser::SourcePlace;

// Rounding of the inverse: less than this beyond a limit is at it.
constexpr double kAtLimit = 1e-9;  // mm, rad
// Below this a speed beyond an axis's is one of rounded feeds.
constexpr double kSpeedMargin = 1.001;
constexpr int kLeastParts = 16;
// A move of more parts than this goes farther than any machine; what it lacks of its own number is
// looked at more coarsely, once the program has had many of them.
constexpr int kManyParts = 128;
constexpr int kMostParts = 4096;
constexpr std::uint64_t kPartsOfLongMoves = 200'000;
constexpr int kJobOffsets = 6;    // G54 to G59
constexpr double kNarrow = 1e-6;  // of a move, where its peak is searched

double shown(const Joint& joint, double value) {
  return joint.rotary() ? value * kDegPerRad : value;
}
const char* unit_of(const Joint& joint) { return joint.rotary() ? "deg" : "mm"; }

// Least and greatest position of one axis in a move.
struct Reach {
  double lo = 0.0;
  double hi = 0.0;
};

// A segment of moves with one axis beyond one of its limits.
struct Excursion {
  SourcePlace first{};
  SourcePlace worst{};
  double position = 0.0;  // the farthest
  std::uint64_t moves = 0;
  LineSet lines{};
};

struct AxisWatch {
  Joint joint{};
  std::array<std::optional<Excursion>, 2> beyond{};  // below the travel, above it
};

struct Haste {
  SourcePlace first{};
  SourcePlace worst{};
  double speed = 0.0;
  std::uint64_t moves = 0;
  LineSet lines{};
};

// What a program without a setup sheet means by G54.
kinematics::Setup with_first_offset(kinematics::Setup setup) {
  setup.work_offsets.try_emplace(1, Vec3::Zero());
  return setup;
}

}  // namespace

class TravelCheck::State {
 public:
  State(const kinematics::Machine& machine, kinematics::Setup setup, parser::Dialect dialect,
        FindingList& findings)
      : machine_(machine),
        setup_(with_first_offset(std::move(setup))),
        dialect_(dialect),
        findings_(findings),
        controller_(machine, setup_, [this](kinematics::CommandedStep&& step) { watch(step); },
                    {.check_travel = false, .feeds_need_tool = false}) {
    for (const auto& offset : setup_.work_offsets) placed_.insert(offset.first);
    for (const Joint& joint : machine.joints()) axes_.push_back({joint, {}});
    hastes_.resize(axes_.size());
  }

  void see(const parser::Motion& motion) {
    place_ = motion.place;
    std::visit([this](const auto& command) { assume(command); }, motion.command);
    command(motion);
  }

  [[nodiscard]] std::uint64_t samples() const { return samples_taken_; }

  void finish() {
    for (AxisWatch& axis : axes_) {
      for (const std::size_t side : {0U, 1U}) end_excursion(axis, side);
    }
    tell_hastes();
    for (const Diagnostic& warning : controller_.warnings()) problem(warning);
  }

 private:
  void command(const parser::Motion& motion) {
    for (const Diagnostic& diagnostic : controller_.command(motion)) problem(diagnostic);
  }
  void watch(const kinematics::CommandedStep& step) {
    if (const auto* move = std::get_if<kinematics::CommandedMove>(&step)) judge(*move);
  }

  void problem(const Diagnostic& diagnostic) {
    // The interpreter or another check says so already, with or without a machine.
    const Check check = check_of(diagnostic, Check::machine_refuses);
    if (check == Check::feed_missing || check == Check::spindle_off ||
        check == Check::length_of_other_tool) {
      return;
    }
    findings_.raise_alike(check, diagnostic, place_);
  }

  // --- the setup, where it is not known ---------------------------------------------------------

  void assume(const parser::ToolChange& change) {
    if (change.tool != 0) know_tool(change.tool);
  }
  void assume(const parser::CompensationChange& change) {
    const int tool = change.offset_number;
    if (change.mode == parser::LengthCompensation::off || change.length || tool == 0) return;
    know_tool(tool);
    if (!of_no_length_.contains(tool)) return;
    findings_.raise(
        Check::setup_assumed, FindingList::key_of(fmt::format("T{}", tool)), place_, [&] {
          return Words{.message = fmt::format("the length of {} is not known and taken as 0",
                                              offset_name(tool, dialect_)),
                       .hint = fmt::format("give --job, or --tool-length {}=MM", tool),
                       .alike = fmt::format("T{}", tool)};
        });
  }
  void assume(const parser::WorkOffsetChange& change) { know_offset(change.number); }
  void assume(const parser::WorkOffsetSetting& setting) {
    const bool whole = std::all_of(setting.origin.begin(), setting.origin.end(),
                                   [](const auto& value) { return value.has_value(); });
    if (whole) {
      placed_.insert(setting.number);
    } else {
      know_offset(setting.number);
    }
  }
  template <typename Other>
  void assume(const Other& /*command*/) {}

  void know_tool(int tool) {
    if (setup_.tools.try_emplace(tool).second) of_no_length_.insert(tool);
  }
  void know_offset(int number) {
    if (!placed_.insert(number).second) return;
    const AxisPositions at_table =
        kinematics::place_tip(machine_, Vec3::Zero(), 0.0, AxisPositions{});
    parser::Motion motion;
    motion.place = place_;
    motion.command = parser::WorkOffsetSetting{
        number, {at_table[AxisLetter::X], at_table[AxisLetter::Y], at_table[AxisLetter::Z]}};
    command(motion);
    const std::string name = parser::work_offset_name(number);
    findings_.raise(Check::setup_assumed, FindingList::key_of(name), place_, [&] {
      return Words{
          .message = fmt::format("work offset {} is not known: its origin is taken to be the "
                                 "table's",
                                 name),
          .hint = number <= kJobOffsets ? fmt::format("give --job, or --offset {}=X,Y,Z", name)
                                        : "let the program place it (G10 L2), or use G54 to G59",
          .alike = name};
    });
  }

  // --- one move ---------------------------------------------------------------------------------

  void judge(const kinematics::CommandedMove& move) {
    const BlockMotion& motion = move.motion;
    samples_.clear();
    // Where the move begins, the one before has ended and been judged.
    const int parts = motion.straight() ? 1 : parts_of(motion.least_parts());
    samples_taken_ += static_cast<std::uint64_t>(parts);
    for (int i = 0; i <= parts; ++i) {
      samples_.push_back(i == 0       ? motion.start()
                         : i == parts ? motion.end()
                                      : motion.at(static_cast<double>(i) / parts));
    }
    const double seconds = move.kind == kinematics::PathKind::feed ? move.feed_duration : 0.0;
    for (std::size_t i = 0; i < axes_.size(); ++i) {
      AxisWatch& axis = axes_[i];
      if (!axis.joint.endless) judge_reach(axis, reach_of(motion, axis.joint.letter));
      if (seconds > 0.0 && axis.joint.dynamics.velocity > 0.0) judge_speed(i, seconds);
    }
  }

  [[nodiscard]] int parts_of(int wanted) {
    if (wanted <= kManyParts) return std::max(kLeastParts, wanted);
    if (long_parts_ > kPartsOfLongMoves) return kManyParts;
    const int parts = std::min(wanted, kMostParts);
    long_parts_ += static_cast<std::uint64_t>(parts);
    return parts;
  }

  // A peak between two samples is beside the outermost of them.
  [[nodiscard]] Reach reach_of(const BlockMotion& motion, AxisLetter letter) const {
    const auto by_axis = [letter](const AxisPositions& a, const AxisPositions& b) {
      return a[letter] < b[letter];
    };
    const auto [least, greatest] =
        std::minmax_element(samples_.begin() + 1, samples_.end(), by_axis);
    Reach reach{(*least)[letter], (*greatest)[letter]};
    if (motion.straight()) return reach;
    const auto parts = static_cast<double>(samples_.size() - 1);
    const auto peak = [&](auto sample, double sign) {
      const auto at = static_cast<double>(sample - samples_.begin());
      const double lo = std::max(at - 1.0, 0.0) / parts, hi = std::min(at + 1.0, parts) / parts;
      const auto found =
          golden_section([&](double u) { return sign * motion.at(u)[letter]; }, lo, hi, kNarrow);
      return sign * found.value;
    };
    // Worth a search only near a limit.
    const Joint& joint = *machine_.joint(letter);
    const double margin = 0.25 * (reach.hi - reach.lo);
    if (reach.hi + margin > joint.travel.hi) reach.hi = std::max(reach.hi, peak(greatest, -1.0));
    if (reach.lo - margin < joint.travel.lo) reach.lo = std::min(reach.lo, peak(least, +1.0));
    return reach;
  }

  void judge_reach(AxisWatch& axis, const Reach& reach) {
    judge_side(axis, 0, axis.joint.travel.lo - reach.lo, reach.lo);
    judge_side(axis, 1, reach.hi - axis.joint.travel.hi, reach.hi);
  }
  void judge_side(AxisWatch& axis, std::size_t side, double excess, double position) {
    auto& excursion = axis.beyond.at(side);
    if (excess <= kAtLimit) {
      end_excursion(axis, side);
      return;
    }
    if (!excursion) excursion = Excursion{place_, place_, position, 0, {}};
    ++excursion->moves;
    excursion->lines.insert(place_);
    const bool farther =
        side == 0 ? position < excursion->position : position > excursion->position;
    if (!farther) return;
    excursion->position = position;
    excursion->worst = place_;
  }
  void end_excursion(AxisWatch& axis, std::size_t side) {
    auto& excursion = axis.beyond.at(side);
    if (!excursion) return;
    const Joint& joint = axis.joint;
    const double limit = side == 0 ? joint.travel.lo : joint.travel.hi;
    const double amount = std::abs(excursion->position - limit);
    const Check check = joint.rotary() ? Check::rotary_over_travel : Check::over_travel;
    // The axis as part of the key: several may leave their travel in one block.
    const auto key = FindingList::key_of(excursion->first) * 16 +
                     static_cast<FindingList::Key>(joint.letter) * 2 + side;
    findings_.raise(check, key, excursion->first, [&] {
      std::string message = fmt::format(
          "{} goes to {:.3f} {unit}, {:.3f} {unit} beyond its travel of {:g} to {:g} {unit}",
          to_char(joint.letter), shown(joint, excursion->position), shown(joint, amount),
          shown(joint, joint.travel.lo), shown(joint, joint.travel.hi),
          fmt::arg("unit", unit_of(joint)));
      if (excursion->moves > 1) {
        message += fmt::format(" ({} moves; farthest on line {})", excursion->moves,
                               excursion->worst.line);
      }
      return Words{
          .message = std::move(message), .hint = remedy(joint), .places = excursion->lines.size()};
    });
    excursion.reset();
  }
  [[nodiscard]] static std::string remedy(const Joint& joint) {
    return joint.rotary() ? "choose the other solution of the rotary axes, or another clamping"
                          : "move the part on the table (--offset, --job), use a shorter or longer "
                            "tool, or a larger machine";
  }

  void judge_speed(std::size_t i, double seconds) {
    const Joint& joint = axes_[i].joint;
    const double parts = static_cast<double>(samples_.size() - 1);
    double most = 0.0;
    for (std::size_t k = 1; k < samples_.size(); ++k) {
      most = std::max(most, std::abs(samples_[k][joint.letter] - samples_[k - 1][joint.letter]));
    }
    const double speed = most * parts / seconds;
    if (speed <= joint.dynamics.velocity * kSpeedMargin) return;
    auto& haste = hastes_[i];
    if (!haste) haste = Haste{place_, place_, speed, 0, {}};
    ++haste->moves;
    haste->lines.insert(place_);
    if (speed <= haste->speed) return;
    haste->worst = place_;
    haste->speed = speed;
  }
  void tell_hastes() {
    for (std::size_t i = 0; i < axes_.size(); ++i) {
      if (!hastes_[i]) continue;
      const Haste& haste = *hastes_[i];
      const Joint& joint = axes_[i].joint;
      const double per_minute = joint.rotary() ? kDegPerRad * 60.0 : 60.0;
      findings_.raise(
          Check::axis_too_slow, static_cast<FindingList::Key>(joint.letter), haste.worst, [&] {
            return Words{
                .message = fmt::format("the feed asks {} for {:.0f} {unit}/min, its greatest is "
                                       "{:.0f} ({} {}, the first on line {})",
                                       to_char(joint.letter), haste.speed * per_minute,
                                       joint.dynamics.velocity * per_minute, haste.moves,
                                       haste.moves == 1 ? "move" : "moves", haste.first.line,
                                       fmt::arg("unit", unit_of(joint))),
                .hint = "the machine slows down there; lower F, or keep away from the pole",
                .alike = std::string(1, to_char(joint.letter)),
                .places = haste.lines.size()};
          });
    }
  }

  const kinematics::Machine& machine_;
  kinematics::Setup setup_;
  parser::Dialect dialect_;
  FindingList& findings_;
  std::set<int> placed_{};        // work offsets
  std::set<int> of_no_length_{};  // tools
  std::vector<AxisWatch> axes_{};
  std::vector<std::optional<Haste>> hastes_{};
  std::vector<AxisPositions> samples_{};
  std::uint64_t samples_taken_ = 0;
  std::uint64_t long_parts_ = 0;  // of moves of many parts
  SourcePlace place_{};
  kinematics::Controller controller_;
};

TravelCheck::TravelCheck(const kinematics::Machine& machine, kinematics::Setup setup,
                         parser::Dialect dialect, FindingList& findings)
    : state_(std::make_unique<State>(machine, std::move(setup), dialect, findings)) {}
TravelCheck::~TravelCheck() = default;

void TravelCheck::see(const parser::Motion& motion) { state_->see(motion); }
std::uint64_t TravelCheck::samples() const { return state_->samples(); }
void TravelCheck::finish() { state_->finish(); }

}  // namespace frustum::lint

#include "kinematics/model/rotary_plan.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numbers>

#include "core/constants.hpp"
#include "kinematics/model/inverse.hpp"
#include "kinematics/model/rotary_axes.hpp"

namespace frustum::kinematics {
namespace {

// An axis with room for more turns than this follows its path like an endless one; its limits are
// checked.
constexpr double kCountedTurns = 6.0;
// A change to the other orientation must save at least this: ties stay.
constexpr double kChangeOfSign = 1e-6;  // rad
// Weighs the first pose's distance from the preferred positions above any travel.
constexpr double kPreference = 1e6;

// An axis solution of one pose. Of an axis that follows, any full turn of the angle is meant.
struct Candidate {
  RotaryAngles angle{};
  double sign = 1.0;
};

struct Cost {
  int unwindings = 0;
  double travel = 0.0;
  [[nodiscard]] bool less(const Cost& other) const {
    if (unwindings != other.unwindings) return unwindings < other.unwindings;
    return travel < other.travel - 1e-9;  // a tie within rounding goes to the earlier
  }
};

// What is kept of a state after its layer is done.
struct Trace {
  RotaryAngles q{};
  std::int32_t parent = -1;  // state of the layer before
  std::int32_t resume = -1;  // index into the list of resumptions; -1: no unwinding
};

struct State {
  Trace trace{};
  double sign = 1.0;
  Cost cost{};
};

// The poses outside the pole: those where both rotary positions are given.
struct Anchor {
  std::size_t pose = 0;
  std::size_t first_trace = 0;
};

class Planner {
 public:
  Planner(const Machine& machine, std::span<const ToolPose> path, double tool_length,
          const PlanOptions& options)
      : machine_(machine),
        path_(path),
        tool_length_(tool_length),
        options_(options),
        axes_(machine),
        tolerance_(std::max(options.pole_tolerance, kPole)) {
    for (std::size_t i = 0; i < axes_.count(); ++i) {
      const Joint& joint = axes_.joint(i);
      counted_[i] = !joint.endless && joint.travel.width() < kCountedTurns * kTurn;
    }
  }

  Result<std::vector<PlannedPose>> plan() {
    const RotaryAngles start = axes_.angles(options_.start);
    states_ = {State{.trace = {.q = start}}};
    bool first = true;
    for (std::size_t i = 0; i < path_.size(); ++i) {
      const auto air = next_air(i);
      free_gap_ = free_gap_ || air;
      const auto found = axes_.solve(path_[i].axis.normalized());
      if (!found) return at_pose(i, found.error().front());
      from_pole_ = axes_.count() == 2 ? axes_.triangle(path_[i].axis.normalized()).from_pole : 1.0;
      if (from_pole_ < tolerance_) continue;
      if (const auto none = collect(i, *found)) return *none;
      if (const auto none = first ? begin() : advance(i)) return *none;
      anchors_.push_back({i, traces_.size()});
      for (const State& state : states_) traces_.push_back(state.trace);
      previous_from_pole_ = from_pole_;
      previous_candidates_ = candidates_;
      first = false;
      free_gap_ = false;
    }
    return assembled();
  }

 private:
  [[nodiscard]] static Diagnostic at_pose(std::size_t i, Diagnostic diagnostic) {
    diagnostic.message = fmt::format("pose {}: {}", i, diagnostic.message);
    return diagnostic;
  }

  // Whether pose i is reached through the air; called with increasing i.
  bool next_air(std::size_t i) {
    while (air_ < options_.through_air.size() && options_.through_air[air_] < i) ++air_;
    return i == 0 || (air_ < options_.through_air.size() && options_.through_air[air_] == i);
  }

  // --- the solutions of one pose ----------------------------------------------------------------

  // Full turns of a counted axis within its travel; of one that follows, the angle itself.
  void turns_of(std::size_t axis, double angle, std::vector<double>& turns) const {
    turns.clear();
    const Joint& joint = axes_.joint(axis);
    if (!counted_[axis]) {
      turns.push_back(angle);
      return;
    }
    double q = nearest_turn(angle, joint.travel.middle());
    while (within_travel(joint, q - kTurn)) q -= kTurn;
    if (!within_travel(joint, q)) q += q < joint.travel.middle() ? kTurn : -kTurn;
    for (; within_travel(joint, q); q += kTurn) turns.push_back(q);
  }

  std::optional<Diagnostic> collect(std::size_t i, const OrientationSolutions& solutions) {
    candidates_.clear();
    std::string in_the_way;
    for (const OrientationSolution& s : solutions) {
      RotaryAngles angle = s.angle;
      for (std::size_t k = 0; k < axes_.count(); ++k) {
        if (s.free[k]) angle[k] = axes_.angles(options_.start)[k];
      }
      const AxisPositions placed =
          place_tip(machine_, path_[i].tip, tool_length_, axes_.with({}, inside(angle)));
      if (const auto violations = travel_violations_if_any(placed); !violations.empty()) {
        in_the_way += (in_the_way.empty() ? "" : ", or ") + violations;
        continue;
      }
      for (std::vector<double>& turns : turns_) turns.assign(1, 0.0);
      for (std::size_t k = 0; k < axes_.count(); ++k) turns_of(k, angle[k], turns_[k]);
      for (const double q0 : turns_[0]) {
        for (const double q1 : turns_[1]) candidates_.push_back({{q0, q1}, s.sign});
      }
    }
    if (!candidates_.empty()) return std::nullopt;
    return at_pose(i, error("axis-over-travel"_id, "beyond travel: " + in_the_way,
                            "move the workpiece on the table, or choose a larger machine"));
  }

  // The turns nearest to the middle of travel: where an axis is unwound to.
  [[nodiscard]] RotaryAngles inside(RotaryAngles angle) const {
    for (std::size_t k = 0; k < axes_.count(); ++k) {
      angle[k] = best_turn(axes_.joint(k), angle[k], axes_.joint(k).travel.middle());
    }
    return angle;
  }

  [[nodiscard]] std::string travel_violations_if_any(const AxisPositions& q) const {
    if (within_travel(machine_, q)) return {};
    return fmt::format("{}", fmt::join(travel_violations(machine_, q), " and "));
  }

  // --- transitions ------------------------------------------------------------------------------

  // The candidate's positions when it is come to from `from`.
  [[nodiscard]] RotaryAngles followed(const Candidate& to, const RotaryAngles& from) const {
    RotaryAngles q = to.angle;
    for (std::size_t k = 0; k < axes_.count(); ++k) {
      if (!counted_[k]) q[k] = nearest_turn(to.angle[k], from[k]);
    }
    return q;
  }
  [[nodiscard]] RotaryAngles unwound(const Candidate& to, const RotaryAngles& from) const {
    RotaryAngles q = to.angle;
    for (std::size_t k = 0; k < axes_.count(); ++k) {
      if (counted_[k]) continue;
      const Joint& joint = axes_.joint(k);
      q[k] = nearest_turn(to.angle[k], joint.endless ? from[k] : joint.travel.middle());
    }
    return q;
  }
  [[nodiscard]] bool allowed(const RotaryAngles& q) const {
    for (std::size_t k = 0; k < axes_.count(); ++k) {
      if (!within_travel(axes_.joint(k), q[k])) return false;
    }
    return true;
  }
  [[nodiscard]] double travel(const RotaryAngles& from, const RotaryAngles& to) const {
    const bool near_pole = std::min(from_pole_, previous_from_pole_) < options_.singular_cone;
    return (near_pole ? options_.singular_weight : 1.0) * std::abs(to[0] - from[0]) +
           std::abs(to[1] - from[1]);
  }
  static double plain_distance(const RotaryAngles& a, const RotaryAngles& b) {
    return std::abs(a[0] - b[0]) + std::abs(a[1] - b[1]);
  }

  std::optional<Diagnostic> begin() {
    const RotaryAngles start = states_.front().trace.q;
    const RotaryAngles wanted = axes_.angles(options_.preferred.value_or(options_.start));
    std::vector<State> begun;
    for (const Candidate& c : candidates_) {
      State state{.sign = c.sign};
      state.trace.q = followed(c, wanted);
      if (!allowed(state.trace.q)) state.trace.q = unwound(c, wanted);
      if (!allowed(state.trace.q)) continue;
      state.cost.travel = plain_distance(start, state.trace.q);
      if (options_.preferred)
        state.cost.travel += kPreference * plain_distance(wanted, state.trace.q);
      begun.push_back(state);
    }
    states_ = std::move(begun);
    return std::nullopt;
  }

  // Where the last anchor can be left from: as it was come to, or after an unwinding there.
  void collect_departures() {
    departures_.clear();
    for (std::size_t p = 0; p < states_.size(); ++p) {
      const State& s = states_[p];
      departures_.push_back({{s.trace.q, static_cast<std::int32_t>(p), -1}, s.sign, s.cost});
    }
    if (free_gap_) return;
    for (const Candidate& c : previous_candidates_) {
      State best;
      for (std::size_t p = 0; p < states_.size(); ++p) {
        const State& s = states_[p];
        const RotaryAngles q = unwound(c, s.trace.q);
        if (!allowed(q)) continue;
        const Cost cost{s.cost.unwindings + 1, s.cost.travel + plain_distance(s.trace.q, q)};
        if (best.trace.parent < 0 || cost.less(best.cost)) {
          best = {{q, static_cast<std::int32_t>(p), 0}, c.sign, cost};
        }
      }
      if (best.trace.parent >= 0) departures_.push_back(best);
    }
  }

  std::optional<Diagnostic> advance(std::size_t i) {
    collect_departures();
    const double reach = options_.largest_step * static_cast<double>(i - anchors_.back().pose);
    std::vector<State> arrived;
    for (const Candidate& c : candidates_) {
      State best;
      const State* from = nullptr;
      for (const State& d : departures_) {
        RotaryAngles q = followed(c, d.trace.q);
        if (free_gap_ && !allowed(q)) q = unwound(c, d.trace.q);
        const bool near =
            std::abs(q[0] - d.trace.q[0]) <= reach && std::abs(q[1] - d.trace.q[1]) <= reach;
        if (!allowed(q) || !(free_gap_ || (near && keeps_to_path(i, d, c.sign, q)))) continue;
        const double change = c.sign == d.sign ? 0.0 : kChangeOfSign;
        const Cost cost{d.cost.unwindings, d.cost.travel + change + travel(d.trace.q, q)};
        if (from == nullptr || cost.less(best.cost)) {
          best = {{q, d.trace.parent, -1}, c.sign, cost};
          from = &d;
        }
      }
      if (from == nullptr) continue;
      if (from->trace.resume >= 0) {
        best.trace.resume = static_cast<std::int32_t>(resumptions_.size());
        resumptions_.push_back(from->trace.q);
      }
      arrived.push_back(best);
    }
    if (arrived.empty()) return no_step(i);
    states_ = std::move(arrived);
    return std::nullopt;
  }

  // Between neighbours the rotary axes run linearly. Half-way the tool axis must not be farther
  // from the path than the neighbours are: a change of the solution away from the pole would swing
  // it through the pole.
  [[nodiscard]] bool keeps_to_path(std::size_t i, const State& from, double sign,
                                   const RotaryAngles& to) const {
    if (i != anchors_.back().pose + 1) return true;  // the poses between are at the pole
    const RotaryAngles& q = from.trace.q;
    // With less than this on one solution the tool axis bulges by a sixteenth of the step at most.
    constexpr double kPlainStep = 0.5;  // rad
    const double largest = std::max(std::abs(to[0] - q[0]), std::abs(to[1] - q[1]));
    if (sign == from.sign && largest < kPlainStep) return true;
    const Vec3 &u = path_[i - 1].axis, &v = path_[i].axis;
    const double off = angle_between(axes_.tool_axis({0.5 * (q[0] + to[0]), 0.5 * (q[1] + to[1])}),
                                     (u + v).normalized());
    return off <= 0.5 * angle_between(u, v) + tolerance_;
  }

  [[nodiscard]] Diagnostic no_step(std::size_t i) const {
    return error("unwinding-needed"_id,
                 fmt::format("from pose {} to pose {} the rotary axes would have to turn through "
                             "the end of their travel, or by more than {:g} deg",
                             anchors_.back().pose, i, options_.largest_step * kDegPerRad),
                 "put poses between the two, or lift the tool off there");
  }

  // --- the way back -----------------------------------------------------------------------------

  Result<std::vector<PlannedPose>> assembled() {
    std::vector<PlannedPose> plan(path_.size());
    std::vector<RotaryAngles> at(anchors_.size());
    std::vector<std::int32_t> resumes(anchors_.size(), -1);
    std::size_t state = 0;
    for (std::size_t s = 1; s < states_.size() && !anchors_.empty(); ++s) {
      if (states_[s].cost.less(states_[state].cost)) state = s;
    }
    for (std::size_t a = anchors_.size(); a-- > 0;) {
      const Trace& trace = traces_[anchors_[a].first_trace + state];
      at[a] = trace.q;
      resumes[a] = trace.resume;
      plan[anchors_[a].pose].axes = placed(anchors_[a].pose, trace.q);
      state = static_cast<std::size_t>(std::max(trace.parent, 0));
    }
    // The poles before the first anchor, between two, and after the last.
    const RotaryAngles idle = axes_.angles(options_.preferred.value_or(options_.start));
    for (std::size_t a = 0; a <= anchors_.size(); ++a) {
      const std::size_t first = a == 0 ? 0 : anchors_[a - 1].pose + 1;
      const std::size_t last = a == anchors_.size() ? path_.size() : anchors_[a].pose;
      RotaryAngles left = anchors_.empty() ? idle : a == 0 ? at[0] : at[a - 1];
      const RotaryAngles right = a == anchors_.size() ? left : at[a];
      if (a > 0 && a < anchors_.size() && resumes[a] >= 0) {
        left = resumptions_[static_cast<std::size_t>(resumes[a])];
        plan[first].unwind = true;
        plan[first].resume = placed(first - 1, left);
      }
      if (const auto beyond = fill(plan, first, last, left, right)) return *beyond;
    }
    return plan;
  }

  [[nodiscard]] AxisPositions placed(std::size_t i, const RotaryAngles& q) const {
    return place_tip(machine_, path_[i].tip, tool_length_, axes_.with({}, q));
  }

  // Poses at the pole in [first, last): the free axis goes evenly from `left` to `right`, or turns
  // before the pose that is come to through the air.
  std::optional<Diagnostic> fill(std::vector<PlannedPose>& plan, std::size_t first,
                                 std::size_t last, const RotaryAngles& left,
                                 const RotaryAngles& right) const {
    const auto air =
        std::lower_bound(options_.through_air.begin(), options_.through_air.end(), first);
    const bool lifts = air != options_.through_air.end() && *air <= last;
    double second = left[1];
    for (std::size_t i = first; i < last; ++i) {
      const double part =
          lifts ? (i < *air ? 0.0 : 1.0)
                : static_cast<double>(i + 1 - first) / static_cast<double>(last + 1 - first);
      const double free = left[0] + part * (right[0] - left[0]);
      second = best_turn(axes_.joint(1), axes_.second_for(path_[i].axis.normalized(), free, second),
                         second);
      plan[i].axes = placed(i, {free, second});
      plan[i].singular = true;
      if (!within_travel(machine_, plan[i].axes)) {
        return at_pose(i,
                       error("axis-over-travel"_id,
                             "beyond travel at the pole: " + travel_violations_if_any(plan[i].axes),
                             "move the workpiece on the table"));
      }
    }
    return std::nullopt;
  }

  const Machine& machine_;
  std::span<const ToolPose> path_;
  double tool_length_;
  const PlanOptions& options_;
  RotaryAxes axes_;
  double tolerance_;
  std::array<bool, 2> counted_{};

  std::size_t air_ = 0;    // next entry of through_air
  bool free_gap_ = false;  // since the last anchor the tool was in the air
  double from_pole_ = 1.0, previous_from_pole_ = 1.0;
  std::array<std::vector<double>, 2> turns_{};
  std::vector<Candidate> candidates_{}, previous_candidates_{};
  std::vector<State> states_{}, departures_{};
  std::vector<Anchor> anchors_{};
  std::vector<Trace> traces_{};
  std::vector<RotaryAngles> resumptions_{};
};

}  // namespace

Result<std::vector<PlannedPose>> plan_axes(const Machine& machine, std::span<const ToolPose> path,
                                           double tool_length, const PlanOptions& options) {
  return Planner(machine, path, tool_length, options).plan();
}

}  // namespace frustum::kinematics

#include "trials/population/motion_pieces.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>
#include <variant>

#include "kinematics/model/chain.hpp"
#include "kinematics/path/approach_direction.hpp"
#include "trials/population/middle_contact.hpp"

namespace frustum::trials {
namespace {

using kinematics::ApproachProfile;
using kinematics::ApproachTracker;
using kinematics::AxisPositions;
using kinematics::AxisState;
using kinematics::BlockMotion;
using kinematics::CommandedMove;
using kinematics::ForwardChain;
using kinematics::GeometricErrors;
using kinematics::ToolPose;

// What a parabola may be off (mm): a hundredth of the nanometre that a contact is good for.
constexpr double kParabola = 2e-8;
// A block of more pieces than these, or of smaller ones than its part after so many halvings, bends
// too sharply to be followed.
constexpr std::size_t kMostPieces = 64;
constexpr int kMostHalvings = 10;

GeometricErrors all_of(const PopulationLaws& laws) {
  return laws.errors(Weights(laws.columns().size(), 1.0));
}

// At the limits of the laws, some up and some down.
Weights at_the_limits(const PopulationLaws& laws) {
  Weights weights;
  for (const ErrorColumn& column : laws.columns()) {
    weights.push_back(weights.size() % 3 == 1 ? -column.most : column.most);
  }
  return weights;
}

class PieceCutter {
 public:
  PieceCutter(const kinematics::Machine& machine, const kinematics::Setup& setup,
              const PopulationLaws& laws, LaneChain& chain)
      : machine_(machine),
        setup_(setup),
        workpiece_from_table_(setup.table_from_workpiece.inverse()),
        middle_(laws.errors(laws.middle())),
        limits_(laws.errors(at_the_limits(laws))),
        chain_(chain) {}

  void cut(std::uint32_t block, const CommandedMove& move, const ApproachProfile& approach,
           bool continues) {
    const kinematics::ToolGeometry& tool = setup_.tools.at(move.tool);
    take_tool(tool);
    MotionPieces::Block cut{block, static_cast<std::uint32_t>(out_.pieces.size()), 0, true};
    block_ = block;
    const BlockMotion& motion = move.motion;
    const auto turns = approach.turning_points();
    const auto turns_at = [&](double u) { return std::ranges::find(turns, u) != turns.end(); };
    const auto breaks = motion.breaks();
    std::vector<double> ends(turns.begin(), turns.end());
    ends.insert(ends.end(), breaks.begin(), breaks.end());
    ends.push_back(1.0);
    std::ranges::sort(ends);
    const auto leaving = [&](double u) { return AxisState(motion.at(u), approach.after(u)); };
    if (!continues) {
      last_ = add(leaving(0.0));
      follows_ = false;
    } else if (turns_at(0.0)) {
      jump_to(leaving(0.0));
    }
    double u0 = 0.0;
    for (const double u1 : ends) {
      if (u1 <= u0) continue;
      const auto state = [&](double w) {
        const double u = w == 1.0 ? u1 : u0 + w * (u1 - u0);
        const AxisPositions q = motion.at(u);
        return w == 0.0 ? out_.states[last_] : AxisState(q, approach.at(u, q));
      };
      const std::size_t before = out_.pieces.size();
      const bool is_cut = cut_between(state, 0.0, 1.0, 0);
      cut.is_smooth = cut.is_smooth && is_cut && out_.pieces.size() - before <= kMostPieces;
      if (u1 < 1.0 && turns_at(u1)) jump_to(leaving(u1));
      u0 = u1;
    }
    cut.count = static_cast<std::uint32_t>(out_.pieces.size()) - cut.first;
    out_.blocks.push_back(cut);
  }

  [[nodiscard]] MotionPieces pieces() && { return std::move(out_); }

 private:
  void take_tool(const kinematics::ToolGeometry& tool) {
    const double length = tool.length + tool.length_error;
    if (chains_ && length == length_ && tool.flute_length == reach_) return;
    length_ = length;
    reach_ = tool.flute_length;
    chains_.emplace(ForwardChain(machine_, middle_, length),
                    ForwardChain(machine_, limits_, length));
  }

  std::uint32_t add(const AxisState& state) {
    out_.states.push_back(state);
    return chain_.add(state, length_);
  }
  void append(std::uint32_t middle, std::uint32_t end) {
    out_.pieces.push_back({{last_, middle, end}, block_, follows_});
    last_ = end;
    follows_ = true;
  }

  // Errors are linear in the directions of approach: half of the jump is half way.
  void jump_to(const AxisState& after) {
    const AxisState& before = out_.states[last_];
    AxisState half = after;
    for (const auto letter : kinematics::kAxisLetters) {
      half.heading[letter] = 0.5 * (before.heading[letter] + after.heading[letter]);
    }
    const std::uint32_t middle = add(half);
    append(middle, add(after));
  }

  // From the place reached to the one at `end`; `state` over 0 to 1. Errors bend where their spans
  // end, so that parts are halved where it takes them.
  template <typename State>
  bool cut_between(const State& state, double begin, double end, int halvings) {
    const double half = 0.5 * (begin + end);
    const bool is_parabola = is_parabolic(state, begin, end);
    if (is_parabola || halvings == kMostHalvings) {
      const std::uint32_t middle = add(state(half));
      append(middle, add(state(end)));
      return is_parabola;
    }
    const bool before = cut_between(state, begin, half, halvings + 1);
    return cut_between(state, half, end, halvings + 1) && before;
  }

  template <typename State>
  bool is_parabolic(const State& state, double begin, double end) const {
    for (const ForwardChain* chain : {&chains_->first, &chains_->second}) {
      const auto pose = [&](double w) {
        return kinematics::tool_pose(workpiece_from_table_ * chain->table_from_tool(state(w)));
      };
      const double h = end - begin;
      const PoseParabola parabola{{pose(begin), pose(begin + 0.5 * h), pose(end)}};
      for (const double t : {0.25, 0.75}) {
        const ToolPose near = parabola.at(t), exact = pose(begin + t * h);
        if (!((near.tip - exact.tip).norm() + reach_ * (near.axis - exact.axis).norm() <
              kParabola)) {
          return false;
        }
      }
    }
    return true;
  }

  const kinematics::Machine& machine_;
  const kinematics::Setup& setup_;
  Pose workpiece_from_table_;
  GeometricErrors middle_, limits_;
  LaneChain& chain_;
  std::optional<std::pair<ForwardChain, ForwardChain>> chains_{};
  double length_ = 0.0, reach_ = 0.0;
  MotionPieces out_{};
  std::uint32_t block_ = 0, last_ = 0;
  bool follows_ = false;
};

}  // namespace

MotionPieces motion_pieces(const kinematics::Machine& machine, const kinematics::Setup& setup,
                           const kinematics::CommandedProgram& program, const PopulationLaws& laws,
                           std::span<const std::uint32_t> blocks, LaneChain& chain) {
  const GeometricErrors every = all_of(laws);
  ApproachTracker tracker(every);
  PieceCutter cutter(machine, setup, laws, chain);
  std::uint32_t block = 0;
  bool is_after_last = false;  // the block before is in the list, and the path goes on from it
  auto wanted = blocks.begin();
  for (const kinematics::CommandedStep& step : program.steps) {
    if (std::holds_alternative<kinematics::CommandedToolChange>(step)) is_after_last = false;
    const auto* move = std::get_if<CommandedMove>(&step);
    if (move == nullptr) continue;
    const ApproachProfile approach =
        tracker.follow([move](double u) { return move->motion.at(u); }, move->motion.least_parts());
    if (move->tool == 0) continue;
    const bool is_wanted = wanted != blocks.end() && *wanted == block;
    if (is_wanted) {
      cutter.cut(block, *move, approach, is_after_last);
      ++wanted;
    }
    is_after_last = is_wanted;
    ++block;
  }
  return std::move(cutter).pieces();
}

}  // namespace frustum::trials

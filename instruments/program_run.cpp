#include "instruments/program_run.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <deque>
#include <optional>

#include "core/constants.hpp"
#include "instruments/approach.hpp"
#include "kinematics/model/chain.hpp"
#include "kinematics/model/inverse.hpp"
#include "kinematics/path/approach_direction.hpp"
#include "kinematics/path/axis_polyline.hpp"
#include "kinematics/timing/servo_lag.hpp"

namespace frustum::instruments {
namespace {

using kinematics::ApproachTracker;
using kinematics::AxisLetter;
using kinematics::AxisPositions;
using kinematics::AxisState;
using kinematics::CommandedMove;
using kinematics::CommandedProgram;
using kinematics::CommandedRest;
using kinematics::Machine;

// mm: what the nominal distance of the balls may be off the bar where it reads. Feed-ins are longer
// by a millimetre, chords of circles shorter by nanometres.
constexpr double kOnBar = 0.02;
// mm or rad: what a rest may be off the pose that it is of. Words have a nanometre.
constexpr double kAtRest = 1e-4;

// A part of a move over which the parameter goes one way, less than a quarter turn.
struct Stretch {
  std::size_t step = 0;  // of the program
  double u0 = 0.0, u1 = 1.0;
  double from = 0.0, to = 0.0;  // parameter, running on from stretch to stretch
};
struct Pass {
  Sense sense = Sense::ccw;
  std::vector<Stretch> stretches{};
};

// A sample of a pass: where in which move.
struct Instant {
  std::size_t step = 0;
  double u = 0.0;
  std::size_t pass = 0;
  std::size_t pose = 0;
};

class PassFinder {
 public:
  PassFinder(const Machine& machine, const MotionTest& test, const TestParameter& parameter)
      : machine_(machine), test_(test), parameter_(parameter) {}

  std::vector<Pass> find(const CommandedProgram& program) {
    for (std::size_t i = 0; i < program.steps.size(); ++i) {
      const auto* move = std::get_if<CommandedMove>(&program.steps[i]);
      if (move == nullptr || move->kind != kinematics::PathKind::feed) {
        open_.reset();
        continue;
      }
      follow(i, *move);
    }
    return std::move(passes_);
  }

 private:
  [[nodiscard]] bool reads_at(const AxisPositions& q) const {
    const Vec3 tip = nominal_pose(machine_, q, test_.tool_length).translation;
    return std::abs((tip - test_.table_ball).norm() - test_.bar) < kOnBar;
  }
  void follow(std::size_t step, const CommandedMove& move) {
    const int parts = move.motion.least_parts();
    double from = parameter_.of(move.motion.start());
    bool reads = reads_at(move.motion.start());
    for (int k = 1; k <= parts; ++k) {
      const double u = static_cast<double>(k) / parts;
      const AxisPositions q = move.motion.at(u);
      const double to = parameter_.of(q);
      const bool reads_on = reads_at(q);
      double change = to - from;
      if (parameter_.repeats) change -= kTurn * std::round(change / kTurn);
      if (!reads || !reads_on) {
        open_.reset();
      } else if (change != 0.0) {
        add({step, static_cast<double>(k - 1) / parts, u, from, change});
      }
      from = to;
      reads = reads_on;
    }
  }
  // `to` of the stretch is its change.
  void add(Stretch stretch) {
    const Sense sense = stretch.to > 0.0 ? Sense::ccw : Sense::cw;
    if (open_ != sense) passes_.push_back({.sense = sense});
    open_ = sense;
    std::vector<Stretch>& stretches = passes_.back().stretches;
    if (!stretches.empty()) stretch.from = stretches.back().to;
    stretch.to += stretch.from;
    stretches.push_back(stretch);
  }

  const Machine& machine_;
  const MotionTest& test_;
  const TestParameter& parameter_;
  std::vector<Pass> passes_{};
  std::optional<Sense> open_{};
};

// Where in a stretch the parameter is `wanted`: it runs nearly evenly, so that regula falsi is
// there in a few steps.
double u_at(const CommandedMove& move, const TestParameter& parameter, const Stretch& stretch,
            double wanted) {
  double u0 = stretch.u0, u1 = stretch.u1;
  double off0 = stretch.from - wanted, off1 = stretch.to - wanted;
  constexpr double kThere = 1e-13;  // rad, mm
  if (std::abs(off0) <= kThere) return u0;
  if (std::abs(off1) <= kThere) return u1;
  double u = u0;
  for (int i = 0; i < 50; ++i) {
    u = std::clamp((u0 * off1 - u1 * off0) / (off1 - off0), u0, u1);
    double off = parameter.of(move.motion.at(u)) - wanted;
    if (parameter.repeats) off -= kTurn * std::round(off / kTurn);
    if (std::abs(off) <= kThere) return u;
    if ((off < 0.0) == (off0 < 0.0)) {
      u0 = u;
      off0 = off;
      off1 *= 0.5;  // the Illinois variant
    } else {
      u1 = u;
      off1 = off;
      off0 *= 0.5;
    }
  }
  return u;
}

Result<std::vector<Instant>> instants_of(const CommandedProgram& program, const Pass& pass,
                                         std::size_t number, const MotionTest& test,
                                         const TestParameter& parameter) {
  constexpr double kRounding = 1e-8;  // rad, mm: of the words at the ends of a capture
  const double begin = pass.stretches.front().from, end = pass.stretches.back().to;
  const auto [least, most] = std::ranges::minmax_element(test.poses, {}, &TestPose::parameter);
  // Which turn of the program the angles are of: that in the middle.
  const double middle = 0.5 * (least->parameter + most->parameter);
  const double turns =
      parameter.repeats ? kTurn * std::round((0.5 * (begin + end) - middle) / kTurn) : 0.0;
  const double w = sign_of(pass.sense);
  std::vector<std::size_t> order(test.poses.size());
  for (std::size_t i = 0; i < order.size(); ++i) order[i] = i;
  std::ranges::stable_sort(order, {}, [&](std::size_t i) { return w * test.poses[i].parameter; });
  std::vector<Instant> instants;
  auto stretch = pass.stretches.begin();
  for (const std::size_t i : order) {
    const double wanted = test.poses[i].parameter + turns;
    while (w * stretch->to < w * wanted && std::next(stretch) != pass.stretches.end()) ++stretch;
    if (w * wanted < w * begin - kRounding || w * wanted > w * end + kRounding) {
      return error("capture-short"_id,
                   fmt::format("the {} pass of the program goes from {:.6g} to {:.6g} deg and does "
                               "not come to {:.6g} deg",
                               name_of(pass.sense), (begin - turns) * kDegPerRad,
                               (end - turns) * kDegPerRad, test.poses[i].parameter * kDegPerRad),
                   "give angles within the capture of the program");
    }
    const auto& move = std::get<CommandedMove>(program.steps[stretch->step]);
    instants.push_back({stretch->step, u_at(move, parameter, *stretch, wanted), number, i});
  }
  return instants;
}

using PosesOfPasses = std::vector<std::vector<TestPose>>;

// The axes are where they are commanded to be.
void visit_commanded(const CommandedProgram& program, const kinematics::GeometricErrors& errors,
                     std::span<const Instant> instants, PosesOfPasses& poses) {
  ApproachTracker tracker(errors);
  auto next = instants.begin();
  for (std::size_t i = 0; i < program.steps.size() && next != instants.end(); ++i) {
    const auto* move = std::get_if<CommandedMove>(&program.steps[i]);
    if (move == nullptr) continue;
    const auto& motion = move->motion;
    if (!tracker.follows_any()) {
      for (; next != instants.end() && next->step == i; ++next) {
        poses[next->pass][next->pose].at = AxisState(motion.at(next->u));
      }
      continue;
    }
    const auto profile =
        tracker.follow([&motion](double u) { return motion.at(u); }, motion.least_parts());
    for (; next != instants.end() && next->step == i; ++next) {
      const AxisPositions q = motion.at(next->u);
      poses[next->pass][next->pose].at = AxisState(q, profile.at(next->u, q));
    }
  }
}

// The axes follow by the time law and their servo gains.
class LaggedRun {
 public:
  LaggedRun(const Machine& machine, const kinematics::GeometricErrors& errors,
            const CommandedProgram& program, const kinematics::TimeLawOptions& time_law,
            PosesOfPasses& poses)
      : program_(program),
        law_(machine, time_law),
        lag_(machine, program.start),
        tracker_(errors),
        poses_(poses) {}

  void run(std::span<const Instant> instants) {
    next_ = instants.begin();
    end_ = instants.end();
    for (std::size_t i = 0; i < program_.steps.size() && next_ != end_; ++i) {
      if (std::holds_alternative<CommandedMove>(program_.steps[i])) {
        plan(i);
      } else {
        const auto* wait = std::get_if<CommandedRest>(&program_.steps[i]);
        rest(wait == nullptr ? 0.0 : wait->seconds);
      }
    }
    rest(0.0);
  }

 private:
  static constexpr double kStep = 5e-4;  // s, over which a command is taken as straight
  struct Planned {
    std::size_t step = 0;
    std::vector<double> ends{};
    std::vector<kinematics::TimedSegment> segments{};
  };

  void plan(std::size_t step) {
    const auto& move = std::get<CommandedMove>(program_.steps[step]);
    Planned planned{.step = step};
    double u0 = 0.0;
    AxisPositions from = move.motion.start();
    for (const auto& part :
         kinematics::even_parts([&move](double u) { return move.motion.at(u); },
                                move.motion.least_parts(), move.motion.breaks())) {
      AxisPositions change;
      for (const AxisLetter letter : kinematics::kAxisLetters) {
        change[letter] = part.to[letter] - from[letter];
      }
      if (law_.add(change, part.unevenness, move.feed_duration * (part.end - u0),
                   planned.ends.empty())) {
        planned.ends.push_back(part.end);
        from = part.to;
        u0 = part.end;
      }
    }
    planned_.push_back(std::move(planned));
    collect();
  }
  void collect() {
    const auto deliver_complete = [&] {
      while (!planned_.empty() &&
             planned_.front().segments.size() == planned_.front().ends.size()) {
        deliver(planned_.front());
        planned_.pop_front();
      }
    };
    deliver_complete();
    while (auto segment = law_.next()) {
      planned_.front().segments.push_back(*std::move(segment));
      deliver_complete();
    }
  }
  void rest(double seconds) {
    law_.rest(0.0);
    collect();
    law_.rest(std::max(seconds, lag_.settling_time()));
    if (lag_.settling_time() > 0.0) {
      follow(lag_.commanded(), lag_.settling_time());
      lag_.settle();
    }
  }
  void deliver(const Planned& planned) {
    const auto& motion = std::get<CommandedMove>(program_.steps[planned.step]).motion;
    double begin = 0.0;
    for (std::size_t k = 0; k < planned.segments.size(); ++k) {
      const auto& segment = planned.segments[k];
      const double width = planned.ends[k] - begin;
      const auto u_of = [&](double time) { return begin + segment.share_at(time) * width; };
      double time = segment.start;
      const auto go_to = [&](double until, double u) {
        const int steps = 1 + static_cast<int>((until - time) / kStep);
        const double from = time;
        for (int i = 1; i <= steps; ++i) {
          const double at = from + (until - from) * i / steps;
          follow(motion.at(i == steps ? u : u_of(at)), (until - from) / steps);
        }
        time = until;
      };
      for (; next_ != end_ && next_->step == planned.step && next_->u <= planned.ends[k]; ++next_) {
        const double share = width > 0.0 ? (next_->u - begin) / width : 1.0;
        go_to(std::max(time, segment.time_at(std::clamp(share, 0.0, 1.0))), next_->u);
        poses_[next_->pass][next_->pose].at = AxisState(lag_.actual(), tracker_.heading());
      }
      go_to(segment.start + segment.duration, planned.ends[k]);
      begin = planned.ends[k];
    }
  }
  void follow(const AxisPositions& commanded, double seconds) {
    const AxisPositions from = lag_.actual();
    const AxisPositions to = lag_.follow(commanded, seconds);
    if (!tracker_.follows_any()) return;
    // The guides see the axes, not their commands.
    (void)tracker_.follow([from, to](double u) { return kinematics::part_way(from, to, u); }, 1);
  }

  const CommandedProgram& program_;
  kinematics::TimeLaw law_;
  kinematics::ServoLag lag_;
  ApproachTracker tracker_;
  PosesOfPasses& poses_;
  std::deque<Planned> planned_{};
  std::span<const Instant>::iterator next_{}, end_{};
};

bool is_at(const AxisPositions& q, const AxisPositions& wanted) {
  return std::ranges::all_of(kinematics::kAxisLetters, [&](AxisLetter letter) {
    return std::abs(q[letter] - wanted[letter]) < kAtRest;
  });
}

}  // namespace

TestParameter circle_parameter(const Machine& machine, const CircleTest& circle) {
  const auto [first, second] = axes_of(circle.plane);
  const AxisPositions centre = place_tip(machine, circle.centre, circle.tool_length, circle.held);
  return {[first = first, second = second, centre](const AxisPositions& q) {
    return std::atan2(q[second] - centre[second], q[first] - centre[first]);
  }};
}

TestParameter rotary_parameter(AxisLetter axis) {
  return {.of = [axis](const AxisPositions& q) { return q[axis]; }, .repeats = false};
}

TestParameter cone_parameter(const Machine& machine, const ConeTest& cone) {
  return {[&machine, cone](const AxisPositions& q) {
    const Vec3 tip = nominal_pose(machine, q, cone.tool_length).translation;
    const Vec3 upright = rotation_y(-cone.inclination) * (tip - cone.centre);
    return std::atan2(upright.y(), upright.x());
  }};
}

Result<PosesOfPasses> bar_passes(const Machine& machine, const kinematics::GeometricErrors& errors,
                                 const CommandedProgram& program, const MotionTest& test,
                                 const TestParameter& parameter, std::span<const Sense> senses,
                                 const ProgramRunOptions& options) {
  const std::vector<Pass> passes = PassFinder(machine, test, parameter).find(program);
  std::vector<Instant> instants;
  PosesOfPasses poses;
  for (const Sense sense : senses) {
    // Not what an axis makes while it finds its place.
    constexpr double kLeast = 1e-3;
    const auto pass = std::ranges::find_if(passes, [&](const Pass& each) {
      return each.sense == sense &&
             std::abs(each.stretches.back().to - each.stretches.front().from) > kLeast;
    });
    if (pass == passes.end()) {
      return error("program-without-test"_id,
                   fmt::format("the program has no {} pass on which the balls are {:.6g} mm apart",
                               name_of(sense), test.bar),
                   "check the place of the table ball, the length of the bar, the work offset and "
                   "the length of the tool");
    }
    auto found = instants_of(program, *pass, poses.size(), test, parameter);
    if (!found) return found.error();
    instants.insert(instants.end(), found->begin(), found->end());
    poses.push_back(test.poses);
  }
  std::ranges::stable_sort(instants, [](const Instant& a, const Instant& b) {
    return a.step < b.step || (a.step == b.step && a.u < b.u);
  });
  if (options.servo_lag) {
    LaggedRun(machine, errors, program, options.time_law, poses).run(instants);
  } else {
    visit_commanded(program, errors, instants, poses);
  }
  return poses;
}

Result<std::vector<TestPose>> rests_at(const kinematics::GeometricErrors& errors,
                                       const CommandedProgram& program,
                                       std::span<const TestPose> wanted) {
  ApproachTracker tracker(errors);
  AxisPositions at = program.start;
  std::vector<TestPose> found;
  for (const auto& step : program.steps) {
    if (const auto* move = std::get_if<CommandedMove>(&step)) {
      const auto& motion = move->motion;
      if (tracker.follows_any()) {
        (void)tracker.follow([&motion](double u) { return motion.at(u); }, motion.least_parts());
      }
      at = motion.end();
      continue;
    }
    const auto* wait = std::get_if<CommandedRest>(&step);
    if (wait == nullptr || wait->seconds <= 0.0 || found.size() == wanted.size()) continue;
    if (!is_at(at, wanted[found.size()].at.q)) continue;
    found.push_back(wanted[found.size()]);
    found.back().at = AxisState(at, tracker.heading());
  }
  if (found.size() == wanted.size()) return found;
  return error("program-without-test"_id,
               fmt::format("the axes rest at {} of the {} poses of the test, in their order",
                           found.size(), wanted.size()),
               "a dwell at each pose is what the instrument reads at");
}

}  // namespace frustum::instruments

#include "dynamics/path_response.hpp"

#include <algorithm>
#include <cmath>
#include <variant>

#include "dynamics/body_reader.hpp"
#include "dynamics/inertial_load.hpp"
#include "dynamics/servo.hpp"
#include "dynamics/static_chain.hpp"
#include "dynamics/time_step.hpp"

namespace frustum::dynamics {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;
using kinematics::AxisPositions;
using kinematics::kAxisLetters;

TipDeviation in_table(const Structure& s, const Row6& tip) {
  return {s.machine_from_table.transpose() * tip.head<3>(),
          s.machine_from_table.transpose() * tip.tail<3>()};
}

bool has_moved(const AxisPositions& from, const AxisPositions& to, const RenewalDistance& least) {
  return std::ranges::any_of(kAxisLetters, [&](auto letter) {
    return std::abs(to[letter] - from[letter]) > (is_rotary(letter) ? least.rotary : least.linear);
  });
}

// In SI, in the order of the model.
VectorXd axis_rates(const DynamicModel& model, const AxisPositions& rates) {
  VectorXd si(static_cast<Index>(model.axes.size()));
  for (std::size_t k = 0; k < model.axes.size(); ++k) {
    const kinematics::Joint& joint = model.axes[k].joint;
    si[static_cast<Index>(k)] = rates[joint.letter] * (joint.rotary() ? 1.0 : kMetresPerMm);
  }
  return si;
}

// What the deviations are, whatever the coordinates of the state.
struct Deviation {
  VectorXd positions{}, velocities{}, integrals{};
};

// The matrices of one stretch of the way.
class Stretch {
 public:
  Stretch(const DynamicModel& model, const AxisPositions& middle, double tool_length, double step,
          std::size_t steps)
      : system_(servo_system(model, middle, tool_length)), space_(state_space(system_)) {
    // The matrices of a step cost as much as about so many steps by the series.
    constexpr std::size_t kMany = 100;
    if (steps > kMany) {
      step_.emplace<TimeStep>(space_.matrix, step);
    } else {
      step_.emplace<SeriesStep>(space_.matrix, system_.coordinates(), step);
    }
  }

  [[nodiscard]] VectorXd begin(const Deviation& from) const {
    if (from.positions.size() == 0) return VectorXd::Zero(space_.matrix.rows());
    return space_.from_positions * from.positions + space_.from_velocities * from.velocities +
           space_.from_integrals * from.integrals;
  }
  [[nodiscard]] Deviation end(const VectorXd& state) const {
    return {space_.positions * state, space_.velocities * state, space_.integrals * state};
  }
  [[nodiscard]] VectorXd positions(const VectorXd& state) const { return space_.positions * state; }
  [[nodiscard]] VectorXd input(const DynamicModel& model, const VectorXd& load,
                               const MotionSample& sample) const {
    return input_of(system_, space_, load, axis_rates(model, sample.velocity),
                    axis_rates(model, sample.acceleration));
  }
  [[nodiscard]] VectorXd next(const VectorXd& state, const VectorXd& before,
                              const VectorXd& after) const {
    if (const auto* by_matrices = std::get_if<TimeStep>(&step_)) {
      return (*by_matrices)(state, before, after);
    }
    return std::get<SeriesStep>(step_)(state, before, after);
  }

 private:
  ServoSystem system_;
  StateSpace space_;
  std::variant<std::monostate, TimeStep, SeriesStep> step_{};
};

// The first sample to which an axis has moved far enough from `from`; the last one otherwise.
std::size_t stretch_end(std::span<const MotionSample> samples, std::size_t from,
                        const RenewalDistance& renewal) {
  std::size_t end = from + 1;
  while (end + 1 < samples.size() &&
         !has_moved(samples[from].position, samples[end].position, renewal)) {
    ++end;
  }
  return end;
}

// The tool less the workpiece, each moved by its body.
Row6 tip_of(const DynamicModel& model, const Structure& s, const VectorXd& x) {
  const auto at_tip = [&](std::size_t body) {
    const auto motion = x.segment<6>(6 * static_cast<Index>(body));
    const Vec3 arm = s.tip_in_machine - s.bodies[body].centre;
    Row6 tip = motion;
    tip.head<3>() += Vec3(motion.tail<3>()).cross(arm);
    return tip;
  };
  const Row6 tool = at_tip(model.tool_axes);
  if (model.has_work_chain()) return tool - at_tip(model.axes.size());
  return model.workpiece_on_ground ? tool : Row6(tool - at_tip(0));
}

}  // namespace

std::vector<MotionSample> with_rates(std::span<const AxisPositions> positions, double step) {
  std::vector<MotionSample> samples(positions.size());
  for (std::size_t i = 0; i < positions.size(); ++i) {
    const AxisPositions& here = positions[i];
    const AxisPositions& before = positions[i == 0 ? 0 : i - 1];
    const AxisPositions& after = positions[std::min(i + 1, positions.size() - 1)];
    samples[i].position = here;
    for (const auto letter : kAxisLetters) {
      samples[i].velocity[letter] = (after[letter] - before[letter]) / (2.0 * step);
      samples[i].acceleration[letter] =
          ((after[letter] - here[letter]) - (here[letter] - before[letter])) / (step * step);
    }
  }
  return samples;
}

std::vector<TipDeviation> quasi_static_deviations(const DynamicModel& model,
                                                  std::span<const MotionSample> samples,
                                                  double tool_length) {
  std::vector<TipDeviation> deviations;
  deviations.reserve(samples.size());
  for (const MotionSample& sample : samples) {
    const Structure s = layout_at(model, sample.position, tool_length);
    const VectorXd load = inertial_load(model, s, sample.velocity, sample.acceleration);
    deviations.push_back(in_table(s, static_tip(model, s, load)));
  }
  return deviations;
}

std::vector<TipDeviation> linear_deviations(const DynamicModel& model,
                                            std::span<const MotionSample> samples, double step,
                                            double tool_length, const RenewalDistance& renewal) {
  std::vector<TipDeviation> deviations;
  if (samples.empty()) return deviations;
  deviations.reserve(samples.size());
  deviations.emplace_back();
  const auto layout = [&](const MotionSample& sample) {
    return layout_at(model, sample.position, tool_length);
  };
  const auto load_of = [&](const Structure& s, const MotionSample& sample) {
    return inertial_load(model, s, sample.velocity, sample.acceleration);
  };
  VectorXd load = load_of(layout(samples.front()), samples.front());
  Deviation carried;
  for (std::size_t from = 0; from + 1 < samples.size();) {
    const std::size_t to = stretch_end(samples, from, renewal);
    const Stretch stretch(model, samples[(from + to) / 2].position, tool_length, step, to - from);
    VectorXd state = stretch.begin(carried);
    VectorXd before = stretch.input(model, load, samples[from]);
    for (std::size_t i = from + 1; i <= to; ++i) {
      const Structure s = layout(samples[i]);
      load = load_of(s, samples[i]);
      VectorXd after = stretch.input(model, load, samples[i]);
      state = stretch.next(state, before, after);
      before = std::move(after);
      deviations.push_back(in_table(s, tip_of(model, s, stretch.positions(state))));
    }
    carried = stretch.end(state);
    from = to;
  }
  return deviations;
}

}  // namespace frustum::dynamics

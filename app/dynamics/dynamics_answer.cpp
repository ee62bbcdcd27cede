#include "app/dynamics/dynamics_answer.hpp"

#include <fmt/format.h>

#include <cmath>

#include "core/linear_algebra.hpp"
#include "dynamics/inertial_load.hpp"

namespace frustum::app {
namespace {

using dynamics::DynamicModel;
using dynamics::ServoSystem;
using dynamics::Structure;

constexpr double kHighestPeak = 1000.0;  // Hz: above it a rigid body is no model of a machine part

RatesAnswer answer_rates(const DynamicModel& model, const Structure& s, const RatesRequest& rates) {
  const Eigen::VectorXd tip =
      s.tip * SymmetricFactors(s.stiffness)
                  .solve(inertial_load(model, s, rates.velocity, rates.acceleration));
  const Mat3 table_from_machine = s.machine_from_table.transpose();
  return {tip.head<3>(), table_from_machine * tip.head<3>(), table_from_machine * tip.tail<3>()};
}

FrequencyAnswer answer_frequency(const DynamicModel& model, const Structure& s,
                                 const ServoSystem& servo, const Eigen::MatrixXcd& loads,
                                 double frequency) {
  const dynamics::HarmonicSystem springs = harmonic_system(s, frequency);
  Eigen::MatrixXcd all_loads(loads.rows(), 3 + loads.cols());
  all_loads << springs.tip.transpose().cast<std::complex<double>>(), loads;
  const Eigen::Matrix3Xcd answers = tip_response(springs, all_loads);
  FrequencyAnswer answer{.frequency = frequency,
                         .compliance = answers.leftCols(3),
                         .inertial = answers.rightCols(loads.cols())};
  if (!model.is_controlled()) return answer;
  answer.compliance = tip_compliance(harmonic_system(servo, frequency));
  answer.tracking = tracking_deviation(servo, frequency);
  return answer;
}

}  // namespace

Result<DynamicsAnswer> answer_dynamics(const DynamicModel& model, const DynamicsRequest& request) {
  const Structure s = structure_at(model, request.axes, request.tool_length);
  if (const auto loose = loose_body(model, s)) return loose->problem;
  const ServoSystem servo = servo_system(model, request.axes, request.tool_length);
  if (const auto unstable = instability(model, servo)) return *unstable;
  DynamicsAnswer answer{.tip_in_machine = s.tip_in_machine,
                        .coordinates = s.coordinates(),
                        .bodies = s.bodies,
                        .modes = undamped_modes(s),
                        .damped = damped_modes(s),
                        .rest = static_response(model, s)};
  for (Eigen::Index m = 0; m < answer.coordinates; ++m) {
    answer.places.push_back(place_of_mode(s, answer.modes.shapes.col(m)));
  }
  const double highest = answer.modes.frequencies[answer.coordinates - 1];
  answer.peaks = dominant_peaks(s, std::min(kHighestPeak, highest + 2.0));
  if (model.is_controlled()) answer.control = ControlAnswer{servo.states(), poles_of(servo)};
  const Eigen::MatrixXcd loads = unit_acceleration_loads(model, s).cast<std::complex<double>>();
  for (const double f : request.frequencies) {
    answer.frequencies.push_back(answer_frequency(model, s, servo, loads, f));
  }
  if (request.rates) answer.rates = answer_rates(model, s, *request.rates);
  if (request.circle) {
    const CircleRequest& c = *request.circle;
    answer.circle = harmonic_circle(servo, s, c.first, c.second, c.radius, c.speed);
  }
  if (request.move) {
    answer.move = jerk_move(model, request.axes, request.tool_length, request.move->axis,
                            request.move->limits);
  }
  if (request.map) {
    auto map = map_workspace(model, request.axes, request.tool_length, request.map->rows,
                             request.map->columns, request.map->quantity);
    if (!map) return map.error();
    answer.map = *std::move(map);
  }
  return answer;
}

std::vector<ComparedRow> compare_inertial(const DynamicModel& first, const DynamicsAnswer& of_first,
                                          const DynamicModel& second,
                                          const DynamicsAnswer& of_second) {
  std::vector<ComparedRow> rows;
  for (const auto letter : kinematics::kLinearAxes) {
    const auto a = first.axis(letter), b = second.axis(letter);
    if (!a || !b) continue;
    for (Eigen::Index i = 0; i < 3; ++i) {
      const auto value = [&](const DynamicsAnswer& of, const DynamicModel& model, std::size_t k) {
        return std::abs(of.rest.inertial(i, static_cast<Eigen::Index>(k))) *
               dynamics::inertial_scale(model.axes[k].joint);
      };
      ComparedRow row{fmt::format("H{}/{}", "xyz"[i], to_char(letter)), value(of_first, first, *a),
                      value(of_second, second, *b), std::nullopt};
      // Rounding, where a symmetry leaves nothing.
      constexpr double kNothing = 1e-9;  // um/gn
      if (row.first > kNothing) row.change = 100.0 * (row.second - row.first) / row.first;
      rows.push_back(row);
    }
  }
  return rows;
}

}  // namespace frustum::app

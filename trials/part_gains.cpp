#include "trials/part_gains.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "kinematics/errors/error_gain.hpp"
#include "trials/surface_gain.hpp"

namespace frustum::trials {
namespace {

using kinematics::Machine;

// How far the readings of the machine itself rise with each parameter: rows of touches.
Eigen::MatrixXd probing_moves(const Machine& machine, const programs::TestPiece& piece,
                              const PartTouches& plan, const PartReadings& nominal,
                              const PartProbe& probe, std::span<const Parameter> parameters) {
  const Pose workpiece_from_table = piece.placement.table_from_workpiece().inverse();
  Eigen::MatrixXd moves = Eigen::MatrixXd::Zero(static_cast<Eigen::Index>(plan.touches.size()),
                                                static_cast<Eigen::Index>(parameters.size()));
  for (std::size_t t = 0; t < plan.touches.size(); ++t) {
    for (std::size_t k = 0; k < parameters.size(); ++k) {
      if (!parameters[k].unit) continue;
      const auto moved =
          first_order_displacement(machine, *parameters[k].unit, nominal.at[t], probe.tool_length);
      moves(static_cast<Eigen::Index>(t), static_cast<Eigen::Index>(k)) =
          -plan.touches[t].normal.dot(workpiece_from_table.direction(
              moved.at(nominal_pose(machine, nominal.at[t].q, probe.tool_length)
                           .direction(probe.ball_off))));
    }
  }
  return moves;
}

Eigen::MatrixXd response(const Sensitivity& s) { return s.odd.cwiseAbs() + s.even.cwiseAbs(); }

}  // namespace

Result<std::vector<Parameter>> part_parameters(const Machine& machine,
                                               const kinematics::AxisSpans& spans) {
  std::vector<std::string> names;
  std::vector<Parameter> linear;
  for (const kinematics::ErrorName& error : machine.error_names()) {
    if (error.location) {
      names.push_back(error.text());
      continue;
    }
    const bool angular = is_rotation(error.direction);
    const std::string written = angular ? "linear 1000000urad" : "linear 1mm";
    const auto entry = kinematics::parse_error(error.text() + "=" + written);
    if (!entry) return entry.error();
    auto unit = kinematics::resolve(machine, std::span(&*entry, 1), spans);
    if (!unit) return unit.error();
    linear.push_back({error.text() + " linear", angular, *std::move(unit)});
  }
  names.emplace_back(kToolRadius);
  auto parameters = parameters_named(machine, names);
  if (!parameters) return parameters;
  for (Parameter& each : linear) parameters->push_back(std::move(each));
  return parameters;
}

Result<PartGains> part_gains(const Machine& machine, const programs::TestPiece& piece,
                             const CommandedPiece& commanded, const PartTouches& plan,
                             const PartProbe& probe, std::span<const Parameter> parameters,
                             const TrialOptions& options) {
  // Forms answer by what they are besides the facets of the program, some tenths of a micrometre.
  constexpr DifferenceSteps kSteps{2e-2, 2e-5};
  const kinematics::GeometricErrors none;
  const auto trial = clean_trial(machine, none, piece, commanded, options);
  if (!trial) return trial.error();
  const auto nominal = part_readings(machine, none, piece, *trial->workpiece, plan, probe);
  if (!nominal) return nominal.error();
  auto gains = surface_gains(machine, piece, *trial, parameters);
  if (!gains) return gains.error();
  const auto on_cmm = sensitivity_of_moves(piece, trial->measurement, *gains, parameters, kSteps);
  if (!on_cmm) return on_cmm.error();
  gains->odd += probing_moves(machine, piece, plan, *nominal, probe, parameters);
  const auto on_machine =
      sensitivity_of_moves(piece, trial->measurement, *gains, parameters, kSteps);
  if (!on_machine) return on_machine.error();
  PartGains found{.parameters = {parameters.begin(), parameters.end()},
                  .on_cmm = response(*on_cmm),
                  .on_machine = response(*on_machine)};
  for (const auto& characteristic : trial->measurement.characteristics) {
    found.characteristics.push_back(characteristic.name);
    found.angular.push_back(metrology::is_angle(characteristic));
  }
  return found;
}

FateOfError fate_of(const PartGains& gains, std::size_t parameter) {
  constexpr double kHalf = 0.5, kMore = 1.5;
  const auto k = static_cast<Eigen::Index>(parameter);
  FateOfError found;
  bool grows = false, falls = false;
  for (std::size_t c = 0; c < gains.characteristics.size(); ++c) {
    const auto row = static_cast<Eigen::Index>(c);
    // In um, urad per um, urad.
    const double factor = (gains.angular[c] ? kUradPerRad : kUmPerMm) /
                          (gains.parameters[parameter].angular ? kUradPerRad : kUmPerMm);
    const double there = gains.on_cmm(row, k) * factor, here = gains.on_machine(row, k) * factor;
    if (std::max(there, here) < kActs) continue;
    if (here < kCancels * there) {
      found.cancelled.push_back(c);
      continue;
    }
    found.kept.push_back(c);
    grows = grows || here > kMore * there;
    falls = falls || here < kHalf * there;
  }
  if (found.kept.empty()) {
    found.fate = found.cancelled.empty() ? ErrorFate::nothing : ErrorFate::cancels;
  } else if (!found.cancelled.empty() || falls) {
    found.fate = ErrorFate::in_part;
  } else {
    found.fate = grows ? ErrorFate::grows : ErrorFate::stays;
  }
  return found;
}

}  // namespace frustum::trials

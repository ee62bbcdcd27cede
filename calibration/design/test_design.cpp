#include "calibration/design/test_design.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <set>

#include "core/spelling.hpp"

namespace frustum::calibration {
namespace {

constexpr double kSecondsPerHour = 3600.0;

// Rows below those that are there, which share no noise with them; columns that they lack are zero.
void append(Observations& all, const Observations& more) {
  const Eigen::Index before = all.gain.rows(), count = more.gain.rows();
  const auto unknowns = static_cast<Eigen::Index>(all.unknowns.size());
  all.rows.insert(all.rows.end(), more.rows.begin(), more.rows.end());
  all.gain.conservativeResize(before + count, unknowns);
  all.gain.bottomRows(count).setZero();
  all.gain.block(before, 0, count, more.gain.cols()) = more.gain;
  Eigen::MatrixXd covariance = Eigen::MatrixXd::Zero(before + count, before + count);
  covariance.topLeftCorner(before, before) = all.covariance;
  covariance.bottomRightCorner(count, count) = more.covariance;
  all.covariance = std::move(covariance);
  all.values = Eigen::VectorXd::Zero(before + count);
}

DesignBlock block_of(const std::string& name, Eigen::Index first, Eigen::Index count) {
  DesignBlock block{.name = name};
  for (Eigen::Index i = 0; i < count; ++i) block.rows.push_back(first + i);
  return block;
}

// Both halves of what is stated for all of it.
Hours hours_of(const Hours& computed, const std::optional<double>& stated) {
  if (!stated || !(computed.all() > 0.0)) return stated ? Hours{*stated, 0.0} : computed;
  const double share = *stated / computed.all();
  return {computed.machine * share, computed.cmm * share};
}

// Everything that can be chosen, with its rows.
struct Catalogue {
  Observations observations{};
  std::vector<DesignBlock> blocks{};
  std::vector<Hours> hours{};
};

std::optional<Diagnostics> add_pieces(Catalogue& catalogue, const kinematics::Machine& machine,
                                      const std::vector<CandidatePiece>& pieces,
                                      const std::vector<Unknown>& unknowns,
                                      const std::vector<Cause>& causes, const WorkingTimes& times) {
  for (std::size_t i = 0; i < pieces.size(); ++i) {
    const auto found = planned_observations(machine, pieces[i].planned, i, unknowns, causes);
    if (!found) return found.error();
    catalogue.blocks.push_back(block_of(pieces[i].planned.piece.name,
                                        catalogue.observations.gain.rows(),
                                        found->observations.gain.rows()));
    append(catalogue.observations, found->observations);
    const Hours computed{
        times.piece_setup + found->cutting_time / kSecondsPerHour,
        times.cmm_setup + times.touch * static_cast<double>(found->touches) / kSecondsPerHour};
    catalogue.hours.push_back(hours_of(computed, pieces[i].hours));
  }
  return std::nullopt;
}

std::optional<Diagnostics> add_motions(Catalogue& catalogue, const kinematics::Machine& machine,
                                       const std::vector<CandidateMotion>& motions,
                                       const std::vector<Cause>& causes,
                                       const WorkingTimes& times) {
  if (motions.empty()) return std::nullopt;
  std::vector<MeasuredMotion> all;
  for (const CandidateMotion& each : motions) all.push_back(each.motion);
  const auto found = observations_of(machine, all, catalogue.observations.unknowns, causes);
  if (!found) return found.error();
  const Eigen::Index before = catalogue.observations.gain.rows();
  const auto& rows = found->observations.rows;
  for (std::size_t i = 0; i < rows.size(); ++i) {
    const bool is_new = i == 0 || rows[i].group != rows[i - 1].group;
    if (is_new) catalogue.blocks.push_back({.name = rows[i].group});
    catalogue.blocks.back().rows.push_back(before + static_cast<Eigen::Index>(i));
    if (!is_new) continue;
    const auto stated = std::ranges::find(motions, rows[i].group,
                                          [](const auto& each) { return each.motion.name; });
    catalogue.hours.push_back(
        hours_of({times.test_setup, 0.0}, stated == motions.end() ? std::nullopt : stated->hours));
  }
  append(catalogue.observations, found->observations);
  return std::nullopt;
}

std::optional<Diagnostic> same_names(const std::vector<std::string>& names) {
  std::set<std::string> seen;
  for (const std::string& name : names) {
    if (seen.insert(name).second) continue;
    return error("given-twice"_id, fmt::format("two pieces or tests are called '{}'", name),
                 "give each a name of its own: name = \"..\"");
  }
  return std::nullopt;
}

}  // namespace

Result<TestDesign> test_design(const kinematics::Machine& machine,
                               const std::vector<CandidatePiece>& pieces,
                               const std::vector<CandidateMotion>& motions,
                               std::vector<Unknown> unknowns, const std::vector<Cause>& causes,
                               const WorkingTimes& times, const TestDesignOptions& options) {
  const std::vector<Unknown> of_pieces = unknowns;
  std::vector<MeasuredMotion> tests;
  for (const CandidateMotion& each : motions) tests.push_back(each.motion);
  for (Unknown& ball : ball_unknowns(tests)) unknowns.push_back(std::move(ball));
  TestDesign design{.unknowns = unknowns};
  Catalogue catalogue{.observations = {.unknowns = unknowns}};
  if (auto problem = add_pieces(catalogue, machine, pieces, of_pieces, causes, times)) {
    return *std::move(problem);
  }
  if (auto problem = add_motions(catalogue, machine, motions, causes, times)) {
    return *std::move(problem);
  }
  for (const DesignBlock& block : catalogue.blocks) design.tests.push_back(block.name);
  if (auto problem = same_names(design.tests)) return *std::move(problem);
  DesignOptions choice{.criterion = options.criterion, .budget = options.budget};
  for (std::size_t k = 0; k < unknowns.size(); ++k) {
    const bool is_machines = k < causes.size() && causes[k].parameter.unit.has_value();
    if (!is_machines) choice.no_interest.push_back(k);
  }
  for (const Hours& hours : catalogue.hours) choice.costs.push_back(hours.all());
  for (const std::string& name : options.required) {
    const auto at = std::ranges::find(design.tests, name);
    if (at == design.tests.end()) {
      return error("unknown-test"_id, fmt::format("the study has no test '{}'", name),
                   suggestion(name, design.tests));
    }
    choice.required.push_back(static_cast<std::size_t>(at - design.tests.begin()));
  }
  for (const Unknown& unknown : unknowns) {
    const auto limit = options.limits.find(unknown.name);
    choice.limits.push_back(limit == options.limits.end() ? std::optional<double>()
                                                          : std::optional(limit->second));
  }
  auto result = calibration::design(catalogue.observations, catalogue.blocks, choice);
  if (!result) return std::move(result).error();
  design.hours = std::move(catalogue.hours);
  design.result = *std::move(result);
  if (const auto seen = observability(catalogue.observations)) {
    design.null_space = seen->null_space;
  }
  return design;
}

}  // namespace frustum::calibration

#include "trials/population/population.hpp"

#include <fmt/format.h>
#include <oneapi/tbb/enumerable_thread_specific.h>
#include <oneapi/tbb/parallel_for.h>

#include <algorithm>
#include <optional>
#include <utility>

#include "metrology/plan/strategy.hpp"
#include "trials/population/draw_block.hpp"
#include "trials/sensitivity.hpp"

namespace frustum::trials {

using kinematics::Machine;
using programs::TestPiece;

struct Population::State {
  PopulationCommon common;
};

namespace {

void count(std::vector<Population::Reason>& reasons, const std::string& why) {
  const auto known = std::ranges::find(reasons, why, &Population::Reason::why);
  if (known != reasons.end()) {
    ++known->points;
  } else {
    reasons.push_back({why, 1});
  }
}

// Points that no draw can follow or sweep near by, by their reasons.
std::optional<Diagnostic> asked_whole(const FollowPlan& plan) {
  std::vector<Population::Reason> reasons;
  for (const FollowedPoint& point : plan.points) {
    if (!point.why_not.empty() && point.surroundings.empty()) count(reasons, point.why_not);
  }
  if (reasons.empty()) return std::nullopt;
  std::string text;
  for (const Population::Reason& reason : reasons) {
    text += fmt::format("{}{} ({} {})", text.empty() ? "" : "; ", reason.why, reason.points,
                        reason.points == 1 ? "point" : "points");
  }
  return error("population-whole"_id,
               "points of the plan cannot be followed from machine to machine: " + text,
               "a trial of the whole program for each machine");
}

}  // namespace

Result<Population> Population::make(const Machine& machine, const TestPiece& piece,
                                    const CommandedPiece& commanded, const PopulationLaws& laws,
                                    const PopulationOptions& options) {
  auto state = std::make_shared<State>(State{{machine, piece, commanded, laws, options}});
  PopulationCommon& common = state->common;
  TrialOptions quiet;
  quiet.find_collisions = false;
  auto middle = run_trial(machine, laws.errors(laws.middle()), piece, commanded, {}, quiet);
  if (!middle) return std::move(middle).error();
  common.middle = *std::move(middle);
  for (const auto& feature : piece.plan.features) {
    common.planned.push_back(metrology::planned_points(feature));
  }
  common.middle_weights = laws.middle();
  for (const ErrorColumn& column : laws.columns()) {
    common.limits.push_back(column.most - std::abs(column.middle));
  }
  common.plan = follow_plan(machine, piece, commanded, common.laws, common.middle,
                            options.refuse_whole ? FollowScope::all : FollowScope::what_can_be);
  if (options.refuse_whole) {
    if (auto refusal = asked_whole(common.plan)) return *std::move(refusal);
  }
  if (!options.follow) {
    for (FollowedPoint& point : common.plan.points) {
      point = {};
      point.why_not = "following is switched off";
    }
    common.plan.windows.clear();
    common.plan.window_nodes.clear();
  }
  return Population(std::move(state));
}

std::vector<PopulationMember> Population::evaluate(std::span<const Weights> draws,
                                                   const EvaluateOptions& options) const {
  std::vector<PopulationMember> members(draws.size());
  tbb::enumerable_thread_specific<DrawScratch> scratch;
  const std::size_t blocks = (draws.size() + kLanes - 1) / kLanes;
  tbb::parallel_for(std::size_t{0}, blocks, [&](std::size_t b) {
    const std::size_t first = b * kLanes, count = std::min(kLanes, draws.size() - first);
    std::vector<metrology::CmmModel> cmms;
    for (std::size_t i = first; options.cmm && i < first + count; ++i) {
      cmms.push_back(options.cmm(i));
    }
    DrawBlock block(state_->common, draws.subspan(first, count), scratch.local());
    block.evaluate(cmms, options.travels, std::span(members).subspan(first, count));
  });
  return members;
}

const Trial& Population::middle_trial() const { return state_->common.middle; }
const PopulationLaws& Population::laws() const { return state_->common.laws; }
std::size_t Population::point_count() const { return state_->common.plan.points.size(); }

Result<SurfaceGains> Population::gains() const {
  std::vector<Parameter> columns;
  for (const ErrorColumn& column : state_->common.laws.columns()) {
    columns.push_back({column.error, column.angular, column.unit});
  }
  return surface_gains(state_->common.machine, state_->common.piece, state_->common.middle,
                       columns);
}

Result<std::vector<double>> Population::evaluate_moved(std::span<const double> moved) const {
  const metrology::Measurement& middle = state_->common.middle.measurement;
  std::vector<metrology::FeaturePoints> features;
  auto by = moved.begin();
  for (const metrology::MeasuredFeature& feature : middle.features) {
    metrology::FeaturePoints points{feature.name, {}, {}};
    for (const metrology::MeasuredPoint& p : feature.points) {
      points.points.push_back(middle.workpiece_from_datum.point(p.point + *by++ * p.normal));
      points.sections.push_back(p.section);
    }
    features.push_back(std::move(points));
  }
  const auto evaluated = metrology::evaluate(state_->common.piece.plan, features);
  if (!evaluated) return evaluated.error();
  const Eigen::VectorXd values = values_of(*evaluated);
  return std::vector<double>(values.begin(), values.end());
}

std::vector<Population::Reason> Population::reasons() const {
  std::vector<Reason> reasons;
  for (const FollowedPoint& point : state_->common.plan.points) {
    if (!point.why_not.empty()) count(reasons, point.why_not);
  }
  return reasons;
}

}  // namespace frustum::trials

#include "trials/population/draw_block.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "metrology/characteristic/datum_system.hpp"
#include "metrology/characteristic/measured_values.hpp"
#include "metrology/cmm.hpp"
#include "trials/population/edge_contact.hpp"
#include "trials/population/lane_kernel.hpp"
#include "trials/sensitivity.hpp"

namespace frustum::trials {
namespace {

using metrology::BallApproach;
using metrology::BallContact;
using metrology::ContactState;
using metrology::FittedFeature;

// How far a draw is from the middle of its laws, of their limits.
double scale_of(const PopulationCommon& common, const Weights& draw) {
  double scale = 0.0;
  for (std::size_t j = 0; j < draw.size(); ++j) {
    const double off = std::abs(draw[j] - common.middle_weights[j]);
    if (off == 0.0) continue;
    scale = std::max(scale, common.limits[j] > 0.0 ? off / common.limits[j]
                                                   : std::numeric_limits<double>::infinity());
  }
  return scale;
}

void set(LaneVec3& to, std::size_t lane, const Vec3& v) {
  to.x.of[lane] = v.x();
  to.y.of[lane] = v.y();
  to.z.of[lane] = v.z();
}
Vec3 lane_of(const LaneVec3& v, std::size_t lane) {
  return {v.x.of[lane], v.y.of[lane], v.z.of[lane]};
}

// The blank before any cut.
class BlankProbe {
 public:
  explicit BlankProbe(const stock::Workpiece& workpiece) : workpiece_(workpiece) {}
  [[nodiscard]] std::optional<metrology::Touch> touch(const Vec3& start, const UnitVec3& direction,
                                                      double length_mm) const {
    const auto surface = workpiece_.first_surface({start, direction}, {0.0, length_mm}, 0);
    if (!surface) return std::nullopt;
    return metrology::Touch{surface->point, surface->normal, {}};
  }

 private:
  const stock::Workpiece& workpiece_;
};

}  // namespace

DrawBlock::DrawBlock(const PopulationCommon& common, std::span<const Weights> draws,
                     DrawScratch& scratch)
    : common_(common),
      draws_(draws),
      scratch_(scratch),
      machines_(common.plan.chain->machines(draws)),
      known_(common.plan.chain->size(), false),
      lanes_(draws.size()) {
  scratch_.poses.resize(common.plan.chain->size());
  scratch_.contacts.resize(common.plan.windows.size());
  common_.plan.chain->find(machines_, common.plan.window_nodes, scratch_.poses);
  for (const std::uint32_t node : common.plan.window_nodes) known_[node] = true;
}

void DrawBlock::evaluate(std::span<const metrology::CmmModel> cmms, bool travels,
                         std::span<PopulationMember> members) {
  const metrology::InspectionPlan& plan = common_.piece.plan;
  for (std::size_t i = 0; i < lanes_.size(); ++i) {
    Lane& lane = lanes_[i];
    lane.member = &members[i];
    lane.scale = scale_of(common_, draws_[i]);
    lane.cmm.emplace(cmms.empty() ? metrology::CmmModel{} : cmms[i]);
    lane.travels.resize(plan.features.size());
    lane.probed_in.resize(plan.features.size());
    lane.features.resize(plan.features.size());
  }
  align();
  for (std::size_t f = 0; f < plan.features.size(); ++f) {
    if (!is_datum_feature(plan, plan.features[f])) probe(f);
  }
  for (Lane& lane : lanes_) {
    if (lane.is_done) continue;
    std::vector<FittedFeature> features;
    for (auto& feature : lane.features) features.push_back(*std::move(feature));
    const auto measurement = metrology::evaluated_values(plan, std::move(features));
    if (!measurement) {
      lane.member->failure = measurement.error();
      continue;
    }
    const Eigen::VectorXd values = values_of(*measurement);
    lane.member->values.assign(values.begin(), values.end());
    if (!travels) continue;
    lane.member->workpiece_from_datum = lane.workpiece_from_datum;
    lane.member->travels = all_travels(lane);
  }
}

std::vector<double> DrawBlock::all_travels(const Lane& lane) const {
  const double ball = 0.5 * common_.piece.plan.probe.ball_diameter;
  const Pose& frame = lane.workpiece_from_datum;
  std::vector<double> all;
  for (std::size_t f = 0; f < lane.travels.size(); ++f) {
    const Pose& before = lane.probed_in[f];
    for (std::size_t i = 0; i < lane.travels[f].size(); ++i) {
      const metrology::PlannedPoint& planned = common_.planned[f][i];
      const Vec3 shift = before.point(planned.point) - frame.point(planned.point);
      const Vec3 centre = shift + (lane.travels[f][i] + ball) * before.direction(planned.normal);
      const bool is_datum = is_datum_feature(common_.piece.plan, common_.piece.plan.features[f]);
      all.push_back(is_datum ? centre.dot(frame.direction(planned.normal)) - ball
                             : lane.travels[f][i]);
    }
  }
  return all;
}

std::vector<FittedFeature> DrawBlock::datums_of(const Lane& lane) const {
  const metrology::InspectionPlan& plan = common_.piece.plan;
  std::vector<FittedFeature> datums;
  for (std::size_t f = 0; f < plan.features.size(); ++f) {
    if (is_datum_feature(plan, plan.features[f])) datums.push_back(*lane.features[f]);
  }
  return datums;
}

// As metrology/cmm.cpp aligns: machines whose parts lie askew are measured again.
void DrawBlock::align() {
  const metrology::InspectionPlan& plan = common_.piece.plan;
  std::vector<bool> is_askew(lanes_.size(), true);
  const auto probe_datums = [&] {
    // Those that are not askew have their features: they sleep.
    std::vector<bool> slept(lanes_.size());
    for (std::size_t i = 0; i < lanes_.size(); ++i) {
      slept[i] = std::exchange(lanes_[i].is_done, lanes_[i].is_done || !is_askew[i]);
    }
    for (std::size_t f = 0; f < plan.features.size(); ++f) {
      if (is_datum_feature(plan, plan.features[f])) probe(f);
    }
    for (std::size_t i = 0; i < lanes_.size(); ++i) {
      if (!is_askew[i]) lanes_[i].is_done = slept[i];
    }
  };
  probe_datums();
  for (int round = 0; round < 3; ++round) {
    bool again = false;
    for (std::size_t i = 0; i < lanes_.size(); ++i) {
      Lane& lane = lanes_[i];
      if (lane.is_done || !is_askew[i]) continue;
      const auto found = metrology::alignment_of(plan, datums_of(lane));
      if (!found) {
        lane.member->failure = found.error();
        lane.is_done = true;
        continue;
      }
      is_askew[i] = metrology::lies_askew(lane.workpiece_from_datum.inverse() * *found);
      lane.workpiece_from_datum = *found;
      again = again || is_askew[i];
    }
    if (!again) break;
    probe_datums();
  }
}

void DrawBlock::probe(std::size_t feature) {
  const FollowPlan& plan = common_.plan;
  const std::uint32_t first = plan.first_point[feature], last = plan.first_point[feature + 1];
  LaneFrame frame;
  Lanes scale;
  for (std::size_t i = 0; i < kLanes; ++i) {
    const Lane& lane = lanes_[std::min(i, lanes_.size() - 1)];
    const Pose& pose = lane.workpiece_from_datum;
    set(frame.x, i, pose.rotation.col(0));
    set(frame.y, i, pose.rotation.col(1));
    set(frame.z, i, pose.rotation.col(2));
    set(frame.origin, i, pose.translation);
    scale.of[i] = lane.scale;
  }
  std::span<const ProbeWindow> windows;
  for (std::uint32_t p = first; p < last; ++p) {
    if (!plan.points[p].is_followed) continue;
    const std::uint32_t begin = plan.points[p].window;
    const auto count = static_cast<std::size_t>(
        std::count_if(plan.points.begin() + first, plan.points.begin() + last,
                      [](const FollowedPoint& point) { return point.is_followed; }));
    windows = {plan.windows.data() + begin, count};
    break;
  }
  find_contacts(windows, plan.tables, scratch_.poses, frame, scale, scratch_.contacts);
  for (Lane& lane : lanes_) {
    lane.travels[feature].resize(last - first);
    if (!lane.is_done) lane.probed_in[feature] = lane.workpiece_from_datum;
  }
  std::size_t followed = 0;
  for (std::uint32_t p = first; p < last; ++p) {
    const LaneContact* contact =
        plan.points[p].is_followed ? &scratch_.contacts[followed++] : nullptr;
    for (std::size_t i = 0; i < lanes_.size(); ++i) {
      if (!lanes_[i].is_done) probe_point(feature, p - first, i, contact);
    }
  }
  for (Lane& lane : lanes_) {
    if (!lane.is_done) fit(feature, lane);
  }
}

BallApproach DrawBlock::approach_of(const Lane& lane, std::size_t feature,
                                    std::size_t index) const {
  const metrology::PlannedPoint& planned = common_.planned[feature][index];
  const metrology::ProbeSettings& probe = common_.piece.plan.probe;
  return {lane.workpiece_from_datum.point(planned.point),
          metrology::unit(lane.workpiece_from_datum.direction(planned.normal)),
          0.5 * probe.ball_diameter, probe.clearance, probe.reach};
}

void DrawBlock::probe_point(std::size_t feature, std::size_t index, std::size_t lane_index,
                            const LaneContact* contact) {
  Lane& lane = lanes_[lane_index];
  double& travel = lane.travels[feature][index];
  const FollowedPoint& point = common_.plan.points[common_.plan.first_point[feature] + index];
  std::uint32_t doubt = contact != nullptr ? contact->doubt[lane_index] : 0;
  constexpr auto kOthers = static_cast<std::uint32_t>(Doubt::others);
  if ((doubt & kOthers) != 0 && others_keep_away(point, lane_index, contact->drift.of[lane_index],
                                                 contact->moved.of[lane_index])) {
    doubt &= ~kOthers;
  }
  if (contact != nullptr && doubt == 0) {
    travel = contact->travel.of[lane_index];
    return;
  }
  const BallApproach approach = approach_of(lane, feature, index);
  if (point.room_on_blank) {
    if (const auto on_blank = travel_on_blank(point, lane.scale, approach)) {
      travel = *on_blank;
      return;
    }
  }
  if (contact != nullptr && doubt == static_cast<std::uint32_t>(Doubt::edges)) {
    if (const auto on_edge = travel_on_edge(point, lane_index, approach)) {
      travel = *on_edge;
      return;
    }
  }
  if (!point.surroundings.empty()) {
    if (const auto local = local_travel(point, lane_index, approach)) {
      ++lane.member->local;
      travel = *local;
      return;
    }
  }
  if (!lane.whole) {
    TrialOptions options{.path_bound = common_.options.path_bound};
    options.find_collisions = options.measure = false;
    const auto trial = run_trial(common_.machine, common_.laws.errors(draws_[lane_index]),
                                 common_.piece, common_.commanded, {}, options);
    if (!trial) {
      lane.member->failure = trial.error();
      lane.is_done = true;
      return;
    }
    lane.whole = trial->workpiece;
  }
  ++lane.member->whole;
  const BallContact met = touch_with_ball(WorkpieceProbe(*lane.whole), approach);
  if (met.state == ContactState::contact) {
    travel = (met.centre - approach.target).dot(approach.outward.vec()) - approach.ball_radius;
  } else {
    whole_trial(lane_index);  // says why
  }
}

bool DrawBlock::others_keep_away(const FollowedPoint& point, std::size_t lane_index, double drift,
                                 double moved) {
  Lane& lane = lanes_[lane_index];
  if (keeps_away(point.others, lane.scale, drift, moved)) return true;
  if (!lane.nearness) {
    std::vector<double> off = draws_[lane_index];
    for (std::size_t j = 0; j < off.size(); ++j) off[j] -= common_.middle_weights[j];
    lane.nearness.emplace(common_.plan.near_places, std::move(off));
  }
  return lane.nearness->keep_away(point.near, point.origin.touched, lane.scale, drift, moved);
}

void DrawBlock::find_poses_of(const FollowedPoint& point) {
  scratch_.wanted.clear();
  for (const PieceRange& range : point.surroundings) {
    for (std::uint32_t k = range.first; k < range.first + range.count; ++k) {
      for (const std::uint32_t node : common_.plan.motion.pieces[k].node) {
        if (known_[node]) continue;
        known_[node] = true;
        scratch_.wanted.push_back(node);
      }
    }
  }
  common_.plan.chain->find(machines_, scratch_.wanted, scratch_.poses);
}

PosesOfPiece DrawBlock::poses_of(const std::array<std::uint32_t, 3>& node, std::size_t lane) const {
  PosesOfPiece poses;
  for (std::size_t k = 0; k < 3; ++k) {
    const LanePose& pose = scratch_.poses[node[k]];
    poses[k] = {lane_of(pose.tip, lane), lane_of(pose.axis, lane)};
  }
  return poses;
}

std::optional<double> DrawBlock::travel_on_edge(const FollowedPoint& point, std::size_t lane,
                                                const BallApproach& approach) const {
  const WindowTables& tables = common_.plan.tables;
  const ProbeWindow& window = common_.plan.windows[point.window];
  std::array<PosesOfPiece, kMostWindowPieces> pieces;
  for (std::uint32_t k = 0; k < window.pieces; ++k) {
    pieces[k] = poses_of(tables.pieces[window.first_piece + k].node, lane);
  }
  const Vec3 normal = approach.outward.vec();
  return edge_travel(
      {window, tables, std::span(pieces).first(window.pieces), point.origin,
       poses_of(point.origin.node, lane), lanes_[lane].scale},
      {approach.target + approach.ball_radius * normal, normal, approach.ball_radius});
}

// A cut takes material away, so that the ball rests on the blank unless its contact is cut.
std::optional<double> DrawBlock::travel_on_blank(const FollowedPoint& point, double scale,
                                                 const BallApproach& approach) const {
  const BallContact met = touch_with_ball(BlankProbe(*common_.middle.workpiece), approach);
  if (met.state != ContactState::contact) return std::nullopt;
  const double moved = (met.touch.point - point.origin.touched).norm();
  if (!(moved + scale * common_.plan.largest_motion < *point.room_on_blank)) return std::nullopt;
  return (met.centre - approach.target).dot(approach.outward.vec()) - approach.ball_radius;
}

std::optional<double> DrawBlock::local_travel(const FollowedPoint& point, std::size_t lane,
                                              const BallApproach& approach) {
  find_poses_of(point);
  std::vector<PosesOfPiece> pieces;
  std::vector<std::uint32_t> lengths;
  for (const PieceRange& range : point.surroundings) {
    lengths.push_back(range.count);
    for (std::uint32_t k = range.first; k < range.first + range.count; ++k) {
      pieces.push_back(poses_of(common_.plan.motion.pieces[k].node, lane));
    }
  }
  const LocalSurroundings near{
      pieces, lengths, poses_of(point.origin.node, lane), point.origin,
      [&](double drift, double moved) { return others_keep_away(point, lane, drift, moved); }};
  const auto met =
      local_contact(near, point.tool, common_.middle.workpiece->removed().tool(point.tool),
                    approach, common_.options.path_bound);
  if (!met) return std::nullopt;
  return (met->centre - approach.target).dot(approach.outward.vec()) - approach.ball_radius;
}

void DrawBlock::fit(std::size_t feature, Lane& lane) {
  const metrology::InspectionPlan& plan = common_.piece.plan;
  const double ball = 0.5 * plan.probe.ball_diameter;
  const double radius = lane.cmm->ball_radius(ball);
  const bool by_approach = plan.probe.compensation == metrology::Compensation::approach;
  std::vector<Vec3> centres;
  std::vector<std::size_t> sections;
  for (std::size_t i = 0; i < common_.planned[feature].size(); ++i) {
    const metrology::PlannedPoint& planned = common_.planned[feature][i];
    const BallApproach approach = approach_of(lane, feature, i);
    const Vec3 centre =
        approach.target + (lane.travels[feature][i] + ball) * approach.outward.vec();
    const Vec3 measured = lane.cmm->measured(
        {centre, approach.outward, metrology::point_index(feature, i), planned.scanned});
    centres.push_back(by_approach ? Vec3(measured - radius * approach.outward.vec()) : measured);
    sections.push_back(planned.section);
  }
  auto fitted = metrology::fit_feature(plan.features[feature], centres, sections,
                                       by_approach ? 0.0 : radius, metrology::FitStart::plan);
  if (!fitted) {
    lane.member->failure = fitted.error();
    lane.is_done = true;
    return;
  }
  lane.features[feature] = *std::move(fitted);
}

void DrawBlock::whole_trial(std::size_t index) {
  Lane& lane = lanes_[index];
  lane.is_done = true;
  TrialOptions options{.path_bound = common_.options.path_bound};
  options.find_collisions = false;
  const auto trial = run_trial(common_.machine, common_.laws.errors(draws_[index]), common_.piece,
                               common_.commanded, {}, options);
  if (!trial) {
    lane.member->failure = trial.error();
    return;
  }
  const Eigen::VectorXd values = values_of(trial->measurement);
  lane.member->values.assign(values.begin(), values.end());
  lane.member->whole = common_.plan.points.size();
}

}  // namespace frustum::trials

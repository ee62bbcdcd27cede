#include "stock/collision/pair_watch.hpp"

#include <algorithm>

#include "kinematics/controller/block_motion.hpp"

namespace frustum::stock {
namespace {

using kinematics::MachinePart;
using kinematics::part_way;

// The last part that carries both.
MachinePart common_part(const MachinePart& a, const MachinePart& b) {
  if (a.side != b.side) return {};
  return {a.side, std::min(a.joints, b.joints)};
}

}  // namespace

PairWatch::PairWatch(const kinematics::Machine& machine, const SceneBody& a, const SceneBody& b)
    : machine_(&machine),
      a_(&a),
      b_(&b),
      common_(common_part(a.part, b.part)),
      branch_a_(machine, common_.joints, a.part, a.part_from_body, a.solid->bounds()),
      branch_b_(machine, common_.joints, b.part, b.part_from_body, b.solid->bounds()),
      tool_(std::max(a.tool, b.tool)) {}

Separation PairWatch::separation_at(const AxisPositions& q) const {
  const Pose common_from_a = branch_a_.common_from_body(q);
  const Pose common_from_b = branch_b_.common_from_body(q);
  Separation apart = separation(*a_->solid, *b_->solid, common_from_a.inverse() * common_from_b);
  apart.normal = common_from_a.direction(apart.normal);
  apart.on_a = common_from_a.point(apart.on_a);
  apart.on_b = common_from_a.point(apart.on_b);
  return apart;
}

void PairWatch::follow(std::span<const AxisVertex> vertices) {
  for (std::size_t k = 1; k < vertices.size(); ++k) {
    const AxisVertex& vertex = vertices[k];
    if (tool_ != 0 && vertex.tool != tool_) {
      is_followed_ = false;
      continue;
    }
    follow(vertices[k - 1].q, vertex);
  }
}

void PairWatch::follow(const AxisPositions& from, const AxisVertex& vertex) {
  // Of bodies that have met: that far, or that part of the way, where large bodies turn.
  constexpr double kStride = 1.0;  // mm
  constexpr double kPart = 1.0 / 64.0;
  if (!is_followed_) {
    has_met_ = false;
    look(from, vertex.move);
    is_followed_ = true;
  }
  for (double u = 0.0; u < 1.0;) {
    if (has_met_) {
      const AxisPositions here = part_way(from, vertex.q, u);
      const double way =
          ClosingBound(here, branch_a_.movers(here), branch_b_.movers(here), nullptr).at(vertex.q);
      u = way <= kStride ? 1.0 : u + std::max((1.0 - u) * kStride / way, kPart);
      look(u < 1.0 ? part_way(from, vertex.q, u) : vertex.q, vertex.move);
      continue;
    }
    if (spare_at(vertex.q) > 0.0) return;
    u = proven_to(from, vertex.q, u);
    look(u < 1.0 ? part_way(from, vertex.q, u) : vertex.q, vertex.move);
  }
}

// How far along the way, from u on, the proof holds: the bound is convex, so up to one place, which
// secants come near to. Where rounding leaves nothing of that, a little beyond u.
double PairWatch::proven_to(const AxisPositions& from, const AxisPositions& to, double u) const {
  constexpr int kRounds = 40;
  constexpr double kNear = 0.001;  // of what is proven
  double proven = u, spare_there = spare_at(part_way(from, to, u));
  double open = 1.0, spare_at_open = spare_at(to);
  for (int k = 0; k < kRounds && open - proven > kNear * (proven - u); ++k) {
    // Every third time half, so that both ends move.
    const bool halves = k % 3 == 2 || !(spare_there > 0.0);
    const double share = halves ? 0.5 : spare_there / (spare_there - spare_at_open);
    const double next = proven + share * (open - proven);
    if (!(proven < next && next < open)) break;
    const double spare = spare_at(part_way(from, to, next));
    if (spare > 0.0) {
      proven = next;
      spare_there = spare;
    } else {
      open = next;
      spare_at_open = spare;
    }
  }
  return proven > u ? proven : open;
}

void PairWatch::look(const AxisPositions& q, std::uint32_t move) {
  const Separation apart = separation_at(q);
  // A little above, so that every proof leads on.
  constexpr double kStep = 0.001;  // mm
  const bool meets = apart.lower <= kMeeting + kStep;
  const double distance = meets ? 0.0 : apart.upper;
  if (!nearest_ || distance < nearest_->distance) nearest_ = {distance, move};
  if (meets) {
    meet(q, move, apart);
    return;
  }
  has_met_ = false;
  certify(q, apart);
}

void PairWatch::meet(const AxisPositions& q, std::uint32_t move, const Separation& apart) {
  const bool goes_on = has_met_ || (!meetings_.empty() && move <= meetings_.back().last_move + 1);
  has_met_ = true;
  if (goes_on && !meetings_.empty()) {
    meetings_.back().last_move = move;
    return;
  }
  const Pose bed_from_common = bed_from_part(*machine_, common_, q);
  meetings_.push_back({move, move, q, bed_from_common.point(0.5 * (apart.on_a + apart.on_b))});
}

// Down to which distance the next proof holds: a little below the smallest so far. Where rounding
// leaves no more than that, half of what there is.
double PairWatch::limit_from(double lower) const {
  constexpr double kShare = 0.01;
  constexpr double kLeast = 0.0005;  // mm: of a proof that leads on
  const double wanted = std::max(kMeeting, (1.0 - kShare) * nearest_->distance - kNearness);
  return wanted < lower - kLeast ? wanted : 0.5 * (lower + kMeeting);
}

void PairWatch::certify(const AxisPositions& q, const Separation& apart) {
  const auto movers_a = branch_a_.movers(q);
  const auto movers_b = branch_b_.movers(q);
  // Along a plane between them sliding costs nothing; of bodies that are not convex the plane is
  // between their hulls, where there is one that proves as much.
  limit_ = limit_from(apart.lower);
  double clear = apart.lower;
  Vec3 normal = apart.normal;
  bool has_plane = a_->solid->is_convex() && b_->solid->is_convex();
  if (!has_plane) {
    const Pose common_from_a = branch_a_.common_from_body(q);
    const Separation hulls = convex_distance(
        *a_->solid, *b_->solid, common_from_a.inverse() * branch_b_.common_from_body(q));
    constexpr double kWorth = 0.3;  // of what any direction could take
    has_plane = hulls.lower - limit_ > kWorth * (apart.lower - limit_);
    if (has_plane) {
      clear = hulls.lower;
      normal = common_from_a.direction(hulls.normal);
    }
  }
  clear_ = clear;
  bound_ = ClosingBound(q, movers_a, movers_b, has_plane ? &normal : nullptr);
}

}  // namespace frustum::stock

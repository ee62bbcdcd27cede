#include "trials/follow_plan.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <optional>
#include <set>
#include <utility>

#include "cutter/sweep/segment_motion.hpp"
#include "metrology/plan/strategy.hpp"
#include "trials/column_motion.hpp"
#include "trials/middle_contact.hpp"
#include "trials/window_bounds.hpp"

namespace frustum::trials {
namespace {

using kinematics::ToolPath;
using kinematics::ToolPose;

// The surroundings of a contact reach to where the cutter is so far off (mm), and no farther than
// so many blocks.
constexpr double kSurroundings = 0.05;
constexpr std::uint32_t kMostBlocks = 16;
// More pieces are no window: then the contact is looked for in its surroundings.
constexpr std::uint32_t kMostWindow = 8;
// A window is wide enough when machines at this share of the proof's limits are proven; they drift
// by so many standard deviations.
constexpr double kShare = 0.7;
constexpr double kDeviations = 3.5;

// A contact of the middle machine as its trial found it.
struct Found {
  Vec3 point = Vec3::Zero(), normal = Vec3::UnitZ();  // planned, in the workpiece
  Vec3 touched = Vec3::Zero();
  std::uint32_t block = 0;
  int tool = 0;
  double ball = 0.0;
};

// Blocks [first, last] of the surroundings.
struct BlockRange {
  std::uint32_t first = 0, last = 0;
};

class Planner {
 public:
  Planner(const kinematics::Machine& machine, const programs::TestPiece& piece,
          const CommandedPiece& commanded, const PopulationLaws& laws, const Trial& middle)
      : machine_(machine),
        piece_(piece),
        commanded_(commanded),
        laws_(laws),
        middle_(middle),
        path_(middle.workpiece->removed().path()),
        setup_(setup_of(piece)),
        columns_(machine, laws, setup_.table_from_workpiece),
        bounds_(machine, setup_, columns_, *middle.workpiece) {
    plan_.chain = std::make_unique<LaneChain>(machine, laws, setup_.table_from_workpiece);
    plan_.largest_motion = bounds_.largest_motion();
  }

  FollowPlan plan() && {
    find_points();
    find_surroundings();
    if (!plan_.chain->carries_all()) refuse_all("the errors have a volumetric grid");
    cut_pieces();
    for (std::size_t i = 0; i < plan_.points.size(); ++i) {
      if (found_[i] && plan_.points[i].why_not.empty()) follow(plan_.points[i], *found_[i], i);
    }
    std::set<std::uint32_t> nodes;
    for (const LanePiece& one : plan_.tables.pieces) nodes.insert(one.node.begin(), one.node.end());
    plan_.window_nodes.assign(nodes.begin(), nodes.end());
    return std::move(plan_);
  }

 private:
  void refuse_all(const std::string& why) {
    for (FollowedPoint& point : plan_.points) {
      if (point.why_not.empty()) point.why_not = why;
    }
  }

  void find_points() {
    const double ball = 0.5 * piece_.plan.probe.ball_diameter;
    const Pose& frame = middle_.measurement.workpiece_from_datum;
    first_segment_.assign(path_.blocks.size() + 1, static_cast<std::uint32_t>(path_.segments.size()));
    for (auto s = static_cast<std::uint32_t>(path_.segments.size()); s-- > 0;) {
      first_segment_[path_.segments[s].block] = s;
    }
    for (std::size_t b = path_.blocks.size(); b-- > 0;) {
      first_segment_[b] = std::min(first_segment_[b], first_segment_[b + 1]);
    }
    for (std::size_t f = 0; f < piece_.plan.features.size(); ++f) {
      plan_.first_point.push_back(static_cast<std::uint32_t>(plan_.points.size()));
      const auto planned = metrology::planned_points(piece_.plan.features[f]);
      const auto& touches = middle_.measurement.features[f].touches;
      for (std::size_t i = 0; i < planned.size(); ++i) {
        FollowedPoint point;
        std::optional<Found> contact;
        const auto& provenance = touches[i].provenance;
        if (!provenance || !provenance->segment) {
          point.why_not = "the blank's own surface is probed";
        } else {
          const std::uint32_t block = path_.segments[*provenance->segment].block;
          contact = Found{frame.point(planned[i].point), frame.direction(planned[i].normal),
                          touches[i].point, block, path_.blocks[block].tool, ball};
        }
        plan_.points.push_back(std::move(point));
        found_.push_back(contact);
      }
    }
    plan_.first_point.push_back(static_cast<std::uint32_t>(plan_.points.size()));
  }

  [[nodiscard]] const cutter::Body& body(int tool) const {
    return middle_.workpiece->removed().tool(tool).body();
  }

  // Blocks with poses near by, as far as the path goes on with the same tool.
  void find_surroundings() {
    std::set<std::uint32_t> wanted;
    for (std::size_t i = 0; i < found_.size(); ++i) {
      BlockRange range;
      if (found_[i]) {
        const Found& contact = *found_[i];
        range = {contact.block, contact.block};
        const auto is_far = [&](std::uint32_t pose) {
          return body(contact.tool).distance(path_.poses[pose], contact.touched) > kSurroundings;
        };
        while (range.first > 0 && contact.block - range.first < kMostBlocks &&
               goes_on(range.first - 1) && !is_far(begin_of(range.first))) {
          --range.first;
        }
        while (range.last + 1 < path_.blocks.size() && range.last - contact.block < kMostBlocks &&
               goes_on(range.last) && !is_far(end_of(range.last))) {
          ++range.last;
        }
        for (std::uint32_t b = range.first; b <= range.last; ++b) wanted.insert(b);
      }
      ranges_.push_back(range);
    }
    blocks_.assign(wanted.begin(), wanted.end());
  }
  [[nodiscard]] std::uint32_t begin_of(std::uint32_t block) const {
    const std::uint32_t s = first_segment_[block];
    return s < path_.segments.size() ? path_.segments[s].first_pose
                                     : static_cast<std::uint32_t>(path_.poses.size() - 1);
  }
  [[nodiscard]] std::uint32_t end_of(std::uint32_t block) const {
    const std::uint32_t s = first_segment_[block + 1];
    return s > 0 ? path_.segments[s - 1].first_pose + 1 : 0;
  }
  // From this block into the next one.
  [[nodiscard]] bool goes_on(std::uint32_t block) const {
    const std::uint32_t s = first_segment_[block + 1];
    if (s == 0 || s >= path_.segments.size()) return false;
    return path_.segments[s].first_pose == path_.segments[s - 1].first_pose + 1 &&
           path_.blocks[block].tool == path_.blocks[block + 1].tool;
  }

  void cut_pieces() {
    plan_.motion =
        motion_pieces(machine_, setup_, commanded_.program, laws_, blocks_, *plan_.chain);
    for (std::size_t i = 0; i < plan_.motion.blocks.size(); ++i) {
      place_of_block_[plan_.motion.blocks[i].block] = i;
    }
    const std::vector<Weights> draws{laws_.middle()};
    std::vector<std::uint32_t> all(plan_.chain->size());
    for (std::uint32_t i = 0; i < all.size(); ++i) all[i] = i;
    std::vector<LanePose> poses(all.size());
    plan_.chain->find(plan_.chain->machines(draws), all, poses);
    for (const LanePose& p : poses) {
      poses_.push_back({{p.tip.x.of[0], p.tip.y.of[0], p.tip.z.of[0]},
                        {p.axis.x.of[0], p.axis.y.of[0], p.axis.z.of[0]}});
    }
  }

  [[nodiscard]] PoseParabola parabola(const MotionPiece& piece) const {
    return {{poses_[piece.node[0]], poses_[piece.node[1]], poses_[piece.node[2]]}};
  }
  [[nodiscard]] PlaceOnPath place(std::uint32_t node) const {
    return {node, poses_[node], plan_.motion.states[node]};
  }

  // The pieces of a point's surroundings, if all of them can be trusted.
  [[nodiscard]] bool take_surroundings(FollowedPoint& point, const BlockRange& range) const {
    const MotionPieces::Block& first = plan_.motion.blocks[place_of_block_.at(range.first)];
    const MotionPieces::Block& last = plan_.motion.blocks[place_of_block_.at(range.last)];
    point.first_piece = first.first;
    point.piece_count = last.first + last.count - first.first;
    for (std::uint32_t b = range.first; b <= range.last; ++b) {
      if (!plan_.motion.blocks[place_of_block_.at(b)].is_smooth) return false;
    }
    return true;
  }

  void follow(FollowedPoint& point, const Found& contact, std::size_t index) {
    if (!body(contact.tool).is_convex()) {
      point.why_not = "the cutter is not convex";
      return;
    }
    if (!take_surroundings(point, ranges_[index])) {
      point.piece_count = 0;
      point.why_not = "an error bends sharply within a block";
      return;
    }
    const std::span<const MotionPiece> pieces(plan_.motion.pieces.data() + point.first_piece,
                                              point.piece_count);
    // What is shown from here on is shown for the surroundings as a whole.
    const CentreLine line{contact.point + contact.ball * contact.normal, contact.normal,
                          contact.ball};
    const double travel = (contact.touched - contact.point).dot(contact.normal);
    std::optional<LaneFace> face;
    std::optional<PieceSolution> best;
    std::size_t own = 0;
    for (std::size_t k = 0; k < pieces.size(); ++k) {
      if (pieces[k].block + 1 < contact.block || pieces[k].block > contact.block + 1) continue;
      const PoseParabola piece = parabola(pieces[k]);
      const ToolPose middle = piece.at(0.5);
      const double height = (contact.touched - middle.tip).dot(middle.axis);
      if (!face) face = face_at(body(contact.tool), height, contact.ball);
      if (!face) continue;
      const auto solution = solve_piece(*face, piece, line, travel);
      if (solution && (!best || solution->travel < best->travel)) {
        best = solution;
        own = k;
      }
    }
    if (!best) {
      point.piece_count = 0;
      point.why_not = "an end face or an edge of the cutter made the surface";
      return;
    }
    ProbeWindow window;
    const PoseParabola own_piece = parabola(pieces[own]);
    const ToolPose pose = own_piece.at(best->tau);
    const Vec3 centre = line.touching + best->travel * line.normal;
    const Vec3 touched = centre + line.ball * best->centre.out;
    if (!((touched - contact.touched).norm() < 5e-3)) {
      point.piece_count = 0;
      point.why_not = "the contact is not one with a smooth face of the cutter";
      return;
    }
    const ContactPlace at{touched, best->centre.out, pose,
                          bounds_.motions(state_on(pieces[own], best->tau), contact.tool, pose,
                                          touched)};
    window.others = bounds_.others(at, ranges_[index].first, ranges_[index].last, contact.tool,
                                   {line.touching, line.normal, contact.ball, best->travel,
                                    piece_.plan.probe.clearance});
    if (!(window.others.per_scale < 1.0)) {
      point.piece_count = 0;
      point.why_not = "other cuts or the blank's surface are too near";
      return;
    }
    point.others = window.others;
    widen(window, pieces, own, at, *face, contact.tool);
    if (window.pieces == 0) {
      point.why_not = "the cutter hardly leaves the surface again";
      return;
    }
    fill(window, pieces, line, best->travel, *face, contact);
    window.tip = {pose.tip.x(), pose.tip.y(), pose.tip.z()};
    window.axis = {pose.axis.x(), pose.axis.y(), pose.axis.z()};
    window.touched = {touched.x(), touched.y(), touched.z()};
    window.travel = best->travel;
    const auto planned = planned_point(index);
    window.point = {planned.point.x(), planned.point.y(), planned.point.z()};
    window.normal = {planned.normal.x(), planned.normal.y(), planned.normal.z()};
    point.is_followed = true;
    point.window = static_cast<std::uint32_t>(plan_.windows.size());
    plan_.windows.push_back(window);
  }

  [[nodiscard]] metrology::PlannedPoint planned_point(std::size_t index) const {
    const auto after = std::ranges::upper_bound(plan_.first_point, index);
    const auto feature = static_cast<std::size_t>(after - plan_.first_point.begin()) - 1;
    return metrology::planned_points(
        piece_.plan.features[feature])[index - plan_.first_point[feature]];
  }

  // Half way between places errors are what they are in the middle, near enough for bounds.
  [[nodiscard]] kinematics::AxisState state_on(const MotionPiece& piece, double tau) const {
    const auto& a = plan_.motion.states[piece.node[tau < 0.5 ? 0 : 1]];
    const auto& b = plan_.motion.states[piece.node[tau < 0.5 ? 1 : 2]];
    const double share = tau < 0.5 ? 2.0 * tau : 2.0 * tau - 1.0;
    kinematics::AxisState state = a;
    for (const auto letter : kinematics::kAxisLetters) {
      state.q[letter] += share * (b.q[letter] - a.q[letter]);
      state.heading[letter] += share * (b.heading[letter] - a.heading[letter]);
    }
    return state;
  }

  // Takes pieces on both sides until what comes after them is proven not to matter for nearly all
  // machines.
  void widen(ProbeWindow& window, std::span<const MotionPiece> pieces, std::size_t own,
             const ContactPlace& at, const LaneFace& face, int tool) {
    const double drift = kDeviations * bounds_.drift_deviation(at);
    std::size_t first = own, last = own;
    const auto is_enough = [&](const SideBound& side) {
      return side.at_end > 0.0 &&
             side.closeness.per_scale + side.closeness.per_drift * drift +
                     side.closeness.per_nearer * (side.lean * drift + 0.5 * drift * drift / side.rho) <
                 kShare;
    };
    const auto side_at = [&](std::uint32_t end, bool up) {
      std::vector<PlaceOnPath> beyond;
      const std::size_t from = up ? last + 1 : 0, to = up ? pieces.size() : first;
      for (std::size_t k = from; k < to; ++k) {
        for (const std::uint32_t node : pieces[k].node) beyond.push_back(place(node));
      }
      return bounds_.side(at, face, tool, place(end), beyond);
    };
    const auto widen_side = [&](bool up) {
      for (;;) {
        const std::uint32_t end = up ? pieces[last].node[2] : pieces[first].node[0];
        const SideBound side = side_at(end, up);
        (up ? window.after : window.before) = side.closeness;
        (up ? window.at_last : window.at_first) = side.at_end;
        const bool is_end = up ? last + 1 == pieces.size() : first == 0;
        if (is_enough(side)) return true;
        if (is_end || last - first + 1 >= kMostWindow) return false;
        if (up) {
          ++last;
        } else {
          --first;
        }
      }
    };
    window.is_open_before = window.is_open_after = true;
    if (!widen_side(false) || !widen_side(true)) return;
    window.own_piece = static_cast<std::uint32_t>(own - first);
    window.first_piece = static_cast<std::uint32_t>(first);
    window.pieces = static_cast<std::uint32_t>(last - first + 1);
  }

  void fill(ProbeWindow& window, std::span<const MotionPiece> pieces, const CentreLine& line,
            double travel, const LaneFace& face, const Found& contact) {
    // A jump bends nothing; steps along it end at its ends.
    constexpr double kLeastBend = 1e-9;
    const std::size_t first = window.first_piece;
    window.first_piece = static_cast<std::uint32_t>(plan_.tables.pieces.size());
    for (std::size_t k = first; k < first + window.pieces; ++k) {
      const auto solution = solve_piece(face, parabola(pieces[k]), line, travel);
      LanePiece piece{pieces[k].node, 0.5, kLeastBend};
      if (solution) {
        piece.tau = solution->tau;
        piece.bend = std::max(solution->bend, kLeastBend);
      }
      plan_.tables.pieces.push_back(piece);
    }
    window.ball = contact.ball;
    window.face = static_cast<std::uint32_t>(plan_.tables.faces.size());
    plan_.tables.faces.push_back(face);
  }

  const kinematics::Machine& machine_;
  const programs::TestPiece& piece_;
  const CommandedPiece& commanded_;
  const PopulationLaws& laws_;
  const Trial& middle_;
  const ToolPath& path_;
  kinematics::Setup setup_;
  ColumnMotion columns_;
  WindowBounds bounds_;
  FollowPlan plan_{};
  std::vector<std::uint32_t> first_segment_{};  // of each block of the path, and the end
  std::vector<std::optional<Found>> found_{};   // by point
  std::vector<BlockRange> ranges_{};
  std::vector<std::uint32_t> blocks_{};
  std::map<std::uint32_t, std::size_t> place_of_block_{};  // in plan_.motion.blocks
  std::vector<ToolPose> poses_{};                          // of the middle machine
};

}  // namespace

FollowPlan follow_plan(const kinematics::Machine& machine, const programs::TestPiece& piece,
                       const CommandedPiece& commanded, const PopulationLaws& laws,
                       const Trial& middle) {
  return Planner(machine, piece, commanded, laws, middle).plan();
}

}  // namespace frustum::trials

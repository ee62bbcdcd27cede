#include "trials/population/follow_plan.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <optional>
#include <set>
#include <utility>

#include "core/golden_section.hpp"
#include "cutter/sweep/segment_motion.hpp"
#include "metrology/plan/strategy.hpp"
#include "trials/population/column_motion.hpp"
#include "trials/population/middle_contact.hpp"
#include "trials/population/window_bounds.hpp"

namespace frustum::trials {
namespace {

using kinematics::ToolPath;
using kinematics::ToolPose;

// The surroundings of a contact reach to where the cutter is so far off (mm), and no farther than
// so many blocks.
constexpr double kSurroundings = 0.05;
constexpr std::uint32_t kMostBlocks = 64;
// Where the path comes as near as this once more (mm), that counts among them: other passes leave
// an allowance of more.
constexpr double kVisit = 0.045;
// More pieces are no window: then the contact is looked for in its surroundings.
constexpr std::uint32_t kMostWindow = 24;
// A window is wide enough when machines at this share of the proof's limits are proven; they drift
// by so many standard deviations.
constexpr double kShare = 0.7;
constexpr double kDriftDeviations = 3.5;

// A contact of the middle machine as its trial found it.
struct Found {
  Vec3 planned_point = Vec3::Zero(), planned_normal = Vec3::UnitZ();
  Vec3 point = Vec3::Zero(), normal = Vec3::UnitZ();  // the same, in the workpiece
  Vec3 touched = Vec3::Zero();
  std::uint32_t block = 0;
  int tool = 0;
  double ball = 0.0;
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

  FollowPlan plan(FollowScope scope) && {
    find_points();
    if (!plan_.chain->carries_all()) refuse_all("the errors have a volumetric grid");
    const auto is_refused = [](const FollowedPoint& point) { return !point.why_not.empty(); };
    if (scope == FollowScope::all && std::ranges::any_of(plan_.points, is_refused)) {
      std::erase_if(plan_.points, [&](const FollowedPoint& point) { return !is_refused(point); });
      return std::move(plan_);
    }
    find_surroundings();
    cut_pieces();
    for (std::size_t i = 0; i < plan_.points.size(); ++i) {
      if (found_[i] && plan_.points[i].why_not.empty()) follow(plan_.points[i], *found_[i], i);
    }
    std::set<std::uint32_t> nodes;
    for (const LanePiece& one : plan_.tables.pieces) nodes.insert(one.node.begin(), one.node.end());
    plan_.window_nodes.assign(nodes.begin(), nodes.end());
    plan_.near_places = bounds_.take_places();
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
    first_segment_.assign(path_.blocks.size() + 1,
                          static_cast<std::uint32_t>(path_.segments.size()));
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
          const double room = bounds_.room(touches[i].point);
          point.origin.touched = touches[i].point;
          if (room > plan_.largest_motion) point.room_on_blank = room;
          if (!point.room_on_blank) point.why_not = "the blank is probed too near a cut";
        } else {
          const std::uint32_t block = path_.segments[*provenance->segment].block;
          contact = Found{planned[i].point,
                          planned[i].normal,
                          frame.point(planned[i].point),
                          frame.direction(planned[i].normal),
                          touches[i].point,
                          block,
                          path_.blocks[block].tool,
                          ball};
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

  // Blocks with poses near by, as far as the path goes on with the same tool; and where the path
  // comes by once more.
  void find_surroundings() {
    std::set<std::uint32_t> wanted;
    for (std::size_t i = 0; i < found_.size(); ++i) {
      std::vector<BlockRange> ranges;
      if (found_[i]) {
        ranges.push_back(around(found_[i]->block, *found_[i]));
        add_other_visits(ranges, *found_[i]);
      }
      for (const BlockRange& range : ranges) {
        for (std::uint32_t b = range.first; b <= range.last; ++b) wanted.insert(b);
      }
      ranges_.push_back(std::move(ranges));
    }
    blocks_.assign(wanted.begin(), wanted.end());
  }

  [[nodiscard]] BlockRange around(std::uint32_t block, const Found& contact) const {
    BlockRange range{block, block};
    const auto is_far = [&](std::uint32_t pose) {
      return body(contact.tool).distance(path_.poses[pose], contact.touched) > kSurroundings;
    };
    while (range.first > 0 && block - range.first < kMostBlocks && goes_on(range.first - 1) &&
           !is_far(begin_of(range.first))) {
      --range.first;
    }
    while (range.last + 1 < path_.blocks.size() && range.last - block < kMostBlocks &&
           goes_on(range.last) && !is_far(end_of(range.last))) {
      ++range.last;
    }
    return range;
  }

  void add_other_visits(std::vector<BlockRange>& ranges, const Found& contact) const {
    constexpr std::size_t kMostVisits = 4;
    bounds_.segments().for_each(contact.touched, kVisit, [&](std::uint32_t s) {
      if (ranges.size() >= kMostVisits) return false;
      const kinematics::PathSegment& segment = path_.segments[s];
      const bool is_other =
          !is_in(ranges, segment.block) && path_.blocks[segment.block].tool == contact.tool;
      if (is_other && least_distance(segment, contact) < kVisit)
        ranges.push_back(around(segment.block, contact));
      return true;
    });
  }

  // A cutter that moves straight is at a distance that is a convex function of time.
  [[nodiscard]] double least_distance(const kinematics::PathSegment& segment,
                                      const Found& contact) const {
    const ToolPose &from = path_.from(segment), &to = path_.to(segment);
    const auto distance = [&](double t) {
      return body(contact.tool).distance(kinematics::between(from, to, t), contact.touched);
    };
    const double ends = std::min(distance(0.0), distance(1.0));
    if (ends < kVisit) return ends;
    constexpr double kTime = 1e-3;  // of a segment: 1e-5 mm of a distance that is curved
    return std::min(ends, golden_section(distance, 0.0, 1.0, kTime).value);
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
  [[nodiscard]] std::vector<PieceRange> pieces_of(std::span<const BlockRange> ranges) const {
    std::vector<PieceRange> found;
    for (const BlockRange& range : ranges) {
      const MotionPieces::Block& first = plan_.motion.blocks[place_of_block_.at(range.first)];
      const MotionPieces::Block& last = plan_.motion.blocks[place_of_block_.at(range.last)];
      for (std::uint32_t b = range.first; b <= range.last; ++b) {
        if (!plan_.motion.blocks[place_of_block_.at(b)].is_smooth) return {};
      }
      found.push_back({first.first, last.first + last.count - first.first});
    }
    return found;
  }
  [[nodiscard]] std::span<const MotionPiece> of(const PieceRange& range) const {
    return {plan_.motion.pieces.data() + range.first, range.count};
  }

  // The middle machine's contact on the motion itself: the face, and the deepest piece.
  struct OwnContact {
    LaneFace face{};
    PieceSolution solution{};
    std::size_t piece = 0;  // of the first range of the surroundings
  };
  [[nodiscard]] std::optional<OwnContact> own_contact(std::span<const MotionPiece> pieces,
                                                      const Found& contact, const CentreLine& line,
                                                      double travel) const {
    std::optional<OwnContact> best;
    for (std::size_t k = 0; k < pieces.size(); ++k) {
      if (pieces[k].block + 1 < contact.block || pieces[k].block > contact.block + 1) continue;
      const PoseParabola piece = parabola(pieces[k]);
      const ToolPose middle = piece.at(0.5);
      const double height = (contact.touched - middle.tip).dot(middle.axis);
      const auto face = face_at(body(contact.tool), height, contact.ball);
      if (!face) continue;
      const auto solution = solve_piece(*face, piece, line, travel);
      if (solution && (!best || solution->travel < best->solution.travel)) {
        best = {*face, *solution, k};
      }
    }
    // A ball on the edge of two facets touches it beside where it would touch each of them: by its
    // radius times the angle between them, which is below a degree.
    constexpr double kFacets = 0.02;
    if (!best) return std::nullopt;
    const Vec3 centre = line.touching + best->solution.travel * line.normal;
    const Vec3 touched = centre + line.ball * best->solution.centre.out;
    if (!((touched - contact.touched).norm() < kFacets * line.ball)) return std::nullopt;
    return best;
  }

  static void refuse(FollowedPoint& point, const char* why) { point.why_not = why; }

  void follow(FollowedPoint& point, const Found& contact, std::size_t index) {
    if (!body(contact.tool).is_convex()) return refuse(point, "the cutter is not convex");
    const std::vector<PieceRange> surroundings = pieces_of(ranges_[index]);
    if (surroundings.empty()) return refuse(point, "an error bends sharply within a block");
    const std::span<const MotionPiece> pieces = of(surroundings.front());
    const CentreLine line{contact.point + contact.ball * contact.normal, contact.normal,
                          contact.ball};
    const double from = (contact.touched - contact.point).dot(contact.normal);
    const auto own = own_contact(pieces, contact, line, from);
    if (!own) return refuse(point, "an end face or an edge of the cutter made the surface");
    const MotionPiece& own_piece = pieces[own->piece];
    const double travel = own->solution.travel;
    const ToolPose pose = parabola(own_piece).at(own->solution.tau);
    const Vec3 touched =
        line.touching + travel * line.normal + line.ball * own->solution.centre.out;
    const ContactPlace at{
        touched, own->solution.centre.out, pose,
        bounds_.motions(state_on(own_piece, own->solution.tau), contact.tool, pose, touched)};
    auto [others, near] = bounds_.others(
        at, ranges_[index], contact.tool,
        {line.touching, line.normal, contact.ball, travel, piece_.plan.probe.clearance});
    // Hardly a machine has more than a fifth of what all columns at their limits make.
    constexpr double kHopeless = 5.0;
    if (!(others.per_scale < (near.is_known ? kHopeless : 1.0)))
      return refuse(point, "other cuts or the blank's surface are too near");
    point.others = others;
    point.near = std::move(near);
    point.surroundings = surroundings;
    point.tool = contact.tool;
    point.origin = {own_piece.node, own->solution.tau, pose, touched};
    ProbeWindow window;
    window.others = point.others;
    window.first_stretch = static_cast<std::uint32_t>(plan_.tables.stretches.size());
    window.first_piece = static_cast<std::uint32_t>(plan_.tables.pieces.size());
    std::vector<WindowStretch> stretches;
    for (const PieceRange& range : surroundings) {
      const bool is_own = stretches.empty();
      const std::size_t deepest =
          is_own ? own->piece : deepest_of(of(range), own->face, line, travel, touched);
      auto stretch = widened(of(range), deepest, at, own->face, contact.tool);
      if (!stretch) return refuse(point, "the cutter hardly leaves the surface again");
      if (is_own) {
        window.own_piece = static_cast<std::uint32_t>(deepest) - stretch->first_piece;
      }
      stretch->first_piece += range.first;
      window.pieces += stretch->pieces;
      stretches.push_back(*stretch);
    }
    if (window.pieces > kMostWindowPieces) return refuse(point, "the path comes by too often");
    window.stretches = static_cast<std::uint32_t>(stretches.size());
    for (WindowStretch& stretch : stretches) {
      const std::span<const MotionPiece> all(plan_.motion.pieces);
      const auto its = all.subspan(stretch.first_piece, stretch.pieces);
      stretch.first_piece = static_cast<std::uint32_t>(plan_.tables.pieces.size());
      fill(its, line, travel, own->face);
      plan_.tables.stretches.push_back(stretch);
    }
    window.ball = contact.ball;
    window.face = static_cast<std::uint32_t>(plan_.tables.faces.size());
    plan_.tables.faces.push_back(own->face);
    window.tip = {pose.tip.x(), pose.tip.y(), pose.tip.z()};
    window.axis = {pose.axis.x(), pose.axis.y(), pose.axis.z()};
    window.touched = {touched.x(), touched.y(), touched.z()};
    window.travel = travel;
    const Vec3 &planned = contact.planned_point, &normal = contact.planned_normal;
    window.point = {planned.x(), planned.y(), planned.z()};
    window.normal = {normal.x(), normal.y(), normal.z()};
    point.is_followed = true;
    point.window = static_cast<std::uint32_t>(plan_.windows.size());
    plan_.windows.push_back(window);
  }

  // Half way between places errors are what they are in the middle, near enough for bounds.
  [[nodiscard]] kinematics::AxisState state_on(const MotionPiece& piece, double tau) const {
    const auto& a = plan_.motion.states[piece.node[tau < 0.5 ? 0 : 1]];
    const auto& b = plan_.motion.states[piece.node[tau < 0.5 ? 1 : 2]];
    const double share = tau < 0.5 ? 2.0 * tau : 2.0 * tau - 1.0;
    return state_between(a, b, share);
  }

  // The piece that lets the ball go deepest; where none meets its line, that with the cutter
  // nearest to the contact.
  [[nodiscard]] std::size_t deepest_of(std::span<const MotionPiece> pieces, const LaneFace& face,
                                       const CentreLine& line, double travel,
                                       const Vec3& touched) const {
    std::size_t best = 0, nearest = 0;
    double least = std::numeric_limits<double>::infinity(), near = least;
    for (std::size_t k = 0; k < pieces.size(); ++k) {
      const PoseParabola piece = parabola(pieces[k]);
      const double distance = std::abs(off_face(face, piece.at(0.5), touched).distance);
      if (distance < near) {
        near = distance;
        nearest = k;
      }
      if (!(distance < kSurroundings)) continue;
      const auto solution = solve_piece(face, piece, line, travel);
      if (solution && solution->travel < least) {
        least = solution->travel;
        best = k;
      }
    }
    return std::isfinite(least) ? best : nearest;
  }

  // Takes pieces on both sides until what comes after them is proven not to matter for nearly all
  // machines. `first_piece` is counted from the first one given.
  std::optional<WindowStretch> widened(std::span<const MotionPiece> pieces, std::size_t deepest,
                                       const ContactPlace& at, const LaneFace& face, int tool) {
    const double drift = kDriftDeviations * bounds_.drift_deviation(at);
    std::size_t first = deepest, last = deepest;
    const auto is_enough = [&](const SideBound& side) {
      const double nearer =
          kDriftDeviations * side.drift_deviation + 0.5 * drift * drift / side.rho;
      return side.at_end > 0.0 && side.closeness.per_scale + side.closeness.per_drift * drift +
                                          side.closeness.per_nearer * nearer <
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
    WindowStretch stretch;
    const auto widen_side = [&](bool up) {
      for (;;) {
        const std::uint32_t end = up ? pieces[last].node[2] : pieces[first].node[0];
        const SideBound side = side_at(end, up);
        (up ? stretch.after : stretch.before) = side.closeness;
        (up ? stretch.at_last : stretch.at_first) = side.at_end;
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
    if (!widen_side(false) || !widen_side(true)) return std::nullopt;
    stretch.first_piece = static_cast<std::uint32_t>(first);
    stretch.pieces = static_cast<std::uint32_t>(last - first + 1);
    return stretch;
  }

  void fill(std::span<const MotionPiece> pieces, const CentreLine& line, double travel,
            const LaneFace& face) {
    // A jump bends nothing; steps along it end at its ends.
    constexpr double kLeastBend = 1e-9;
    for (const MotionPiece& one : pieces) {
      const auto solution = solve_piece(face, parabola(one), line, travel);
      LanePiece piece{one.node, 0.5, kLeastBend};
      if (solution) {
        piece.tau = solution->tau;
        piece.bend = std::max(solution->bend, kLeastBend);
      }
      plan_.tables.pieces.push_back(piece);
    }
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
  std::vector<std::uint32_t> first_segment_{};     // of each block of the path, and the end
  std::vector<std::optional<Found>> found_{};      // by point
  std::vector<std::vector<BlockRange>> ranges_{};  // the first is that of the contact
  std::vector<std::uint32_t> blocks_{};
  std::map<std::uint32_t, std::size_t> place_of_block_{};  // in plan_.motion.blocks
  std::vector<ToolPose> poses_{};                          // of the middle machine
};

}  // namespace

FollowPlan follow_plan(const kinematics::Machine& machine, const programs::TestPiece& piece,
                       const CommandedPiece& commanded, const PopulationLaws& laws,
                       const Trial& middle, FollowScope scope) {
  return Planner(machine, piece, commanded, laws, middle).plan(scope);
}

}  // namespace frustum::trials

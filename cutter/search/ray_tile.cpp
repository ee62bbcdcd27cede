#include "cutter/search/ray_tile.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

#include "core/constants.hpp"
#include "cutter/search/group_search.hpp"
#include "cutter/search/path_climb.hpp"
#include "cutter/search/pose_descent.hpp"
#include "cutter/search/ray_fans.hpp"
#include "cutter/search/tile_cover.hpp"
#include "cutter/search/whole_sweep.hpp"
#include "cutter/sweep/tangent_plane.hpp"

namespace frustum::cutter {
namespace {

// Bounds of groups hold but for rounding (mm); this is a hundred times that.
constexpr double kSurely = 1e-10;
// The ends of an anchor count for so much less (mm): more than a solution leaves of an end.
constexpr double kInward = 1e-6;
// Groups are divided for a tile while they are this many times larger: at first, and once it is
// known what is covered.
constexpr double kCoarse = 4.0, kFine = 0.5;
// Tiles of so many rays or fewer have fans; of so few or fewer are not looked at as a whole.
constexpr std::size_t kFannedTile = 64, kFewRays = 16;
// Planes that a ray meets at a smaller cosine bound badly.
constexpr double kGrazingCover = 0.02;

// Rays [u0, u1) of rows [v0, v1).
struct Rectangle {
  std::size_t u0 = 0, u1 = 0, v0 = 0, v1 = 0;
};

enum class Verdict : std::uint8_t { aside, level, open };

class TileSearch {
 public:
  TileSearch(const TileQuestion& question, const ToolSweep& sweep,
             std::span<std::vector<SweptInterval>> swept)
      : question_(question), sweep_(sweep), swept_(swept), done_(question.rays.size(), 0) {}

  void run() {
    if (sweep_.tree.empty() || question_.rays.empty()) return;
    lists_.assign(1, 0U);
    const Rectangle all{0, question_.row, 0, question_.rays.size() / question_.row};
    divide(all, 0, std::nullopt, {});
  }

 private:
  [[nodiscard]] std::size_t index(std::size_t u, std::size_t v) const {
    return v * question_.row + u;
  }
  [[nodiscard]] bool is_asked(std::size_t r) const {
    return question_.spans[r].lo <= question_.spans[r].hi;
  }

  // A ray of the tile that is asked and not answered yet, the nearer to the middle the better.
  [[nodiscard]] std::optional<std::size_t> middle_of(const Rectangle& at) const {
    const std::size_t u = (at.u0 + at.u1) / 2, v = (at.v0 + at.v1) / 2;
    std::optional<std::size_t> best;
    std::size_t best_off = 0;
    for (std::size_t y = at.v0; y < at.v1; ++y) {
      for (std::size_t x = at.u0; x < at.u1; ++x) {
        const std::size_t r = index(x, y);
        if (done_[r] != 0 || !is_asked(r)) continue;
        const std::size_t off = (x > u ? x - u : u - x) + (y > v ? y - v : v - y);
        if (best && off >= best_off) continue;
        best = r;
        best_off = off;
      }
    }
    return best;
  }

  [[nodiscard]] RayTile tile_of(const Rectangle& at, const Ray& frame) const {
    const Vec3 d = frame.direction;
    const Vec3 e1 = d.unitOrthogonal(), e2 = d.cross(e1);
    double lo1 = kInfinity, hi1 = -kInfinity, lo2 = kInfinity, hi2 = -kInfinity;
    RayTile tile{.span = {kInfinity, -kInfinity}};
    for (std::size_t y = at.v0; y < at.v1; ++y) {
      for (std::size_t x = at.u0; x < at.u1; ++x) {
        const std::size_t r = index(x, y);
        if (done_[r] != 0 || !is_asked(r)) continue;
        const Vec3 off = question_.rays[r].origin - frame.origin;
        const double a = e1.dot(off), b = e2.dot(off), ahead = d.dot(off);
        lo1 = std::min(lo1, a);
        hi1 = std::max(hi1, a);
        lo2 = std::min(lo2, b);
        hi2 = std::max(hi2, b);
        tile.span.lo = std::min(tile.span.lo, question_.spans[r].lo + ahead);
        tile.span.hi = std::max(tile.span.hi, question_.spans[r].hi + ahead);
      }
    }
    // Rounding of the corners.
    const auto corner = [&](double a, double b) { return Ray{frame.origin + a * e1 + b * e2, d}; };
    lo1 -= kSurely;
    lo2 -= kSurely;
    hi1 += kSurely;
    hi2 += kSurely;
    tile.corners = {corner(lo1, lo2), corner(hi1, lo2), corner(lo1, hi2), corner(hi1, hi2)};
    tile.size = std::hypot(hi1 - lo1, hi2 - lo2);
    tile.box.min = Vec3::Constant(kInfinity);
    tile.box.max = Vec3::Constant(-kInfinity);
    for (const Ray& c : tile.corners) {
      for (const double s : {tile.span.lo, tile.span.hi}) {
        tile.box.min = tile.box.min.cwiseMin(c.at(s));
        tile.box.max = tile.box.max.cwiseMax(c.at(s));
      }
    }
    return tile;
  }

  // The groups of lists_ from `first` on are what is open for this tile.
  void divide(const Rectangle& at, std::size_t first, std::optional<std::size_t> neighbour,
              std::span<const CoverFan> fans) {
    const auto middle = middle_of(at);
    if (!middle) return;
    std::size_t last = lists_.size();
    const std::size_t count = (at.u1 - at.u0) * (at.v1 - at.v0);
    if (!neighbour) {
      // The first of its tile: the whole tree, but for what is beside.
      filter(tile_of(at, question_.rays[*middle]), first, last);
      first = last;
      last = lists_.size();
    }
    if (first == last && anchors_.empty()) return;
    solve(*middle, first, last, neighbour, fans);
    done_[*middle] = 1;
    if (count == 1) return;
    const std::size_t anchored = anchors_.size();
    std::vector<CoverFan> own;
    if (count > kFewRays && middle_of(at)) {
      const RayTile tile = tile_of(at, question_.rays[*middle]);
      find_covers(tile, *middle);
      fans_follow_ = count <= kFannedTile;
      filter(tile, first, last);
      first = last;
      if (count <= kFannedTile) {
        own = fans_of(*middle, first);
        fans = own;
      }
    }
    const std::size_t u = (at.u0 + at.u1 + 1) / 2, v = (at.v0 + at.v1 + 1) / 2;
    for (const Rectangle& part : {Rectangle{at.u0, u, at.v0, v}, Rectangle{u, at.u1, at.v0, v},
                                  Rectangle{at.u0, u, v, at.v1}, Rectangle{u, at.u1, v, at.v1}}) {
      const std::size_t kept = lists_.size();
      divide(part, first, middle, fans);
      lists_.resize(kept);
    }
    anchors_.resize(anchored);
  }

  // One ray, from the answer of its neighbour on.
  void solve(std::size_t r, std::size_t first, std::size_t last,
             const std::optional<std::size_t>& neighbour, std::span<const CoverFan> fans) {
    const RayQuestion question{question_.path, question_.rays[r], question_.spans[r],
                               question_.first_excluded};
    const EndPlanes planes(question, *sweep_.body);
    WholeSweep goal(question, sweep_, planes, swept_[r]);
    GroupSearch search(question, sweep_, goal);
    for (const TileAnchor& anchor : anchors_) {
      const auto chord = anchor.part->chord(anchor.pose, question.ray);
      if (!chord) continue;
      // Its ends within the span are its segment's, which finds them itself.
      goal.take({{chord->lo + kInward, anchor.segment, anchor.section, anchor.t, chord->lo_face},
                 {chord->hi - kInward, anchor.segment, anchor.section, anchor.t, chord->hi_face}});
    }
    if (neighbour) {
      find_hints(question, question_.rays[*neighbour], swept_[*neighbour]);
      // First what their poses cover, so that ends inside of that need no solution.
      for (const std::uint32_t likely : hints_) search.take_pose(likely);
      fill_gaps(question, swept_[*neighbour].size(), goal, search);
      for (std::size_t i = 0; i < hints_.size(); ++i) {
        search.solve_parts(hints_[i]);
        const auto t = goal.end_at_pose_of(hints_[i]);
        const auto next = t ? next_at(question, sweep_, hints_[i], *t) : std::nullopt;
        if (next && std::ranges::find(hints_, *next) == hints_.end()) search.solve_parts(*next);
      }
    }
    RayFans held(question, goal, fans, last - first);
    search.run(std::span(lists_).subspan(first, last - first),
               [&](std::size_t i) { return held.next_open(i); });
    while (const auto segment = goal.unsolved()) {
      search.solve_parts(*segment);
      goal.settle(*segment);
    }
    swept_[r] = goal.swept();
  }

  // Takes poses between the pieces of what is covered, while the ray beside has fewer: so many.
  void fill_gaps(const RayQuestion& question, std::size_t beside, WholeSweep& goal,
                 GroupSearch<WholeSweep>& search) const {
    for (std::size_t i = 0; i + 1 < goal.known().size() && goal.known().size() > beside;) {
      const auto pieces = goal.known();
      const Vec3 middle = question.ray.at(0.5 * (pieces[i].hi + pieces[i + 1].lo));
      const auto likely = likely_segment_at(middle, question, sweep_);
      const int change = goal.change();
      if (likely) search.take_pose(*likely);
      if (goal.change() == change) ++i;
    }
  }

  // Segments that likely make the ends of a ray beside another, of which this is covered.
  void find_hints(const RayQuestion& question, const Ray& other,
                  std::span<const SweptInterval> beside) {
    hints_.clear();
    for (const SweptInterval& c : beside) {
      for (const bool leaving : {false, true}) {
        const SweptIntervalEnd& end = leaving ? c.hi : c.lo;
        if (body_of(end.segment) != sweep_.body) continue;
        ClimbTop top = climbed(question, sweep_, end.segment, leaving);
        // From where the end was to the middle of the piece, which is shorter here.
        for (const double share : {0.0, 0.5, 1.0}) {
          if (top.meets) break;
          const double at = std::lerp(end.s, 0.5 * (c.lo.s + c.hi.s), share);
          const auto there = likely_segment_at(
              question.ray.at(question.ray.direction.dot(other.at(at) - question.ray.origin)),
              question, sweep_);
          if (there) top = climbed(question, sweep_, *there, leaving);
        }
        if (!top.meets) continue;
        if (std::ranges::find(hints_, top.segment) == hints_.end()) hints_.push_back(top.segment);
      }
    }
  }

  [[nodiscard]] const Body* body_of(std::uint32_t segment) const {
    const std::uint32_t block = question_.path->segments[segment].block;
    return &question_.tools->at(question_.path->blocks[block].tool).body();
  }

  // The cutter where it makes this end of the middle ray, seen from all rays of the tile.
  [[nodiscard]] std::optional<HalfCover> half_cover(const RayTile& tile, const Ray& ray,
                                                    const SweptIntervalEnd& end,
                                                    bool leaving) const {
    if (end.section == kConcaveSurface) return std::nullopt;
    const Body& body = *body_of(end.segment);
    const Profile& part = body.sections()[end.section];
    const SegmentMotion motion(*question_.path, question_.path->segments[end.segment],
                               body.reach());
    const ToolPose pose = motion.at(end.t);
    const auto known = part.chord(pose, ray);
    if (!known) return std::nullopt;
    HalfCover cover;
    const TangentPlane plane(part, pose, ray, *known, leaving);
    if (plane.along < kGrazingCover) return std::nullopt;
    cover.anchor = {&part, pose, end.segment, end.section, end.t};
    cover.plane = plane_at(ray,
                           {leaving ? known->hi : known->lo, end.section,
                            leaving ? known->hi_face : known->lo_face, pose},
                           leaving, body);
    cover.is_beyond = true;
    for (std::size_t k = 0; k < 4; ++k) {
      const auto chord = part.chord(pose, tile.corners[k]);
      if (!chord) return std::nullopt;
      cover.chords[k] = *chord;
      const double s = leaving ? chord->hi : chord->lo;
      cover.ends[k] = tile.corners[k].at(s);
      cover.is_beyond = cover.is_beyond && (leaving ? s >= tile.span.hi + 2.0 * kInward
                                                    : s <= tile.span.lo - 2.0 * kInward);
    }
    return cover;
  }

  // Of this tool's cutters; where another tool's makes the end, by the latitude of that one.
  [[nodiscard]] SeparatingPlane plane_at(const Ray& ray, const EndContact& end, bool leaving,
                                         const Body& body) const {
    if (&body == sweep_.body) return {body, ray, end, leaving};
    const Vec3 beyond = leaving ? ray.direction : Vec3(-ray.direction), point = ray.at(end.s);
    const Facing facing = body.sections()[end.section].facing(end.face, end.pose, point, beyond);
    return {*sweep_.body, point, beyond, {facing.axial, facing.lateral}};
  }

  // At the ends of what is covered of a ray, for the groups of lists_ from `first` on.
  [[nodiscard]] std::vector<CoverFan> fans_of(std::size_t r, std::size_t first) const {
    const RayQuestion question{question_.path, question_.rays[r], question_.spans[r],
                               question_.first_excluded};
    const EndPlanes planes(question, *sweep_.body);
    const std::span<const std::uint32_t> groups = std::span(lists_).subspan(first);
    const auto fan_at = [&](const SweptIntervalEnd& end, bool leaving) {
      const bool within = leaving ? end.s < question.span.hi : end.s > question.span.lo;
      if (!within || body_of(end.segment) != sweep_.body) return EndFan();
      return EndFan(planes.at(end, leaving), sweep_.tree.quads(), groups);
    };
    std::vector<CoverFan> fans;
    for (const SweptInterval& c : swept_[r])
      fans.push_back({fan_at(c.lo, false), fan_at(c.hi, true)});
    return fans;
  }

  void find_covers(const RayTile& tile, std::size_t middle) {
    covers_.clear();
    const Ray& ray = question_.rays[middle];
    for (const SweptInterval& c : swept_[middle]) {
      const auto lo = half_cover(tile, ray, c.lo, false), hi = half_cover(tile, ray, c.hi, true);
      if (lo && hi && are_linked(tile, *lo, *hi)) {
        add_cover({*lo, *hi});
        continue;
      }
      for (const SweptIntervalEnd& end : {c.lo, c.hi}) {
        const auto enters = half_cover(tile, ray, end, false);
        const auto leaves = half_cover(tile, ray, end, true);
        if (enters && leaves) add_cover({*enters, *leaves});
      }
    }
  }

  void add_cover(const TileCover& cover) {
    covers_.push_back(cover);
    // What other tools cover is known of every ray.
    const auto is_own = [&](const TileAnchor& anchor) {
      return body_of(anchor.segment) == sweep_.body;
    };
    for (const HalfCover& half : {cover.lo, cover.hi}) {
      if (half.is_beyond && is_own(half.anchor)) anchors_.push_back(half.anchor);
    }
  }

  // What a cutter where a segment begins covers of the corners.
  struct Link {
    std::uint32_t segment = 0;
    std::array<Chord, 4> chords{};
  };

  // Whether cutters from the one to the other along the path link what both cover, on all rays of
  // the tile. Those between are anchors then: groups left aside may hold them.
  [[nodiscard]] bool are_linked(const RayTile& tile, const HalfCover& lo, const HalfCover& hi) {
    if (overlap(lo.chords, hi.chords)) return true;
    constexpr int kHalvings = 5;
    const std::size_t before = anchors_.size();
    const Link a{lo.anchor.segment, lo.chords}, b{hi.anchor.segment, hi.chords};
    const bool own = body_of(a.segment) == sweep_.body && body_of(b.segment) == sweep_.body;
    if (own && link(tile, *lo.anchor.part, lo.anchor.section, a, b, kHalvings)) return true;
    anchors_.resize(before);
    return false;
  }
  [[nodiscard]] bool link(const RayTile& tile, const Profile& part, std::uint32_t section,
                          const Link& a, const Link& b, int halvings) {
    if (overlap(a.chords, b.chords)) return true;
    Link middle{(a.segment + b.segment) / 2};
    if (halvings == 0 || middle.segment == a.segment || middle.segment == b.segment ||
        body_of(middle.segment) != sweep_.body) {
      return false;
    }
    const ToolPose& pose = question_.path->from(question_.path->segments[middle.segment]);
    for (std::size_t k = 0; k < 4; ++k) {
      const auto chord = part.chord(pose, tile.corners[k]);
      if (!chord) return false;
      middle.chords[k] = *chord;
    }
    anchors_.push_back({&part, pose, middle.segment, section, 0.0});
    return link(tile, part, section, a, middle, halvings - 1) &&
           link(tile, part, section, middle, b, halvings - 1);
  }

  // Chords of two convex cutters that overlap at all corners do so on all rays between.
  [[nodiscard]] static bool overlap(const std::array<Chord, 4>& a, const std::array<Chord, 4>& b) {
    for (std::size_t k = 0; k < 4; ++k) {
      if (a[k].lo > b[k].hi - 4.0 * kInward || b[k].lo > a[k].hi - 4.0 * kInward) return false;
    }
    return true;
  }

  [[nodiscard]] double height(const PoseGroup& group, const Vec3& normal) const {
    double most = -kInfinity;
    for (const Profile& part : sweep_.body->parts())
      most = std::max(most, support(group, part, normal));
    return most + normal.dot(group.middle.tip);
  }

  [[nodiscard]] bool is_beside(const RayTile& tile, const PoseGroup& group) const {
    const Vec3 d = tile.corners[0].direction;
    const Vec3 middle = 0.25 * (tile.corners[0].origin + tile.corners[1].origin +
                                tile.corners[2].origin + tile.corners[3].origin);
    const Vec3& axis = group.middle.axis;
    const Vec3 offset = middle - group.middle.tip;
    const auto apart = [&](const Vec3& n) {
      double least = kInfinity;
      for (const Ray& c : tile.corners) least = std::min(least, n.dot(c.origin));
      return height(group, n) < least - kSurely;
    };
    const Vec3 across = d.cross(axis);
    const double sine = across.norm();
    if (sine > 1e-3 && apart(across * ((across.dot(offset) > 0.0 ? 1.0 : -1.0) / sine)))
      return true;
    const Vec3 facing = axis - d.dot(axis) * d;
    const double length = facing.norm();
    if (length > 1e-3) {
      const Profile& part = sweep_.body->parts().front();
      const double half = 0.5 * (part.bottom() + part.height());
      const double side = facing.dot(offset) > half * length * length ? 1.0 : -1.0;
      if (apart(facing * (side / length))) return true;
    }
    const Vec3 radial = offset - offset.dot(d) * d;
    const double away = radial.norm();
    return away > 1e-3 && apart(radial / away);
  }

  [[nodiscard]] bool is_out_of_reach(const RayTile& tile, const GroupQuad& groups,
                                     std::size_t lane) const {
    if (groups.earliest[lane] >= question_.first_excluded) return true;
    for (std::size_t d = 0; d < 3; ++d) {
      const auto k = static_cast<Eigen::Index>(d);
      if (groups.box_min[d][lane] > tile.box.max[k] || groups.box_max[d][lane] < tile.box.min[k]) {
        return true;
      }
    }
    return false;
  }

  // Of the groups `from` to `to` of a quad.
  using Verdicts = std::array<Verdict, kSiblings>;
  [[nodiscard]] Verdicts judge(const RayTile& tile, const GroupQuad& groups, std::size_t from,
                               std::size_t to) const {
    Verdicts verdicts{Verdict::aside, Verdict::aside, Verdict::aside, Verdict::aside};
    for (std::size_t lane = from; lane < to; ++lane) {
      if (!is_out_of_reach(tile, groups, lane)) verdicts[lane] = Verdict::open;
    }
    for (const TileCover& c : covers_) {
      if (std::ranges::all_of(verdicts, [](Verdict v) { return v == Verdict::aside; }))
        return verdicts;
      const DoubleFour lo = c.lo.is_beyond ? four_of(kInfinity) : c.lo.behind(groups);
      const DoubleFour hi = c.hi.is_beyond ? four_of(kInfinity) : c.hi.behind(groups);
      for (std::size_t lane = 0; lane < kSiblings; ++lane) {
        const double least = std::min(lo[lane], hi[lane]);
        if (verdicts[lane] == Verdict::aside || !(least >= -kSurely)) continue;
        verdicts[lane] = least >= kFanMargin ? Verdict::aside : Verdict::level;
      }
    }
    for (std::size_t lane = 0; lane < kSiblings; ++lane) {
      if (verdicts[lane] != Verdict::aside && is_beside(tile, groups.group(lane)))
        verdicts[lane] = Verdict::aside;
    }
    return verdicts;
  }

  // Appends to lists_ what of it between first and last the tile leaves open. Groups that are much
  // larger than the tile are divided.
  void filter(const RayTile& tile, std::size_t first, std::size_t last) {
    for (std::size_t k = first; k < last; ++k) {
      const std::size_t lane = lists_[k] % kSiblings;
      sift(tile, lists_[k] / kSiblings, lane, lane + 1);
    }
    covers_.clear();
  }
  // The groups `from` to `to` of a quad; false if nothing of them was left aside.
  bool sift(const RayTile& tile, std::uint32_t quad, std::size_t from, std::size_t to) {
    const GroupQuad& groups = sweep_.tree.quads()[quad];
    const Verdicts verdicts = judge(tile, groups, from, to);
    bool any_aside = false;
    for (std::size_t lane = from; lane < to; ++lane) {
      if (groups.is_free(lane)) continue;
      const bool left = verdicts[lane] == Verdict::aside ||
                        keep(tile, kSiblings * quad + static_cast<std::uint32_t>(lane),
                             verdicts[lane] == Verdict::open);
      any_aside = any_aside || left;
    }
    return any_aside;
  }
  // False if nothing of it was left aside: then it stays whole.
  bool keep(const RayTile& tile, std::uint32_t index, bool divides) {
    const GroupQuad& groups = sweep_.tree.quads()[index / kSiblings];
    const std::size_t lane = index % kSiblings, before = lists_.size();
    const double fine = covers_.empty() ? kCoarse : kFine;
    if (divides && groups.count[lane] == 0 && groups.shift[lane] > fine * tile.size) {
      if (sift(tile, groups.next[lane], 0, kSiblings) || fans_follow_) return true;
      lists_.resize(before);
    }
    lists_.push_back(index);
    return false;
  }

  const TileQuestion& question_;
  const ToolSweep& sweep_;
  std::span<std::vector<SweptInterval>> swept_;
  std::vector<std::uint8_t> done_;
  std::vector<std::uint32_t> lists_{};  // a stack: of each tile on the way down, what is open
  std::vector<std::uint32_t> hints_{};
  std::vector<TileCover> covers_{};
  bool fans_follow_ = false;
  std::vector<TileAnchor> anchors_{};  // a stack too
};

}  // namespace

void extend_swept_intervals(const TileQuestion& question, const ToolSweep& sweep,
                            std::span<std::vector<SweptInterval>> swept) {
  TileSearch(question, sweep, swept).run();
}

}  // namespace frustum::cutter

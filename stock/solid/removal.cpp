#include "stock/solid/removal.hpp"

#include <fmt/format.h>
#include <oneapi/tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "cutter/sweep/segment_sweep.hpp"

namespace frustum::stock {
namespace {

using cutter::SegmentMotion;
using kinematics::ToolPath;
using kinematics::ToolPose;

// What two answers for the same ray may differ by without anybody having cut: rounding of ends.
constexpr double kRounding = 1e-9;  // mm

// One ray's history. States are nested by construction: material that is gone never comes back,
// whatever the rounding of the ends.
class RayHistory {
 public:
  RayHistory(const Workpiece& workpiece, const Timetable& table, const Ray& ray, RaySpan span)
      : workpiece_(workpiece), table_(table), ray_(ray), span_(span) {}

  std::vector<RemovedPiece> pieces() {
    const IntervalSet blank = before(0);
    if (blank.empty()) return {};
    divide(0, table_.blocks(), blank, before(table_.blocks()).intersected(blank));
    return std::move(pieces_);
  }

 private:
  [[nodiscard]] IntervalSet before(std::uint32_t block) const {
    return workpiece_.material_along(ray_, span_, table_.first_segment(block));
  }

  // Material is `had` before block `from` and `left` before block `to`.
  void divide(std::uint32_t from, std::uint32_t to, const IntervalSet& had,
              const IntervalSet& left) {
    const IntervalSet gone = had.minus(left);
    if (gone.empty()) return;
    if (to - from == 1 || gone.length() <= kRounding) {
      for (const Interval& piece : gone.intervals()) pieces_.push_back({to - 1, piece});
      return;
    }
    const std::uint32_t pivot = likely(from, to, gone);
    const auto at = [&](std::uint32_t block) {
      return before(block).intersected(had).united(left);
    };
    const IntervalSet until = pivot == from ? had : at(pivot);
    const IntervalSet after = pivot + 1 == to ? left : at(pivot + 1).intersected(until);
    if (pivot > from) divide(from, pivot, had, until);
    divide(pivot, pivot + 1, until, after);
    if (pivot + 1 < to) divide(pivot + 1, to, after, left);
  }

  // The last block whose sweep bounds what is gone, else the middle of the range.
  [[nodiscard]] std::uint32_t likely(std::uint32_t from, std::uint32_t to,
                                     const IntervalSet& gone) const {
    const auto& path = workpiece_.removed().path();
    std::int64_t best = -1;
    for (const Interval& piece : gone.intervals()) {
      for (const EndTag tag : {piece.lo_tag, piece.hi_tag}) {
        if (tag < 0) continue;
        const std::uint32_t block = path.segments[static_cast<std::size_t>(tag)].block;
        if (block >= from && block < to) best = std::max<std::int64_t>(best, block);
      }
    }
    return best >= 0 ? static_cast<std::uint32_t>(best) : from + (to - from) / 2;
  }

  const Workpiece& workpiece_;
  const Timetable& table_;
  const Ray& ray_;
  RaySpan span_;
  std::vector<RemovedPiece> pieces_{};
};

struct Extent {
  double lo = std::numeric_limits<double>::infinity();
  double hi = -std::numeric_limits<double>::infinity();
  void take(double v) {
    lo = std::min(lo, v);
    hi = std::max(hi, v);
  }
  void take(const Extent& other) {
    lo = std::min(lo, other.lo);
    hi = std::max(hi, other.hi);
  }
  [[nodiscard]] bool empty() const { return lo > hi; }
};

// How a block takes a piece of a ray: when its cutter meets it first, along what of its axis the
// cutter is in it at any time, and where across axis and feed it meets the piece's ends.
struct Engagement {
  Extent time{}, axial{}, radial{};
  Extent made{};  // when it makes ends of the piece
};

class EngagementSearch {
 public:
  EngagementSearch(const Workpiece& workpiece, const Timetable& table)
      : swept_(workpiece.removed()), path_(swept_.path()), table_(table) {}

  // The cutter is looked at at every quarter of its radius; first meetings are halved down to a
  // nanometre of motion.
  [[nodiscard]] Engagement of(const RemovedPiece& removed, const Ray& ray) const {
    Engagement engagement;
    bool has_lo = take_made_end(engagement, removed, ray, removed.piece.lo, removed.piece.lo_tag);
    bool has_hi = take_made_end(engagement, removed, ray, removed.piece.hi, removed.piece.hi_tag);
    for (std::uint32_t i = table_.first_segment(removed.block);
         i < table_.first_segment(removed.block + 1); ++i) {
      if (!meets(swept_.box(i), ray, removed.piece)) continue;
      const Passage passage(*this, i, removed, ray);
      if (engagement.time.empty()) {
        const auto t = passage.first(removed.piece.lo, removed.piece.hi);
        if (!t) continue;
        engagement.time.take(table_.time(i, *t));
      }
      passage.take_all(engagement);
      const double middle = 0.5 * (removed.piece.lo + removed.piece.hi);
      has_lo = has_lo || passage.take_first(engagement, removed.piece.lo, middle);
      has_hi = has_hi || passage.take_first(engagement, removed.piece.hi, middle);
    }
    if (engagement.time.empty()) engagement.time = engagement.made;  // it hardly grazes
    return engagement;
  }

 private:
  // A piece and the cutter on its way over one segment.
  class Passage {
   public:
    Passage(const EngagementSearch& search, std::uint32_t segment, const RemovedPiece& removed,
            const Ray& ray)
        : body_(search.body_of(removed)),
          motion_(search.path_, search.path_.segments[segment], body_.reach()),
          feed_(motion_.at(1.0).tip - motion_.at(0.0).tip),
          piece_(removed.piece),
          ray_(ray),
          steps_(1 + static_cast<int>(motion_.travel() / (0.25 * body_.max_radius()))) {}

    // When it first covers some of the ray from lo to hi.
    [[nodiscard]] std::optional<double> first(double lo, double hi) const {
      const auto covers = [&](double t) { return body_.meets(motion_.at(t), ray_, lo, hi); };
      if (covers(0.0)) return 0.0;
      int k = 1;
      while (k <= steps_ && !covers(time(k))) ++k;
      if (k > steps_) return std::nullopt;
      double before = time(k - 1), after = time(k);
      while ((after - before) * motion_.travel() > 1e-6) {
        const double middle = 0.5 * (before + after);
        if (middle == before || middle == after) break;
        (covers(middle) ? after : before) = middle;
      }
      return after;
    }
    void take_all(Engagement& engagement) const {
      for (int k = 0; k <= steps_; ++k) take_axial(engagement, motion_.at(time(k)));
    }
    // Where it first covers an end, if it does; `inside`: a place within the piece.
    bool take_first(Engagement& engagement, double end, double inside) const {
      constexpr double kJustInside = 1e-6;  // mm
      const double next = end + std::clamp(inside - end, -kJustInside, kJustInside);
      const auto t = first(std::min(end, next), std::max(end, next));
      if (!t) return false;
      take_end(engagement, end, motion_.at(*t));
      return true;
    }
    void take_end(Engagement& engagement, double end, const ToolPose& pose) const {
      take_axial(engagement, pose);
      constexpr double kPlunge = 1e-6;  // of the feed across the axis
      const Vec3 across = feed_.cross(pose.axis);
      if (!(across.norm() > kPlunge * feed_.norm())) return;
      engagement.radial.take((ray_.at(end) - pose.tip).dot(across.normalized()));
    }

   private:
    [[nodiscard]] double time(int k) const { return static_cast<double>(k) / steps_; }
    // Of what of the piece it covers; hollows of concave bodies count as if they were filled.
    void take_axial(Engagement& engagement, const ToolPose& pose) const {
      for (const cutter::Profile& section : body_.sections()) {
        const auto chord = section.chord(pose, ray_);
        if (!chord) continue;
        const double lo = std::max(chord->lo, piece_.lo), hi = std::min(chord->hi, piece_.hi);
        if (!(lo < hi)) continue;
        for (const double s : {lo, hi})
          engagement.axial.take((ray_.at(s) - pose.tip).dot(pose.axis));
      }
    }

    const cutter::Body& body_;
    SegmentMotion motion_;
    Vec3 feed_;
    const Interval& piece_;
    const Ray& ray_;
    int steps_;
  };

  [[nodiscard]] const cutter::Body& body_of(const RemovedPiece& removed) const {
    return swept_.tool(path_.blocks[removed.block].tool).body();
  }

  // An end that this block made, where its cutter is there.
  bool take_made_end(Engagement& engagement, const RemovedPiece& removed, const Ray& ray,
                     double end, EndTag tag) const {
    if (tag < static_cast<EndTag>(table_.first_segment(removed.block)) ||
        tag >= static_cast<EndTag>(table_.first_segment(removed.block + 1)))
      return false;
    const auto segment = static_cast<std::uint32_t>(tag);
    const cutter::SweepContact contact = swept_.contact(ray, end, segment);
    Passage(*this, segment, removed, ray).take_end(engagement, end, contact.pose);
    engagement.made.take(table_.time(segment, contact.t));
    return true;
  }

  static bool meets(const Box& box, const Ray& ray, const Interval& piece) {
    const Vec3 a = ray.at(piece.lo), b = ray.at(piece.hi);
    return (a.cwiseMin(b).array() <= box.max.array()).all() &&
           (a.cwiseMax(b).array() >= box.min.array()).all();
  }

  const cutter::SweptCutter& swept_;
  const ToolPath& path_;
  const Timetable& table_;
};

// Sums over the pieces of one block.
struct Tally {
  std::uint32_t block = 0;
  double volume = 0.0;
  double length = 0.0;
  double largest = 0.0;
  std::uint64_t pieces = 0;
  Extent axial{}, radial{}, time{};

  void take(const Tally& other) {
    volume += other.volume;
    length += other.length;
    largest = std::max(largest, other.largest);
    pieces += other.pieces;
    axial.take(other.axial);
    radial.take(other.radial);
    time.take(other.time);
  }
};

// Of one row of rays, by block; pieces are met in the order of rays and of the program.
std::vector<Tally> tally_row(const Workpiece& workpiece, const Timetable& table,
                             const CellRays& rays, int v) {
  const EngagementSearch search(workpiece, table);
  std::vector<Tally> tallies;
  for (int u = 0; u < rays.count_u; ++u) {
    const Ray ray = rays.ray(u, v);
    for (const RemovedPiece& removed : removed_along(workpiece, table, ray, rays.span())) {
      const double length = removed.piece.length();
      Tally tally{.block = removed.block, .volume = length * rays.cell() / 3.0};
      if (length > kRounding) {
        tally.length = tally.largest = length;
        tally.pieces = 1;
        const Engagement engagement = search.of(removed, ray);
        tally.axial = engagement.axial;
        tally.radial = engagement.radial;
        tally.time = engagement.time;
      }
      const auto same = std::find_if(tallies.begin(), tallies.end(),
                                     [&](const Tally& t) { return t.block == removed.block; });
      same == tallies.end() ? tallies.push_back(tally) : same->take(tally);
    }
  }
  return tallies;
}

BlockRemoval summary(const Tally& tally, const kinematics::PathBlock& block) {
  BlockRemoval removal{
      .block = tally.block, .volume = tally.volume, .largest_thickness = tally.largest};
  if (block.duration > 0.0) removal.rate = 60.0 * tally.volume / block.duration;
  if (tally.pieces > 0) removal.mean_thickness = tally.length / static_cast<double>(tally.pieces);
  if (!tally.axial.empty()) removal.axial_engagement = tally.axial.hi - tally.axial.lo;
  if (!tally.radial.empty()) removal.radial_engagement = tally.radial.hi - tally.radial.lo;
  if (!tally.time.empty()) {
    removal.first_contact = tally.time.lo;
    removal.last_contact = tally.time.hi;
  }
  return removal;
}

std::optional<Diagnostic> fault_of(const BoundingBox& box, double pitch) {
  if (!std::isfinite(pitch) || pitch <= 0.0) {
    return error("ray-pitch"_id, fmt::format("the pitch of the rays is {} mm", pitch),
                 "it must be a finite number above 0");
  }
  const Vec3 n = (box.max - box.min) / pitch;
  const double rays = n.x() * n.y() + n.y() * n.z() + n.z() * n.x();
  if (rays <= kMaxRemovalRays) return std::nullopt;
  return error("ray-pitch"_id,
               fmt::format("a pitch of {} mm needs {:.3g} rays for this blank; {:.3g} is the limit",
                           pitch, rays, kMaxRemovalRays),
               fmt::format("use a pitch of {:.2g} mm or more",
                           1.1 * pitch * std::sqrt(rays / kMaxRemovalRays)));
}

}  // namespace

std::vector<RemovedPiece> removed_along(const Workpiece& workpiece, const Timetable& table,
                                        const Ray& ray, RaySpan span) {
  return RayHistory(workpiece, table, ray, span).pieces();
}

CellRays CellRays::over(const BoundingBox& box, int axis, double pitch) {
  const int u = (axis + 1) % 3, v = (axis + 2) % 3;
  const Vec3 size = box.max - box.min;
  CellRays rays{.origin = box.min, .axis = axis, .length = size[axis]};
  // A hair below a whole number is that number.
  const auto cells = [&](int k) {
    return std::max(1, static_cast<int>(std::ceil(size[k] / pitch - 1e-9)));
  };
  rays.count_u = cells(u);
  rays.count_v = cells(v);
  rays.pitch_u = size[u] / rays.count_u;
  rays.pitch_v = size[v] / rays.count_v;
  return rays;
}

Ray CellRays::ray(int u, int v) const {
  // Irrational steps from row to row: a face along the rays of one row is not met by all rows
  // alike.
  constexpr double kStepU = 0.61803398874989485, kStepV = 0.41421356237309505;
  const auto shift = [](double s) { return s - std::floor(s); };
  return {origin + (u + shift(0.5 + kStepU * v)) * pitch_u * Vec3::Unit((axis + 1) % 3) +
              (v + shift(0.5 + kStepV * u)) * pitch_v * Vec3::Unit((axis + 2) % 3),
          Vec3::Unit(axis)};
}

Result<std::vector<BlockRemoval>> removal_of(const Workpiece& workpiece,
                                             const RemovalOptions& options) {
  const BoundingBox box = workpiece.blank().bounds();
  double pitch = options.pitch.value;
  if (pitch == 0.0) pitch = (box.max - box.min).maxCoeff() / 120.0;
  if (const auto fault = fault_of(box, pitch)) return *fault;

  const ToolPath& path = workpiece.removed().path();
  const Timetable table(path);
  std::vector<Tally> all(path.blocks.size());
  for (std::uint32_t i = 0; i < all.size(); ++i) all[i].block = i;
  for (int axis = 0; axis < 3; ++axis) {
    const CellRays rays = CellRays::over(box, axis, pitch);
    std::vector<std::vector<Tally>> rows(static_cast<std::size_t>(rays.count_v));
    tbb::parallel_for(0, rays.count_v, [&](int v) {
      rows[static_cast<std::size_t>(v)] = tally_row(workpiece, table, rays, v);
    });
    for (const auto& row : rows) {
      for (const Tally& tally : row) all[tally.block].take(tally);
    }
  }
  std::vector<BlockRemoval> removal;
  removal.reserve(all.size());
  for (const Tally& tally : all) removal.push_back(summary(tally, path.blocks[tally.block]));
  return removal;
}

}  // namespace frustum::stock

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

// When and where in the tool's frame a block meets a piece of a ray.
struct Meeting {
  double time = 0.0;
  ToolPose pose{};
  Vec3 feed = Vec3::Zero();  // of the tip, not normalised
};

class MeetingSearch {
 public:
  MeetingSearch(const Workpiece& workpiece, const Timetable& table)
      : swept_(workpiece.removed()), path_(swept_.path()), table_(table) {}

  // The first instant at which the block's cutter, at every quarter of its radius, covers some of
  // the piece; then halved down to a nanometre of motion.
  [[nodiscard]] std::optional<Meeting> first(const RemovedPiece& removed, const Ray& ray) const {
    for (std::uint32_t i = table_.first_segment(removed.block);
         i < table_.first_segment(removed.block + 1); ++i) {
      const Box& box = swept_.box(i);
      if (!meets(box, ray, removed.piece)) continue;
      if (const auto t = first_in(i, removed, ray)) {
        const auto& segment = path_.segments[i];
        return Meeting{table_.time(i, *t),
                       kinematics::between(path_.from(segment), path_.to(segment), *t),
                       path_.to(segment).tip - path_.from(segment).tip};
      }
    }
    return std::nullopt;
  }

 private:
  static bool meets(const Box& box, const Ray& ray, const Interval& piece) {
    const Vec3 a = ray.at(piece.lo), b = ray.at(piece.hi);
    return (a.cwiseMin(b).array() <= box.max.array()).all() &&
           (a.cwiseMax(b).array() >= box.min.array()).all();
  }

  [[nodiscard]] std::optional<double> first_in(std::uint32_t i, const RemovedPiece& removed,
                                               const Ray& ray) const {
    const auto& segment = path_.segments[i];
    const cutter::Body& body = swept_.tool(path_.blocks[removed.block].tool).body();
    const SegmentMotion motion(path_, segment, body.reach());
    const auto covers = [&](double t) {
      return body.meets(motion.at(t), ray, removed.piece.lo, removed.piece.hi);
    };
    if (covers(0.0)) return 0.0;
    const int steps = 1 + static_cast<int>(motion.travel() / (0.25 * body.max_radius()));
    int k = 1;
    while (k <= steps && !covers(static_cast<double>(k) / steps)) ++k;
    if (k > steps) return std::nullopt;
    double lo = static_cast<double>(k - 1) / steps, hi = static_cast<double>(k) / steps;
    while ((hi - lo) * motion.travel() > 1e-6) {
      const double middle = 0.5 * (lo + hi);
      (covers(middle) ? hi : lo) = middle;
      if (middle == lo && middle == hi) break;
    }
    return hi;
  }

  const cutter::SweptCutter& swept_;
  const ToolPath& path_;
  const Timetable& table_;
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

void take_engagement(Tally& tally, const Meeting& meeting, const Ray& ray, const Interval& piece) {
  constexpr double kPlunge = 1e-6;  // of the feed across the axis
  tally.time.take(meeting.time);
  const Vec3 across = meeting.feed.cross(meeting.pose.axis);
  const bool has_side = across.norm() > kPlunge * meeting.feed.norm();
  for (const double s : {piece.lo, piece.hi}) {
    const Vec3 w = ray.at(s) - meeting.pose.tip;
    tally.axial.take(w.dot(meeting.pose.axis));
    if (has_side) tally.radial.take(w.dot(across.normalized()));
  }
}

// Of one row of rays, by block; pieces are met in the order of rays and of the program.
std::vector<Tally> tally_row(const Workpiece& workpiece, const Timetable& table,
                             const CellRays& rays, int v) {
  const MeetingSearch search(workpiece, table);
  std::vector<Tally> tallies;
  for (int u = 0; u < rays.count_u; ++u) {
    const Ray ray = rays.ray(u, v);
    for (const RemovedPiece& removed : removed_along(workpiece, table, ray, rays.span())) {
      const double length = removed.piece.length();
      Tally tally{.block = removed.block, .volume = length * rays.cell() / 3.0};
      if (length > kRounding) {
        tally.length = tally.largest = length;
        tally.pieces = 1;
        if (const auto meeting = search.first(removed, ray)) {
          take_engagement(tally, *meeting, ray, removed.piece);
        }
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

#include "trials/population/window_bounds.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "cutter/sweep/segment_motion.hpp"
#include "trials/population/middle_contact.hpp"

namespace frustum::trials {
namespace {

using kinematics::PoseDisplacement;
using kinematics::ToolPath;
using kinematics::ToolPose;

// For what is of second order in the errors.
constexpr double kSecondOrder = 1.02;
// Machines are followed up to this many times the limits of their laws, by distances at least.
constexpr double kMostScale = 4.0;
// Twice, for both move; beyond so many of the largest motions nothing matters.
constexpr double kFarOff = 2.0 * kMostScale * 2.0;
// Motions of one place are some 4 kB.
constexpr std::uint32_t kMostPlaces = 20'000;
constexpr double kNever = std::numeric_limits<double>::infinity();

// Of the body at a pose from the point, and the way out of the body there.
struct BodyDistance {
  double value = 0.0;
  Vec3 out = Vec3::UnitZ();
};
BodyDistance from_body(const cutter::Body& body, const ToolPose& pose, const Vec3& point) {
  constexpr double kStep = 1e-4;  // mm: the direction to 1e-4 rad where the cutter is round
  BodyDistance d{body.distance(pose, point), Vec3::Zero()};
  for (int i = 0; i < 3; ++i) {
    const Vec3 step = kStep * Vec3::Unit(i);
    d.out[i] = body.distance(pose, point + step) - body.distance(pose, point - step);
  }
  d.out.normalize();
  return d;
}

// The least distance of the moving body from a point, from below: the distance of a convex cutter
// that moves straight is a convex function of time, so that its tangents at two moments hold it
// from below in between, but for what turning bends. That of any other changes by no more than its
// way.
class LeastDistance {
 public:
  LeastDistance(const cutter::Body& body, const cutter::SegmentMotion& motion, const Vec3& point)
      : body_(body), motion_(motion), point_(point) {}

  struct Moment {
    double t = 0.0;
    BodyDistance off{};
  };
  // Not looked into where it is more than enough.
  [[nodiscard]] double find(const Moment& begin, const Moment& end, double enough) const {
    return between(begin, end, enough, 0);
  }

 private:
  [[nodiscard]] double between(const Moment& a, const Moment& b, double enough, int depth) const {
    const double lower = std::min(a.off.value, b.off.value);
    const double least = body_.is_convex() ? by_tangents(a, b) : by_way(a, b);
    constexpr int kDeepest = 14;
    if (depth == kDeepest || least > enough || least > 0.8 * lower || lower <= 0.0) return least;
    const double t = 0.5 * (a.t + b.t);
    const Moment middle{t, from_body(body_, motion_.at(t), point_)};
    return std::min(between(a, middle, enough, depth + 1), between(middle, b, enough, depth + 1));
  }

  [[nodiscard]] double by_tangents(const Moment& a, const Moment& b) const {
    const double dt = b.t - a.t;
    const double fall = std::max(0.0, dt * a.off.out.dot(motion_.velocity(point_, a.t)));
    const double rise = std::max(0.0, -dt * b.off.out.dot(motion_.velocity(point_, b.t)));
    double least = std::min(a.off.value, b.off.value);
    if (fall > 0.0 && rise > 0.0) {
      const double t = std::clamp((a.off.value - b.off.value + rise) / (fall + rise), 0.0, 1.0);
      least = std::min(least, a.off.value - fall * t);
    }
    return least - 0.125 * motion_.bend() * dt * dt;
  }
  [[nodiscard]] double by_way(const Moment& a, const Moment& b) const {
    const double sum = a.off.value + b.off.value - motion_.travel() * (b.t - a.t);
    return std::min({0.5 * sum, a.off.value, b.off.value});
  }

  const cutter::Body& body_;
  const cutter::SegmentMotion& motion_;
  const Vec3& point_;
};

void take(Closeness& worst, const Closeness& one) {
  worst.per_scale = std::max(worst.per_scale, one.per_scale);
  worst.per_drift = std::max(worst.per_drift, one.per_drift);
  worst.per_nearer = std::max(worst.per_nearer, one.per_nearer);
}

Vec3 across(const Vec3& v, const Vec3& normal) { return v - v.dot(normal) * normal; }

// Of half of the angle between two unit vectors; above 0.
double cosine_between(const Vec3& a, const Vec3& b) {
  return std::sqrt(std::max(0.5 * (1.0 + a.dot(b)), 1e-12));
}

ColumnMotions numbers_of(std::span<const PoseDisplacement> motions) {
  ColumnMotions numbers(motions.size());
  for (std::size_t j = 0; j < motions.size(); ++j) {
    for (std::size_t k = 0; k < 3; ++k) {
      const auto i = static_cast<Eigen::Index>(k);
      numbers[j][k] = static_cast<float>(motions[j].tip[i]);
      numbers[j][k + 3] = static_cast<float>(motions[j].turn[i]);
    }
  }
  return numbers;
}

}  // namespace

WindowBounds::WindowBounds(const kinematics::Machine& /*machine*/, const kinematics::Setup& setup,
                           const ColumnMotion& columns, const stock::Workpiece& workpiece)
    : setup_(setup), columns_(columns), workpiece_(workpiece), segments_(workpiece.removed()) {
  measure_largest();
}

double WindowBounds::tool_length(int tool) const {
  const kinematics::ToolGeometry& geometry = setup_.tools.at(tool);
  return geometry.length + geometry.length_error;
}

// At the ends of all blocks; errors that have waves within a block are of no use to anybody.
void WindowBounds::measure_largest() {
  constexpr std::size_t kSamples = 512;
  const ToolPath& path = workpiece_.removed().path();
  const auto limits = columns_.limits();
  PathMotions& kept = near_.path;
  kept.spread.assign(limits.size(), 0.0);
  const std::size_t stride = path.blocks.size() / kSamples + 1;
  std::vector<PoseDisplacement> last;
  std::size_t looked = 0;
  for (std::size_t s = 0; s < path.segments.size(); ++s) {
    const kinematics::PathSegment& segment = path.segments[s];
    if (s + 1 < path.segments.size() && path.segments[s + 1].block == segment.block) continue;
    const int tool = path.blocks[segment.block].tool;
    const double reach = workpiece_.removed().tool(tool).body().reach();
    const auto motions = columns_.at(path.axes[segment.first_pose + 1], tool_length(tool));
    const bool is_kept = looked++ % stride == 0;
    if (is_kept) {
      last = motions;
      kept.places.push_back(numbers_of(motions));
    }
    kept.reach = std::max(kept.reach, reach);
    double sum = 0.0;
    for (std::size_t j = 0; j < motions.size(); ++j) {
      sum += limits[j] * (motions[j].tip.norm() + reach * motions[j].turn.norm());
      kept.spread[j] =
          std::max(kept.spread[j], (motions[j].tip - last[j].tip).norm() +
                                       reach * (motions[j].turn - last[j].turn).norm());
    }
    largest_ = std::max(largest_, sum);
  }
  largest_ *= kSecondOrder;
}

std::vector<Vec3> WindowBounds::motions(const kinematics::AxisState& state, int tool,
                                        const ToolPose& pose, const Vec3& point) const {
  std::vector<Vec3> motions;
  for (const PoseDisplacement& d : columns_.at(state, tool_length(tool))) {
    motions.push_back(d.at(point - pose.tip));
  }
  return motions;
}

double WindowBounds::deviation(const std::function<double(const Vec3&)>& size,
                               const ContactPlace& at) const {
  double variance = 0.0;
  for (std::size_t j = 0; j < at.motions.size(); ++j) {
    // As if all laws were uniform.
    const double by = columns_.limits()[j] * size(at.motions[j]);
    variance += by * by / 3.0;
  }
  return std::sqrt(variance);
}

double WindowBounds::drift_deviation(const ContactPlace& at) const {
  return deviation([&](const Vec3& motion) { return across(motion, at.normal).norm(); }, at);
}

const WindowBounds::Motions& WindowBounds::motions_at(Known& known, std::uint32_t id,
                                                      const kinematics::AxisState& state,
                                                      int tool) const {
  const auto found = known.find(id);
  if (found != known.end()) return found->second;
  return known.emplace(id, numbers_of(columns_.at(state, tool_length(tool)))).first->second;
}

std::vector<double> WindowBounds::nearer(const ContactPlace& at, const Vec3& normal,
                                         const ToolPose& pose, const Motions& motions) const {
  // normal . (tip + turn x m) = normal . tip + (m x normal) . turn
  const Vec3 moment = (at.point - pose.tip).cross(normal);
  std::vector<double> by(motions.size());
  for (std::size_t j = 0; j < by.size(); ++j) {
    const auto& d = motions[j];
    const double motion = normal.x() * d[0] + normal.y() * d[1] + normal.z() * d[2] +
                          moment.x() * d[3] + moment.y() * d[4] + moment.z() * d[5];
    by[j] = motion - normal.dot(at.motions[j]);
  }
  return by;
}

double WindowBounds::sum_at_limits(std::span<const double> by) const {
  double sum = 0.0;
  for (std::size_t j = 0; j < by.size(); ++j) sum += columns_.limits()[j] * std::abs(by[j]);
  return kSecondOrder * sum;
}

// How much nearer a place beyond the end comes follows from how much the end itself does, times the
// ratio of the leans; what is left are second differences along the path.
SideBound WindowBounds::side(const ContactPlace& at, const LaneFace& face, int tool,
                             const PlaceOnPath& end, std::span<const PlaceOnPath> beyond) {
  SideBound side;
  const PointOffFace at_end = off_face(face, end.pose, at.point);
  side.at_end = at_end.distance;
  side.rho = at_end.rho;
  const Vec3 lean = across(at_end.out, at.normal);
  side.lean = lean.norm();
  side.drift_deviation = deviation([&](const Vec3& motion) { return motion.dot(lean); }, at);
  if (!(side.at_end > 0.0)) return side;
  side.closeness.per_nearer = 1.0 / side.at_end;
  const std::vector<double> by_end =
      nearer(at, at_end.out, end.pose, motions_at(of_places_, end.id, end.state, tool));
  for (const PlaceOnPath& place : beyond) {
    if (place.id == end.id) continue;
    const PointOffFace off = off_face(face, place.pose, at.point);
    const Vec3 its_lean = across(off.out, at.normal);
    const double ratio =
        side.lean > 1e-9 ? std::max(0.0, its_lean.dot(lean) / (side.lean * side.lean)) : 1.0;
    std::vector<double> by =
        nearer(at, off.out, place.pose, motions_at(of_places_, place.id, place.state, tool));
    for (std::size_t j = 0; j < by.size(); ++j) by[j] -= ratio * by_end[j];
    if (!(off.distance > 0.0)) {
      side.at_end = 0.0;
      return side;
    }
    take(side.closeness, {sum_at_limits(by) / off.distance,
                          (its_lean - ratio * lean).norm() / off.distance, ratio / off.distance});
  }
  return side;
}

ColumnMotions WindowBounds::motions_of(const kinematics::PathSegment& segment, double t) const {
  const ToolPath& path = workpiece_.removed().path();
  const kinematics::AxisState &from = path.axes[segment.first_pose],
                              &to = path.axes[segment.first_pose + 1];
  const kinematics::AxisState state = t == 1.0 ? to : state_between(from, to, t);
  return numbers_of(columns_.at(state, tool_length(path.blocks[segment.block].tool)));
}

NearPart::End WindowBounds::near_end(std::uint32_t index, double t, const Vec3& normal) {
  const ToolPath& path = workpiece_.removed().path();
  const kinematics::PathSegment& segment = path.segments[index];
  // The end of one segment is mostly the beginning of the next: both go by the pose.
  constexpr double kPose = -1.0;
  const bool is_pose = t == 0.0 || t == 1.0;
  const auto key =
      is_pose ? std::pair{segment.first_pose + (t == 0.0 ? 0U : 1U), kPose} : std::pair{index, t};
  const auto next = static_cast<std::uint32_t>(near_.places.size());
  const auto known = near_known_.find(key);
  if (known != near_known_.end()) return {known->second, normal.cast<float>()};
  if (next < kMostPlaces) {  // else the point's are not known then
    near_known_.emplace(key, next);
    const Vec3 &from = path.from(segment).tip, &to = path.to(segment).tip;
    near_.places.push_back({from + t * (to - from), motions_of(segment, t)});
  }
  return {next, normal.cast<float>()};
}

void WindowBounds::take_segment(Others& others, const ContactPlace& at, std::uint32_t index) {
  // What a machine that far outside of its laws may meet is looked at by itself.
  constexpr double kWithin = 1.0 / 50.0;
  const ToolPath& path = workpiece_.removed().path();
  const kinematics::PathSegment& segment = path.segments[index];
  const int tool = path.blocks[segment.block].tool;
  const cutter::Body& body = workpiece_.removed().tool(tool).body();
  const cutter::SegmentMotion motion(path, segment, body.reach());
  const double enough = kFarOff * largest_;
  // Both ends of a part: how far off, and how much nearer it comes.
  struct Moment {
    double t = 0.0;
    BodyDistance off{};
    double nearer = 0.0, lean = 0.0;
  };
  const auto moment = [&](double t, const BodyDistance& off) {
    const ToolPose pose = motion.at(t);
    Moment m{t, off};
    m.lean = across(m.off.out, at.normal).norm();
    m.nearer = 2.0 * largest_;
    if (m.off.value > enough) return m;
    const auto by = [&](const Motions& motions) {
      return std::min(m.nearer, sum_at_limits(nearer(at, m.off.out, pose, motions)));
    };
    if (t == 0.0 || t == 1.0) {
      const std::uint32_t end = segment.first_pose + (t == 0.0 ? 0U : 1U);
      m.nearer = by(motions_at(of_poses_, end, path.axes[end], tool));
    } else {
      m.nearer = by(motions_of(segment, t));
    }
    return m;
  };
  const auto take_near = [&](const Moment& a, const Moment& b, double least) {
    const bool is_far = a.off.value > enough || b.off.value > enough;
    const double lean = is_far ? 1.0 : std::max(a.lean, b.lean);
    const double between = is_far ? 1.0 : cosine_between(a.off.out, b.off.out);
    const double worth = between * least;
    const Closeness one{std::max(a.nearer, b.nearer) / worth, lean / worth, 0.0};
    take(others.closeness, one);
    if (one.per_scale <= kWithin) {
      take(others.near.rest, one);
      return;
    }
    constexpr double kRounding = 1e-6;
    NearPart part{static_cast<float>(least * (1.0 - kRounding)),
                  static_cast<float>(between * (1.0 - kRounding)),
                  static_cast<float>(lean * (1.0 + kRounding))};
    for (std::size_t k = 0; k < 2; ++k) {
      const Moment& m = k == 0 ? a : b;
      if (!(m.off.value > enough)) part.ends[k] = near_end(index, m.t, m.off.out);
    }
    others.near.parts.push_back(part);
  };
  // A long segment comes nearer at one end than at the other: its parts count for themselves.
  const auto take_part = [&](const auto& self, const Moment& a, const Moment& b,
                             int depth) -> void {
    const double least =
        LeastDistance(body, motion, at.point).find({a.t, a.off}, {b.t, b.off}, enough);
    constexpr int kDeepest = 8;
    const double most = std::max(a.off.value, b.off.value);
    constexpr double kTurned = 0.98;  // cosine of 11 degrees: what `between` costs then is 2 %
    const bool is_uneven = most > 1.2 * least || cosine_between(a.off.out, b.off.out) < kTurned;
    const bool is_long = is_uneven && motion.travel() * (b.t - a.t) > 0.02;
    if (least < enough && is_long && depth < kDeepest) {
      const double t = 0.5 * (a.t + b.t);
      const Moment middle = moment(t, from_body(body, motion.at(t), at.point));
      self(self, a, middle, depth + 1);
      self(self, middle, b, depth + 1);
    } else if (least > enough) {
      take(others.closeness, {2.0 * largest_ / least, 1.0 / least, 0.0});
    } else if (least > 0.0) {
      take_near(a, b, least);
    } else {
      others.closeness.per_scale = others.closeness.per_drift = kNever;
      others.near.rest.per_scale = kNever;
    }
  };
  const BodyDistance a = from_body(body, path.from(segment), at.point);
  const BodyDistance b = from_body(body, path.to(segment), at.point);
  const double least = LeastDistance(body, motion, at.point).find({0.0, a}, {1.0, b}, enough);
  if (least > enough) {
    take(others.closeness, {2.0 * largest_ / least, 1.0 / least, 0.0});
  } else if (!body.is_convex()) {
    // Between two moments it may be nearest with another of its sides: in every direction it comes
    // nearer by no more than all that moves.
    const Closeness any = least > 0.0 ? Closeness{2.0 * largest_ / least, 1.0 / least, 0.0}
                                      : Closeness{kNever, kNever, 0.0};
    take(others.closeness, any);
    take(others.near.rest, any);
  } else {
    take_part(take_part, moment(0.0, a), moment(1.0, b), 0);
  }
}

double WindowBounds::room(const Vec3& point) const {
  const ToolPath& path = workpiece_.removed().path();
  double least = kFarOff * largest_;
  segments_.for_each(point, least, [&](std::uint32_t s) {
    const kinematics::PathSegment& segment = path.segments[s];
    const cutter::Body& body = workpiece_.removed().tool(path.blocks[segment.block].tool).body();
    const cutter::SegmentMotion motion(path, segment, body.reach());
    const BodyDistance a = from_body(body, path.from(segment), point);
    const BodyDistance b = from_body(body, path.to(segment), point);
    least = std::min(least, LeastDistance(body, motion, point).find({0.0, a}, {1.0, b}, least));
    return true;
  });
  return least;
}

// A ball of that radius, by 26 directions.
bool WindowBounds::is_inside_blank(const Vec3& point, double margin) const {
  for (int x = -1; x <= 1; ++x) {
    for (int y = -1; y <= 1; ++y) {
      for (int z = 0; z <= 1; ++z) {
        const Vec3 direction = Vec3(x, y, z);
        if (direction.isZero(0.0)) continue;
        const Ray ray{point, direction.normalized()};
        const IntervalSet inside = workpiece_.blank().along(ray, {-margin, margin});
        if (inside.intervals().size() != 1) return false;
        const Interval& whole = inside.intervals().front();
        if (whole.lo > -margin || whole.hi < margin) return false;
      }
    }
  }
  return true;
}

bool is_in(std::span<const BlockRange> ranges, std::uint32_t block) {
  return std::ranges::any_of(ranges, [block](const BlockRange& r) { return r.has(block); });
}

WindowBounds::Others WindowBounds::others(const ContactPlace& at, std::span<const BlockRange> but,
                                          int tool, const ApproachLine& line) {
  const ToolPath& path = workpiece_.removed().path();
  const double far = kFarOff * largest_;
  Others others{{2.0 * largest_ / far, 1.0 / far, 0.0}, {}};
  others.near.far = far;
  // The cutter itself clears the way from the start: the point of the ball is in it then, and seen
  // from this cutter moves along the surface only, but for the turn of the line of approach (mm).
  constexpr double kTurned = 0.01;
  const Vec3 start = at.point + (line.clearance - line.travel) * line.normal;
  const double cleared = -workpiece_.removed().tool(tool).body().distance(at.pose, start);
  constexpr double kLeastInside = 1e-3;  // mm: hardly cut at all
  double inside = far;
  while (inside > kLeastInside && !is_inside_blank(at.point, inside)) inside *= 0.8;
  if (!(cleared > 0.0) || !(inside > kLeastInside)) return {{kNever, kNever, 0.0}, {}};
  for (Closeness* both : {&others.closeness, &others.near.rest}) {
    take(*both, {kTurned / cleared, 1.0 / cleared, 0.0});
    take(*both, {0.0, 0.0, 1.0 / inside});
  }
  // What is farther off says no more than `far` does.
  segments_.for_each(at.point, far, [&](std::uint32_t s) {
    if (!is_in(but, path.segments[s].block)) take_segment(others, at, s);
    return std::isfinite(others.closeness.per_scale);
  });
  if (!std::isfinite(others.closeness.per_scale)) return others;
  others.near.is_known = near_.places.size() < kMostPlaces;
  for (const Vec3& motion : at.motions) {
    others.near.own.push_back({static_cast<float>(motion.x()), static_cast<float>(motion.y()),
                               static_cast<float>(motion.z())});
  }
  return others;
}

}  // namespace frustum::trials

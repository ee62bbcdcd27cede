#include "cutter/sweep/chord_times.hpp"

#include <algorithm>
#include <array>
#include <boost/math/tools/minima.hpp>
#include <cmath>
#include <limits>
#include <numbers>
#include <utility>

#include "core/constants.hpp"
#include "cutter/sweep/segment_sweep.hpp"

namespace frustum::cutter {
namespace {

// A plane that contains the ray's direction, with unit normal n pointing from the body to the ray.
struct SeparatingPlane {
  Vec3 normal;
  double gap;
};

// Distance from the body's supporting plane with that normal to the ray; negative: overlapping.
double gap_of(const Vec3& normal, const Profile& body, const ToolPose& pose, const Ray& ray) {
  const double u = std::clamp(normal.dot(pose.axis), -1.0, 1.0);
  return normal.dot(ray.origin - pose.tip) - body.support(u);
}

// Whether the plane along the ray with that normal has the body, on its way from a to b, on its
// other side but for kMissedDepth. True is a proof. `slack`: by so much the body leaves the
// straight way between them.
bool parts(const Vec3& normal, const Profile& body, const ToolPose& a, const ToolPose& b,
           double slack, const Ray& ray) {
  // Between its ends the gap is (1 - t) A + t B or less by 4 t (1 - t) slack: least where that is
  // A / t + B / (1 - t) = (sqrt A + sqrt B)^2 against 4 slack.
  const double at_a = gap_of(normal, body, a, ray) + kMissedDepth;
  if (!(at_a > 0.0)) return false;
  const double at_b = gap_of(normal, body, b, ray) + kMissedDepth;
  if (!(at_b > 0.0)) return false;
  const double roots = std::sqrt(at_a) + std::sqrt(at_b);
  return roots * roots >= 4.0 * slack;
}

// From where a round end of the profile is about, or the end itself, to the other.
std::pair<double, double> core_of(const Profile& body) {
  const Zone &lowest = body.zones().front(), &highest = body.zones().back();
  const double lo = lowest.kind == ZoneKind::cone ? body.bottom() : lowest.centre;
  const double hi = highest.kind == ZoneKind::cone ? body.height() : highest.centre;
  return {std::min(lo, hi), std::max(lo, hi)};
}

// Across the ray, from the place of the cutter's axis that is nearest to it; about.
Vec3 away_from_axis(const Profile& body, const ToolPose& pose, const Ray& ray) {
  const Vec3 m = ray.origin - pose.tip;
  const Vec3 facing = pose.axis - ray.direction.dot(pose.axis) * ray.direction;
  const auto [lo, hi] = core_of(body);
  const double steep2 = facing.squaredNorm();
  const double height = steep2 > 1e-6 ? std::clamp(m.dot(facing) / steep2, lo, hi) : lo;
  const Vec3 arm = m - height * pose.axis;
  const Vec3 across = arm - arm.dot(ray.direction) * ray.direction;
  const double length = across.norm();
  if (!(length > 1e-9)) return perpendicular_to(ray.direction);
  // Once more: what rounding leaves along the ray of a short arm would count for all of its length.
  const Vec3 normal = across / length;
  return (normal - normal.dot(ray.direction) * ray.direction).normalized();
}

// Whether one of the planes that are likely to part them does. True is a proof.
bool surely_apart(const Profile& body, const ToolPose& a, const ToolPose& b, double slack,
                  const Ray& ray) {
  const auto apart = [&](const Vec3& normal) { return parts(normal, body, a, b, slack, ray); };
  if (apart(away_from_axis(body, a, ray))) return true;
  // The plane between the ray and the axis, and the one that faces an end of the cutter.
  const Vec3 across = ray.direction.cross(a.axis);
  const double sine = across.norm();
  if (sine > 1e-3) {
    const double side = across.dot(ray.origin - a.tip) > 0.0 ? 1.0 : -1.0;
    if (apart(across * (side / sine))) return true;
  }
  const Vec3 facing = a.axis - ray.direction.dot(a.axis) * ray.direction;
  const double length = facing.norm();
  if (length < 1e-3) return false;
  return apart(facing / length) || apart(facing / -length);
}

// The best of the planes along the ray: maximises the gap over the angle of its normal.
SeparatingPlane separate(const Profile& body, const ToolPose& pose, const Ray& ray) {
  const auto gap_at = [&](const Vec3& normal) { return gap_of(normal, body, pose, ray); };
  // Turned by thirty degrees while that is better.
  constexpr double kTall = 0.5 * std::numbers::sqrt3;
  SeparatingPlane best{away_from_axis(body, pose, ray), 0.0};
  best.gap = gap_at(best.normal);
  for (const double side : {0.5, -0.5}) {
    bool turns = false;
    for (int i = 0; i < 6; ++i) {
      const Vec3 normal = kTall * best.normal + side * ray.direction.cross(best.normal);
      const double gap = gap_at(normal);
      if (!(gap > best.gap)) break;
      best = {normal, gap};
      turns = true;
    }
    if (turns) break;
  }
  // Between its neighbours, by the tangent of the angle: to 1e-7, where the gap is flat within
  // rounding.
  constexpr double kTangent = 1.0 / std::numbers::sqrt3;
  constexpr int kBits = 24;
  const Vec3 middle = best.normal, across = ray.direction.cross(middle);
  const auto beside = [&](double tangent) -> Vec3 {
    return (middle + tangent * across) / std::sqrt(1.0 + tangent * tangent);
  };
  const auto [tangent, loss] = boost::math::tools::brent_find_minima(
      [&](double at) { return -gap_at(beside(at)); }, -kTangent, kTangent, kBits);
  return -loss < best.gap ? best : SeparatingPlane{beside(tangent), -loss};
}

// Where a run of chords ends, by the last three of them: the square of a chord's length falls
// towards the end, to 0 where the ray comes to touch the body.
class RunEnd {
 public:
  explicit RunEnd(const ChordSample& first) { take(first); }

  void take(const ChordSample& sample) {
    last_[2] = last_[1];
    last_[1] = last_[0];
    const double length = sample.chord->hi - sample.chord->lo;
    last_[0] = {sample.t, length * length};
    if (++count_ < 2) return;
    const double two = at_by(last_[0], last_[1]);
    is_expected_ = last_[0].length2 < last_[1].length2;
    if (count_ == 2) {
      at_ = two;
      unsure_ = 0.1 * std::abs(at_ - last_[0].t);
      return;
    }
    const double other = at_by(last_[1], last_[2]);
    const double share = last_[0].length2 / (last_[2].length2 - last_[0].length2);
    at_ = two + share * (two - other);
    unsure_ = 0.2 * std::abs(at_ - two);
  }
  [[nodiscard]] bool is_expected() const { return is_expected_; }
  [[nodiscard]] double at() const { return at_; }
  [[nodiscard]] double unsure() const { return unsure_; }

 private:
  struct Known {
    double t = 0.0, length2 = 0.0;
  };
  // Of time as a linear function of the square.
  [[nodiscard]] static double at_by(const Known& a, const Known& b) {
    return a.t + (a.t - b.t) * a.length2 / (b.length2 - a.length2);
  }

  std::array<Known, 3> last_{};
  int count_ = 0;
  bool is_expected_ = false;
  double at_ = 0.0, unsure_ = 0.0;
};

}  // namespace

bool overlap(const Chord& a, const Chord& b) { return a.lo <= b.hi && b.lo <= a.hi; }

ChordTimes::ChordTimes(const Profile& body, const SegmentMotion& motion, const Ray& ray)
    : body_(body), motion_(motion), ray_(ray) {
  const int steps = static_cast<int>(std::ceil(motion_.turn() / kTurnPerSample));
  samples_.push_back(sample(0.0));
  for (int i = 1; i <= std::max(1, steps); ++i) {
    const ChordSample next = sample(static_cast<double>(i) / std::max(1, steps));
    refine_between(ChordSample(samples_.back()), next, 0);
    samples_.push_back(next);
  }
}

void ChordTimes::insert(std::size_t i, double t) {
  const std::vector<ChordSample> after(samples_.begin() + static_cast<std::ptrdiff_t>(i) + 1,
                                       samples_.end());
  samples_.resize(i + 1);
  const ChordSample middle = sample(t);
  refine_between(ChordSample(samples_.back()), middle, 0);
  samples_.push_back(middle);
  refine_between(middle, after.front(), 0);
  samples_.insert(samples_.end(), after.begin(), after.end());
}

ChordSample ChordTimes::sample(double t) const {
  ChordSample s{.t = t, .pose = motion_.at(t)};
  s.chord = body_.chord(s.pose, ray_);
  return s;
}

// Appends the samples needed between two neighbours: proofs of emptiness, or ends of runs.
void ChordTimes::refine_between(const ChordSample& a, const ChordSample& b, int depth) {
  if (a.chord && b.chord) {
    join(a, b, depth);
  } else if (a.chord) {
    const ChordSample end = end_of_run(a, b);
    join(a, end, depth);
    samples_.push_back(end);
    search_beside_run(end, b, depth);
  } else if (b.chord) {
    const ChordSample begin = end_of_run(b, a);
    search_beside_run(begin, a, depth);
    samples_.push_back(begin);
    join(begin, b, depth);
  } else {
    search_empty(a, b);
  }
}

// Samples between two chords until neighbours overlap, or show a gap.
void ChordTimes::join(const ChordSample& a, const ChordSample& b, int depth) {
  if (overlap(*a.chord, *b.chord) || motion_.turn() == 0.0) return;
  if (departure(a, b) < kMissedDepth || depth > 60) return;
  const ChordSample middle = sample(0.5 * (a.t + b.t));
  refine_between(a, middle, depth + 1);
  samples_.push_back(middle);
  refine_between(middle, b, depth + 1);
}

// A body that does not turn meets the ray from the one chord to the other without a break. One that
// turns is never farther than this from it: its points run on arcs, and two of them, on the ray at
// either moment, are moved differently.
double ChordTimes::departure(const ChordSample& a, const ChordSample& b) const {
  const double dt = b.t - a.t;
  const double apart = std::max(a.chord->lo - b.chord->hi, b.chord->lo - a.chord->hi);
  return motion_.bend() * dt * dt / 8.0 +
         0.25 * motion_.turn() * dt * (motion_.travel() * dt + std::max(0.0, apart));
}

// Between the last moment of a run and a sample without a chord: none but what turning brings back.
void ChordTimes::search_beside_run(const ChordSample& run_end, const ChordSample& outside,
                                   int depth) {
  if (motion_.turn() == 0.0) return;
  const double dt = outside.t - run_end.t;
  const double beyond = run_end.t + std::copysign(2.0 * resolution(), dt);
  if (std::abs(beyond - run_end.t) >= std::abs(dt)) return;
  const ChordSample gone = sample(beyond);
  // The ray slides along the body, by rounding in and out: so often and no oftener.
  if (gone.chord && depth > 60) return;
  const bool stays_away = !gone.chord && leaves_for_good(run_end, gone, outside);
  if (dt > 0.0) {
    samples_.push_back(gone);
    if (!stays_away) refine_between(gone, outside, depth + 1);
  } else {
    if (!stays_away) refine_between(outside, gone, depth + 1);
    samples_.push_back(gone);
  }
}

// Whether the plane along the ray that touches the body where the run ends parts it from the ray
// between two samples after that. True is a proof.
bool ChordTimes::leaves_for_good(const ChordSample& run_end, const ChordSample& gone,
                                 const ChordSample& outside) const {
  const Vec3 normal =
      body_.normal_of(run_end.chord->lo_face, run_end.pose, ray_.at(run_end.chord->lo));
  const Vec3 across = normal - normal.dot(ray_.direction) * ray_.direction;
  const double length = across.norm();
  if (!(length > 1e-3)) return false;
  return parts(across / length, body_, gone.pose, outside.pose, slack_between(gone, outside), ray_);
}

double ChordTimes::slack_between(const ChordSample& a, const ChordSample& b) const {
  const double dt = b.t - a.t;
  return motion_.bend() * dt * dt / 8.0;
}

double ChordTimes::resolution() const {
  return kTangentMotion / std::max(motion_.travel(), kTangentMotion);
}

// The last time with a chord between `inside` (has one) and `outside` (has none).
ChordSample ChordTimes::end_of_run(ChordSample inside, ChordSample outside) const {
  constexpr int kHalvings = 8;  // every so many steps
  const double tolerance = resolution(), onwards = outside.t > inside.t ? 1.0 : -1.0;
  RunEnd end(inside);
  double misses = 1.0;
  for (int i = 0; std::abs(outside.t - inside.t) > tolerance; ++i) {
    const double middle = 0.5 * (inside.t + outside.t);
    if (middle == inside.t || middle == outside.t) break;
    double t = middle;
    if (end.is_expected() && i % kHalvings != 0) {
      // Just before the end, at last just after it; farther from where that was wrong.
      const double left = onwards * (end.at() - inside.t), least = 0.4 * misses * tolerance;
      const double margin = std::min(std::max(least, misses * end.unsure()), 0.9 * left);
      const double aim = inside.t + onwards * (left > tolerance ? left - margin : left + least);
      if (std::min(inside.t, outside.t) < aim && aim < std::max(inside.t, outside.t)) t = aim;
    }
    const ChordSample next = sample(t);
    if (next.chord) {
      inside = next;
      end.take(next);
      misses = 1.0;
    } else {
      outside = next;
      misses *= 4.0;
    }
  }
  return inside;
}

// Both ends have no chord: proves that there is none between, or finds one.
void ChordTimes::search_empty(const ChordSample& a, const ChordSample& b) {
  const double span = b.t - a.t;
  if (0.5 * motion_.travel() * span < kMissedDepth) return;
  const double slack = slack_between(a, b);
  if (surely_apart(body_, a.pose, b.pose, slack, ray_)) return;
  const ToolPose middle_pose = motion_.at(0.5 * (a.t + b.t));
  if (!body_.chord(middle_pose, ray_, 0.5 * motion_.travel() * span)) return;
  if (stays_beyond_end(a, b)) return;

  // Each separating plane holds until its gap, a nearly linear function of time, runs out.
  const double holds_after_a = reach_of_plane(a, b, slack);
  if (holds_after_a == b.t) return;
  const double holds_before_b = reach_of_plane(b, a, slack);
  if (holds_after_a >= holds_before_b) return;
  const ChordSample middle = sample(0.5 * (holds_after_a + holds_before_b));
  if (!(middle.t > a.t && middle.t < b.t)) return;
  refine_between(a, middle, 0);
  samples_.push_back(middle);
  refine_between(middle, b, 0);
}

// Whether the plane of an end of the body, which goes with it, has all of the ray on its other side
// that the body could reach. True is a proof.
bool ChordTimes::stays_beyond_end(const ChordSample& a, const ChordSample& b) const {
  const double span = b.t - a.t;
  const double way = motion_.travel() * span;
  double lo = kInfinity, hi = -kInfinity;
  for (const ToolPose& pose : {a.pose, b.pose}) {
    // At no moment is a point of the body farther from where it is at the nearer of both.
    const auto chord = body_.chord(pose, ray_, 0.5 * way);
    if (!chord) continue;
    lo = std::min(lo, chord->lo);
    hi = std::max(hi, chord->hi);
  }
  if (lo > hi) return true;
  double lowest = kInfinity, highest = -kInfinity;
  for (const ToolPose& pose : {a.pose, b.pose}) {
    for (const double s : {lo, hi}) {
      const double height = (ray_.at(s) - pose.tip).dot(pose.axis);
      lowest = std::min(lowest, height);
      highest = std::max(highest, height);
    }
  }
  const double departure = motion_.plane_departure(span, body_.reach() + way, way);
  return highest + departure <= body_.bottom() + kMissedDepth ||
         lowest - departure >= body_.height() - kMissedDepth;
}

// How far from `start` towards `end` the separating plane found at `start` surely separates.
double ChordTimes::reach_of_plane(const ChordSample& start, const ChordSample& end,
                                  double slack) const {
  const SeparatingPlane plane = separate(body_, start.pose, ray_);
  const double at_start = plane.gap + kMissedDepth;
  if (!(at_start > 0.0)) return start.t;
  const double at_end = gap_of(plane.normal, body_, end.pose, ray_) + kMissedDepth;
  // At x of the way the gap is at_start (1 - x) + at_end x or less by 4 x (1 - x) slack: up to the
  // first root.
  const double rise = at_end - at_start - 4.0 * slack;
  const double root2 = rise * rise - 16.0 * slack * at_start;
  if (rise >= 0.0 || root2 < 0.0) return end.t;
  const double share = 2.0 * at_start / (std::sqrt(root2) - rise);
  return share < 1.0 ? start.t + (end.t - start.t) * share : end.t;
}

}  // namespace frustum::cutter

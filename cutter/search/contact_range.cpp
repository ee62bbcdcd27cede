#include "cutter/search/contact_range.hpp"

#include <algorithm>
#include <array>

namespace frustum::cutter {
namespace {

// How far off the cutter a point may be at its own state: from rounding to twice the accuracy of a
// ray's interval end. The least that holds is what counts for the other states, since a rim that
// leaves the point by a nanometre has gone on by a millimetre.
constexpr std::array kContactTolerances{1e-10, 1e-9, 1e-8, 1e-7, 2e-6};  // mm
constexpr double kResolution = 1e-9;
// A round side seems to touch for as long as it takes to cross the chord that the tolerance cuts
// off, at most 2 sqrt(2 R 2e-6 mm): 0.02 mm for a cutter of 25 mm radius. That is one at.
constexpr double kOneState = 0.05;  // mm of tip travel

class PointUnderPass {
 public:
  PointUnderPass(const SweptCutter& swept, const Vec3& point, const PathState& own)
      : swept_(swept), point_(point) {
    const auto least =
        std::find_if(kContactTolerances.begin(), kContactTolerances.end(), [&](double tolerance) {
          tolerance_ = tolerance;
          return touched(own);
        });
    is_touched_ = least != kContactTolerances.end();
  }

  [[nodiscard]] bool is_touched_at_its_own_state() const { return is_touched_; }

  [[nodiscard]] bool touched(const PathState& at) const {
    const auto& path = swept_.path();
    const auto& segment = path.segments[at.segment];
    const auto pose = kinematics::between(path.from(segment), path.to(segment), at.t);
    const auto& generatrix = swept_.tool(path.blocks[segment.block].tool).body().generatrix();
    const Vec3 m = point_ - pose.tip;
    const double z = m.dot(pose.axis);
    return std::abs(generatrix.distance((m - z * pose.axis).norm(), z)) <= tolerance_;
  }

  [[nodiscard]] Vec3 tip(const PathState& at) const {
    const auto& segment = swept_.path().segments[at.segment];
    return kinematics::between(swept_.path().from(segment), swept_.path().to(segment), at.t).tip;
  }

  // Walks from a touched state towards t = `end` (0 or 1), segment by segment, and returns the
  // states passed: segment ends, then the last touched one.
  [[nodiscard]] std::vector<PathState> walk(PathState from, double end) const {
    std::vector<PathState> passed;
    const auto& segments = swept_.path().segments;
    const std::uint32_t block = segments[from.segment].block;
    while (touched({from.segment, end})) {
      passed.push_back({from.segment, end});
      const bool last = end == 0.0 ? from.segment == 0 : from.segment + 1 == segments.size();
      if (last) return passed;
      const std::uint32_t next = end == 0.0 ? from.segment - 1 : from.segment + 1;
      if (segments[next].block != block) return passed;
      from = {next, 1.0 - end};
    }
    double inside = from.t, outside = end;
    while (std::abs(outside - inside) > kResolution) {
      const double middle = 0.5 * (inside + outside);
      (touched({from.segment, middle}) ? inside : outside) = middle;
    }
    if (inside != from.t) passed.push_back({from.segment, inside});
    return passed;
  }

 private:
  const SweptCutter& swept_;
  Vec3 point_;
  double tolerance_ = 0.0;
  bool is_touched_ = false;
};

}  // namespace

std::vector<PathState> contact_range(const SweptCutter& swept, const PathState& here,
                                     const Vec3& point) {
  const PointUnderPass under(swept, point, here);
  if (!under.is_touched_at_its_own_state()) return {here};
  std::vector<PathState> range = under.walk(here, 0.0);
  std::reverse(range.begin(), range.end());
  range.push_back(here);
  const std::vector<PathState> after = under.walk(here, 1.0);
  range.insert(range.end(), after.begin(), after.end());
  const Vec3 travel = under.tip(range.back()) - under.tip(range.front());
  if (travel.norm() < kOneState) return {here};
  return range;
}

}  // namespace frustum::cutter

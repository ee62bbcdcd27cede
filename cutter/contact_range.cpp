#include "cutter/contact_range.hpp"

#include <algorithm>
#include <array>

namespace frustum::cutter {
namespace {

// How far off the cutter a point may be at its own moment: from rounding to twice the accuracy of a ray's
// interval end. The least that holds is what counts for the other moments, since a rim that leaves the
// point by a nanometre has gone on by a millimetre.
constexpr std::array kTouching{1e-10, 1e-9, 1e-8, 1e-7, 2e-6};  // mm
constexpr double kResolution = 1e-9;
// A round side seems to touch for as long as it takes to cross the chord that the tolerance cuts off, at
// most 2 sqrt(2 R 2e-6 mm): 0.02 mm for a cutter of 25 mm radius. That is one moment.
constexpr double kOneMoment = 0.05;  // mm of tip travel

class PointUnderPass {
 public:
  PointUnderPass(const SweptCutter& swept, const Vec3& point, const PathMoment& own)
      : swept_(swept), point_(point) {
    const auto least = std::find_if(kTouching.begin(), kTouching.end(), [&](double tolerance) {
      tolerance_ = tolerance;
      return touched(own);
    });
    is_touched_ = least != kTouching.end();
  }

  [[nodiscard]] bool is_touched_at_its_own_moment() const { return is_touched_; }

  [[nodiscard]] bool touched(const PathMoment& moment) const {
    const auto& path = swept_.path();
    const auto& stretch = path.stretches[moment.stretch];
    const auto pose = kinematics::between(path.from(stretch), path.to(stretch), moment.t);
    const auto& outline = swept_.tool(path.blocks[stretch.block].tool).body().outline();
    const Vec3 m = point_ - pose.tip;
    const double z = m.dot(pose.axis);
    return std::abs(outline.distance((m - z * pose.axis).norm(), z)) <= tolerance_;
  }

  [[nodiscard]] Vec3 tip(const PathMoment& moment) const {
    const auto& stretch = swept_.path().stretches[moment.stretch];
    return kinematics::between(swept_.path().from(stretch), swept_.path().to(stretch), moment.t)
        .tip;
  }

  // Walks from a touched moment towards t = `end` (0 or 1), stretch by stretch, and returns the moments
  // passed: stretch ends, then the last touched moment.
  [[nodiscard]] std::vector<PathMoment> walk(PathMoment from, double end) const {
    std::vector<PathMoment> passed;
    const auto& stretches = swept_.path().stretches;
    const std::uint32_t block = stretches[from.stretch].block;
    while (touched({from.stretch, end})) {
      passed.push_back({from.stretch, end});
      const bool last = end == 0.0 ? from.stretch == 0 : from.stretch + 1 == stretches.size();
      if (last) return passed;
      const std::uint32_t next = end == 0.0 ? from.stretch - 1 : from.stretch + 1;
      if (stretches[next].block != block) return passed;
      from = {next, 1.0 - end};
    }
    double inside = from.t, outside = end;
    while (std::abs(outside - inside) > kResolution) {
      const double middle = 0.5 * (inside + outside);
      (touched({from.stretch, middle}) ? inside : outside) = middle;
    }
    if (inside != from.t) passed.push_back({from.stretch, inside});
    return passed;
  }

 private:
  const SweptCutter& swept_;
  Vec3 point_;
  double tolerance_ = 0.0;
  bool is_touched_ = false;
};

}  // namespace

std::vector<PathMoment> contact_range(const SweptCutter& swept, const SweepContact& contact,
                                      const Vec3& point) {
  const PathMoment here{contact.stretch, contact.t};
  const PointUnderPass under(swept, point, here);
  if (!under.is_touched_at_its_own_moment()) return {here};
  std::vector<PathMoment> range = under.walk(here, 0.0);
  std::reverse(range.begin(), range.end());
  range.push_back(here);
  const std::vector<PathMoment> after = under.walk(here, 1.0);
  range.insert(range.end(), after.begin(), after.end());
  const Vec3 travel = under.tip(range.back()) - under.tip(range.front());
  if (travel.norm() < kOneMoment) return {here};
  return range;
}

}  // namespace frustum::cutter

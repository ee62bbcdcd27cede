#include "cutter/contact_range.hpp"

#include <algorithm>

namespace frustum::cutter {
namespace {

// Twice the accuracy of a ray's interval end.
constexpr double kTouching = 2e-6;  // mm
constexpr double kResolution = 1e-9;

class PointUnderPass {
 public:
  PointUnderPass(const SweptCutter& swept, const Vec3& point) : swept_(swept), point_(point) {}

  [[nodiscard]] bool touched(const PathMoment& moment) const {
    const auto& path = swept_.path();
    const auto& stretch = path.stretches[moment.stretch];
    const auto pose = kinematics::between(path.from(stretch), path.to(stretch), moment.t);
    const auto& profile = swept_.tool(path.blocks[stretch.block].tool).profile();
    return profile.touches(pose, point_, kTouching);
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
};

}  // namespace

std::vector<PathMoment> contact_range(const SweptCutter& swept, const SweepContact& contact,
                                      const Vec3& point) {
  const PointUnderPass under(swept, point);
  const PathMoment here{contact.stretch, contact.t};
  std::vector<PathMoment> range;
  if (under.touched(here)) {
    range = under.walk(here, 0.0);
    std::reverse(range.begin(), range.end());
  }
  range.push_back(here);
  if (under.touched(here)) {
    const std::vector<PathMoment> after = under.walk(here, 1.0);
    range.insert(range.end(), after.begin(), after.end());
  }
  return range;
}

}  // namespace frustum::cutter

#include "kinematics/path/axis_polyline.hpp"

#include <algorithm>
#include <cmath>

namespace frustum::kinematics {
namespace {

constexpr int kDeepestPolyline = 16;
constexpr double kPacePerOff = 5.0;

class Cutter {
 public:
  Cutter(const std::function<AxisPositions(double)>& motion, const PolylineTolerance& tolerance)
      : motion_(motion), tolerance_(tolerance) {}

  void cut(double u0, const AxisPositions& from, double u1, const AxisPositions& to, int depth) {
    const double u = 0.5 * (u0 + u1);
    const AxisPositions middle = motion_(u);
    AxisPositions off;
    bool even = true;
    for (const AxisLetter letter : kAxisLetters) {
      off[letter] = std::abs(middle[letter] - 0.5 * (from[letter] + to[letter]));
      even = even && off[letter] <= (is_rotary(letter) ? tolerance_.rotary : tolerance_.linear);
    }
    if (depth >= kDeepestPolyline || even) {
      for (const AxisLetter letter : kAxisLetters) off[letter] *= kPacePerOff;
      parts_.push_back({u1, to, off});
      return;
    }
    cut(u0, from, u, middle, depth + 1);
    cut(u, middle, u1, to, depth + 1);
  }

  [[nodiscard]] std::vector<EvenPart> parts() && { return std::move(parts_); }

 private:
  const std::function<AxisPositions(double)>& motion_;
  const PolylineTolerance& tolerance_;
  std::vector<EvenPart> parts_;
};

}  // namespace

std::vector<EvenPart> even_parts(const std::function<AxisPositions(double)>& motion,
                                 int least_parts, std::span<const double> cuts,
                                 const PolylineTolerance& tolerance) {
  std::vector<double> ends(cuts.begin(), cuts.end());
  for (int part = 1; part <= least_parts; ++part) {
    ends.push_back(static_cast<double>(part) / least_parts);
  }
  std::sort(ends.begin(), ends.end());
  ends.erase(std::unique(ends.begin(), ends.end()), ends.end());
  Cutter cutter(motion, tolerance);
  double u0 = 0.0;
  AxisPositions from = motion(0.0);
  for (const double u1 : ends) {
    const AxisPositions to = motion(u1);
    cutter.cut(u0, from, u1, to, 0);
    u0 = u1;
    from = to;
  }
  return std::move(cutter).parts();
}

}  // namespace frustum::kinematics

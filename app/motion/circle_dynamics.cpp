#include "app/motion/circle_dynamics.hpp"

#include <algorithm>
#include <cmath>

#include "core/constants.hpp"

namespace frustum::app {

using dynamics::PathMethod;

std::vector<Vec3> circle_deviations(const dynamics::DynamicModel& model, PathMethod method,
                                    const instruments::CircleTest& circle,
                                    const instruments::MotionTest& test, double feed) {
  constexpr int kTurnsBefore = 2;
  constexpr double kLongestStep = 5e-4;                // s, where the circle is fast
  constexpr double kFewest = 3600.0, kMost = 20000.0;  // samples a turn
  const double seconds = kTurn * circle.length / feed;
  const auto samples_of_turn =
      static_cast<int>(std::clamp(std::ceil(seconds / kLongestStep), kFewest, kMost));
  const double step = seconds / samples_of_turn;
  const double per_sample = sign_of(circle.sense) * kTurn / samples_of_turn;
  std::vector<kinematics::AxisPositions> positions;
  // One sample more at the end, whose neighbour would be a stop.
  const int count = (kTurnsBefore + 1) * samples_of_turn + 2;
  for (int i = 0; i < count; ++i) positions.push_back(test.motion.axes(i * per_sample));
  const auto samples = dynamics::with_rates(positions, step);
  const auto found = method == PathMethod::linear
                         ? linear_deviations(model, samples, step, circle.tool_length)
                         : quasi_static_deviations(model, samples, circle.tool_length);
  std::vector<Vec3> deviations;
  for (const double phi : circle.angles) {
    const double turned = phi / per_sample;
    const double within = turned - samples_of_turn * std::floor(turned / samples_of_turn);
    const auto below = static_cast<std::size_t>(kTurnsBefore * samples_of_turn + within);
    const double share = within - std::floor(within);
    constexpr double kMmPerMetre = 1e3;
    deviations.emplace_back(kMmPerMetre *
                            (found[below].tip + share * (found[below + 1].tip - found[below].tip)));
  }
  return deviations;
}

}  // namespace frustum::app

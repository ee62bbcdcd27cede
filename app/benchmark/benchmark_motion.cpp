#include "app/benchmark/benchmark_motion.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <vector>

#include "kinematics/model/chain.hpp"
#include "kinematics/model/inverse.hpp"

namespace frustum::app {
namespace {

using kinematics::AxisLetter;
using kinematics::AxisPositions;
using kinematics::GeometricErrors;
using kinematics::Machine;

constexpr double kToolLength = 150.0;

// Of one row, with the instrument's noise.
std::string row(const Machine& machine, const KeyedNumbers& numbers, const std::string& name,
                const GeometricErrors& errors, const kinematics::AxisState& at,
                std::uint64_t number) {
  constexpr double kNoise = 0.2;  // um
  const Vec3 d = kUmPerMm * tip_deviation(machine, errors, at);
  const auto noise = [&](std::uint64_t k) {
    return kNoise * numbers.normal(name + " noise", 3 * number + k);
  };
  return fmt::format("{}{},{:.4f},{:.4f},{:.4f}\n", number, axes_text(machine, at.q),
                     d.x() + noise(0), d.y() + noise(1), d.z() + noise(2));
}

// Where the rotary axes may stand.
std::vector<double> grid(const kinematics::Joint& joint, int count) {
  constexpr double kTilt = 60.0 * kRadPerDeg;
  const bool turns = joint.endless || joint.travel.width() > 6.0;
  const double low = turns ? 0.0 : std::max(joint.travel.lo, -kTilt);
  const double high = turns ? 2.0 * std::numbers::pi : std::min(joint.travel.hi, kTilt);
  std::vector<double> places;
  for (int i = 0; i < count; ++i) {
    places.push_back(low + (high - low) * i / (turns ? count : count - 1));
  }
  return places;
}

}  // namespace

Vec3 tip_deviation(const Machine& machine, const GeometricErrors& errors,
                   const kinematics::AxisState& at) {
  return kinematics::ForwardChain(machine, errors, kToolLength).table_from_tool(at).translation -
         kinematics::nominal_pose(machine, at.q, kToolLength).translation;
}
std::string axes_header(const Machine& machine) {
  std::string header;
  for (const kinematics::Joint& joint : machine.joints()) {
    header += fmt::format(",{}", kinematics::to_char(joint.letter));
  }
  return header;
}
std::string axes_text(const Machine& machine, const AxisPositions& q) {
  std::string text;
  for (const kinematics::Joint& joint : machine.joints()) {
    text += fmt::format(",{:.6f}", q[joint.letter] * (joint.rotary() ? kDegPerRad : 1.0));
  }
  return text;
}

std::string rtest_csv(const Machine& machine, const GeometricErrors& errors,
                      const KeyedNumbers& numbers) {
  std::vector<kinematics::Joint> rotary;
  for (const kinematics::Joint& joint : machine.joints()) {
    if (joint.rotary()) rotary.push_back(joint);
  }
  std::string rtest = "pose" + axes_header(machine) + ",dx_um,dy_um,dz_um\n";
  const Vec3 ball(80.0, 0.0, 60.0);
  std::uint64_t number = 0;
  for (const double first : grid(rotary.front(), 9)) {
    for (const double second : grid(rotary.back(), 12)) {
      AxisPositions q;
      q[rotary.front().letter] = first;
      q[rotary.back().letter] = second;
      q = kinematics::place_tip(machine, ball, kToolLength, q);
      if (kinematics::within_travel(machine, q))
        rtest += row(machine, numbers, "rtest", errors, q, ++number);
    }
  }
  return rtest;
}

std::string ballbar_csv(const Machine& machine, const GeometricErrors& errors,
                        const KeyedNumbers& numbers) {
  std::string ballbar = "pose" + axes_header(machine) + ",direction,dx_um,dy_um,dz_um\n";
  std::uint64_t number = 0;
  constexpr int kAngles = 72;
  constexpr double kRadius = 100.0;
  const Vec3 centre(0.0, 0.0, 100.0);
  const std::array<std::array<int, 2>, 3> planes{{{0, 1}, {1, 2}, {2, 0}}};
  for (const auto& [a, b] : planes) {
    for (const int sense : {1, -1}) {
      for (int k = 0; k < kAngles; ++k) {
        const double angle = 2.0 * std::numbers::pi * k / kAngles;
        Vec3 tip = centre;
        tip[a] += kRadius * std::cos(angle);
        tip[b] += kRadius * std::sin(angle);
        const AxisPositions q = kinematics::place_tip(machine, tip, kToolLength, {});
        if (!kinematics::within_travel(machine, q)) continue;
        // Which way each axis goes there.
        Vec3 next = centre;
        next[a] += kRadius * std::cos(angle + 1e-6 * sense);
        next[b] += kRadius * std::sin(angle + 1e-6 * sense);
        const AxisPositions then = kinematics::place_tip(machine, next, kToolLength, {});
        AxisPositions heading;
        for (const AxisLetter letter : kinematics::kLinearAxes) {
          const double step = then[letter] - q[letter];
          heading[letter] = std::abs(step) < 1e-9 ? 0.0 : std::copysign(1.0, step);
        }
        std::string text = row(machine, numbers, "ballbar", errors, {q, heading}, ++number);
        // The direction stands before the deviations.
        std::size_t comma = text.size();
        for (int i = 0; i < 3; ++i) comma = text.rfind(',', comma - 1);
        text.insert(comma, sense > 0 ? ",ccw" : ",cw");
        ballbar += text;
      }
    }
  }
  return ballbar;
}

}  // namespace frustum::app

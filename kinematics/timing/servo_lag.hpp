// Where the axes really are behind their commands: a first-order lag of each position loop.
//
// Model    : y' = Kv (q - y) for each axis with its own gain Kv; solved exactly while q moves
//            evenly. Axes without a stated gain follow at once
// Units    : mm, rad, s
// Errors   : none
// Accuracy : steady lag v / Kv and the shrunken circle to 1e-9 (tests/kinematics/time_law_test.cpp)
#pragma once

#include <array>

#include "kinematics/model/axes.hpp"
#include "kinematics/model/machine.hpp"

namespace frustum::kinematics {

class ServoLag {
 public:
  ServoLag(const Machine& machine, const AxisPositions& start);

  // The commands go evenly from where they are to `commanded` in `seconds`; returns where the axes
  // are.
  const AxisPositions& follow(const AxisPositions& commanded, double seconds);
  // The axes wait until they are in position.
  void settle() { actual_ = commanded_; }
  // After which nothing is left of a lag but e^-12 of it, s; 0 where the axes are in position.
  [[nodiscard]] double settling_time() const;
  [[nodiscard]] const AxisPositions& actual() const { return actual_; }
  [[nodiscard]] const AxisPositions& commanded() const { return commanded_; }

 private:
  std::array<double, kAxisLetters.size()> gain_{};  // 1/s; 0: no lag
  AxisPositions commanded_{};
  AxisPositions actual_{};
};

}  // namespace frustum::kinematics

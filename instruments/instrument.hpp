// What an instrument shows of the readings that the machine gives it.
//
// Model    : reading + noise of one standard deviation, rounded to the resolution
// Units    : mm
// Shape    : as many as readings; `trace` separates the runs of a test
// Errors   : none
// Accuracy : noise by counter (core/random.hpp): equal for any order of evaluation
// Source   : JCGM 100:2008, 4.3
#pragma once

#include <cstdint>
#include <vector>

#include "core/pose.hpp"

namespace frustum::instruments {

struct Instrument {
  double noise = 0.0;       // standard deviation
  double resolution = 0.0;  // 0: continuous
  std::uint64_t seed = 1;
};

[[nodiscard]] std::vector<double> shown(const Instrument& instrument, std::vector<double> readings,
                                        std::uint32_t trace);
[[nodiscard]] std::vector<Vec3> shown(const Instrument& instrument, std::vector<Vec3> readings,
                                      std::uint32_t trace);

}  // namespace frustum::instruments

// Eight numbers, one of each of eight machines of a population.
//
// Model    : plain arrays. The kernel (lane_kernel.cpp) takes as many of them at a time as the
//            registers of the processor hold; every operation is on each number alone, so that a
//            machine's numbers depend neither on its neighbours nor on the processor (no fused
//            multiply-add: -ffp-contract=off)
// Units    : those of what it holds
// Errors   : none
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

namespace frustum::trials {

inline constexpr std::size_t kLanes = 8;
struct alignas(64) Lanes {
  std::array<double, kLanes> of{};
};
struct LaneVec3 {
  Lanes x{}, y{}, z{};
};
// Where the tool is: tip and unit axis.
struct LanePose {
  LaneVec3 tip{}, axis{};
};
// Columns of a rotation, and a translation.
struct LaneFrame {
  LaneVec3 x{}, y{}, z{}, origin{};
};

}  // namespace frustum::trials

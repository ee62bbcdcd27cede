// Counter-based random numbers: a draw is a pure function of (seed, draw, purpose, index).
//
// Nothing is shared and nothing advances, so results do not depend on the number of threads nor on
// the order of evaluation.
//
// Units: none. Errors: none; every key and index is valid.
// Source: Philox 4x32-10, Salmon et al. 2011 (SC'11), through Random123.
#pragma once

#include <cstdint>

namespace frustum {

// Separates the streams of one draw. Add at the end; never renumber: old seeds keep their meaning.
enum class RandomPurpose : std::uint32_t {
  cmm_point = 1,
  cmm_scale = 2,
  test_data = 3,
  error_amount = 4,
  cmm_geometry = 11,
  cmm_probe = 12,
  cmm_repeat = 13,
  cmm_scan = 14,
  cmm_qualification = 15,
  cmm_drift = 16,
  cmm_thermal = 17,
  instrument_reading = 18
};

struct RandomKey {
  std::uint64_t seed = 0;
  std::uint32_t draw = 0;
  RandomPurpose purpose = RandomPurpose::test_data;
};

// Uniform on the open interval (0, 1), 53 random bits.
[[nodiscard]] double uniform(const RandomKey& key, std::uint64_t index);
// Normal with mean 0 and standard deviation 1; depends on uniform at the same key and index.
[[nodiscard]] double normal(const RandomKey& key, std::uint64_t index);

}  // namespace frustum

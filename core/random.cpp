#include "core/random.hpp"

#include <Random123/philox.h>

#include <cmath>
#include <numbers>

namespace frustum {
namespace {

using Generator = r123::Philox4x32;

Generator::ctr_type bits(const RandomKey& key, std::uint64_t index) {
  const auto low = [](std::uint64_t v) { return static_cast<std::uint32_t>(v); };
  const auto high = [](std::uint64_t v) { return static_cast<std::uint32_t>(v >> 32); };
  const Generator::ctr_type counter{
      {low(index), high(index), key.draw, static_cast<std::uint32_t>(key.purpose)}};
  const Generator::key_type seed{{low(key.seed), high(key.seed)}};
  return Generator{}(counter, seed);
}

// 53 bits, shifted by half a step so that neither 0 nor 1 occurs.
double open_unit(std::uint32_t high, std::uint32_t low) {
  const std::uint64_t word = (static_cast<std::uint64_t>(high) << 32) | low;
  return (static_cast<double>(word >> 11) + 0.5) * 0x1p-53;
}

}  // namespace

double uniform(const RandomKey& key, std::uint64_t index) {
  const auto word = bits(key, index);
  return open_unit(word[0], word[1]);
}

double normal(const RandomKey& key, std::uint64_t index) {
  const auto word = bits(key, index);  // Box-Muller: one cosine branch a counter
  const double radius = std::sqrt(-2.0 * std::log(open_unit(word[0], word[1])));
  return radius * std::cos(2.0 * std::numbers::pi * open_unit(word[2], word[3]));
}

}  // namespace frustum

#include "instruments/instrument.hpp"

#include <cmath>

#include "core/random.hpp"

namespace frustum::instruments {
namespace {

double shown_value(const Instrument& instrument, double reading, const RandomKey& key,
                   std::uint64_t index) {
  if (instrument.noise > 0.0) reading += instrument.noise * normal(key, index);
  if (instrument.resolution > 0.0) {
    reading = std::round(reading / instrument.resolution) * instrument.resolution;
  }
  return reading;
}

RandomKey key_of(const Instrument& instrument, std::uint32_t trace) {
  return {.seed = instrument.seed, .draw = trace, .purpose = RandomPurpose::instrument_reading};
}

}  // namespace

std::vector<double> shown(const Instrument& instrument, std::vector<double> readings,
                          std::uint32_t trace) {
  const RandomKey key = key_of(instrument, trace);
  for (std::size_t i = 0; i < readings.size(); ++i) {
    readings[i] = shown_value(instrument, readings[i], key, i);
  }
  return readings;
}

std::vector<Vec3> shown(const Instrument& instrument, std::vector<Vec3> readings,
                        std::uint32_t trace) {
  const RandomKey key = key_of(instrument, trace);
  for (std::size_t i = 0; i < readings.size(); ++i) {
    for (Eigen::Index k = 0; k < 3; ++k) {
      readings[i][k] =
          shown_value(instrument, readings[i][k], key, 3 * i + static_cast<std::uint64_t>(k));
    }
  }
  return readings;
}

}  // namespace frustum::instruments

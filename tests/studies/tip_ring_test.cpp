#include "studies/engine/tip_ring.hpp"

#include "tests/studies/populations.hpp"

namespace frustum::studies {
namespace {

const char* const kPlaces[] = {"proposed/cone", "proposed/cylinder", "comparison/cone",
                               "comparison/cylinder"};

TEST(TipRingReference, FirstDrawsAreThoseOfTheIndependentComputation) {
  for (const char* place : kPlaces) {
    for (const char read : {'A', 'R'}) {
      const RingPopulation& population = RingPopulation::of(place, read);
      EXPECT_EQ(population.set.columns().size(), 154U);
      const nlohmann::json& numbers = expected()["cone"][place][std::string(1, read)];
      for (std::uint32_t d = 0; d < 8; ++d) {
        const Eigen::VectorXd w = population.weights(1, d);
        // Of 10 um; the computation's ranges of travel have six digits.
        EXPECT_NEAR(value_of(population.model.characteristics[0], w),
                    numbers["first_draws"][d].get<double>(), 1e-3)
            << place << read << d;
        if (!numbers.contains("half_angle_urad")) continue;
        EXPECT_NEAR(value_of(population.model.characteristics[1], w),
                    numbers["half_angle_urad"]["first_draws"][d].get<double>(), 1e-2)
            << place << read << d;
      }
    }
  }
}

// With a tool of 150 mm the errors of Z that are linear shift, and only half angles see it.
TEST(TipRingReference, ALongToolShiftsHalfAnglesAlone) {
  const RingPopulation& population = RingPopulation::of("proposed/cone", 'A', 150.0);
  const double half_angles[] = {-61.48, -32.26, 5.48};
  for (std::uint32_t d = 0; d < 3; ++d) {
    const Eigen::VectorXd w = population.weights(1, d);
    EXPECT_NEAR(value_of(population.model.characteristics[0], w),
                expected()["cone"]["proposed/cone"]["A"]["first_draws"][d].get<double>(), 1e-3);
    EXPECT_NEAR(value_of(population.model.characteristics[1], w), half_angles[d], 0.01);
  }
}

}  // namespace
}  // namespace frustum::studies

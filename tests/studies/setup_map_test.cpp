#include "studies/answers/setup_map.hpp"

#include "tests/law_count.hpp"
#include "tests/studies/populations.hpp"

namespace frustum::studies {
namespace {

TEST(SetupMapReference, RowsAreThoseOfTheIndependentComputation) {
  const kinematics::Machine machine = machine_named("iwf-bc");
  const auto errors = errors_of_file("bossoni-cone-limits");
  const nlohmann::json& rows = expected()["map"]["rows"];
  const std::size_t every = proof::law_count<std::size_t>(1, 9);
  for (std::size_t i = 0; i < rows.size(); i += every) {
    const nlohmann::json& row = rows[i];
    ConeRing ring;
    ring.half_angle = row["alpha"].get<double>() * kRadPerDeg;
    ring.inclination = row["beta"].get<double>() * kRadPerDeg;
    ring.radius = row["r"];
    ring.center = Vec3(row["centre"][0], row["centre"][1], row["centre"][2]);
    const auto map = setup_map(machine, errors, {&ring, 1}, {.draws = 4000});
    ASSERT_TRUE(map) << to_string(map.error().front());
    const MapRow& found = map->front();
    EXPECT_NEAR(found.rms_um, row["rms"].get<double>(), 1e-3) << row["alpha"] << row["beta"];
    EXPECT_NEAR(found.directions, row["directions"].get<double>(), 5e-3);
    EXPECT_EQ(found.shown, row["shown"].get<std::size_t>()) << row["alpha"] << row["beta"];
    // Other numbers of draws: within both intervals.
    EXPECT_NEAR(found.median_um, row["median"].get<double>(), 0.15);
    EXPECT_NEAR(found.q95_um, row["q95"].get<double>(), 0.5);
  }
}

TEST(SetupMap, AConeAngleBelowTheInclinationIsRefused) {
  const kinematics::Machine machine = machine_named("iwf-bc");
  const ConeRing ring{.half_angle = 0.3, .inclination = 0.4, .radius = 40.0};
  const auto map = setup_map(machine, errors_of_file("bossoni-cone-limits"), {&ring, 1}, {});
  ASSERT_FALSE(map);
  EXPECT_EQ(map.error().front().id, "map-setup"_id);
}

}  // namespace
}  // namespace frustum::studies

// The shortest leash with which two lines can be walked along, by hand and against a free space.
#include "calibration/compensate/leash.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "core/random.hpp"
#include "tests/calibration/frechet_distance.hpp"

namespace frustum::calibration {
namespace {

using Line = std::vector<Vec3>;

Line on_x(const std::vector<double>& positions) {
  Line line;
  for (const double x : positions) line.emplace_back(x, 0.0, 0.0);
  return line;
}

constexpr double kExact = 1e-5;  // of lengths of a few mm

TEST(Leash, IsWhatAWalkerStraysToTheSide) {
  const Line line = on_x({0, 10}), walker{{0, 0, 0}, {3, 0, 0}, {3, 2, 0}, {3, 0, 0}, {10, 0, 0}};
  EXPECT_NEAR(leash_of_places(walker, line), 2.0, kExact);
  EXPECT_NEAR(frechet_distance(walker, line), 2.0, kExact);
}

TEST(Leash, IsHalfOfWhatAWalkerGoesBackAlongTheLine) {
  const Line line = on_x({0, 2, 10}), walker = on_x({0, 6, 4, 10});
  EXPECT_NEAR(leash_of_places(walker, line), 1.0, kExact);  // both at 5
  EXPECT_NEAR(frechet_distance(walker, line), 1.0, kExact);
}

TEST(Leash, HoldsBothAtTheirEnds) {
  const Line line = on_x({0, 10});
  EXPECT_NEAR(leash_of_places(on_x({3, 10}), line), 3.0, kExact);
  EXPECT_NEAR(leash_of_places(on_x({0, 6}), line), 4.0, kExact);
  EXPECT_NEAR(leash_of_places(on_x({5}), line), 5.0, kExact);
  EXPECT_NEAR(leash_of_places(on_x({3, 10}), on_x({4})), 6.0, kExact);
}

// Places, in um, where a corrected program begins and axes turn at once: the nearest place to the
// first is not the start of the line, and from there on the third is farther away than need be.
TEST(Leash, WaitsForWhatComes) {
  const Line line{{-13.235, 1.390, -10.906}, {-9013.235, 1.390, -10.906}};
  const Line walker{{-19.705, 2.780, -11.913},
                    {-7.306, 1.390, -10.907},
                    {0, 0, 0},
                    {-13.235, 1.390, -10.906},
                    {-9013.235, 1.390, -10.906}};
  const double at_start = std::sqrt(13.235 * 13.235 + 1.390 * 1.390 + 10.906 * 10.906);
  EXPECT_NEAR(leash_of_places(walker, line), at_start, 1e-4);
  EXPECT_NEAR(frechet_distance(walker, line), at_start, 1e-4);
}

TEST(Leash, FollowsGreatCircles) {
  const auto at = [](double longitude, double latitude) {
    return Vec3(std::cos(latitude) * std::cos(longitude), std::cos(latitude) * std::sin(longitude),
                std::sin(latitude));
  };
  const Line equator{at(0.0, 0.0), at(1.5, 0.0)};
  EXPECT_NEAR(leash_of_directions(Line{at(0.0, 0.0), at(0.7, 1e-4), at(1.5, 0.0)}, equator), 1e-4,
              1e-9);
  // Back by 0.2 mrad.
  EXPECT_NEAR(leash_of_directions(
                  Line{at(0.0, 0.0), at(0.7, 0.0), at(0.7 - 2e-4, 0.0), at(1.5, 0.0)}, equator),
              1e-4, 1e-9);
  // Both: half of the way back, and to the side.
  EXPECT_NEAR(leash_of_directions(
                  Line{at(0.0, 0.0), at(0.7, 3e-4), at(0.7 - 8e-4, 3e-4), at(1.5, 0.0)}, equator),
              5e-4, 1e-9);
  EXPECT_NEAR(leash_of_directions(Line{at(0.0, 0.0), at(0.1, 2e-4)}, Line{at(0.0, 0.0)}),
              angle_between(at(0.0, 0.0), at(0.1, 2e-4)), 1e-6);
}

// What the walker cuts of the line's corners is held in the free space only, and so is what it does
// between its places: where it has many and the line's corners are no spikes, the two are one.
TEST(Leash, IsThatOfTheFreeSpaceOnRandomLines) {
  for (std::uint32_t draw = 0; draw < 100; ++draw) {
    const RandomKey key{.seed = 101, .draw = draw};
    std::uint64_t index = 0;
    const auto between = [&](double lo, double hi) {
      return lo + (hi - lo) * uniform(key, index++);
    };
    Line line{Vec3::Zero()}, walker{Vec3::Zero()};
    for (int k = 1; k <= 40; ++k) {
      line.emplace_back(0.1 * k, 1e-3 * between(-1.0, 1.0), 1e-3 * between(-1.0, 1.0));
      const Vec3 from = walker.back();
      const Vec3 to = line.back() + 0.2 * Vec3(between(-1, 1), between(-1, 1), between(-1, 1));
      for (int part = 1; part <= 50; ++part) walker.emplace_back(from + (to - from) * part / 50.0);
    }
    walker.push_back(line.back());
    const double distance = frechet_distance(walker, line);
    EXPECT_NEAR(leash_of_places(walker, line), distance, 0.01 * distance) << draw;
  }
}

}  // namespace
}  // namespace frustum::calibration

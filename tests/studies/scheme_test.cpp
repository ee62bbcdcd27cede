#include "studies/laws/scheme.hpp"

#include <algorithm>
#include <cmath>
#include <set>

#include "core/random.hpp"
#include "studies/engine/linear_engine.hpp"
#include "studies/statistics/summary.hpp"
#include "tests/law_count.hpp"
#include "tests/studies/populations.hpp"

namespace frustum::studies {
namespace {

TEST(SchemeReference, SobolPointsAreThoseOfJoeAndKuo) {
  const nlohmann::json& points = expected()["sobol_points"]["points"];
  for (std::uint32_t i = 0; i < points.size(); ++i) {
    const auto point = sobol_point(i, 5);
    for (std::size_t j = 0; j < 5; ++j) {
      EXPECT_EQ(point[j] * 0x1p-32, points[i][j].get<double>()) << i << ' ' << j;
    }
  }
}

// One point in each of as many slices, whatever the scramble and the permutation.
TEST(Scheme, EachBlockAndReplicateHasOnePointInEachSlice) {
  const std::vector<std::uint64_t> streams{17, 3, 99, 1234567, 8};
  const Scheme latin = *Scheme::make(SchemeKind::latin, 4, streams);
  const Scheme sobol = *Scheme::make(SchemeKind::sobol, 4, streams);
  std::vector<double> u(streams.size());
  for (std::size_t j = 0; j < streams.size(); ++j) {
    std::set<int> slices;
    for (std::uint32_t d = 2048; d < 3072; ++d) {
      latin.point(d, u);
      slices.insert(static_cast<int>(u[j] * 1024.0));
    }
    EXPECT_EQ(slices.size(), 1024U);
    slices.clear();
    for (std::uint32_t i = 0; i < 256; ++i) {
      sobol.point(16 * i + 5, u);
      slices.insert(static_cast<int>(u[j] * 256.0));
    }
    EXPECT_EQ(slices.size(), 256U);
  }
}

// Pairs of dimensions of a scrambled net: as many points in each box of equal size. Pairs of a
// latin block are as independent as random ones.
TEST(Scheme, ScrambledNetsKeepTheirBoxesAndLatinPairsAreIndependent) {
  const std::vector<std::uint64_t> streams{17, 3};
  const Scheme sobol = *Scheme::make(SchemeKind::sobol, 4, streams, 1);
  std::vector<double> u(2);
  for (const int rows : {4, 16, 64}) {
    std::vector<int> boxes(256, 0);
    for (std::uint32_t i = 0; i < 256; ++i) {
      sobol.point(i, u);
      const int a = static_cast<int>(u[0] * rows), b = static_cast<int>(u[1] * (256 / rows));
      ++boxes[static_cast<std::size_t>(a * (256 / rows) + b)];
    }
    EXPECT_EQ(*std::max_element(boxes.begin(), boxes.end()), 1) << rows;
  }
  const Scheme latin = *Scheme::make(SchemeKind::latin, 4, streams);
  double product = 0.0;
  constexpr std::uint32_t kDraws = 65536;
  for (std::uint32_t d = 0; d < kDraws; ++d) {
    latin.point(d, u);
    product += 12.0 * (u[0] - 0.5) * (u[1] - 0.5) / kDraws;
  }
  EXPECT_NEAR(product, 0.0, 4.0 / std::sqrt(kDraws));
}

TEST(Scheme, SeedsStreamsAndReplicatesGiveOtherPoints) {
  std::vector<double> a(2), b(2);
  for (const SchemeKind kind : {SchemeKind::latin, SchemeKind::sobol}) {
    std::set<double> seen;
    for (const std::uint64_t seed : {1U, 2U, 3U}) {
      const Scheme scheme = *Scheme::make(kind, seed, {5, 6});
      for (const std::uint32_t d : {0U, 1U, 1024U}) {
        scheme.point(d, a);
        seen.insert(a.begin(), a.end());
        scheme.point(d, b);
        EXPECT_EQ(a, b);
        EXPECT_TRUE(a[0] > 0.0 && a[0] < 1.0);
      }
    }
    EXPECT_EQ(seen.size(), 18U);
  }
  EXPECT_FALSE(Scheme::make(SchemeKind::sobol, 1, std::vector<std::uint64_t>(4000, 1)));
}

// Standard deviations of the estimates of 1,024 draws of the proposed cone over replicates with
// other seeds.
TEST(SchemeLaws, EstimatesScatterAsThoseOfTheIndependentComputation) {
  const auto replicates = proof::law_count<std::uint32_t>(200, 40);
  const RingPopulation& population = RingPopulation::of("proposed/cone", 'A');
  const LinearEngine engine(population.set, population.model);
  const std::vector<std::uint64_t> streams = population.set.streams();
  const auto spread = [](const std::vector<double>& x) {
    double mean = 0.0, square = 0.0;
    for (const double v : x) mean += v / static_cast<double>(x.size());
    for (const double v : x) square += (v - mean) * (v - mean);
    return std::sqrt(square / static_cast<double>(x.size() - 1));
  };
  for (const auto& [kind, name] :
       {std::pair{SchemeKind::random, "random"}, std::pair{SchemeKind::latin, "latin hypercube"},
        std::pair{SchemeKind::sobol, "sobol"}}) {
    std::vector<double> medians;
    for (std::uint32_t r = 0; r < replicates; ++r) {
      const Scheme scheme = *Scheme::make(kind, 100 + r, streams, 1);
      std::vector<double> values = engine.evaluate(scheme, 100 + r, 0, 1024);
      values.resize(1024);
      medians.push_back(unsorted_quantile(values, 0.5));
    }
    const double expected_spread = expected()["sampling"]["schemes"][name]["median_sd"];
    // Both numbers have a standard error of 5 % for 200 replicates; four of the difference.
    const double slack = 4.0 * std::sqrt(0.5 / replicates + 0.0025) * expected_spread;
    EXPECT_NEAR(spread(medians), expected_spread, slack) << name;
    RecordProperty(name, std::to_string(spread(medians)));
  }
}

}  // namespace
}  // namespace frustum::studies

// The fits against published reference pairs, which stay outside the repository: the folder named
// by FRUSTUM_REFERENCE_FITS, or
// ../shared/spec/reference-fits beside the source tree.

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <fstream>

#include "metrology/fit/least_squares.hpp"
#include "synthetic.hpp"

namespace frustum::metrology {
namespace {

using synthetic::line_angle;
using synthetic::off_axis;

// Ours: a sloppy solver (finite differences, no centring) misses by 1e-7 to 1e-5 mm.
constexpr double kReferenceMm = 1e-9;
constexpr double kReferenceRad = 1e-11;

std::filesystem::path folder() {
  const char* named = std::getenv("FRUSTUM_REFERENCE_FITS");  // NOLINT(concurrency-mt-unsafe)
  // Beside the checkout, where the specifications lie.
  return named != nullptr
             ? std::filesystem::path(named)
             : std::filesystem::path(FRUSTUM_SOURCE_DIR) / "../shared/spec/reference-fits";
}

std::vector<double> numbers_in(const std::filesystem::path& file) {
  std::ifstream in(file);
  std::vector<double> numbers;
  for (double x = 0.0; in >> x;) numbers.push_back(x);
  return numbers;
}

struct Pair {
  std::string name;
  std::vector<Vec3> points;
  std::vector<double> reference;
};

std::vector<Pair> pairs_of(const std::string& kind) {
  std::vector<Pair> pairs;
  for (const auto& entry : std::filesystem::directory_iterator(folder() / kind)) {
    if (entry.path().extension() != ".ds") continue;
    Pair pair{entry.path().stem().string(), {}, {}};
    if (pair.name == "con7") continue;  // six points: the solution may not be unique
    const std::vector<double> data = numbers_in(entry.path());
    for (std::size_t i = 1; i + 2 < data.size(); i += 3) {
      pair.points.emplace_back(data[i], data[i + 1], data[i + 2]);
    }
    pair.reference = numbers_in(std::filesystem::path(entry.path()).replace_extension(".fit"));
    pairs.push_back(std::move(pair));
  }
  std::sort(pairs.begin(), pairs.end(),
            [](const Pair& a, const Pair& b) { return a.name < b.name; });
  return pairs;
}

Vec3 point_in(const Pair& pair) {
  return {pair.reference[0], pair.reference[1], pair.reference[2]};
}
UnitVec3 axis_in(const Pair& pair) {
  return unit({pair.reference[3], pair.reference[4], pair.reference[5]});
}

class FitReference : public testing::Test {
 protected:
  void SetUp() override {
    if (!std::filesystem::is_directory(folder())) {
      GTEST_SKIP() << "no reference pairs at " << folder()
                   << "; set FRUSTUM_REFERENCE_FITS to their folder";
    }
  }
  void TearDown() override {
    RecordProperty("worst_in_fm", std::to_string(worst_mm_ * 1e12));  // femtometres: no exponent
    RecordProperty("worst_in_frad", std::to_string(worst_rad_ * 1e15));
  }
  void mm(double deviation, const Pair& pair) {
    EXPECT_LT(std::abs(deviation), kReferenceMm) << pair.name;
    worst_mm_ = std::max(worst_mm_, std::abs(deviation));
  }
  void rad(double deviation, const Pair& pair) {
    EXPECT_LT(std::abs(deviation), kReferenceRad) << pair.name;
    worst_rad_ = std::max(worst_rad_, std::abs(deviation));
  }

 private:
  double worst_mm_ = 0.0;
  double worst_rad_ = 0.0;
};

TEST_F(FitReference, PlanesAgree) {
  const auto pairs = pairs_of("Plane");
  EXPECT_EQ(pairs.size(), 30U);
  for (const Pair& pair : pairs) {
    const auto fit = fit_plane(pair.points);
    ASSERT_TRUE(fit) << pair.name << fit.error().front().message;
    mm((fit->element.point - point_in(pair)).norm(), pair);
    rad(line_angle(fit->element.axis, axis_in(pair)), pair);
  }
}

TEST_F(FitReference, CirclesInCoordinatePlanesAgree) {
  const auto pairs = pairs_of("Circle2d");
  EXPECT_EQ(pairs.size(), 30U);
  for (const Pair& pair : pairs) {
    for (const auto& fit : {fit_circle(pair.points), fit_circle_2d(pair.points)}) {
      ASSERT_TRUE(fit) << pair.name << fit.error().front().message;
      mm((fit->element.point - point_in(pair)).norm(), pair);
      mm(2.0 * fit->element.radius - pair.reference[6], pair);
      rad(line_angle(fit->element.axis, axis_in(pair)), pair);
    }
  }
}

TEST_F(FitReference, SpheresAgree) {
  const auto pairs = pairs_of("Sphere");
  EXPECT_EQ(pairs.size(), 30U);
  for (const Pair& pair : pairs) {
    const auto fit = fit_sphere(pair.points);
    ASSERT_TRUE(fit) << pair.name << fit.error().front().message;
    mm((fit->element.point - point_in(pair)).norm(), pair);
    mm(2.0 * fit->element.radius - pair.reference[3], pair);
  }
}

TEST_F(FitReference, CylindersAgree) {
  const auto pairs = pairs_of("Cylinder");
  EXPECT_EQ(pairs.size(), 30U);
  for (const Pair& pair : pairs) {
    const auto fit = fit_cylinder(pair.points);
    ASSERT_TRUE(fit) << pair.name << fit.error().front().message;
    mm(off_axis(fit->element.point, fit->element.axis, point_in(pair)), pair);
    mm(2.0 * fit->element.radius - pair.reference[6], pair);
    rad(line_angle(fit->element.axis, axis_in(pair)), pair);
  }
}

TEST_F(FitReference, ConesAgree) {
  const auto pairs = pairs_of("Cone");
  EXPECT_EQ(pairs.size(), 29U);
  for (const Pair& pair : pairs) {
    const auto fit = fit_cone(pair.points);
    ASSERT_TRUE(fit) << pair.name << fit.error().front().message;
    mm(off_axis(fit->element.point, fit->element.axis, point_in(pair)), pair);
    mm((fit->element.point - point_in(pair)).norm(), pair);
    mm(fit->element.radius - pair.reference[6], pair);
    rad(angle_between(fit->element.axis, axis_in(pair)), pair);
    rad(fit->element.half_angle - 0.5 * pair.reference[7] * kRadPerDeg, pair);
  }
}

}  // namespace
}  // namespace frustum::metrology

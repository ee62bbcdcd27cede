// Any points at all: a proven element or a reason why there is none; and on few points every
// candidate tried.

#include <gtest/gtest.h>

#include <cstdlib>
#include <limits>
#include <numbers>

#include "metrology/fit/association.hpp"
#include "metrology/fit/minimax/extreme_association.hpp"
#include "tests/law_count.hpp"
#include "tests/metrology/synthetic.hpp"

namespace frustum::metrology {
namespace {

using synthetic::Draws;

// 100,000 on request; fewer where every test run pays for them.
int extreme_sets() {
  const char* wanted = std::getenv("FRUSTUM_RANDOM_SETS");  // NOLINT(concurrency-mt-unsafe)
  return wanted != nullptr ? std::atoi(wanted) : proof::law_count(1000, 60);
}

// Blobs, rough and good elements, duplicates, collinear, coplanar, spherical, tiny and huge ones.
std::vector<Vec3> any_points(Draws& draws) {
  const int count = static_cast<int>(draws.between(2.0, 21.0));
  const double size = std::pow(10.0, draws.between(-3.0, 3.0));
  const Pose pose = draws.pose(size * 3.0);
  const auto kind = static_cast<int>(draws.between(0.0, 8.0));
  const double rough = std::pow(10.0, draws.between(-9.0, -0.5));
  std::vector<Vec3> points;
  for (int i = 0; i < count; ++i) {
    Vec3 p = draws.place(1.0);
    const double turn = draws.between(0.0, 2.0 * std::numbers::pi);
    const Vec3 e(std::cos(turn), std::sin(turn), 0.0);
    const Vec3 blur = rough * draws.place(1.0);
    if (kind == 1) p = Vec3(p.x(), 0.0, 0.0) + blur;                            // collinear
    if (kind == 2) p.z() = rough * p.z();                                       // coplanar
    if (kind == 3) p = e + blur;                                                // circle
    if (kind == 4) p = 0.5 * e + p.z() * Vec3::UnitZ() + blur;                  // cylinder
    if (kind == 5) p = (0.6 + 0.3 * p.z()) * e + p.z() * Vec3::UnitZ() + blur;  // cone
    if (kind == 6) p = p.normalized() + blur;                                   // sphere
    if (kind == 7 && i > 0 && draws.between(0.0, 1.0) < 0.4) {                  // duplicates
      points.push_back(points[static_cast<std::size_t>(draws.between(0.0, i - 0.001))]);
      continue;
    }
    points.push_back(pose.point(size * p));
  }
  if (draws.between(0.0, 1.0) < 0.003) {
    points[0].x() = draws.between(0.0, 1.0) < 0.5 ? std::numeric_limits<double>::quiet_NaN()
                                                  : std::numeric_limits<double>::infinity();
  }
  return points;
}

// How far its points are apart: what "a part of 100 mm" means.
double size_of(const std::vector<Vec3>& points) {
  double farthest = 0.0;
  for (const Vec3& p : points) {
    for (const Vec3& q : points) farthest = std::max(farthest, (p - q).norm());
  }
  return farthest;
}

class RandomZoneLaws : public testing::TestWithParam<std::string> {};

TEST_P(RandomZoneLaws, AnyPointsGiveAProvenZoneOrAReason) {
  const std::string name = GetParam();
  int proven = 0;
  // A torus costs as much as five others.
  const int sets = extreme_sets() / (name == "torus" ? 5 : 1);
  for (int i = 0; i < sets; ++i) {
    Draws draws(static_cast<std::uint64_t>(100000 + i));
    std::vector<Vec3> points = any_points(draws);
    if (name == "line2d" || name == "circle2d") {
      for (Vec3& p : points) p.z() = 1.0;
    }
    const auto found = associate(name, points, {.criterion = Criterion::minimum_zone});
    if (!found) {
      ASSERT_FALSE(found.error().front().message.empty());
      continue;
    }
    ++proven;
    const double size = size_of(points);
    ASSERT_TRUE(found->certificate) << i;
    // Contacts that tie prove less sharply: to 1e-9 mm.
    ASSERT_LE(found->certificate->gap, size * std::clamp(1e-9 / size, 1e-11, 1e-9)) << i;
    // What the proof says of the points themselves.
    double high = -std::numeric_limits<double>::infinity();
    double low = -high;
    for (const Vec3& p : points) {
      const double d = residual(found->fit.element, p);
      high = std::max(high, d);
      low = std::min(low, d);
    }
    const double width = name.starts_with("line") ? 2.0 * high : high - low;
    const double place = point_of(found->fit.element).norm() + size;
    ASSERT_NEAR(width, found->fit.form, 1e-9 * place) << i;
  }
  RecordProperty("proven", proven);
  EXPECT_GT(proven, 0);
}

INSTANTIATE_TEST_SUITE_P(Kinds, RandomZoneLaws,
                         testing::Values("line2d", "line", "plane", "circle2d", "circle", "sphere",
                                         "cylinder", "cone", "torus"),
                         [](const auto& tested) { return tested.param; });

// Of a circle's zone the centre is where two bisectors of points meet, whatever the contacts.
double narrowest_ring(const std::vector<Vec3>& points) {
  struct Bisector {
    Eigen::Vector2d normal;
    double at;
  };
  std::vector<Bisector> bisectors;
  for (std::size_t i = 0; i < points.size(); ++i) {
    for (std::size_t j = i + 1; j < points.size(); ++j) {
      const Eigen::Vector2d a = points[i].head<2>();
      const Eigen::Vector2d b = points[j].head<2>();
      bisectors.push_back({b - a, 0.5 * (b.squaredNorm() - a.squaredNorm())});
    }
  }
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < bisectors.size(); ++i) {
    for (std::size_t j = i + 1; j < bisectors.size(); ++j) {
      Eigen::Matrix2d rows;
      rows << bisectors[i].normal.transpose(), bisectors[j].normal.transpose();
      const double area = rows.determinant();
      if (std::abs(area) < 1e-12) continue;
      const Eigen::Vector2d centre(
          (bisectors[i].at * rows(1, 1) - bisectors[j].at * rows(0, 1)) / area,
          (rows(0, 0) * bisectors[j].at - rows(1, 0) * bisectors[i].at) / area);
      double near = std::numeric_limits<double>::infinity();
      double far = 0.0;
      for (const Vec3& p : points) {
        near = std::min(near, (p.head<2>() - centre).norm());
        far = std::max(far, (p.head<2>() - centre).norm());
      }
      least = std::min(least, far - near);
    }
  }
  return least;
}

double width_along(const std::vector<Vec3>& points, const Vec3& direction) {
  double high = -std::numeric_limits<double>::infinity();
  double low = -high;
  for (const Vec3& p : points) {
    high = std::max(high, p.dot(direction));
    low = std::min(low, p.dot(direction));
  }
  return high - low;
}

// Of a plane's zone one bound carries three points, or both carry two.
double narrowest_slab(const std::vector<Vec3>& points) {
  std::vector<Vec3> edges;
  for (std::size_t i = 0; i < points.size(); ++i) {
    for (std::size_t j = i + 1; j < points.size(); ++j) edges.emplace_back(points[j] - points[i]);
  }
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < edges.size(); ++i) {
    for (std::size_t j = i + 1; j < edges.size(); ++j) {
      const auto normal = UnitVec3::of(edges[i].cross(edges[j]));
      if (normal) least = std::min(least, width_along(points, *normal));
    }
  }
  return least;
}

double narrowest_strip(const std::vector<Vec3>& points) {
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < points.size(); ++i) {
    for (std::size_t j = i + 1; j < points.size(); ++j) {
      const auto normal = UnitVec3::of((points[j] - points[i]).cross(Vec3::UnitZ()));
      if (normal) least = std::min(least, width_along(points, *normal));
    }
  }
  return least;
}

double smallest_circle(const std::vector<Vec3>& points) {
  double least = std::numeric_limits<double>::infinity();
  const auto consider = [&](const Vec3& centre) {
    double far = 0.0;
    for (const Vec3& p : points) far = std::max(far, (p - centre).norm());
    least = std::min(least, far);
  };
  for (std::size_t i = 0; i < points.size(); ++i) {
    for (std::size_t j = i + 1; j < points.size(); ++j) {
      consider(0.5 * (points[i] + points[j]));
      for (std::size_t k = j + 1; k < points.size(); ++k) {
        const Vec3 a = points[j] - points[i];
        const Vec3 b = points[k] - points[i];
        const Vec3 n = a.cross(b);
        if (n.norm() < 1e-12) continue;
        consider(points[i] +
                 (a.squaredNorm() * b - b.squaredNorm() * a).cross(n) / (2.0 * n.squaredNorm()));
      }
    }
  }
  return least;
}

struct Rough {
  std::string name;
  Criterion criterion;
  double (*tried)(const std::vector<Vec3>&);
};

class EveryCandidateOracle : public testing::TestWithParam<Rough> {};

TEST_P(EveryCandidateOracle, IsNotBetter) {
  for (int i = 0; i < 300; ++i) {
    Draws draws(static_cast<std::uint64_t>(300 + i));
    const int count = 5 + i % 6;
    const double rough = std::pow(10.0, draws.between(-4.0, -0.7));
    std::vector<Vec3> points;
    for (int k = 0; k < count; ++k) {
      const double turn = 2.0 * std::numbers::pi * (k + draws.between(-0.3, 0.3)) / count;
      const double off = rough * draws.between(-1.0, 1.0);
      const Vec3 e(std::cos(turn), std::sin(turn), 0.0);
      if (GetParam().name == "plane") {
        points.emplace_back(10.0 * draws.between(0.5, 1.0) * e + 10.0 * off * Vec3::UnitZ());
      } else if (GetParam().name == "line2d") {
        points.emplace_back(10.0 * std::cos(turn), 10.0 * off, 0.0);
      } else {
        points.emplace_back(10.0 * (1.0 + off) * e);
      }
    }
    const auto found = associate(GetParam().name, points, {.criterion = GetParam().criterion});
    ASSERT_TRUE(found) << i << ": " << found.error().front().message;
    const auto* circle = std::get_if<Circle>(&found->fit.element);
    const bool is_zone = GetParam().criterion == Criterion::minimum_zone;
    EXPECT_NEAR(is_zone ? found->fit.form : circle->radius, GetParam().tried(points), 1e-9)
        << i << ", " << count << " points, rough " << rough;
  }
}

INSTANTIATE_TEST_SUITE_P(Kinds, EveryCandidateOracle,
                         testing::Values(Rough{"circle2d", Criterion::minimum_zone, narrowest_ring},
                                         Rough{"plane", Criterion::minimum_zone, narrowest_slab},
                                         Rough{"line2d", Criterion::minimum_zone, narrowest_strip},
                                         Rough{"circle2d", Criterion::minimum_circumscribed,
                                               smallest_circle}),
                         [](const auto& tested) {
                           return tested.param.name + "_" +
                                  std::string(name_of(tested.param.criterion));
                         });

}  // namespace
}  // namespace frustum::metrology

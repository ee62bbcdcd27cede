#include "studies/engine/linear_model.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "core/constants.hpp"
#include "core/random.hpp"

namespace frustum::studies {
namespace {

struct Feature {
  std::vector<Vec3> points{}, normals{};
};

Feature cone(double half_angle, int rows) {
  Feature feature;
  const double c = std::cos(half_angle), s = std::sin(half_angle);
  for (int row = 0; row < rows; ++row) {
    for (int k = 0; k < 24; ++k) {
      const double phi = kTurn * (k + 0.3 * row) / 24.0, z = 5.0 * row;
      const Vec3 out(std::cos(phi), std::sin(phi), 0.0);
      feature.points.emplace_back((40.0 - z * std::tan(half_angle)) * out + z * Vec3::UnitZ());
      feature.normals.emplace_back(c * out + s * Vec3::UnitZ());
    }
  }
  return feature;
}

Eigen::MatrixXd noise(std::size_t rows) {
  Eigen::MatrixXd x(static_cast<Eigen::Index>(rows), 1);
  for (std::size_t i = 0; i < rows; ++i) x(static_cast<Eigen::Index>(i), 0) = normal({1, 0}, i);
  return x;
}

TEST(LinearModel, WhatIsLeftIsPerpendicularToAllMotions) {
  const Feature feature = cone(0.5, 3);
  const auto motions = element_motions(feature.points, feature.normals, ElementSize::half_angle);
  const Eigen::MatrixXd rest = centred(noise(feature.points.size()), motions);
  for (Eigen::Index k = 0; k < motions.cols(); ++k) {
    EXPECT_NEAR(rest.col(0).dot(motions.col(k)), 0.0, 1e-13 + 1e-10 * motions.col(k).norm());
  }
  // And nothing else is gone: twice is once.
  EXPECT_LT((centred(rest, motions) - rest).norm(), 1e-12);
}

// One ring of a cone can only move as a circle does; three rows know the half angle.
TEST(LinearModel, ARingOfAConeMovesAsACircle) {
  const Feature ring = cone(0.7, 1);
  Eigen::VectorXd angles(24);
  for (Eigen::Index k = 0; k < 24; ++k) angles[k] = kTurn * static_cast<double>(k) / 24.0;
  const Eigen::MatrixXd x = noise(24);
  const Eigen::MatrixXd by_element =
      centred(x, element_motions(ring.points, ring.normals, ElementSize::fixed));
  EXPECT_LT((by_element - centred(x, circle_motions(angles))).norm(), 1e-12);
}

// A cone of another half angle, its points where the normals meet it.
TEST(LinearModel, AHalfAngleIsTakenUp) {
  constexpr double kAngle = 0.5, kChange = 1e-6;
  const Feature feature = cone(kAngle, 4), tilted = cone(kAngle + kChange, 4);
  Eigen::MatrixXd moved(static_cast<Eigen::Index>(feature.points.size()), 1);
  for (std::size_t i = 0; i < feature.points.size(); ++i) {
    moved(static_cast<Eigen::Index>(i), 0) =
        (tilted.points[i] - feature.points[i]).dot(feature.normals[i]);
  }
  const auto fixed = element_motions(feature.points, feature.normals, ElementSize::fixed);
  const auto free = element_motions(feature.points, feature.normals, ElementSize::half_angle);
  EXPECT_GT(centred(moved, fixed).norm(), 1e-6);
  EXPECT_LT(centred(moved, free).norm(), 1e-10);
}

TEST(LinearModel, ValuesAreSumsAndRanges) {
  Eigen::MatrixXd gains(3, 2);
  gains << 1.0, 0.0, 0.0, 2.0, -1.0, 1.0;
  const LinearCharacteristic range{"a", "um", LinearRange{Eigen::Vector3d(0.0, 0.5, 0.0), gains}};
  EXPECT_DOUBLE_EQ(value_of(range, Eigen::Vector2d(1.0, 2.0)), 3.5);
  const LinearCharacteristic sum{"b", "um", LinearSum{0.25, Eigen::Vector2d(1.0, -2.0)}};
  EXPECT_DOUBLE_EQ(value_of(sum, Eigen::Vector2d(1.0, 2.0)), -2.75);
}

}  // namespace
}  // namespace frustum::studies

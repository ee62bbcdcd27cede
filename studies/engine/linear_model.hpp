// Characteristics of a part as functions of the weights of a draw, to first order.
//
// Model    : point i moves by x_i = nominal_i + sum_j g_ij w_j along its normal. A characteristic
//            is one of
//              a sum          c + sum_j g_j w_j
//              a range        max_i x_i - min_i x_i over the points of a form, after the fit has
//                             been taken out of the gains (centred(): x less its least-squares
//                             combination of the element's own motions); of the worst row where
//                             the points are in rows
//              a reach        factor x max_i |x_i|
//              a length       factor x the longest of vectors whose parts the x_i are
// Units    : weights mm and rad; values as the gains make them (um, urad: see `unit`)
// Shape    : columns are those of a FactorSet
// Errors   : none
// Accuracy : first order in the errors; see engine_controls.hpp
// Source   : Bossoni 2010, section 3.9; first order of least-squares fits
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <span>
#include <string>
#include <variant>
#include <vector>

#include "core/pose.hpp"

namespace frustum::studies {

struct LinearSum {
  double constant = 0.0;
  Eigen::VectorXd gains{};  // by column
};

struct LinearRange {
  Eigen::VectorXd nominal{};        // by point
  Eigen::MatrixXd gains{};          // points x columns
  std::vector<std::size_t> rows{};  // points of each row; empty: all are in one
};

struct LinearReach {
  double factor = 1.0;
  Eigen::VectorXd nominal{};
  Eigen::MatrixXd gains{};
};

struct LinearLength {
  double factor = 1.0;
  std::size_t dimensions = 1;  // parts of a vector
  Eigen::VectorXd nominal{};   // vector after vector
  Eigen::MatrixXd gains{};
};

struct LinearCharacteristic {
  std::string name{};
  std::string unit{};  // "um", "urad", "mm"
  std::variant<LinearSum, LinearRange, LinearReach, LinearLength> of{};
};

struct LinearModel {
  std::vector<LinearCharacteristic> characteristics{};
};

// Columns less their least-squares combination of the columns of `motions`: what a fit leaves.
[[nodiscard]] Eigen::MatrixXd centred(const Eigen::MatrixXd& columns,
                                      const Eigen::MatrixXd& motions);
// 1, cos and sin of the angles: a circle that may move and change its size.
[[nodiscard]] Eigen::MatrixXd circle_motions(const Eigen::VectorXd& angles);

// How the points of a feature move along their normals when its element moves as a rigid body, and
// when it changes its size: what a least-squares fit takes up to first order. Motions that do
// nothing, or the same as others, do no harm.
enum class ElementSize : std::uint8_t {
  fixed,      // plane, line
  radius,     // circle, cylinder, sphere: all points outward
  half_angle  // cone: rotation of the generatrix about its point nearest to the centroid
};
[[nodiscard]] Eigen::MatrixXd element_motions(std::span<const Vec3> points,
                                              std::span<const Vec3> normals, ElementSize size,
                                              const Vec3& axis = Vec3::UnitZ());

// Of the sum, or of the points: points x columns.
[[nodiscard]] Eigen::MatrixXd gains_of(const LinearCharacteristic& characteristic);

// The value of one characteristic, point by point: what the engine is compared with.
[[nodiscard]] double value_of(const LinearCharacteristic& characteristic,
                              const Eigen::VectorXd& weights);

}  // namespace frustum::studies

// The sparsest basis of a subspace: few unknowns in each vector, so that people can read it.
//
// Model    : vectors are sought by the size of their support, 1, 2, .. kMostTogether entries; those
//            independent of the ones found are kept (greedy is optimal: the supports of minimal
//            vectors are the circuits of a matroid). What remains is completed by elimination.
// Units    : those of the subspace
// Shape    : orthonormal n x k in, n x k out, largest entry of each column 1, not orthonormal
// Errors   : none
// Accuracy : entries below `tolerance` (of the largest) are zero
// Source   : Edmonds 1971, Mathematical Programming 1 (matroids and the greedy algorithm)
#pragma once

#include <Eigen/Core>

namespace frustum::calibration {

constexpr int kMostTogether = 4;

[[nodiscard]] Eigen::MatrixXd sparse_basis(const Eigen::MatrixXd& orthonormal, double tolerance);

}  // namespace frustum::calibration

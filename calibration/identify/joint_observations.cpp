#include "calibration/identify/joint_observations.hpp"

#include <utility>

namespace frustum::calibration {
namespace {

// One above the other; columns that the upper one lacks are zero.
Eigen::MatrixXd stacked(const Eigen::MatrixXd& upper, const Eigen::MatrixXd& lower) {
  Eigen::MatrixXd all = Eigen::MatrixXd::Zero(upper.rows() + lower.rows(), lower.cols());
  all.topLeftCorner(upper.rows(), upper.cols()) = upper;
  all.bottomRows(lower.rows()) = lower;
  return all;
}

Eigen::VectorXd one_after_other(const Eigen::VectorXd& first, const Eigen::VectorXd& second) {
  Eigen::VectorXd all(first.size() + second.size());
  all << first, second;
  return all;
}

}  // namespace

PieceObservations joint_observations(PieceObservations pieces, MotionObservations motions) {
  if (motions.observations.rows.empty()) return pieces;
  if (pieces.observations.rows.empty()) {
    pieces.observations = std::move(motions.observations);
    pieces.without_unknowns = std::move(motions.without_unknowns);
    pieces.model = std::move(motions.model);
    return pieces;
  }
  Observations& o = pieces.observations;
  const Observations& more = motions.observations;
  const Eigen::Index of_pieces = static_cast<Eigen::Index>(o.unknowns.size());
  o.rows.insert(o.rows.end(), more.rows.begin(), more.rows.end());
  o.unknowns = more.unknowns;
  o.gain = stacked(o.gain, more.gain);
  o.values = one_after_other(o.values, more.values);
  const Eigen::Index first = o.covariance.rows(), second = more.covariance.rows();
  Eigen::MatrixXd covariance = Eigen::MatrixXd::Zero(first + second, first + second);
  covariance.topLeftCorner(first, first) = o.covariance;
  covariance.bottomRightCorner(second, second) = more.covariance;
  o.covariance = std::move(covariance);
  pieces.without_unknowns = one_after_other(pieces.without_unknowns, motions.without_unknowns);
  pieces.model = [parts = std::move(pieces.model), tests = std::move(motions.model),
                  of_pieces](const Eigen::VectorXd& x) -> Result<Prediction> {
    const auto upper = parts(x.head(of_pieces));
    if (!upper) return upper.error();
    const auto lower = tests(x);
    if (!lower) return lower.error();
    return Prediction{one_after_other(upper->values, lower->values),
                      stacked(upper->gain, lower->gain)};
  };
  return pieces;
}

}  // namespace frustum::calibration

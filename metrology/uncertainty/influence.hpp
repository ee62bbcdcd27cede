// How far the error of each probed point moves a characteristic: the gradients that uncertainties
// are made of.
//
// Model    : d value / d e_i, where e_i moves point i along its outward normal. Lines and frames in
//            closed form, from the weights of their regressions and the small motion that floors
//            and wall give the frame; radii, diameters and half angles, and what a datum system
//            adds to them, by the responses of the fits (fit_response.hpp)
// Units    : mm, rad; points in the workpiece frame
// Shape    : one row a characteristic, one column a point: features in order, points in order
// Errors   : those of the frame and of the fits
// Accuracy : first order about the measured part; 1e-3 of the gradient for a part 1 mrad askew
//            (tests/metrology/propagation_test.cpp)
// Source   : JCGM 100:2008, section 5.1.3
#pragma once

#include <Eigen/Core>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "core/result.hpp"
#include "metrology/characteristic/fitted_feature.hpp"
#include "metrology/characteristic/standard_uncertainty.hpp"

namespace frustum::metrology {

class Influence {
 public:
  // `features`, in the workpiece frame, and the plan outlive this.
  Influence(const InspectionPlan& plan, std::span<const FittedFeature> features);

  // Nothing for characteristics that cannot be negative (forms, zones, concentricities): they have
  // a kink at zero, where a derivative says nothing.
  [[nodiscard]] Result<std::optional<Eigen::RowVectorXd>> of(const PlannedCharacteristic& planned);

  // d e_i / d term for the six terms of the machine's linear field about the workpiece origin: xx,
  // yy, zz, xy, xz, yz. It acts on ball centres.
  [[nodiscard]] const Eigen::MatrixXd& of_field() const { return field_; }

 private:
  using Motion = Eigen::Matrix<double, 6, Eigen::Dynamic>;

  [[nodiscard]] Eigen::Index find(const std::string& name) const;
  [[nodiscard]] Result<Eigen::RowVectorXd> lines(const PlannedCharacteristic& planned);
  [[nodiscard]] Result<Eigen::RowVectorXd> size(const PlannedCharacteristic& planned);
  [[nodiscard]] Result<Motion> motion_of_frame(const PlannedFrame& frame) const;
  [[nodiscard]] Result<Motion> motion_of_datum() const;

  // Where characteristics in a frame are evaluated, and how the points move that place: shift of
  // the workpiece origin and rotation, in planned directions, a column a point.
  struct Place {
    Pose workpiece_from_place{};
    Motion motion{};
  };
  [[nodiscard]] const Result<Place>& place(const std::string& frame);
  [[nodiscard]] Result<Place> found_place(const std::string& frame) const;

  const InspectionPlan& plan_;
  std::span<const FittedFeature> features_;
  std::vector<Eigen::Index> first_point_{};  // of each feature; the number of all points at the end
  Eigen::MatrixXd field_{};
  std::map<std::string, Result<Place>> places_{};
};

// Variance of a value with that gradient: independent points and a field common to all.
[[nodiscard]] double variance(const Eigen::RowVectorXd& gradient, const Eigen::MatrixXd& field,
                              const PointUncertainty& u);

}  // namespace frustum::metrology

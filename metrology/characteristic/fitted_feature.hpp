// A planned feature with the element that its points gave.
//
// Model    : the element is fitted to ball centres and offset by the ball radius along its own
//            normals; so are the points. Axes are turned to agree with the plan
// Units    : mm, rad; one frame for everything
// Shape    : one feature
// Errors   : those of the fits, with the feature's name; a cone that opens against the plan
// Accuracy : that of least_squares.hpp
// Source   : offset elements of orthogonal-distance fits have the same residuals
#pragma once

#include <vector>

#include "core/result.hpp"
#include "metrology/fit/least_squares.hpp"
#include "metrology/measurement.hpp"
#include "metrology/plan/inspection_plan.hpp"

namespace frustum::metrology {

struct FittedFeature {
  const PlannedFeature* planned = nullptr;  // of the plan that outlives this
  Element element{};
  std::vector<MeasuredPoint> points{};
  double form = 0.0;
  double rms = 0.0;
  Eigen::MatrixXd cofactor{};            // as least_squares.hpp
  double compensation_difference = 0.0;  // as MeasuredFeature

  [[nodiscard]] std::vector<Vec3> section(std::size_t index) const;
  [[nodiscard]] std::vector<Vec3> all_points() const;
};

// Where fits begin: anywhere, or at the planned element, which the points are near. The fit is the
// same.
enum class FitStart { anywhere, plan };

// `centres` are ball centres, or surface points when ball_radius is 0; sections go with them.
[[nodiscard]] Result<FittedFeature> fit_feature(const PlannedFeature& planned,
                                                const std::vector<Vec3>& centres,
                                                const std::vector<std::size_t>& sections,
                                                double ball_radius,
                                                FitStart start = FitStart::anywhere);

// The same from a fit to the centres that is there already.
[[nodiscard]] Result<FittedFeature> feature_from(const PlannedFeature& planned, Fit<Element> fit,
                                                 const std::vector<Vec3>& centres,
                                                 const std::vector<std::size_t>& sections,
                                                 double ball_radius);

[[nodiscard]] FittedFeature transformed(const Pose& to_from, FittedFeature feature);

// What is wrong with one of its sections, told with the names of both.
[[nodiscard]] Diagnostics about_section(const FittedFeature& feature, std::size_t section,
                                        Diagnostics faults);

// What a report says about it.
[[nodiscard]] MeasuredFeature summary(const FittedFeature& feature);

}  // namespace frustum::metrology

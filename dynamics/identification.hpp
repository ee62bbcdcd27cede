// Stiffness and damping that explain measured frequency responses.
//
// Model    : each parameter is a factor on all stiffnesses or dampings of one kind: M(p) fixed,
//            K(p) = K0 + sum (p - 1) dK, D alike. Least squares of ln (measured / computed), whose
//            parts are magnitude and phase, over ln p, by Levenberg and Marquardt with exact
//            derivatives dG = -L Z^-1 dZ Z^-1 L^T. Noise is what is left; the covariance is that of
//            the linearised problem at the end
// Units    : factors; noise as a share of the response
// Shape    : more than as many lines as parameters; names "mount.stiffness", "mount.stiffness.z"
//            (x, y, z, horizontal), "X.carriage.damping" (.normal, .lateral), "B.bearing.stiffness"
//            (.axial, .radial, .tilt), "X.drive.stiffness"
// Errors   : names that the machine has not, with the nearest, or that stand for the same numbers;
//            controlled drives; a response of 0; too few lines; no convergence
// Accuracy : 95 % intervals hold the truth in 90 to 98 % of 200 repetitions on ten machines with
//            5 % noise (tests/dynamics/identification_test.cpp)
// Source   : Marquardt 1963; the ETH thesis adjusts its mounts by hand
#pragma once

#include <span>
#include <string>
#include <vector>

#include "core/result.hpp"
#include "dynamics/dynamic_model.hpp"
#include "dynamics/response_files.hpp"
#include "kinematics/model/axes.hpp"

namespace frustum::dynamics {

// All names that a machine accepts.
[[nodiscard]] std::vector<std::string> parameter_names(const DynamicModel& model);
// The machine with that factor; `name` is one of parameter_names.
[[nodiscard]] DynamicModel with_factor(const DynamicModel& model, const std::string& name,
                                       double factor);

struct IdentifiedParameter {
  std::string name{};
  double factor = 1.0;
  double relative_uncertainty = 0.0;  // standard uncertainty of ln factor
  double low = 1.0, high = 1.0;       // 95 % interval
};

struct Identification {
  std::vector<IdentifiedParameter> parameters{};
  double noise = 0.0;  // rms of magnitude or phase (rad) that is left
  // Combinations that the responses do not show: the parameters in them, largest share first.
  std::vector<std::vector<std::string>> not_separated{};
  DynamicModel model{};  // with the factors
};

[[nodiscard]] Result<Identification> identify_parameters(
    const DynamicModel& model, const kinematics::AxisPositions& q, double tool_length,
    std::span<const FrequencyResponse> measured, const std::vector<std::string>& names);

}  // namespace frustum::dynamics

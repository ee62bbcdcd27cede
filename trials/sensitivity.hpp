// Derivatives of every characteristic of a test piece to machine errors and to the tool radius.
//
// Model    : the piece is cut and measured by a noise-free CMM with the errors given, and with the
//            lag and the dynamic deviation that the options ask for. About that
//            trial a characteristic answers a parameter e by  odd e + even |e|. Two independent
//            ways:
//              analytic     every measured point is moved by its gain (surface_gain.hpp) and the
//              plan is
//                           evaluated again: one trial for all parameters
//              differences  whole trials with the parameter at +step and -step:
//                           odd = (f+ - f-) / 2 step, even = (f+ + f- - 2 f0) / 2 step
// Units    : mm and rad: characteristics per parameter
// Shape    : characteristics of the plan by parameters
// Errors   : those of the trial and of the evaluation
// Accuracy : the two agree to 2e-4 um or urad per um or urad on the step patterns
//            (tests/trials/step_sensitivity_test.cpp); 1e-6 against an independent computation
// Source   : ours; the odd part is what linear models of machining tests call sensitivity, the even
//            part is the dish that a leaning end face cuts, and what forms answer about a perfect
//            part
#pragma once

#include <Eigen/Core>
#include <span>
#include <string>
#include <vector>

#include "core/result.hpp"
#include "kinematics/model/machine.hpp"
#include "metrology/measurement.hpp"
#include "programs/test_piece.hpp"
#include "trials/parameter.hpp"
#include "trials/trial.hpp"

namespace frustum::trials {

struct Sensitivity {
  metrology::Measurement measurement{};  // about which the derivatives are taken
  std::vector<Parameter> parameters{};
  Eigen::MatrixXd odd{};   // rows: measurement.characteristics; columns: parameters
  Eigen::MatrixXd even{};  // of the same shape
};

[[nodiscard]] Result<Sensitivity> sensitivity(const kinematics::Machine& machine,
                                              const kinematics::GeometricErrors& errors,
                                              const programs::TestPiece& piece,
                                              std::span<const Parameter> parameters,
                                              const TrialOptions& options = {});
// Of a piece that has been commanded before (trial.hpp).
[[nodiscard]] Result<Sensitivity> sensitivity(const kinematics::Machine& machine,
                                              const kinematics::GeometricErrors& errors,
                                              const programs::TestPiece& piece,
                                              const CommandedPiece& commanded,
                                              std::span<const Parameter> parameters,
                                              const TrialOptions& options = {});

// A trial with a CMM without errors, all of whose measured features were cut by what should cut
// them: a derivative of anything else would be of no use to anybody.
[[nodiscard]] Result<Trial> clean_trial(const kinematics::Machine& machine,
                                        const kinematics::GeometricErrors& errors,
                                        const programs::TestPiece& piece,
                                        const CommandedPiece& commanded,
                                        const TrialOptions& options);

struct DifferenceSteps {
  double length = 1e-3;  // mm
  double angle = 1e-6;   // rad
};
struct SurfaceGains;
// How the characteristics answer when each parameter moves the measured points along their normals
// by its gains. Steps are small against every curvature and large against rounding, and for forms
// large against that of the part itself.
[[nodiscard]] Result<Sensitivity> sensitivity_of_moves(const programs::TestPiece& piece,
                                                       const metrology::Measurement& measurement,
                                                       const SurfaceGains& gains,
                                                       std::span<const Parameter> parameters,
                                                       const DifferenceSteps& steps = {});

[[nodiscard]] Result<Sensitivity> sensitivity_by_differences(
    const kinematics::Machine& machine, const kinematics::GeometricErrors& errors,
    const programs::TestPiece& piece, std::span<const Parameter> parameters,
    const DifferenceSteps& steps = {}, const TrialOptions& options = {});

// Values of all characteristics in mm and rad.
[[nodiscard]] Eigen::VectorXd values_of(const metrology::Measurement& measurement);

}  // namespace frustum::trials

// Which machine errors cancel when a part is probed on the machine that cut it.
//
// Model    : an error moves a measured point by g, the motion of the cut surface along its normal n
//            (surface_gain.hpp), on a CMM; on the machine by g - n . d, where d is what the same
//            error moves the ball by when it touches there. Both as the response of every
//            characteristic of the error-free part: the larger of f(+e) - f(0) and f(-e) - f(0)
//            over e, so that forms, which answer the size of an error, count like sizes
// Units    : mm and rad: characteristics per parameter
// Shape    : characteristics of the plan by parameters
// Errors   : those of the trial, of the touches and of the evaluation
// Accuracy : first order (surface_gain.hpp)
// Source   : ours
#pragma once

#include <Eigen/Core>
#include <span>
#include <string>
#include <vector>

#include "core/result.hpp"
#include "kinematics/errors/error_assignment.hpp"
#include "trials/part_probing.hpp"
#include "trials/sensitivity.hpp"

namespace frustum::trials {

// On the machine an error that has less than this part of its effect on a CMM cancels.
constexpr double kCancels = 0.05;
// um per um, um per urad: below it an error does nothing to a characteristic.
constexpr double kActs = 1e-3;

// Location errors by their ISO names, the tool radius, and component errors that grow evenly over
// the spans ("EXX linear").
[[nodiscard]] Result<std::vector<Parameter>> part_parameters(const kinematics::Machine& machine,
                                                             const kinematics::AxisSpans& spans);

struct PartGains {
  std::vector<Parameter> parameters{};
  std::vector<std::string> characteristics{};
  std::vector<bool> angular{};  // of the characteristics
  Eigen::MatrixXd on_cmm{};
  Eigen::MatrixXd on_machine{};
};

[[nodiscard]] Result<PartGains> part_gains(const kinematics::Machine& machine,
                                           const programs::TestPiece& piece,
                                           const CommandedPiece& commanded, const PartTouches& plan,
                                           const PartProbe& probe,
                                           std::span<const Parameter> parameters,
                                           const TrialOptions& options = {});

// What an error does to the characteristics of a part.
enum class ErrorFate {
  nothing,  // to none of them, here or there
  cancels,  // on the machine nothing of what it does on a CMM
  in_part,  // of some characteristics nothing, or less than half
  stays,    // about the same
  grows     // at least half as much again as on a CMM, or only here
};
struct FateOfError {
  ErrorFate fate = ErrorFate::nothing;
  std::vector<std::size_t> cancelled{};  // characteristics
  std::vector<std::size_t> kept{};       // that it still acts on
};
[[nodiscard]] FateOfError fate_of(const PartGains& gains, std::size_t parameter);

}  // namespace frustum::trials

// Amounts by which a program's set-up or a machine differs, fitted so that the program agrees with
// the right tool path.
//
// Units  : mm; an amount has as many parameters as it takes
// Errors : none; no amounts where none explain the difference
#pragma once

#include <Eigen/Core>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "post/comparing/trial_path.hpp"

namespace frustum::post {

// What a set-up or a machine may have different, by as many amounts as it has parameters.
struct Amounts {
  int count = 0;
  bool leaves_commands = false;  // the axes are commanded the same, whatever the amounts
  std::function<void(const Eigen::VectorXd&, kinematics::Setup&, kinematics::GeometricErrors&)>
      apply{};
  std::function<std::string(const Eigen::VectorXd&)> words{};
};

[[nodiscard]] std::vector<Amounts> adjustable(const kinematics::Machine& machine);

class AmountFit {
 public:
  // All must outlive it; `commanded` is the program as it is.
  AmountFit(const kinematics::Machine& machine, const kinematics::ToolPath& first,
            const ComparedProgram& program, const kinematics::CommandedProgram& commanded,
            const DifferenceLimits& limits)
      : machine_(machine),
        first_(first),
        program_(program),
        commanded_(commanded),
        limits_(limits) {}

  // The amounts that make the program agree with the first path; nothing when none do.
  [[nodiscard]] std::optional<Eigen::VectorXd> operator()(const Amounts& amounts) const;

 private:
  using Poses = std::vector<kinematics::ToolPose>;

  [[nodiscard]] std::optional<kinematics::ToolPath> run(
      const Amounts& amounts, const Eigen::VectorXd& p,
      PathSampling sampling = PathSampling::coarse) const;
  [[nodiscard]] std::optional<Eigen::VectorXd> same_way_with(const Amounts& amounts,
                                                             const Eigen::VectorXd& p) const;
  // Motion of each block end by a unit of each amount: three rows a block.
  [[nodiscard]] std::optional<Eigen::MatrixXd> slopes_of(const Amounts& amounts,
                                                         const Poses& poses) const;
  // How far each block end is from where the first path is after the same share of its way.
  [[nodiscard]] Eigen::VectorXd by_progress(const Poses& poses) const;
  // Only displacements across the direction of the first path count.
  [[nodiscard]] Eigen::VectorXd step_across(const Eigen::MatrixXd& slopes,
                                            const kinematics::ToolPath& path) const;

  const kinematics::Machine& machine_;
  const kinematics::ToolPath& first_;
  const ComparedProgram& program_;
  const kinematics::CommandedProgram& commanded_;
  const DifferenceLimits& limits_;
};

}  // namespace frustum::post

// What a job's measured points and characteristics do to first order in the errors.
//
// Model    : the points of the machine in the middle move along their normals by gains x weights
//            (trials/surface_gain.hpp). A characteristic that is a size of parts (the deviations of
//            a form, the vector of an offset) or a deviation of either sign is linear in its parts,
//            whose gains are differences of the plan's evaluation; where the first draws confirm
//            that, the engine in lanes has it. Any other characteristic is evaluated by the plan
//            from the moved points, draw by draw
// Units    : points and values um, urad; weights mm, rad
// Shape    : columns are those of the factors; characteristics those of the study
// Errors   : none; what stands against a linear engine has its words
// Accuracy : first order; see studies/engine/engine_controls.hpp
// Source   : ours
#pragma once

#include <Eigen/Core>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "app/study/study_model.hpp"
#include "metrology/measurement.hpp"
#include "studies/engine/linear_engine.hpp"
#include "trials/trial.hpp"

namespace frustum::app {

// Deviations from the nominal values where there are any, um or urad; of `value` in mm or rad.
[[nodiscard]] double shown_value(const metrology::CharacteristicResult& c, double value);
[[nodiscard]] double shown_value(const metrology::CharacteristicResult& c);
[[nodiscard]] std::vector<double> shown_values(const metrology::Measurement& measurement);
// From the planned points to the measured ones, along the planned normals, um.
[[nodiscard]] std::vector<double> deviations_of(const metrology::InspectionPlan& plan,
                                                const metrology::Measurement& measurement);

class LinearPiece {
 public:
  // All outlive it. `middle`: of the machine with the errors that are not drawn, by a CMM without
  // errors.
  LinearPiece(const StudyFile& study, const studies::FactorSet& factors,
              const trials::Trial& middle);

  // Why the surface is not linear in the errors; empty: it is.
  [[nodiscard]] const std::string& against() const { return against_; }
  // Points that show how far a draw is from the middle: of each feature at most 64, evenly taken.
  [[nodiscard]] const Eigen::MatrixXd& reach_gains() const { return reach_gains_; }
  // All characteristics, then the largest motion of those points; none where one is not linear.
  [[nodiscard]] const studies::LinearEngine* engine() const { return engine_.get(); }
  // Nothing where the characteristic is not linear in its parts.
  [[nodiscard]] const std::optional<studies::LinearCharacteristic>& characteristic(
      std::size_t place) const {
    return characteristics_[place];
  }

  // By the plan, from all points moved so.
  [[nodiscard]] DrawOutcome moved(const Eigen::VectorXd& weights) const;
  // As deviations_of() gives them.
  [[nodiscard]] std::vector<double> points(const Eigen::VectorXd& weights) const;
  // The middle machine's points as another CMM judges them.
  [[nodiscard]] Result<metrology::Measurement> judged_by(const metrology::CmmModel& cmm) const {
    return evaluated({}, cmm);
  }

 private:
  void find_gains();
  void find_characteristics();
  void find_engine();
  // How far value and plan's evaluation differ in the first draws, beyond what may be.
  [[nodiscard]] bool agrees(std::size_t characteristic, double relative, double absolute) const;
  [[nodiscard]] Result<metrology::Measurement> evaluated(const Eigen::VectorXd& moves,
                                                         const metrology::CmmModel& cmm) const;

  struct Checked {
    Eigen::VectorXd weights{};
    std::vector<double> values{};  // by the plan
  };

  const StudyFile& study_;
  const studies::FactorSet& factors_;
  const trials::Trial& middle_;
  Eigen::MatrixXd gains_{}, reach_gains_{};
  std::string against_{};
  std::vector<std::optional<studies::LinearCharacteristic>> characteristics_{};
  std::vector<Checked> checked_{};
  std::unique_ptr<studies::LinearEngine> engine_{};
};

}  // namespace frustum::app

// What machines of a study make: from the random numbers of a draw to the values of all
// characteristics, by whole trials (full) or to first order in the errors (linear).
//
// Units  : values and points um, urad; weights mm, rad
// Shape  : one outcome a draw; parallel over draws, the same for any number of threads
// Errors : a draw that fails has its message and no values; the others go on
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "app/study/study_file.hpp"
#include "core/result.hpp"
#include "studies/engine/linear_engine.hpp"
#include "studies/laws/factors.hpp"

namespace frustum::app {

struct DrawnMachine {
  std::uint32_t draw = 0;
  std::vector<double> values{};  // of all variables of the factors
};

struct DrawOutcome {
  std::vector<double> values{};  // by characteristic; empty: the draw failed
  std::vector<double> points{};  // along the planned normals; of full ones, if asked for
  double largest_move = 0.0;     // um, of a point; linear alone
  std::string failure{};
};

struct EvaluationRequest {
  double scale = 1.0;  // on everything that is drawn
  bool points = false;
};

// A characteristic to first order in the weights.
struct LinearView {
  Eigen::MatrixXd gains{};  // of its deviations, as its fit leaves them; a column a weight
  // Values for rows of weights, one row a draw.
  std::function<std::vector<double>(std::span<const double> weights)> values{};
};

class StudyModel {
 public:
  virtual ~StudyModel() = default;

  [[nodiscard]] virtual const studies::FactorSet& factors() const = 0;
  [[nodiscard]] virtual std::size_t point_count() const = 0;
  // Of points that show how far a draw is from the middle: um per mm or rad of the weights.
  [[nodiscard]] virtual const Eigen::MatrixXd& gains() const = 0;
  // Values of all characteristics and, last, the largest motion (um); null where the linear model
  // is evaluated draw by draw.
  [[nodiscard]] virtual const studies::LinearEngine* linear_engine() const { return nullptr; }
  // Why the linear engine cannot stand whatever its controls say; empty: it may.
  [[nodiscard]] virtual std::string against_linear() const = 0;
  // Nothing where the characteristic is no range or length of what moves in proportion.
  [[nodiscard]] virtual std::optional<LinearView> linear_view(std::size_t characteristic) const = 0;
  // Standard uncertainty of a measured characteristic by the job's CMM; 0: none is stated.
  [[nodiscard]] virtual double measuring_uncertainty(std::size_t characteristic) const = 0;

  // How full() makes its draws, where there is more than one way.
  [[nodiscard]] virtual std::string about_full() const { return {}; }

  // SHA-256 of files with subprograms that the program has opened.
  [[nodiscard]] virtual std::vector<std::string> program_hashes() const { return {}; }

  [[nodiscard]] virtual std::vector<DrawOutcome> full(std::span<const DrawnMachine> draws,
                                                      const EvaluationRequest& request) const = 0;
  [[nodiscard]] virtual std::vector<DrawOutcome> linear(std::span<const DrawnMachine> draws,
                                                        const EvaluationRequest& request) const = 0;
  // Along the planned normals, um, to first order.
  [[nodiscard]] virtual std::vector<double> linear_points(const DrawnMachine&) const { return {}; }
};

// Weights of all columns, all of them scaled.
[[nodiscard]] Eigen::VectorXd weights_of(const studies::FactorSet& factors,
                                         const DrawnMachine& machine, double scale);
// Everything that is drawn scaled, what is not as it is.
[[nodiscard]] Result<kinematics::GeometricErrors> errors_of(const studies::FactorSet& factors,
                                                            const kinematics::Machine& on,
                                                            const DrawnMachine& machine,
                                                            double scale);
// What an engine as StudyModel::linear_engine() has it says of these machines.
[[nodiscard]] std::vector<DrawOutcome> in_lanes(const studies::LinearEngine& engine,
                                                const studies::FactorSet& factors,
                                                std::span<const DrawnMachine> draws, double scale);

// With everything that is done once: the nominal trial, the gains. Both outlive the model.
[[nodiscard]] Result<std::unique_ptr<StudyModel>> make_model(const StudyFile& study);

}  // namespace frustum::app

// What a study draws: the machine errors that are written as distributions, as independent factors,
// and the columns that they weigh.
//
// Model    : a variable is one random number of a draw. An amount (size, phase, ...) of a term is a
//            value times what its variables give. A column is a term with an amount of 1 mm or
//            1 rad; the machine's errors of a draw are
//              fixed errors + sum of weight x column
//            A harmonic or cyclic term a cos(x + psi) whose phase is drawn has two columns, cos x
//            with weight a cos psi and sin x with weight -a sin psi: columns and weights are those
//            of trials::PopulationLaws. A factor is what is
//            drawn independently of all others: a term with its amplitude and phase, several terms
//            that share a drawn quantity, a correlated group
//            Correlated members: y = L z, L the Cholesky factor of the correlation, z the normal
//            quantiles of the members' own u; x_i = F_i^-1(Phi(y_i)). The correlation is that of
//            the normals
// Units    : mm, rad
// Shape    : variables, amounts, columns and factors in the order of the entries
// Errors   : a scale pattern without a match; names of correlated groups that are unknown, twice,
//            or no constants with one drawn amount; matrices that are no correlations; what
//            resolve() refuses of the entries; nothing drawn at all
// Accuracy : draws of the scheme random equal those of kinematics::draw bit by bit where nothing is
//            correlated or scaled (tests/studies/factors_test.cpp)
// Source   : ours; Gaussian copula: Nelsen, An Introduction to Copulas
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "core/result.hpp"
#include "kinematics/errors/error_assignment.hpp"
#include "kinematics/errors/error_shape.hpp"
#include "studies/laws/law.hpp"

namespace frustum::studies {

// Amounts of the terms that a pattern such as "E?X:harmonic 2" names, times a factor. A pattern is
// an error's name with * and ?, then perhaps a colon, a kind of shape and the order of a harmonic.
struct ScaleRule {
  std::string pattern{};
  double factor = 1.0;
};

struct CorrelatedGroup {
  std::vector<std::string> names{};
  Eigen::MatrixXd correlation{};
};

// Why an error cannot be a member of a correlated group: it is no constant with one drawn amount of
// its own.
[[nodiscard]] std::optional<Diagnostic> uncorrelatable(
    std::span<const kinematics::ErrorEntry> entries, const std::string& name);

struct FactorOptions {
  kinematics::ToleranceReading read_as = kinematics::ToleranceReading::uniform;
  std::vector<ScaleRule> scale{};  // of several that match a term the last holds
  std::vector<CorrelatedGroup> correlated{};
  kinematics::AxisSpans spans{};  // default spans of shapes, as in kinematics::resolve
};

struct Variable {
  std::string place{};  // "EXX/0/amount/0", "drawn a1": what keys its stream
  std::uint64_t stream = 0;
  Law law{};
};

// An amount of a term that depends on variables.
struct DrawnAmount {
  struct Part {
    std::size_t variable = 0;
    double shift = 0.0;
    kinematics::DrawnFactor::Function function = kinematics::DrawnFactor::Function::itself;
  };
  // "amounts/EXX/0", "phases/EXX/2", "peaks/..", "coefficients/EXX/0/1"; empty: a fixed amplitude
  // whose phase is drawn.
  std::string name{};
  UnitKind unit = UnitKind::none;
  double value = 1.0;
  std::vector<Part> parts{};

  [[nodiscard]] double operator()(std::span<const double> variables) const;
};

enum class Wave : std::uint8_t { none, cosine, sine };

struct Column {
  std::string name{};  // "EXX/0", "EXX/2 cos", "EXX/2 sin"
  std::size_t factor = 0;
  std::size_t amount = 0;              // of FactorSet::amounts
  std::optional<std::size_t> phase{};  // of FactorSet::amounts
  Wave wave = Wave::none;
  kinematics::GeometricErrors unit{};
};

struct Factor {
  std::string name{};                  // "EXX/0", or several joined by " + "
  std::vector<std::string> entries{};  // "EXX"
  std::string shape{};                 // "linear", "harmonic 2"; of several, that of the first
  std::vector<std::size_t> variables{};
  std::vector<std::size_t> columns{};
};

// Mean and covariance of the columns' weights.
struct WeightMoments {
  Eigen::VectorXd mean{};
  Eigen::MatrixXd covariance{};
};

class FactorSet {
 public:
  [[nodiscard]] static Result<FactorSet> make(const kinematics::Machine& machine,
                                              std::span<const kinematics::ErrorEntry> entries,
                                              const FactorOptions& options = {});

  [[nodiscard]] const std::vector<Variable>& variables() const { return variables_; }
  // Their streams, as a Scheme takes them.
  [[nodiscard]] std::vector<std::uint64_t> streams() const;
  [[nodiscard]] const std::vector<DrawnAmount>& amounts() const { return amounts_; }
  [[nodiscard]] const std::vector<Column>& columns() const { return columns_; }
  [[nodiscard]] const std::vector<Factor>& factors() const { return factors_; }
  // The errors that are not drawn.
  [[nodiscard]] const kinematics::GeometricErrors& fixed() const { return fixed_; }
  // Terms that no column can stand for, with the reason: the linear engine must refuse them.
  [[nodiscard]] const std::vector<std::string>& nonlinear() const { return nonlinear_; }
  // Whether all errors are drawn and centred on nothing fixed, so that one factor scales them all.
  [[nodiscard]] bool has_fixed_errors() const { return has_fixed_; }

  // Values of all variables in one draw of the scheme random.
  void draw(std::uint64_t seed, std::uint32_t index, std::span<double> values) const;
  // The same from one u in (0, 1) a variable.
  void from_uniform(std::span<const double> u, std::span<double> values) const;
  // Weights of all columns for the values of all variables.
  void weights(std::span<const double> values, std::span<double> weights) const;
  // The largest that the absolute value of each column's weight can be; see largest() of a law.
  [[nodiscard]] std::vector<double> largest_weights() const;
  [[nodiscard]] WeightMoments weight_moments() const;
  // Draws that the linear engine may make in lanes: no variable is correlated.
  [[nodiscard]] bool has_correlated() const { return !copulas_.empty(); }

  // What was read: tolerances as their laws, amounts scaled, fields written out as harmonics.
  [[nodiscard]] const std::vector<kinematics::ErrorEntry>& entries() const { return entries_; }
  // Errors of a draw as people write them, and over the machine's axes.
  [[nodiscard]] std::vector<kinematics::ErrorEntry> entries_at(
      std::span<const double> values) const;
  [[nodiscard]] Result<kinematics::GeometricErrors> errors_at(const kinematics::Machine& machine,
                                                              std::span<const double> values) const;

 private:
  friend class FactorReader;
  struct Copula {
    std::vector<std::size_t> variables{};
    Eigen::MatrixXd correlation{};
    Eigen::MatrixXd cholesky{};
  };
  void correlate(const Copula& copula, std::span<double> uniform_to_value) const;

  std::vector<Variable> variables_;
  std::vector<DrawnAmount> amounts_;
  std::vector<Column> columns_;
  std::vector<Factor> factors_;
  std::vector<Copula> copulas_;
  std::vector<std::string> nonlinear_;
  std::vector<kinematics::ErrorEntry> entries_;
  std::vector<std::size_t> written_;  // of amounts_, in the order of the entries' drawn amounts
  kinematics::AxisSpans spans_;
  kinematics::GeometricErrors fixed_;
  bool has_fixed_ = false;
};

}  // namespace frustum::studies

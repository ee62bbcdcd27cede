// What differs between the machines of a population: error shapes whose amounts are drawn, as
// columns of a matrix that a draw weighs.
//
// Model    : the errors of a draw are fixed + sum_j w_j unit_j, unit_j one mm or rad of a shape. A
//            shape with a drawn amount is one column; a harmonic or cyclic shape with a drawn
//            phase is two, with  w = a cos(phase) and -a sin(phase)  for an amount a: the errors
//            are linear in the weights whatever the laws are. A polynomial has a column for each
//            drawn coefficient
// Units    : mm, rad
// Shape    : as many columns as there are drawn shapes, those with a drawn phase twice
// Errors   : those of error_assignment.hpp for the entries with their amounts at the middle of
//            their laws; "population-law" for what is not linear: a tent that is drawn where it
//            stands. Such populations are drawn and tried one by one
// Accuracy : errors(weights(drawn)) is what error_assignment.hpp makes of `drawn`, but for rounding
//            (tests/trials/population_test.cpp)
// Source   : ours
#pragma once

#include <span>
#include <string>
#include <vector>

#include "core/result.hpp"
#include "kinematics/errors/error_assignment.hpp"
#include "kinematics/model/geometric_errors.hpp"
#include "kinematics/model/machine.hpp"
#include "programs/test_piece.hpp"
#include "trials/trial.hpp"

namespace frustum::trials {

// Which of its amounts a column weighs.
enum class ColumnPart { amount, cosine, sine, coefficient };

struct ErrorColumn {
  std::size_t entry = 0;  // place among the entries
  std::size_t term = 0;   // of the entry
  std::string error{};    // as written: "EXX", or an alias
  ColumnPart part = ColumnPart::amount;
  std::size_t coefficient = 0;  // of a polynomial
  bool angular = false;         // its weight is in rad, else mm
  double middle = 0.0;          // of its weight's law: 0 where the phase is drawn
  double most = 0.0;            // no weight of the law is larger; of normal amounts 8 sd
  kinematics::GeometricErrors unit{};
};

// One machine: the weight of each column.
using Weights = std::vector<double>;

class PopulationLaws {
 public:
  // The entries of [errors] or of a file of errors, drawn amounts and others; shapes without a span
  // are over what the piece's error_span travels.
  [[nodiscard]] static Result<PopulationLaws> of(const kinematics::Machine& machine,
                                                 std::span<const kinematics::ErrorEntry> entries,
                                                 const programs::TestPiece& piece,
                                                 const CommandedPiece& commanded);
  // With spans found elsewhere.
  [[nodiscard]] static Result<PopulationLaws> of(const kinematics::Machine& machine,
                                                 std::span<const kinematics::ErrorEntry> entries,
                                                 const kinematics::AxisSpans& spans);

  // Columns that were made elsewhere; weights() of entries is not for them.
  [[nodiscard]] static PopulationLaws of(kinematics::GeometricErrors fixed,
                                         std::vector<ErrorColumn> columns);

  [[nodiscard]] std::span<const ErrorColumn> columns() const { return columns_; }
  // Of the errors that are not drawn.
  [[nodiscard]] const kinematics::GeometricErrors& fixed() const { return fixed_; }

  // Of the same entries, in the same order, with all amounts fixed (kinematics::draw()).
  [[nodiscard]] Weights weights(std::span<const kinematics::ErrorEntry> drawn) const;
  [[nodiscard]] Weights middle() const;
  // As run_trial() takes them.
  [[nodiscard]] kinematics::GeometricErrors errors(std::span<const double> weights) const;

 private:
  std::vector<ErrorColumn> columns_{};
  kinematics::GeometricErrors fixed_{};
};

}  // namespace frustum::trials

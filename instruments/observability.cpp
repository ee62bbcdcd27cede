#include "instruments/observability.hpp"

#include <fmt/format.h>

#include <Eigen/QR>
#include <algorithm>
#include <array>
#include <cmath>

#include "core/linear_algebra.hpp"

namespace frustum::instruments {
namespace {

using kinematics::AxisLetter;
using kinematics::ErrorDirection;
using kinematics::ErrorName;
using kinematics::Machine;
using kinematics::MachineError;

// Gains of order one carry rounding of 1e-13; what is really told is above 1e-4.
constexpr double kNothing = 1e-9;

// What the columns of `free` cannot make of `rows`.
Eigen::MatrixXd projected(const Eigen::MatrixXd& rows, const Eigen::MatrixXd& free) {
  if (free.cols() == 0 || free.rows() == 0) return rows;
  Eigen::ColPivHouseholderQR<Eigen::MatrixXd> factors(free.rows(), free.cols());
  factors.setThreshold(kNothing);
  factors.compute(free);
  const Eigen::Index rank = factors.rank();
  Eigen::MatrixXd turned = factors.householderQ().transpose() * rows;
  turned.topRows(rank).setZero();
  return factors.householderQ() * turned;
}

// Gauss-Jordan in the order of the columns; rows are independent.
Eigen::MatrixXd reduced_echelon(Eigen::MatrixXd rows) {
  Eigen::Index done = 0;
  for (Eigen::Index column = 0; column < rows.cols() && done < rows.rows(); ++column) {
    Eigen::Index at = 0;
    // Rows are of length one: what elimination leaves below a millionth is rounding.
    const double pivot = rows.col(column).tail(rows.rows() - done).cwiseAbs().maxCoeff(&at);
    if (pivot < 1e-7) {
      rows.col(column).tail(rows.rows() - done).setZero();
      continue;
    }
    rows.row(done).swap(rows.row(done + at));
    rows.row(done) /= rows(done, column);
    for (Eigen::Index i = 0; i < rows.rows(); ++i) {
      if (i != done) rows.row(i) -= rows(i, column) * rows.row(done);
    }
    ++done;
  }
  return rows;
}

std::string combination_text(const Eigen::RowVectorXd& row, std::span<const MachineError> errors) {
  std::string text;
  for (std::size_t k = 0; k < errors.size(); ++k) {
    double c = row[static_cast<Eigen::Index>(k)];
    if (std::abs(c) < 1e-6) continue;
    if (std::abs(c - std::round(c)) < 1e-6) c = std::round(c);
    if (!text.empty()) text += c < 0.0 ? " - " : " + ";
    if (std::abs(c) != 1.0) text += fmt::format("{:.6g} ", std::abs(c));
    text += errors[k].name;
  }
  return text;
}

void add_locations(const Machine& machine, const std::vector<kinematics::Joint>& chain,
                   std::vector<MachineError>& errors) {
  for (const kinematics::Joint& joint : chain) {
    if (!joint.rotary()) continue;
    for (const auto direction : {ErrorDirection::X, ErrorDirection::Y, ErrorDirection::Z,
                                 ErrorDirection::A, ErrorDirection::B, ErrorDirection::C}) {
      const ErrorName name{direction, joint.letter, true};
      if (!machine.refused(name)) errors.push_back({.name = name.text(), .error = name});
    }
  }
}

}  // namespace

std::vector<MachineError> location_unknowns(const Machine& machine) {
  std::vector<MachineError> errors;
  add_locations(machine, machine.work_chain(), errors);
  add_locations(machine, machine.tool_chain(), errors);
  for (const ErrorName& name : {ErrorName{ErrorDirection::C, AxisLetter::Y, true},
                                ErrorName{ErrorDirection::A, AxisLetter::Z, true},
                                ErrorName{ErrorDirection::B, AxisLetter::Z, true}}) {
    if (machine.joint(name.axis) != nullptr && !machine.refused(name)) {
      errors.push_back({.name = name.text(), .error = name});
    }
  }
  return errors;
}

Eigen::MatrixXd without_setup(std::span<const ReadingGains> tests, SpindleBall ball) {
  if (tests.empty()) return {};
  const Eigen::Index columns = tests.front().errors.cols();
  Eigen::Index rows = 0;
  for (const ReadingGains& test : tests) rows += test.errors.rows();
  Eigen::MatrixXd all(rows, columns + 3);
  rows = 0;
  for (const ReadingGains& test : tests) {
    Eigen::MatrixXd of_test(test.errors.rows(), columns + 3);
    of_test << test.errors, test.ball;
    all.middleRows(rows, of_test.rows()) = projected(of_test, test.of_test);
    rows += of_test.rows();
  }
  const Eigen::MatrixXd errors = all.leftCols(columns);
  return ball == SpindleBall::known ? errors : projected(errors, all.rightCols(3));
}

Told told_by(std::span<const MachineError> errors, std::span<const ReadingGains> tests,
             SpindleBall ball) {
  Told found{.unknowns = static_cast<int>(errors.size())};
  for (const MachineError& each : errors) found.not_told.push_back(each.name);
  if (tests.empty() || errors.empty()) return found;
  Eigen::MatrixXd rows = without_setup(tests, ball);
  for (std::size_t k = 0; k < errors.size(); ++k) {
    if (is_rotation(errors[k].error.direction)) {
      rows.col(static_cast<Eigen::Index>(k)) *= kUmPerMm / kUradPerRad;
    }
  }
  const SingularValues spectrum = singular_values(rows, SingularVectors::thin);
  Eigen::Index rank = 0;
  while (rank < spectrum.values.size() && spectrum.values[rank] > kNothing) ++rank;
  const Eigen::MatrixXd echelon = reduced_echelon(spectrum.right.leftCols(rank).transpose());
  for (Eigen::Index i = 0; i < rank; ++i) {
    found.told.push_back(combination_text(echelon.row(i), errors));
  }
  std::erase_if(found.not_told, [&](const std::string& name) {
    return std::ranges::find(found.told, name) != found.told.end();
  });
  return found;
}

}  // namespace frustum::instruments

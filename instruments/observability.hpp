// What readings say of a machine's location errors, whatever the set-up is.
//
// Model    : gains of all readings (um per um and um per urad), less what the unknowns of each
//            mounting and, unless it is known, the offset of the spindle ball can make; the space
//            of the rows that are left, by singular values, is written as combinations of errors
//            in reduced echelon form: each names one error that no other combination has
// Units    : um and urad
// Shape    : any number of tests
// Errors   : none
// Accuracy : singular values below 1e-9 of the largest count as zero: gains are exact to 1e-13
// Source   : Golub, Van Loan, Matrix Computations, section 5.5
#pragma once

#include <span>
#include <string>
#include <vector>

#include "instruments/reading_gains.hpp"
#include "kinematics/errors/error_gain.hpp"
#include "kinematics/model/machine.hpp"

namespace frustum::instruments {

// Location errors of the rotary axes (those of the work chain first, bed outwards), then the
// squarenesses EC0Y, EA0Z, EB0Z, as far as the machine has them.
[[nodiscard]] std::vector<kinematics::MachineError> location_unknowns(
    const kinematics::Machine& machine);

enum class SpindleBall { unknown, known };

struct Told {
  int unknowns = 0;
  std::vector<std::string> told{};      // "EA0A + EA0C": as many as the rank
  std::vector<std::string> not_told{};  // errors that the readings do not say by themselves

  [[nodiscard]] int rank() const { return static_cast<int>(told.size()); }
};

[[nodiscard]] Told told_by(std::span<const kinematics::MachineError> errors,
                           std::span<const ReadingGains> tests, SpindleBall ball);

// The gains of the errors that are left when the set-up is taken out by least squares, a row a
// reading: mm per mm and mm per rad.
[[nodiscard]] Eigen::MatrixXd without_setup(std::span<const ReadingGains> tests, SpindleBall ball);

}  // namespace frustum::instruments

// Axis errors as instruments write them: CSV with units in its header, and calibration files in
// sections.
//
// Model    : tables of one coordinate, and constants
// Units    : CSV: those of its header (X_mm,EXX_um,EBX_urad). Calibration file: values in mm and
//            rad, positions in mm and degrees
// Errors   : file, line and column of positions that do not increase, a missing unit, an unknown
//            error name, a column of another axis, what is no number
#pragma once

#include <filesystem>
#include <vector>

#include "core/result.hpp"
#include "kinematics/errors/error_shape.hpp"

namespace frustum::kinematics {

// First column the axis's position, every other one an error of that axis.
[[nodiscard]] Result<std::vector<ErrorEntry>> read_error_csv(const std::filesystem::path& file);

// Sections such as
//   [B0C]            [EXX]
//   VALUE = 1.8e-5   Gridpoints = {
//                    -200.0 -0.004
//                       0.0  0.0
//                    }
// with // comments: the exchange format of laser tracer calibrations.
[[nodiscard]] Result<std::vector<ErrorEntry>> read_calibration(const std::filesystem::path& file);

}  // namespace frustum::kinematics

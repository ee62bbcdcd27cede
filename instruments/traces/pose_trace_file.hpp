// Measured displacements of an R-test, and readings along diagonals.
//
// Text   : of an R-test a row a pose in the order of the test: columns of its rotary axes (A_deg,
//          B_deg, C_deg), which may be left out, and x_um, y_um, z_um in the frame of the table; of
//          diagonals: diagonal (+++, ++-, ...), length_mm, reading_um, points in increasing order
//          (trace_table.hpp)
// Units  : as the columns say; out: mm
// Errors : another number of poses or points than the test has, positions or lengths that are not
//          those of the test, a diagonal that it has not: with file and line
#pragma once

#include <filesystem>
#include <map>
#include <span>
#include <string>
#include <vector>

#include "core/result.hpp"
#include "instruments/line_test.hpp"
#include "instruments/motion_test.hpp"

namespace frustum::instruments {

[[nodiscard]] Result<std::vector<Vec3>> read_pose_trace(const std::filesystem::path& file,
                                                        const kinematics::Machine& machine,
                                                        std::span<const TestPose> poses);
[[nodiscard]] std::string pose_csv(const kinematics::Machine& machine,
                                   std::span<const TestPose> poses, std::span<const Vec3> readings);

// By line, in the order of `lines`.
[[nodiscard]] Result<std::vector<std::vector<double>>> read_diagonal_trace(
    const std::filesystem::path& file, const std::map<std::string, LineTest>& lines);

}  // namespace frustum::instruments

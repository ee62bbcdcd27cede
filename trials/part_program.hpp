// The touches of a cut part as programs of its machine, and what such a program has logged.
//
// Text     : of a log: columns of the rotary axes (A_deg, ..), point, counted from 0 in the order
//            of the plan, and ball_x_mm, ball_y_mm, ball_z_mm, counted from G54; of Fanuc A ..,
//            POINT, BALLX, BALLY, BALLZ (instruments/probing_program.hpp)
// Units    : as the columns say; inside mm, rad
// Errors   : tool-tilted: heads that tilt the tool at a pose, where a program without tool centre
//            point control would have to know the length of the probe; of a log, with its line:
//            touches that the plan has not, twice, missing, or beyond what the probe reaches
// Accuracy : a nanometre in programs, 1e-9 mm in our own logs
// Source   : ours
#pragma once

#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "core/result.hpp"
#include "instruments/probing_program.hpp"
#include "trials/part_probing.hpp"

namespace frustum::trials {

[[nodiscard]] Result<instruments::ProbingProgram> part_program(const kinematics::Machine& machine,
                                                               const programs::TestPiece& piece,
                                                               const PartTouches& plan);

[[nodiscard]] std::string part_log(const kinematics::Machine& machine,
                                   const programs::TestPiece& piece, const PartTouches& plan,
                                   std::span<const double> readings);
// Readings in the order of the plan.
[[nodiscard]] Result<std::vector<double>> read_part_log(const std::filesystem::path& file,
                                                        const kinematics::Machine& machine,
                                                        const programs::TestPiece& piece,
                                                        const PartTouches& plan);

// A remark on each touch that lies apart from the others of its feature: more than 0.05 mm and
// fifty times what they scatter about their median. A speck or a wrong point, not form.
[[nodiscard]] Diagnostics touches_apart(const programs::TestPiece& piece, const PartTouches& plan,
                                        std::span<const double> readings);

}  // namespace frustum::trials

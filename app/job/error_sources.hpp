// The errors of a command: what its job says, error files, single errors of the command line, one
// draw.
//
// Units    : as people write them; inside mm and rad
// Errors   : what cannot be read, and a file that is written for another machine
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "core/result.hpp"
#include "kinematics/errors/error_assignment.hpp"
#include "kinematics/errors/error_table.hpp"
#include "kinematics/model/machine.hpp"

namespace frustum::app {

// Which draw of the errors that are written as distributions.
struct ErrorDraw {
  std::uint64_t seed = 0;
  std::uint32_t index = 0;
};

// What the command line may add; later words win: the job's errors, these files, then these errors.
struct ErrorWords {
  std::vector<std::string> files{};
  std::vector<std::string> errors{};  // "EB0C=30urad"
  std::optional<std::uint64_t> draw{};
};

// The files that are named there.
[[nodiscard]] std::vector<std::filesystem::path> error_files_of(const ErrorWords& words);
// The seed of the command line goes before the job's; the number of the draw is the job's.
[[nodiscard]] std::optional<ErrorDraw> drawn_by(const ErrorWords& words,
                                                std::optional<ErrorDraw> of_job);
// `draw`: as drawn_by() says.
[[nodiscard]] Result<std::vector<kinematics::ErrorEntry>> gather_errors(
    kinematics::ErrorList of_job, const ErrorWords& words, std::optional<ErrorDraw> draw,
    const kinematics::Machine& machine);

// A path (relative to `folder`, else to the working folder), or the name of a shipped error file.
[[nodiscard]] std::filesystem::path find_error_file(const std::string& name,
                                                    const std::filesystem::path& folder);

}  // namespace frustum::app

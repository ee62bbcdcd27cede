// The job of a compensated program: the original's text with the keys changed that cannot stay.
//
// Changed: title, program, lines of operations, the plan's name, no [errors]; paths of files so
//          that they are found from the new folder. All else stays as it was written
// Units  : none
// Errors : a job that is no longer what was loaded
#pragma once

#include <filesystem>
#include <string>

#include "app/job/job.hpp"
#include "programs/test_piece.hpp"

namespace frustum::app {

// `plan`: as the new job names it.
[[nodiscard]] Result<std::string> compensated_job(const Job& job, const programs::TestPiece& made,
                                                  const std::string& plan,
                                                  const std::filesystem::path& folder);

}  // namespace frustum::app

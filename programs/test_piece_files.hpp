// Writes a test piece as the files that `frustum run` reads: job, NC program, inspection plan.
//
// Units: as the files state them. Errors: a folder that cannot be made or a file that cannot be
// written; each file appears whole or not at all.
#pragma once

#include <filesystem>
#include <string>
#include <utility>
#include <vector>

#include "core/result.hpp"
#include "programs/test_piece.hpp"

namespace frustum::programs {

// job.toml as text; `machine` is the machine as the job shall name it: a shipped name, or the path
// of a file.
[[nodiscard]] std::string job_text(const TestPiece& piece, const std::string& machine,
                                   const std::string& plan_file);

// Whether files say by which version of Frustum they were made.
enum class Maker { stated, left_out };

// The files by their names: the job first, the NC program, the plan, the blank where it is a mesh.
[[nodiscard]] std::vector<std::pair<std::string, std::string>> test_piece_files(
    const TestPiece& piece, const std::string& machine, Maker maker = Maker::stated);

// Writes job.toml, the NC program and the plan; returns their paths, the job first.
// With `sheet` as setup.html, where there is one. The files are exchanged as one (file_set.hpp).
[[nodiscard]] Result<std::vector<std::filesystem::path>> write_test_piece(
    const TestPiece& piece, const std::string& machine, const std::filesystem::path& folder,
    const std::string& sheet = {});

}  // namespace frustum::programs

// Where machine files are: beside the job, in the working folder, or shipped with the program.
// Units: none. Errors: a machine that is in none of these places, with the shipped ones that
//        resemble it.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "core/result.hpp"
#include "kinematics/model/machine.hpp"

namespace frustum::app {

// A path (relative to `folder`, else to the working folder), or the name of a shipped machine.
[[nodiscard]] Result<std::filesystem::path> find_machine(const std::string& name,
                                                         const std::filesystem::path& folder);
[[nodiscard]] Result<kinematics::Machine> load_machine(const std::string& name,
                                                       const std::filesystem::path& folder);
// As a job in `folder` shall name a machine file: a shipped one by its name, so that the job can be
// moved; another by its path from there.
[[nodiscard]] std::string name_for_job(const std::filesystem::path& machine_file,
                                       const std::filesystem::path& folder);
// A file's path from a folder, whichever of them is given relative to the working folder.
[[nodiscard]] std::string path_from(const std::filesystem::path& file,
                                    const std::filesystem::path& folder);
// Where shipped machines may be, best first; error files are in errors/ under it.
[[nodiscard]] std::vector<std::filesystem::path> machine_folders();
// The shipped machine files, by name.
[[nodiscard]] std::vector<std::filesystem::path> shipped_machines();

// URI of the folder with the documents (check.md), which ends with /; empty where there are none.
[[nodiscard]] std::string documents_uri();

}  // namespace frustum::app

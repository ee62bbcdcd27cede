// The source tree as the house tests read it: files of a folder, their lines, their includes.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace frustum::house {

struct Include {
  std::string target;   // "kinematics/model/chain.hpp", "Eigen/Core"
  bool quoted = false;  // "..." rather than <...>
  int line = 0;
};

// Where the tests were configured from.
[[nodiscard]] std::filesystem::path source_dir();

// Files under `folder` (relative to the source tree) with one of `extensions`, sorted, as paths
// relative to the source tree. Folders that packages fill (node_modules) and build outputs are
// skipped.
[[nodiscard]] std::vector<std::string> files_of(const std::string& folder,
                                                const std::vector<std::string>& extensions);
[[nodiscard]] std::string text_of(const std::string& file);
[[nodiscard]] std::vector<std::string> lines_of(const std::string& file);
[[nodiscard]] std::vector<Include> includes_of(const std::string& file);

}  // namespace frustum::house

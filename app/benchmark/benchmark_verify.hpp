// Whether what a benchmark has revealed is what it committed to, and makes what it gave.
//
// Units : none
// Errors: answers that cannot be read, a commitment that is missing
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "core/result.hpp"

namespace frustum::app {

struct VerifiedMachine {
  std::string id{};
  bool commitment_holds = false;
  std::vector<std::string> differing{};  // files that the key makes otherwise, or not at all
  [[nodiscard]] bool holds() const { return commitment_holds && differing.empty(); }
};

// Of each machine whose answers are there: all of them, or those named.
[[nodiscard]] Result<std::vector<VerifiedMachine>> verify_benchmark(
    const std::filesystem::path& benchmark, const std::vector<std::string>& only);

}  // namespace frustum::app

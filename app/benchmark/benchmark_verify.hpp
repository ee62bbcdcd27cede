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

// Names of files are those below the benchmark's folder.
struct VerifiedMachine {
  std::string id{};
  bool commitment_holds = false;
  std::vector<std::string> differing{};   // files that the key makes otherwise, or that are missing
  std::vector<std::string> unexpected{};  // files of the machine that the key does not make
  [[nodiscard]] bool holds() const {
    return commitment_holds && differing.empty() && unexpected.empty();
  }
};

struct VerifiedBenchmark {
  std::vector<VerifiedMachine> machines{};
  std::vector<std::string> unexpected{};  // in machines/, prior/, answers/ and of no machine
  [[nodiscard]] bool holds() const;
};

// Of each machine whose answers are there: all of them, or those named, without what is of none.
[[nodiscard]] Result<VerifiedBenchmark> verify_benchmark(const std::filesystem::path& benchmark,
                                                         const std::vector<std::string>& only);

}  // namespace frustum::app

// The scores of a submission to the open blind benchmark.
//
// Reads DIR/answers/mNN.json (true values of points, poses, errors), DIR/prior/mNN.csv (id,sd: the
// standard deviation of the laws at each) and SUBMISSION/mNN/predictions.csv (id,mean_um,sd_um) and
// errors.csv (name,mean,sd,unit), and nothing else but whether SUBMISSION/method.md says how they
// were found.
// Units : um, urad as the files say; errors count in units of the prior's standard deviation
// Errors: an id or name that nobody asked for, one that is there twice, a standard deviation that
//         is not above 0, an unknown unit: each with file, line and column; a folder in
//         DIR/submissions/ without method.md (elsewhere a warning). A row that is missing
//         or not finite is no error: it counts ten times what the prior is expected to
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "core/result.hpp"

namespace frustum::app {

// Means over the rows that were predicted; nothing where there are none.
struct KindScore {
  std::size_t n = 0;        // asked
  std::size_t missing = 0;  // of them not predicted, or not finite
  std::optional<double> skill{}, crps{}, rmse{}, coverage_95{}, interval_score_95{}, log_score{},
      within_2sd{};
};

struct MachineScore {
  std::string id{};
  KindScore points{}, poses{}, errors{};
  Diagnostics notes{};  // rows that count ten times
};

// Of each machine whose answers and submission are there.
[[nodiscard]] Result<std::vector<MachineScore>> score_submission(
    const std::filesystem::path& benchmark, const std::filesystem::path& submission);

[[nodiscard]] std::string score_json(const std::vector<MachineScore>& scores);
[[nodiscard]] std::string score_text(const std::vector<MachineScore>& scores);

}  // namespace frustum::app

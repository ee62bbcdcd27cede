// The draws of a study, computed part by part until all of them are on disk.
//
// Parts are shared among the jobs of an array and the ranks of each: part p is computed by worker
// p mod (jobs x ranks). What is on disk is kept. When the work is interrupted or fails, what was
// computed is on disk as well as it can be, and the study is resumed from there. The samples do not
// depend on how the parts were shared, interrupted or resumed.
// Units  : draws
// Errors : those of the evaluation and of the folder; on another rank
#pragma once

#include <cstdint>
#include <functional>

#include "core/result.hpp"
#include "studies/samples/ranks.hpp"
#include "studies/samples/sample_folder.hpp"

namespace frustum::studies {

// Draws of one evaluation where nothing else is said: a call of it is not interrupted.
inline constexpr std::uint64_t kDrawsPerStep = 1024;

struct Campaign {
  // Draws from `first` on; failed ones are listed in the block.
  std::function<Result<SampleBlock>(std::uint64_t first, std::uint64_t count)> evaluate{};
  std::uint64_t draws_per_step = kDrawsPerStep;
  std::function<bool()> interrupted = [] { return false; };
  std::function<void(std::uint64_t draws)> progress = [](std::uint64_t) {};  // of this rank
  // Draws take so long that each step is worth keeping.
  bool keep_steps = false;
  std::uint64_t job = 0, jobs = 1;  // of an array
};

enum class CampaignEnd { complete, interrupted };

// All draws before `end`, from the first one on.
[[nodiscard]] Result<CampaignEnd> compute(const Campaign& campaign, const SampleFolder& folder,
                                          const Ranks& ranks, std::uint64_t end);

}  // namespace frustum::studies

// Runs a study: its draws shared among ranks and jobs, on disk as they are made, until there are as
// many as are asked for or the stop rules are content.
//
// Units  : draws, seconds
// Errors : those of the folder and of the disk; parts that are missing; on another rank
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "app/study/engine_choice.hpp"
#include "app/study/interruption.hpp"
#include "app/study/sample_columns.hpp"
#include "app/study/sampler.hpp"
#include "studies/samples/campaign.hpp"
#include "studies/samples/ranks.hpp"

namespace frustum::app {

struct StudyWork {
  std::filesystem::path folder{};
  bool resume = false;
  std::uint64_t job = 0, jobs = 1;             // of an array: --part
  std::vector<std::filesystem::path> merge{};  // folders of parts; empty: nothing is merged
};

// How a study goes on, for whoever waits.
struct StudyProgress {
  std::uint64_t done = 0, end = 0;  // draws of this rank
  std::string first{};              // "cone.form median 9.10 (8.95 .. 9.26) um"
};

struct StudyEnd {
  bool interrupted = false;
  std::uint64_t samples = 0;   // on disk, from the first one on
  std::uint64_t computed = 0;  // by this rank, in this run
};

class StudyRun {
 public:
  // All outlive it.
  StudyRun(const StudyFile& study, const StudyModel& model, const ChosenEngine& engine,
           const studies::Ranks& ranks, studies::SampleMark mark)
      : study_(study), model_(model), engine_(engine), ranks_(ranks), mark_(std::move(mark)) {}

  // Seconds that all draws take, as a few of them do.
  [[nodiscard]] Result<double> estimate(const StudyWork& work) const;
  [[nodiscard]] Result<StudyEnd> run(const StudyWork& work, const Interruption& interruption,
                                     const std::function<void(const StudyProgress&)>& progress);
  [[nodiscard]] const studies::SampleFolder& folder() const { return *folder_; }
  [[nodiscard]] Result<SampleColumns> columns(std::uint64_t samples) const;

 private:
  [[nodiscard]] Result<studies::SampleFolder> open(const StudyWork& work) const;
  [[nodiscard]] Result<StudyEnd> merged(const StudyWork& work) const;
  [[nodiscard]] std::uint64_t end_of_all() const;
  [[nodiscard]] Result<bool> is_content(std::uint64_t samples) const;

  const StudyFile& study_;
  const StudyModel& model_;
  const ChosenEngine& engine_;
  const studies::Ranks& ranks_;
  studies::SampleMark mark_;
  std::optional<studies::SampleFolder> folder_{};
};

}  // namespace frustum::app

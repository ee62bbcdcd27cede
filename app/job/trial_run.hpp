// Runs a job's trial with a progress bar and a stop watch.
// Units: seconds. Errors: those of the trial.
#pragma once

#include <string>
#include <vector>

#include "app/job/job.hpp"
#include "report/progress.hpp"
#include "report/run_report.hpp"
#include "trials/trial.hpp"

namespace frustum::app {

// All that a job says of a trial.
[[nodiscard]] trials::TrialOptions trial_options_of(const Job& job);
// The same path, without the limits of the time law where it does not depend on them.
[[nodiscard]] trials::TrialOptions path_options_of(const Job& job);

class TrialRun {
 public:
  explicit TrialRun(report::ProgressStyle style);

  [[nodiscard]] Result<trials::Trial> trial(const Job& job, bool measure = true);
  // Starts a step of its own, ending the one before.
  void begin(const std::string& step);
  void at(double share) { progress_.at(share); }
  void end();
  [[nodiscard]] const std::vector<report::Timing>& timings() const { return timings_; }

 private:
  report::Progress progress_;
  std::vector<report::Timing> timings_;
  std::string step_;
  double started_ = 0.0;
};

}  // namespace frustum::app

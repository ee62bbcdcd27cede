#include "app/job/trial_run.hpp"

#include <chrono>
#include <iostream>

namespace frustum::app {
namespace {

double now() {
  return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

}  // namespace

trials::TrialOptions trial_options_of(const Job& job) {
  trials::TrialOptions options;
  options.path_bound = job.path_bound;
  options.time_law = job.controller.time_law;
  options.servo_lag = job.controller.servo_lag;
  options.dynamic_model = job.dynamic_model;
  options.dynamics = job.controller.dynamics;
  return options;
}

trials::TrialOptions path_options_of(const Job& job) {
  trials::TrialOptions options = trial_options_of(job);
  if (!options.servo_lag && !options.has_dynamics()) options.time_law = {.limits = false};
  return options;
}

TrialRun::TrialRun(report::ProgressStyle style) : progress_(std::cerr, style) {}

Result<trials::Trial> TrialRun::trial(const Job& job, bool measure) {
  trials::TrialOptions options = trial_options_of(job);
  options.measure = measure;
  options.poses_alone = !measure;
  options.on_stage = [this](trials::Stage stage) { begin(std::string(name_of(stage))); };
  auto result = run_trial(job.machine, job.errors, job.piece, job.cmm, options);
  end();
  if (result) return result;
  // What no module could give a place belongs to the job that asked for it.
  Diagnostics problems = result.error();
  for (Diagnostic& d : problems) {
    if (d.file.empty()) d.file = job.file.string();
  }
  return problems;
}

void TrialRun::begin(const std::string& step) {
  end();
  step_ = step;
  started_ = now();
  progress_.begin(step);
}

void TrialRun::end() {
  if (step_.empty()) return;
  timings_.push_back({step_, now() - started_});
  step_.clear();
  progress_.end();
}

}  // namespace frustum::app

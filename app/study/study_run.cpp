#include "app/study/study_run.hpp"

#include <fmt/format.h>
#include <tbb/global_control.h>

#include <algorithm>
#include <chrono>

#include "app/study/study_statistics.hpp"
#include "studies/statistics/summary.hpp"

namespace frustum::app {
namespace {

using studies::CampaignEnd;
using studies::SampleBlock;
using studies::SampleFolder;

double seconds_now() {
  return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

// Draws of so many seconds are worth keeping before their part is whole.
constexpr double kWorthKeeping = 2.0;  // s
constexpr std::size_t kShownDraws = 100'000;
// Stop rules are looked at after 4096 * 2^k draws.
constexpr std::uint64_t kFirstLook = 4096;

// The first characteristic so far, for whoever waits; computed anew as the draws grow by half, as
// long as more of them are seen in its digits.
class FirstStatistic {
 public:
  explicit FirstStatistic(const StudyFile& study) : study_(study) {}

  void add(const SampleBlock& block) {
    if (block.columns.empty() || values_.size() >= kShownDraws) return;
    const auto& more = block.columns.front().values;
    values_.insert(values_.end(), more.begin(), more.end());
    if (values_.size() < told_ + told_ / 2 || values_.size() < 2) return;
    told_ = values_.size();
    std::vector<double> sorted = values_;
    studies::sort_values(sorted);
    const auto interval = studies::quantile_interval(sorted, 0.5);
    const StudyCharacteristic& c = study_.characteristics.front();
    text_ = fmt::format("{} median {:.4g}", c.name, studies::sorted_quantile(sorted, 0.5));
    if (interval.lo && interval.hi) {
      text_ += fmt::format(" ({:.4g} .. {:.4g})", *interval.lo, *interval.hi);
    }
    text_ += " " + c.unit();
  }
  [[nodiscard]] const std::string& text() const { return text_; }

 private:
  const StudyFile& study_;
  std::vector<double> values_{};
  std::size_t told_ = 0;
  std::string text_{};
};

// Draws before `end` that one of all workers computes.
std::uint64_t draws_of_worker(std::uint64_t end, std::uint64_t worker, std::uint64_t workers) {
  std::uint64_t draws = 0;
  for (std::uint64_t part = worker; part * studies::kDrawsPerPart < end; part += workers) {
    draws += std::min(studies::kDrawsPerPart, end - part * studies::kDrawsPerPart);
  }
  return draws;
}

}  // namespace

std::uint64_t StudyRun::end_of_all() const {
  const StudyQuestions& asked = study_.questions;
  return asked.stop.empty() || asked.samples_at_most == 0 ? study_.samples : asked.samples_at_most;
}

Result<double> StudyRun::estimate(const StudyWork& work) const {
  const auto sampler = Sampler::make(study_, model_, engine_.kind);
  if (!sampler) return sampler.error();
  const auto threads =
      tbb::global_control::active_value(tbb::global_control::max_allowed_parallelism);
  // A step of lanes takes milliseconds; of others so many that each thread has two.
  const bool in_lanes = sampler->step() > studies::kDrawsPerStep;
  const std::uint64_t few =
      std::min<std::uint64_t>(in_lanes ? sampler->step() : 2 * threads, end_of_all());
  const double started = seconds_now();
  (void)sampler->sample(0, few);
  const double each = (seconds_now() - started) / static_cast<double>(few);
  const std::uint64_t workers = work.jobs * ranks_.count();
  return each * static_cast<double>(draws_of_worker(end_of_all(), 0, workers));
}

// The first rank makes the folder ready; the others wait for it.
Result<SampleFolder> StudyRun::open(const StudyWork& work) const {
  if (!ranks_.is_first()) {
    if (ranks_.sum(0) > 0) return error("other-rank"_id, "the first rank has failed");
    return SampleFolder::opened(work.folder, mark_);
  }
  auto opened = SampleFolder::open(work.folder, mark_, work.resume);
  if (opened) {
    // Results of samples that are about to change are results of nothing.
    std::error_code none;
    for (const char* stale : {"result.json", "report.html", "run.json"}) {
      std::filesystem::remove(work.folder / stale, none);
    }
  }
  (void)ranks_.sum(opened ? 0 : 1);
  return opened;
}

Result<SampleColumns> StudyRun::columns(std::uint64_t samples) const {
  return read_columns(*folder_, samples, [](const std::string& name) {
    return name.starts_with(kCharacteristics) || name == kLargestMove;
  });
}

Result<bool> StudyRun::is_content(std::uint64_t samples) const {
  const auto scheme = scheme_of(study_, model_);
  if (!scheme) return scheme.error();
  const auto so_far = columns(samples);
  if (!so_far) return so_far.error();
  return std::ranges::all_of(stop_states(study_, *scheme, *so_far), &StopState::reached);
}

Result<StudyEnd> StudyRun::merged(const StudyWork& work) const {
  const auto draws = folder_->merge(work.merge);
  if (!draws) return draws.error();
  const std::uint64_t end = end_of_all();
  if (study_.questions.stop.empty() && *draws < end) {
    return error("samples-missing"_id, fmt::format("the folders hold {} of {} draws", *draws, end),
                 "merge the folders of all parts, each run to its end, or ask for fewer --samples");
  }
  const auto kept = folder_->end_at(std::min(end, *draws));
  if (!kept) return kept.error();
  return StudyEnd{.samples = *kept};
}

Result<StudyEnd> StudyRun::run(const StudyWork& work, const Interruption& interruption,
                               const std::function<void(const StudyProgress&)>& progress) {
  auto opened = open(work);
  if (!opened) return std::move(opened).error();
  folder_ = *std::move(opened);
  if (!work.merge.empty()) return merged(work);
  const auto sampler = Sampler::make(study_, model_, engine_.kind);
  if (!sampler) return sampler.error();

  StudyEnd result;
  StudyProgress state{.end =
                          draws_of_worker(end_of_all(), work.job * ranks_.count() + ranks_.rank(),
                                          work.jobs * ranks_.count())};
  FirstStatistic first(study_);
  double kept = seconds_now();
  studies::Campaign campaign;
  campaign.job = work.job;
  campaign.jobs = work.jobs;
  campaign.draws_per_step = sampler->step();
  campaign.interrupted = [&] { return interruption.has_come(); };
  campaign.evaluate = [&](std::uint64_t begin, std::uint64_t count) -> Result<SampleBlock> {
    SampleBlock block = sampler->sample(begin, count);
    campaign.keep_steps = seconds_now() - kept > kWorthKeeping;
    if (campaign.keep_steps) kept = seconds_now();
    first.add(block);
    result.computed += count;
    return block;
  };
  campaign.progress = [&](std::uint64_t draws) {
    state.done += draws;
    state.first = first.text();
    progress(state);
  };
  const bool has_stop = !study_.questions.stop.empty();
  for (std::uint64_t look = has_stop ? kFirstLook : end_of_all();; look *= 2) {
    const std::uint64_t end = std::min(look, end_of_all());
    state.done = 0;  // draws of earlier looks are told of again
    const auto computed = studies::compute(campaign, *folder_, ranks_, end);
    if (!computed) return computed.error();
    result.samples = end;
    result.interrupted = *computed == CampaignEnd::interrupted;
    if (result.interrupted || end == end_of_all()) break;
    if (!has_stop) break;
    // The first rank decides for all.
    std::uint64_t decision = 0;  // 0: go on, 1: content, 2: failed
    Diagnostics failure;
    if (ranks_.is_first()) {
      const auto content = is_content(end);
      if (!content) failure = content.error();
      decision = !content ? 2 : *content ? 1 : 0;
    }
    decision = ranks_.from_first(decision);
    if (decision == 2)
      return failure.empty() ? Diagnostics{error("the first rank has failed")} : failure;
    if (decision == 1) break;
  }
  if (!result.interrupted && work.jobs == 1 && ranks_.is_first()) {
    const auto ended = folder_->end_at(result.samples);
    if (!ended) return ended.error();
  }
  return result;
}

}  // namespace frustum::app

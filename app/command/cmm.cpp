// frustum cmm: the acceptance test of a job's virtual CMM, on one machine or on many of its kind.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iostream>
#include <memory>

#include "app/command/command_line.hpp"
#include "app/command/commands.hpp"
#include "app/job/job.hpp"
#include "app/view/console.hpp"
#include "metrology/probing/acceptance_test.hpp"

namespace frustum::app {
namespace {

using metrology::AcceptanceReport;
using metrology::CmmModel;

struct CmmOptions {
  std::string job{};
  std::uint64_t seeds = 1;
};

int test_one(const CmmModel& cmm) {
  const AcceptanceReport report = metrology::acceptance_test(cmm);
  std::cout << metrology::to_text(report);
  return report.passes() ? kDone : kOutOfTolerance;
}

int test_many(CmmModel cmm, std::uint64_t seeds) {
  std::vector<double> shares;
  std::vector<std::uint64_t> failed;
  std::size_t failed_on_sphere = 0;
  for (std::uint64_t i = 0; i < seeds; ++i, ++cmm.seed) {
    const AcceptanceReport report = metrology::acceptance_test(cmm);
    shares.push_back(report.worst_length_share());
    if (!report.passes()) failed.push_back(cmm.seed);
    if (!report.probing_passes()) ++failed_on_sphere;
  }
  std::ranges::sort(shares);
  const auto percent = [](double share) {
    return std::isfinite(share) ? fmt::format("{:.0f} %", 100.0 * share)
                                : std::string("more than any share (the limit is 0)");
  };
  std::cout << fmt::format(
      "{} machines: {} passed; of its limit the worst of 105 lengths uses {} on the best machine, "
      "{} on the median one, {} on the worst\n",
      seeds, seeds - failed.size(), percent(shares.front()), percent(shares[shares.size() / 2]),
      percent(shares.back()));
  if (failed.empty()) return kDone;
  std::cout << fmt::format(
      "{} failed on the sphere of 25 points; the first that failed has seed {}\n", failed_on_sphere,
      failed.front());
  return kOutOfTolerance;
}

int test(const CmmOptions& options) {
  const auto job = load_job(options.job, {}, false);
  if (!job) return refuse(job.error());
  return options.seeds == 1 ? test_one(job->cmm) : test_many(job->cmm, options.seeds);
}

}  // namespace

void add_cmm(Command& program) {
  auto options = std::make_shared<CmmOptions>();
  Command command = program.command(
      "cmm", "Run the acceptance test of ISO 10360-2 and -5 on a job's virtual CMM");
  command.option("job", options->job, "Job file with inspection.cmm").required();
  command
      .option("--seeds", options->seeds, "Number of CMMs to simulate, from the job's seed on (1)")
      .within(std::uint64_t{1}, std::uint64_t{100000});
  command.footer("Example: frustum cmm job.toml --seeds 200");
  command.runs([options] { return test(*options); });
}

}  // namespace frustum::app

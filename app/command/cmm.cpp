// frustum cmm: the acceptance test of a job's virtual CMM, on one machine or on many of its kind.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iostream>
#include <memory>
#include <nlohmann/json.hpp>

#include "app/command/command_line.hpp"
#include "app/command/commands.hpp"
#include "app/job/job.hpp"
#include "app/view/console.hpp"
#include "core/program_version.hpp"
#include "metrology/probing/acceptance_test.hpp"

namespace frustum::app {
namespace {

using metrology::AcceptanceReport;
using metrology::CmmModel;

struct CmmOptions : AnswerOptions {
  std::string job{};
  std::uint64_t seeds = 1;
};

int test_one(const CmmOptions& options, const CmmModel& cmm) {
  const AcceptanceReport report = metrology::acceptance_test(cmm);
  if (options.json) {
    // Infinite where the limit is 0: JSON has no number for it.
    const double share = report.worst_length_share();
    nlohmann::ordered_json doc{{"schema", "frustum/cmm/1"},
                               {"version", program_version()},
                               {"passes", report.passes()},
                               {"worst_length_share", nullptr},
                               {"probing_form_um", report.probing_form * kUmPerMm},
                               {"probing_size_um", report.probing_size * kUmPerMm},
                               {"probing_limit_um", report.probing_limit * kUmPerMm},
                               {"lengths", nlohmann::ordered_json::array()}};
    if (std::isfinite(share)) doc["worst_length_share"] = share;
    for (const metrology::TestedLength& each : report.lengths) {
      const Vec3& d = each.direction;
      doc["lengths"].push_back({{"direction", {d.x(), d.y(), d.z()}},
                                {"length_mm", each.length},
                                {"repetition", each.repetition},
                                {"error_um", each.error * kUmPerMm},
                                {"limit_um", each.limit * kUmPerMm}});
    }
    std::cout << doc.dump(2) << '\n';
  } else if (!options.quiet) {
    std::cout << metrology::to_text(report);
  }
  return report.passes() ? kDone : kOutOfTolerance;
}

struct SeriesResult {
  std::vector<double> shares{};  // of the limit that the worst length of each machine uses; rising
  std::vector<std::uint64_t> failed{};  // seeds
  std::uint64_t failed_on_sphere = 0;
};

SeriesResult test_series(CmmModel cmm, std::uint64_t seeds, report::Progress& progress) {
  SeriesResult result;
  for (std::uint64_t i = 0; i < seeds; ++i, ++cmm.seed) {
    progress.at(static_cast<double>(i) / static_cast<double>(seeds));
    const AcceptanceReport report = metrology::acceptance_test(cmm);
    result.shares.push_back(report.worst_length_share());
    if (!report.passes()) result.failed.push_back(cmm.seed);
    if (!report.probing_passes()) ++result.failed_on_sphere;
  }
  std::ranges::sort(result.shares);
  return result;
}

int test_many(const CmmOptions& options, const CmmModel& cmm) {
  const auto [shares, failed, failed_on_sphere] = with_progress(
      options, "test machines",
      [&](report::Progress& progress) { return test_series(cmm, options.seeds, progress); });
  const double median = shares[shares.size() / 2];
  if (options.json) {
    const auto number = [](double share) {
      return std::isfinite(share) ? nlohmann::ordered_json(share) : nlohmann::ordered_json();
    };
    const nlohmann::ordered_json doc{{"schema", "frustum/cmm-series/1"},
                                     {"version", program_version()},
                                     {"machines", options.seeds},
                                     {"passed", options.seeds - failed.size()},
                                     {"worst_length_share",
                                      {{"best", number(shares.front())},
                                       {"median", number(median)},
                                       {"worst", number(shares.back())}}},
                                     {"failed_on_sphere", failed_on_sphere},
                                     {"failed_seeds", failed}};
    std::cout << doc.dump(2) << '\n';
  } else if (!options.quiet) {
    const auto percent = [](double share) {
      return std::isfinite(share) ? fmt::format("{:.0f} %", 100.0 * share)
                                  : std::string("more than any share (the limit is 0)");
    };
    std::cout << fmt::format(
        "{} machines: {} passed; of its limit the worst of 105 lengths uses {} on the best "
        "machine, {} on the median one, {} on the worst\n",
        options.seeds, options.seeds - failed.size(), percent(shares.front()), percent(median),
        percent(shares.back()));
    if (!failed.empty()) {
      std::cout << fmt::format(
          "{} failed on the sphere of 25 points; the first that failed has seed {}\n",
          failed_on_sphere, failed.front());
    }
  }
  return failed.empty() ? kDone : kOutOfTolerance;
}

int test(const CmmOptions& options) {
  const auto job = load_job(options.job, {}, false);
  if (!job) return refuse(job.error(), options);
  return options.seeds == 1 ? test_one(options, job->cmm) : test_many(options, job->cmm);
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
  add_answer_options(command, *options);
  command.footer("Example: frustum cmm job.toml --seeds 200");
  command.computes([options] { return test(*options); });
}

}  // namespace frustum::app

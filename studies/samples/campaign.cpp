#include "studies/samples/campaign.hpp"

#include <algorithm>
#include <optional>
#include <utility>

namespace frustum::studies {
namespace {

std::uint64_t end_of(std::uint64_t part, std::uint64_t end) {
  return std::min(end, (part + 1) * kDrawsPerPart);
}

Result<CampaignEnd> compute_part(const Campaign& campaign, const SampleFolder& folder,
                                 std::uint64_t part, std::uint64_t end) {
  if (part * kDrawsPerPart + folder.draws_of(part) >= end) return CampaignEnd::complete;
  SampleBlock block = folder.read(part).value_or(SampleBlock{part * kDrawsPerPart});
  campaign.progress(block.count);
  std::uint64_t kept = block.first_draw + block.count;
  const auto keep = [&]() -> Result<CampaignEnd> {
    const std::uint64_t next = block.first_draw + block.count;
    if (next == kept) return CampaignEnd::interrupted;
    const auto written = folder.write_piece(from(block, kept));
    if (!written) return written.error();
    kept = next;
    return CampaignEnd::interrupted;
  };
  for (std::uint64_t next = kept; next < end; next = block.first_draw + block.count) {
    if (campaign.interrupted()) return keep();
    auto step = campaign.evaluate(next, std::min(campaign.draws_per_step, end - next));
    if (!step) return step.error();
    append(block, *step);
    campaign.progress(step->count);
    if (!campaign.keep_steps) continue;
    if (const auto written = keep(); !written) return written.error();
  }
  const auto written = folder.write(block);
  if (!written) return written.error();
  return CampaignEnd::complete;
}

}  // namespace

Result<CampaignEnd> compute(const Campaign& campaign, const SampleFolder& folder,
                            const Ranks& ranks, std::uint64_t end) {
  const std::uint64_t workers = campaign.jobs * ranks.count();
  std::optional<Diagnostics> failure;
  bool interrupted = false;
  for (std::uint64_t part = campaign.job * ranks.count() + ranks.rank();
       part * kDrawsPerPart < end && !failure && !interrupted; part += workers) {
    const auto done = compute_part(campaign, folder, part, end_of(part, end));
    if (!done) failure = done.error();
    interrupted = done && *done == CampaignEnd::interrupted;
  }
  // Every rank comes here, whatever has happened to it: nobody waits for one that is gone.
  const std::uint64_t failures = ranks.sum(failure ? 1 : 0);
  const std::uint64_t interruptions = ranks.sum(interrupted ? 1 : 0);
  if (failure) return *std::move(failure);
  if (failures > 0) {
    return error("other-rank"_id, "another rank has failed", "see what it printed");
  }
  return interruptions > 0 ? CampaignEnd::interrupted : CampaignEnd::complete;
}

}  // namespace frustum::studies

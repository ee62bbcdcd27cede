#include "lint/checked_file.hpp"

#include <algorithm>

namespace frustum::lint {

FindingCounts counts_of(std::span<const CheckedFile> files) {
  FindingCounts counts;
  for (const CheckedFile& file : files) {
    const CheckReport& report = file.report;
    counts.errors += report.count(Severity::error);
    counts.warnings += report.count(Severity::warning);
    counts.notes += report.count(Severity::note);
    counts.suppressed +=
        static_cast<std::size_t>(std::ranges::count_if(report.findings, [](const Finding& finding) {
          return finding.suppressed != Suppressed::no;
        }));
    counts.blocks += report.blocks;
  }
  return counts;
}

}  // namespace frustum::lint

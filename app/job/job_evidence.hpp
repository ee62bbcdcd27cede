// What a job's result is evidence of: whose part, measured how, made from which files.
//
// Units : none
// Errors: a file that can no longer be read
#pragma once

#include <string>
#include <string_view>

#include "app/job/job.hpp"
#include "report/evidence.hpp"
#include "trials/trial.hpp"

namespace frustum::app {

// What the job states of part and CMM, and the fingerprints of its files as they are now: to be
// taken before the long work. The job, what it names, the error files of the command line and the
// machine, and what those name in turn.
[[nodiscard]] Result<report::Evidence> evidence_of(const Job& job);
// The files that its program has opened, after the program's own.
void add_subprograms(report::Evidence& evidence, const trials::Trial& trial);

// A pipe, which cannot be read once more, is left out.
[[nodiscard]] Diagnostics add_hash(std::vector<report::HashedFile>& files, const std::string& role,
                                   const std::filesystem::path& file);
// The files that the text of a document names, and what those name in turn.
[[nodiscard]] Diagnostics add_named_hashes(std::vector<report::HashedFile>& files,
                                           std::string_view text,
                                           const std::filesystem::path& document);

}  // namespace frustum::app

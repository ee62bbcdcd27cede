// One text as a file of one kind, whatever its bytes: what the fuzzers try and the seeds repeat.
//
// Units : none
// Errors: std::runtime_error that says which promise was broken: a failure without file, place or
//         message; a value that is not finite in what was accepted; what was written is not read
//         back as the same
#pragma once

#include <string_view>

namespace frustum::fuzz {

// An inspection plan, which is written and read again when it is accepted.
void run_one_plan(std::string_view text);
void run_one_machine(std::string_view text);
// A job, in a folder of the process with the files of tests/fuzz/job/beside.
void run_one_job(std::string_view text);
// Measured points, without a unit of the caller's and in inches; what begins as PLY is read as
// such, too.
void run_one_points(std::string_view text);

}  // namespace frustum::fuzz

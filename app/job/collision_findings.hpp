// Where a program of a job cuts with what must not cut: rapids through material, shanks and holders
// in it; and where bodies of machine, fixtures and tools meet.
//
// Units : mm
// Errors: those of the trial: a program that cannot be run on the job
#pragma once

#include <vector>

#include "app/job/job.hpp"
#include "core/result.hpp"
#include "lint/finding_list.hpp"

namespace frustum::app {

// Of the job's program, by the machine as it should be, without its errors.
[[nodiscard]] Result<std::vector<lint::Finding>> collisions_of(const Job& job);

}  // namespace frustum::app

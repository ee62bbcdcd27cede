// Where a program of a job cuts with what must not cut: rapids through material, shanks and holders
// in it.
//
// Units : mm
// Errors: those of the trial: a program that cannot be run on the job
#pragma once

#include <string>
#include <vector>

#include "app/job/job.hpp"
#include "core/result.hpp"
#include "lint/finding_list.hpp"
#include "parser/program.hpp"

namespace frustum::app {

// Of this program in place of the job's, by the machine as it should be, without its errors.
[[nodiscard]] Result<std::vector<lint::Finding>> collisions_of(Job job, std::string program,
                                                               const std::string& file,
                                                               parser::Dialect dialect);

}  // namespace frustum::app

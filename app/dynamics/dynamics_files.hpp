// The files of frustum dynamics: page, responses for spreadsheets and modal-test programs, map.
//
// Units  : as the headings say: mm, deg, Hz, um/N, um/gn
// Errors : none; those of writing are FileSet's
#pragma once

#include <span>
#include <string>
#include <vector>

#include "app/dynamics/dynamics_answer.hpp"
#include "core/file_set.hpp"
#include "dynamics/response_files.hpp"

namespace frustum::app {

// All that such a folder may hold.
[[nodiscard]] std::vector<std::string> dynamics_file_names();

// `measured` is drawn beside what is computed.
void add_dynamics_files(FileSet& files, const kinematics::Machine& machine,
                        const dynamics::DynamicModel& model, const DynamicsRequest& request,
                        const DynamicsAnswer& answer,
                        std::span<const dynamics::FrequencyResponse> measured);

}  // namespace frustum::app

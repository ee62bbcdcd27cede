// A job file: machine, program, blank, tools, errors, inspection.
//
// Units: as people write them (mm, degrees, "10 um"); inside mm and rad. Paths are relative to the
//        file.
// Errors: every misspelt or missing key, wrong unit and unreadable file at once, with file, line
//         and key.
#pragma once

#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "app/job/controller_settings.hpp"
#include "app/job/error_sources.hpp"
#include "core/result.hpp"
#include "kinematics/errors/error_assignment.hpp"
#include "kinematics/model/geometric_errors.hpp"
#include "kinematics/model/machine.hpp"
#include "metrology/cmm.hpp"
#include "programs/test_piece.hpp"
#include "stock/solid/facet_solid.hpp"

namespace frustum::app {

struct Job {
  kinematics::Machine machine;
  std::filesystem::path file{};
  std::string text{};  // of the file
  std::filesystem::path machine_file{};
  std::filesystem::path plan_file{};  // empty: none
  std::string plan_text{};
  programs::TestPiece piece{};
  std::vector<kinematics::ErrorEntry> errors{};
  std::vector<std::filesystem::path> error_files{};  // of the command line
  std::optional<ErrorDraw> draw{};                   // that the errors are
  // A shape that surfaces are compared with instead of the plan's; null: none.
  std::shared_ptr<const stock::FacetSolid> nominal{};
  metrology::CmmModel cmm{};
  ControllerSettings controller{};
  std::shared_ptr<const dynamics::DynamicModel> dynamic_model{};  // null: not asked for
  double path_bound = 1e-5;                                       // mm
  double mesh_pitch = 0.0;  // mm; 0: chosen by the size of the blank
  bool report = true;
  std::vector<std::filesystem::path> exports{};  // results in other formats
};

// What the command line may change in a job.
struct JobOverrides {
  ErrorWords errors{};
  std::optional<std::string> tool_radius_error{};
  bool undrawn = false;  // errors stay the distributions that they are written as

  [[nodiscard]] bool any() const {
    return !errors.files.empty() || !errors.errors.empty() || errors.draw || tool_radius_error;
  }
};

// `want_plan`: a job without [inspection] is an error.
[[nodiscard]] Result<Job> load_job(const std::filesystem::path& file, const JobOverrides& overrides,
                                   bool want_plan);

}  // namespace frustum::app

// A study file: parts that were cut and measured, motion tests that were measured, what is to be
// found, what is known.
//
// Units: as people write them ("-24.6 um", "30 urad", "-0.0034 deg"); inside mm and rad. Paths are
// relative to the file.
// Errors: every misspelt or missing key, unknown characteristic or error name, wrong unit and
// unreadable file at once, with file, line and key.
#pragma once

#include <filesystem>
#include <functional>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "app/job/job.hpp"
#include "calibration/design/test_design.hpp"
#include "calibration/identify/motion_observations.hpp"
#include "calibration/identify/piece_observations.hpp"
#include "core/result.hpp"
#include "core/toml_document.hpp"
#include "metrology/cmm.hpp"

namespace frustum::app {

using calibration::MeasuredPart;
using calibration::MeasuredValue;

// Workpieces of one kind: cut by one job, measured once or several times.
struct StudyPart {
  std::string name{};
  Job job;
  std::vector<MeasuredPart> measured{};
  // What a design counts with.
  calibration::PlannedRows rows = calibration::PlannedRows::characteristics;
  std::optional<double> hours{};
};

struct KnownError {
  std::string name{};
  double value = 0.0;
  double uncertainty = 0.0;  // standard; 0: exact
};

// Somebody else's estimate, to be printed beside ours.
struct OtherEstimate {
  std::string name{};
  std::map<std::string, double> values{};  // by error name
};

enum class ToolRadius { common, each, exact };     // one for all parts; one a part; as the jobs say
enum class RecipeChoice { none, case_1, case_2 };  // of the step patterns' paper

// A motion test on a machine, as a table [[motion]] of the file says.
struct StudyMotion {
  kinematics::Machine machine;
  calibration::MeasuredMotion motion{};
  std::optional<double> hours{};  // that a design counts with
};
// Reads such a table: it is known in a folder above this one. Nothing where the table itself is
// wrong, which stays noted in its document.
using MotionReader = std::function<Result<std::optional<StudyMotion>>(const TomlTable&)>;

struct Study {
  std::string title{};
  std::filesystem::path file{};
  std::vector<StudyPart> parts{};  // parts and tests: at least one, all on the same machine
  std::vector<calibration::MeasuredMotion> motions{};
  std::vector<std::optional<double>> motion_hours{};  // of each, where it is stated
  calibration::WorkingTimes times{};
  std::vector<std::string> unknowns{};
  std::vector<KnownError> known{};
  ToolRadius tool_radius = ToolRadius::common;
  std::optional<metrology::CmmModel> cmm{};
  double floor_length = 0.0;  // mm: added in quadrature to every measured length
  double floor_angle = 0.0;   // rad
  bool refine = true;
  RecipeChoice recipe = RecipeChoice::none;
  std::vector<OtherEstimate> others{};

  std::optional<kinematics::Machine> on{};
  [[nodiscard]] const kinematics::Machine& machine() const { return *on; }
};

// `planned`: parts may be without measured values, which then are those of the plan.
[[nodiscard]] Result<Study> load_study(const std::filesystem::path& file,
                                       const MotionReader& read_motion = {}, bool planned = false);

}  // namespace frustum::app

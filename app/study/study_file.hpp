// A study file: for which job or test machines are drawn, how many, and what is asked of them.
//
// Units  : as people write them ("10 um", "30 urad"); inside mm and rad, limits in the units of
//          samples (um, urad). Paths are relative to the file
// Errors : every misspelt or missing key, unknown name, wrong unit and unreadable file at once,
//          with file, line, key, and the nearest known name
#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "app/job/error_sources.hpp"
#include "app/job/job.hpp"
#include "app/motion/drawn_test.hpp"
#include "app/study/study_characteristic.hpp"
#include "core/result.hpp"
#include "studies/answers/shares.hpp"
#include "studies/engine/engine_controls.hpp"
#include "studies/laws/factors.hpp"
#include "studies/laws/scheme.hpp"
#include "studies/statistics/conformity_risk.hpp"

namespace frustum::app {

// What the command line may change; later words win.
struct StudyWords {
  std::optional<std::uint64_t> samples{};
  std::optional<std::uint64_t> seed{};
  std::string scheme{};
  std::string engine{};
  std::vector<std::string> stop{};  // "cone.equivalent_form q50=0.05um"
  ErrorWords errors{};
};

// One pose of a machine, where the error of the tip is asked for.
struct VolumetricTarget {
  kinematics::Machine machine;
  std::filesystem::path machine_file{};
  std::string axes{};  // as written
  kinematics::AxisPositions at{};
  double tool_length = 0.0;  // mm
};

// A motion test that every machine runs.
struct MotionTarget {
  std::filesystem::path file{}, machine_file{};
  kinematics::ErrorList errors{};  // of the test file, where the study has none
  std::shared_ptr<const MotionSetup> setup{};
  DrawnTest test{};  // refers to the set-up
};

struct StudyMeasurement {
  bool noise = false;         // each draw is measured by the job's CMM, the test's instrument
  std::optional<double> u{};  // um: standard uncertainty of lengths; absent: what the CMM gives
};

struct AllocationRequest {
  std::string characteristic{};
  double probability = 0.95;
  std::map<std::string, double> cost{};  // by group; 1 where it is not said
};

// Set-ups of a cone to compare.
struct MapRequest {
  std::vector<double> cone_angle_deg{};
  std::vector<double> inclination_deg{};
  std::vector<std::vector<double>> center_mm{};
};

// What is asked of the samples.
struct StudyQuestions {
  double at_least = 0.0;              // of each P(conform); 0: not asked
  std::vector<StopRule> stop{};       // all of them
  std::uint64_t samples_at_most = 0;  // with stop rules; 0: the number of samples
  std::vector<studies::DecisionRule> rules{};
  bool shares = false;
  std::map<std::string, std::vector<std::string>> groups{};  // empty: each error by itself
  std::string share_characteristic{};                        // empty: the first one
  std::optional<AllocationRequest> allocation{};
  std::optional<MapRequest> map{};
};

struct StudyFile {
  std::string title{};
  std::filesystem::path file{};
  std::optional<Job> job{};  // one of the three
  std::optional<VolumetricTarget> volumetric{};
  std::optional<MotionTarget> motion{};
  std::uint64_t samples = 10'000;
  std::uint64_t seed = 1;
  studies::SchemeKind scheme = studies::SchemeKind::random;
  studies::EngineKind engine = studies::EngineKind::automatic;
  bool keep_amounts = false;
  bool keep_points = false;
  std::vector<kinematics::ErrorEntry> errors{};      // as written: laws, and what is not drawn
  std::vector<std::filesystem::path> error_files{};  // of the command line
  kinematics::ToleranceReading read_as = kinematics::ToleranceReading::uniform;
  std::vector<studies::ScaleRule> scale{};
  std::vector<studies::CorrelatedGroup> correlated{};
  std::vector<StudyCharacteristic> characteristics{};  // with their limits
  StudyMeasurement measurement{};
  StudyQuestions questions{};

  [[nodiscard]] const kinematics::Machine& machine() const {
    return job ? job->machine : volumetric ? volumetric->machine : motion->setup->machine;
  }
};

// A study, or a job alone, which is a study with the defaults.
[[nodiscard]] Result<StudyFile> load_study_file(const std::filesystem::path& file,
                                                const StudyWords& words);

class StudyModel;
// SHA-256 of everything that the samples and what is asked of them depend on: the study as it was
// read, without title, number of samples and stop rules, and every file that it reads.
// `engine`: the one that makes the samples.
[[nodiscard]] Result<std::string> fingerprint_of(const StudyFile& study, const StudyModel& model,
                                                 studies::EngineKind engine);

}  // namespace frustum::app

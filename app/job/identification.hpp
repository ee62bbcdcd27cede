// From a study file to identified machine errors: what `frustum identify` does before it prints.
//
// Units: mm, rad.
// Errors: those of the trials and of the identification.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "app/job/study.hpp"
#include "calibration/design/step_catalogue.hpp"
#include "calibration/design/step_recipes.hpp"
#include "calibration/identify/identification.hpp"
#include "calibration/identify/information.hpp"
#include "calibration/identify/motion_observations.hpp"
#include "calibration/identify/observability.hpp"

namespace frustum::app {

// Step patterns that would identify what the measurements do not.
struct Remedy {
  std::vector<std::string> patterns{};  // the fewest that do; empty: all together do not
  std::vector<std::string> unreachable{};
};

struct StudyResult {
  calibration::Identification identification{};
  std::size_t asked = 0;  // of its estimates: those that the study lists; others are of set-ups
  std::vector<calibration::FoundMounting> mountings{};  // of the motion tests, one by one
  std::vector<double> changes{};  // of each round of refinement, in standard uncertainties
  calibration::InformationShares shares{};
  std::vector<std::string> left_out{};  // measured, but without a derivative
  std::optional<Remedy> remedy{};
  // The published recipe as printed, and with its equations (12) and (20) put right.
  std::optional<calibration::Recipe> recipe{}, corrected_recipe{};
};

// Whether every error that was asked for has a value.
[[nodiscard]] bool is_answered(const StudyResult& result);

[[nodiscard]] Result<StudyResult> identify_study(const Study& study);

// Unknowns and causes of a study or a design, one by one.
struct UnknownCauses {
  std::vector<calibration::Unknown> unknowns{};
  std::vector<calibration::Cause> causes{};
};
// Radius errors of tools beside them, as the study says.
void add_tool_radius(const Study& study, UnknownCauses& all);
// The parts as they were cut, or will be.
[[nodiscard]] Result<std::vector<calibration::MeasuredPiece>> pieces_of(const Study& study);
// What a virtual CMM of a laboratory would be when nobody states one.
[[nodiscard]] metrology::CmmModel ordinary_cmm();
[[nodiscard]] Result<UnknownCauses> unknown_causes(const kinematics::Machine& machine,
                                                   const std::vector<std::string>& names,
                                                   const std::vector<KnownError>& known);

}  // namespace frustum::app

// Which step patterns to cut on a machine so that its errors can be identified.
//
// Model    : design() over the patterns within travel (step_catalogue.hpp). Sets without pattern 3
//            may have pattern 4 in its place on workpiece 2; sets with both need a third workpiece
// Units    : mm, rad
// Shape    : every subset of the patterns
// Errors   : those of step_catalogue() and design(); patterns that do not exist or are out of
//            travel
// Accuracy : exhaustive
// Source   : ours; the criteria: design.hpp
#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "calibration/design/step_catalogue.hpp"

namespace frustum::calibration {

struct StepDesignOptions {
  DesignCriterion criterion = DesignCriterion::d_optimal;
  std::vector<std::string> among{};        // empty: all within travel
  std::vector<std::string> required{};     // in every set
  std::map<std::string, double> limits{};  // largest standard deviation wanted, by unknown
  // Leave out unknowns that all patterns together do not separate from those before them.
  bool leave_out_dependent = false;
};

// A set of patterns and what it would identify.
struct StepChoice {
  std::vector<std::string> patterns{};
  std::size_t workpieces = 0;
  DesignChoice choice{};  // `blocks` are places in StepDesign::patterns
};

struct StepDesign {
  std::vector<Unknown> unknowns{};
  std::vector<std::string> left_out{};  // unknowns
  std::vector<std::string> patterns{};  // to choose from
  std::vector<UnreachablePattern> unreachable{};
  int free_unknowns = 0;
  std::vector<StepChoice> best_of_size{};
  std::vector<std::size_t> identifying_sets{};  // of each of those sizes
  std::optional<StepChoice> smallest{};         // that identifies all within the limits
  std::vector<std::vector<std::string>> smallest_identifying{};
  std::vector<NullDirection> null_space{};  // of all patterns together
};

[[nodiscard]] Result<StepDesign> step_design(
    const kinematics::Machine& machine, std::vector<Unknown> unknowns, std::vector<Cause> causes,
    const metrology::CmmModel& cmm, const CatalogueSetup& setup, const StepDesignOptions& options);

}  // namespace frustum::calibration

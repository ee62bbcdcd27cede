// Every step pattern that a machine can cut, as something that could be measured.
//
// Model    : workpiece 1 with its patterns and workpiece 2 with its own; pattern 4 cuts the
//            surfaces of 3 and takes its place on workpiece 2, or another workpiece 2 to itself.
//            Gains are those of trials::sensitivity(), covariances those of the measuring machine
// Units    : mm, rad
// Shape    : one block a pattern; rows: its characteristics; columns: the unknowns
// Errors   : a machine on which no pattern can be cut, with the reasons; tools or sizes that no
//            machine could cut with; those of the trials
// Accuracy : that of trials::sensitivity() and metrology::covariance()
// Source   : Ibaraki et al. 2010, sections 3 and 4
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "calibration/design/design.hpp"
#include "calibration/identify/trial_model.hpp"
#include "metrology/cmm.hpp"
#include "programs/step/step_pattern.hpp"

namespace frustum::calibration {

// How the workpieces are placed on the table; tools, feeds and limits as StepTest has them.
struct CatalogueSetup {
  double raise = 0.0;  // mm, added to all heights
  // Of the centres of both workpieces, mm; absent: as published.
  std::optional<std::pair<double, double>> centre{};
  programs::StepTest test{};  // workpiece and patterns are not used
};

enum class Pattern4 : std::uint8_t {
  on_its_own,         // a third workpiece, beside pattern 3 on the second
  in_the_place_of_3,  // no pattern 3
};

struct UnreachablePattern {
  std::string pattern{};
  std::string reason{};
};

struct StepCatalogue {
  Observations observations{};  // values are 0
  std::vector<DesignBlock> patterns{};
  std::vector<int> workpiece{};  // of each pattern: 1, 2, or 3 for the second workpiece 2
  std::vector<UnreachablePattern> unreachable{};

  // Of one pattern, to be cut beside what was measured already.
  [[nodiscard]] Candidate candidate(std::size_t pattern) const;
};

[[nodiscard]] Result<StepCatalogue> step_catalogue(const kinematics::Machine& machine,
                                                   std::vector<Unknown> unknowns,
                                                   const std::vector<Cause>& causes,
                                                   const metrology::CmmModel& cmm,
                                                   const CatalogueSetup& setup = {},
                                                   Pattern4 pattern_4 = Pattern4::on_its_own);

}  // namespace frustum::calibration

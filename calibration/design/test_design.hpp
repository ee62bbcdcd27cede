// Which motion tests to run on a machine so that its errors can be identified.
//
// Model    : design() over the tests of a study, each a block of its rows. The offset of the ball
//            in the spindle is known to `ball`, one standard deviation, beforehand: without that no
//            set of tests on a table would identify the position of its first axis
// Units    : mm, rad
// Shape    : every subset of at most kMostBlocks tests
// Errors   : those of observations_of() and design(); a test that is required and not there
// Accuracy : exhaustive
// Source   : design.hpp
#pragma once

#include <map>
#include <string>
#include <vector>

#include "calibration/design/design.hpp"
#include "calibration/identify/motion_observations.hpp"

namespace frustum::calibration {

struct TestDesignOptions {
  DesignCriterion criterion = DesignCriterion::d_optimal;
  std::vector<std::string> required{};     // in every set
  std::map<std::string, double> limits{};  // largest standard deviation wanted, by unknown
  double ball = 0.03;                      // mm
};

struct TestDesign {
  std::vector<Unknown> unknowns{};
  std::vector<std::string> tests{};  // DesignChoice::blocks are places in it
  DesignResult result{};
  std::vector<NullDirection> null_space{};  // of all tests together
};

// Readings of the tests are not used.
[[nodiscard]] Result<TestDesign> test_design(const kinematics::Machine& machine,
                                             const std::vector<MeasuredMotion>& motions,
                                             std::vector<Unknown> unknowns,
                                             const std::vector<Cause>& causes,
                                             const TestDesignOptions& options);

}  // namespace frustum::calibration

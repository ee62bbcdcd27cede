// Which motion tests to run on a machine so that its errors can be identified.
//
// Model    : design() over the tests of a study, each a block of its rows. The offset of the ball
//            in the spindle is an unknown that is not asked for, as frustum identify takes it: on a
//            table no set of tests separates it from the position of the first axis, unless the
//            ball is exact
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

// Which test pieces to cut and which motion tests to run on a machine so that its errors can be
// identified.
//
// Model    : design() over the pieces and tests of a study, each a block of its rows, each with its
//            hours. The offset of the ball in the spindle is an unknown that is not asked for, as
//            frustum identify takes it: on a table no set of tests separates it from the position
//            of the first axis, unless something is known of the ball beforehand
// Units    : mm, rad; h
// Shape    : every subset of at most kMostBlocks pieces and tests
// Errors   : those of planned_observations(), observations_of() and design(); one that is required
//            and not there; two of one name
// Accuracy : exhaustive
// Source   : design.hpp
#pragma once

#include <map>
#include <string>
#include <vector>

#include "calibration/design/design.hpp"
#include "calibration/design/planned_piece.hpp"
#include "calibration/identify/motion_observations.hpp"

namespace frustum::calibration {

struct TestDesignOptions {
  DesignCriterion criterion = DesignCriterion::d_optimal;
  std::vector<std::string> required{};     // in every set
  std::map<std::string, double> limits{};  // largest standard deviation wanted, by unknown
  std::optional<double> budget{};          // h
};

// What the work beside cutting and touching takes.
struct WorkingTimes {
  double piece_setup = 0.5;  // h at the machine, for each piece: blank, tool, zero
  double cmm_setup = 0.5;    // h, for each piece: temperature, clamping, alignment
  double touch = 3.0;        // s a point
  double test_setup = 0.25;  // h, for each motion test, with its run
};
struct Hours {
  double machine = 0.0, cmm = 0.0;
  [[nodiscard]] double all() const { return machine + cmm; }
};

struct CandidatePiece {
  PlannedPiece planned{};
  std::optional<double> hours{};  // instead of those that are computed
};
struct CandidateMotion {
  MeasuredMotion motion{};  // readings are not used
  std::optional<double> hours{};
};

struct TestDesign {
  std::vector<Unknown> unknowns{};
  std::vector<std::string> tests{};  // pieces, then motion tests; blocks are places in it
  std::vector<Hours> hours{};        // of each
  DesignResult result{};
  std::vector<NullDirection> null_space{};  // of all tests together
};

[[nodiscard]] Result<TestDesign> test_design(
    const kinematics::Machine& machine, const std::vector<CandidatePiece>& pieces,
    const std::vector<CandidateMotion>& motions, std::vector<Unknown> unknowns,
    const std::vector<Cause>& causes, const WorkingTimes& times, const TestDesignOptions& options);

}  // namespace frustum::calibration

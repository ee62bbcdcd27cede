// What an instrument reads on a machine with errors: ball bar, R-test and laser as one model.
//
// Model    : s is where the chain with errors takes the tip, R the attitude of the tool there;
//            set-up errors ds (tool frame), db (table frame), dL:
//              displacement  d = s + R ds - s(nominal) - db        what an R-test sees
//              bar           |s + R ds - (b + db)| - (L + dL)
//              line          d . e, where e is the nominal direction
//            Nothing is linear in the errors
// Units    : mm, rad; frame: table
// Shape    : one reading a pose
// Errors   : none: every pose has a reading
// Accuracy : 1e-5 um of chains computed apart (tests/instruments/readings_test.cpp); without errors
//            below 1e-6 um
// Source   : ISO 230-1 and ISO 230-7 errors through kinematics/model/chain.hpp
#pragma once

#include <span>
#include <vector>

#include "instruments/motion_test.hpp"
#include "instruments/setup_errors.hpp"
#include "kinematics/model/chain.hpp"

namespace frustum::instruments {

[[nodiscard]] Vec3 displacement(const kinematics::ForwardChain& actual, const TestPose& pose,
                                const SetupErrors& setup);

[[nodiscard]] std::vector<Vec3> displacements(const kinematics::ForwardChain& actual,
                                              std::span<const TestPose> poses,
                                              const SetupErrors& setup);

// The chain must have the tool length of the test. `moved`: what else moves the tip in each pose,
// for example masses and springs; empty for nothing.
[[nodiscard]] std::vector<double> bar_readings(const kinematics::ForwardChain& actual,
                                               const MotionTest& test, const SetupErrors& setup,
                                               std::span<const Vec3> moved = {});

}  // namespace frustum::instruments

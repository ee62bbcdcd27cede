// The tip under loads at rest, along the chains: without a matrix of the whole machine.
//
// Model    : the bodies are a tree, so each connection bears all loads from its body outwards; its
//            own stiffness of 6 x 6 gives what it yields, and the tip adds up both chains
// Units    : SI
// Shape    : loads as structure.hpp: 6 numbers for each body
// Errors   : none; each connection holds its body (loose_body)
// Accuracy : rounding; equal to L K^-1 f within 1e-12 (tests/dynamics/laws_test.cpp)
// Source   : equilibrium of a statically determinate tree
#pragma once

#include "dynamics/structure.hpp"

namespace frustum::dynamics {

// Displacement and rotation of the tool less those of the workpiece, at the tip, in the frame of
// the machine.
[[nodiscard]] Row6 static_tip(const DynamicModel& model, const Structure& structure,
                              const Eigen::VectorXd& load);

}  // namespace frustum::dynamics

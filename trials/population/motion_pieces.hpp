// The commanded motion near the contacts of a trial, cut into pieces on which a tool pose is a
// parabola, whatever the drawn errors.
//
// Model    : a block is cut where an error jumps and where its axes change their law, and then into
//            halves and halves of halves as far as it takes; a jump is a piece of its own.
//            Neighbouring pieces share a place
// Units    : mm, rad
// Shape    : the blocks asked for, in program order
// Errors   : blocks of errors that bend too sharply within are marked
// Accuracy : parabolas within 2e-8 mm of the motion, at the tip and at the top of the flutes, for
//            the middle machine and one at the limits of its laws, at the quarter points of a piece
// Source   : path_recorder.hpp cuts and samples the same motion
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "kinematics/controller/commanded_program.hpp"
#include "kinematics/controller/setup.hpp"
#include "trials/population/lane_chain.hpp"

namespace frustum::trials {

struct MotionPiece {
  std::array<std::uint32_t, 3> node{};  // places of the chain
  std::uint32_t block = 0;              // of the tool path
  bool follows = false;                 // begins where the piece before it in the list ends
};

struct MotionPieces {
  std::vector<MotionPiece> pieces{};
  // For each block asked for, in their order: its pieces, and whether they are to be trusted.
  struct Block {
    std::uint32_t block = 0;
    std::uint32_t first = 0, count = 0;
    bool is_smooth = true;
  };
  std::vector<Block> blocks{};
  std::vector<kinematics::AxisState> states{};  // of the places of the chain
};

// `blocks`: of the tool path, increasing. Their places are added to the chain, which must be empty.
[[nodiscard]] MotionPieces motion_pieces(const kinematics::Machine& machine,
                                         const kinematics::Setup& setup,
                                         const kinematics::CommandedProgram& program,
                                         const PopulationLaws& laws,
                                         std::span<const std::uint32_t> blocks, LaneChain& chain);

}  // namespace frustum::trials

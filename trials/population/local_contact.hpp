// A contact that the lanes could not prove: one machine's cutter is swept near by.
//
// Model    : the pieces of motion around the contact, as chords, and the probe's ball on what they
//            leave. It is the contact on the whole part if it is not made by an end of these
//            pieces, and if all other parts of the path keep away (follow_plan.hpp)
// Units    : mm; frame: workpiece
// Errors   : nothing where that is not shown
// Accuracy : that of stock/solid/workpiece.hpp for a path within the bound
// Source   : ours
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <span>

#include "cutter/body/cutter.hpp"
#include "metrology/probing/ball_contact.hpp"
#include "trials/population/lane_contact.hpp"
#include "trials/population/middle_contact.hpp"

namespace frustum::trials {

struct LocalSurroundings {
  std::span<const PosesOfPiece> pieces{};    // of all ranges, one after the other
  std::span<const std::uint32_t> lengths{};  // of the ranges
  PosesOfPiece own{};                        // of the origin's piece
  const ContactOrigin& origin;
  // Whether other parts of the path keep out of the way of a contact (middle_contact.hpp).
  std::function<bool(double drift, double moved)> others_keep_away{};
};

[[nodiscard]] std::optional<metrology::BallContact> local_contact(
    const LocalSurroundings& near, int tool, const cutter::Cutter& cutter,
    const metrology::BallApproach& approach, double path_bound);

}  // namespace frustum::trials

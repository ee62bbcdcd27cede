// Which contacts of a plan can be followed from the middle machine to others, by which pieces of
// motion, and how far a machine may be off for that to be proven.
//
// Model    : population.hpp and lane_contact.hpp. A window has the pieces around a contact that
//            machines within their laws reach; the pieces beyond, up to where the cutter is 0.05 mm
//            off, are its surroundings. How much other parts of the path can come nearer to a
//            contact is summed over all columns at their limits: of pieces in the surroundings what
//            the ends of the window do not tell (the second differences along the path), of other
//            passes all of it, of what is farther off twice the largest motion of any point.
//            Of one machine the same follows from its own weights (near_parts.hpp)
// Units    : mm, rad; frame: workpiece
//            The blank's own surface stays where it is: a contact on it needs no window
// Errors   : points that cannot be followed say why
// Accuracy : bounds to first order in the errors, with 2 % for what is of second order: 1e-4 of a
//            motion for errors of 100 urad. Between the places at which a piece is looked at,
//            bounds are taken to change evenly
// Source   : ours
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "trials/population/lane_chain.hpp"
#include "trials/population/lane_contact.hpp"
#include "trials/population/local_contact.hpp"
#include "trials/population/motion_pieces.hpp"
#include "trials/population/near_parts.hpp"
#include "trials/population/population_laws.hpp"
#include "trials/trial.hpp"

namespace frustum::trials {

// Pieces in a row.
struct PieceRange {
  std::uint32_t first = 0, count = 0;
};

// One planned point.
struct FollowedPoint {
  bool is_followed = false;
  std::string why_not{};
  std::uint32_t window = 0;  // if it is followed
  // Its surroundings, of the list of pieces: where the contact is, then where the path comes by
  // once more; none where other parts of the path cannot be excluded.
  std::vector<PieceRange> surroundings{};
  Closeness others{};  // of what is not in them
  NearParts near{};    // the same, for one machine
  int tool = 0;
  ContactOrigin origin{};
  // mm: of a contact on the blank's own surface, how far cutters keep from it. It is met there as
  // long as they do, by any machine.
  std::optional<double> room_on_blank{};
};

struct FollowPlan {
  std::unique_ptr<LaneChain> chain{};
  MotionPieces motion{};
  WindowTables tables{};
  std::vector<ProbeWindow> windows{};
  std::vector<FollowedPoint> points{};        // features and points in the order of the plan
  std::vector<std::uint32_t> first_point{};   // of each feature, and the end
  std::vector<std::uint32_t> window_nodes{};  // that any window needs
  NearPlaces near_places{};
  double largest_motion = 0.0;  // mm, of any point of the cutters for errors within their laws
};

// all: no more than the reasons are found where the middle machine's trial tells already that a
// point cannot be followed.
enum class FollowScope { what_can_be, all };

[[nodiscard]] FollowPlan follow_plan(const kinematics::Machine& machine,
                                     const programs::TestPiece& piece,
                                     const CommandedPiece& commanded, const PopulationLaws& laws,
                                     const Trial& middle,
                                     FollowScope scope = FollowScope::what_can_be);

}  // namespace frustum::trials

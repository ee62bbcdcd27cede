// Moves that meet material although they must not: rapids through it, feeds with the spindle off,
// shanks and holders in it.
//
// Model    : every move is held against the material that is left when it begins, so that what its
//            own cutting edges remove does not count. The cutter of a straight move is followed by
//            rays along the motion through rings of points of its surface, that of a turning one by
//            a grid of rays through its box; shanks and holders (of all moves) by a grid through
//            the blank. Bodies are shrunk by a margin, so that a retract along a finished wall is
//            no collision
// Units    : mm
// Errors   : none
// Accuracy : overlaps of more than the margin (10.1 um) are found when they hold a ray: a third of
//            the cutter's radius between rings and an eighth of a right angle around; a twelfth of
//            the diameter where it turns, but not less than 1/128 of the move's box; for shanks and
//            holders a quarter of their radius, but not less than 1/250 of the blank's longest
//            side, after those that up to eight times as few rays have found. The depth of the
//            cutter is as exact as its rays are dense, that of a shank or holder is the deepest of
//            four blocks of its run (body_depth.hpp)
// Threads  : find_collisions() runs on oneTBB; the same bits for any number of threads
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "stock/solid/workpiece.hpp"

namespace frustum::stock {

enum class CollisionKind : std::uint8_t {
  rapid_through_material,
  feed_with_spindle_off,
  body_in_material,  // a shank or holder during a feed
  bodies_meet,       // two bodies of the machine (stock/collision/machine_collision.hpp)
};
enum class CollisionBody : std::uint8_t { cutter, shank, holder };

struct Collision {
  CollisionKind kind = CollisionKind::rapid_through_material;
  CollisionBody body = CollisionBody::cutter;
  std::uint32_t block = 0;  // of the tool path
  std::uint32_t source_line = 0;
  std::shared_ptr<const std::string> source_file{};  // null: the file of the main program
  // Blocks that follow each other with one body in the material make one collision; the last of
  // them.
  std::uint32_t last_line = 0;
  int tool = 0;
  Vec3 point = Vec3::Zero();      // where it is worst
  double depth = 0.0;             // mm of material, along the axis in which it is thinnest
  std::string first{}, second{};  // the bodies that meet
};

// A part of a tool that must never meet material: convex parts in the tool's frame.
struct NonCuttingBody {
  int tool = 0;
  CollisionBody body = CollisionBody::holder;
  std::vector<cutter::Profile> parts{};
  std::optional<cutter::Body> whole{};  // not needed: makes long programs fast
};

// The shanks and holders of the tools that the program uses.
[[nodiscard]] std::vector<NonCuttingBody> non_cutting_bodies(const Workpiece& workpiece);

// Of all bodies of all tools, in program order.
[[nodiscard]] std::vector<Collision> find_collisions(const Workpiece& workpiece);

// Of the cutting edges alone.
[[nodiscard]] std::vector<Collision> find_cutter_collisions(const Workpiece& workpiece);
// Of these bodies alone.
[[nodiscard]] std::vector<Collision> find_body_collisions(
    const Workpiece& workpiece, const std::vector<NonCuttingBody>& bodies);

// Blocks that feed through material while the spindle turns against the hand of the cutter, of each
// stretch without a change of tool or spindle the first. The blocks of a tap, which goes in along
// its axis and comes back with the spindle reversed, are none.
[[nodiscard]] std::vector<std::uint32_t> cuts_against_hand(const Workpiece& workpiece);

// Above any geometric error, below any collision that matters.
inline constexpr double kCollisionMargin = 0.01;  // mm

}  // namespace frustum::stock

// The contacts of a probe's ball with what a moving cutter leaves, for eight machines at once.
//
// Model    : over a piece of motion the tip and the axis of the tool are parabolas in tau through
//            three places that the chain has found. With the ball's centre on its line of approach,
//            v mm past the place where the ball touches the planned point, F(v, tau) is how far it
//            is from the cutter less the ball's radius; the contact is where F = 0 and dF/dtau = 0,
//            or where a piece ends. Of several pieces the deepest counts; where two of them meet
//            the ball rests on the edge that both leave
//            A contact is proven when nothing else covers it: the distance of other parts of the
//            path from the middle machine's contact is more than they can have come nearer. Of the
//            next parts on either side this is told from how the ends of its stretches have moved
// Units    : mm; tau 0 to 1 over a piece; frame: workpiece
// Errors   : contacts that are not proven say why
// Accuracy : 1e-10 mm for the pieces given
// Source   : ours
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "trials/population/lanes.hpp"

namespace frustum::trials {

// A face of the cutter, in its meridian.
struct LaneFace {
  bool is_round = false;
  // cone, cylinder: radius at z_lo, slope of the radius, cosine of the flank's angle, its sine
  double radius = 0.0, slope = 0.0, cosine = 1.0, sine = 0.0;
  double major = 0.0, centre = 0.0;  // sphere, torus: with `radius` that of the tube
  double z_lo = 0.0, z_hi = 0.0;     // mm above the tip, of points on the face
};

struct LanePiece {
  std::array<std::uint32_t, 3> node{};  // places of the chain at tau 0, 1/2 and 1
  double tau = 0.5;                     // of the middle machine's contact on it
  double bend = 0.0;                    // d2F/dtau2 there
};

// How far something is to be from the middle machine's contact, each divided by how far it is:
// what a machine moves by in all must remain below one.
struct Closeness {
  double per_scale = 0.0;  // for the errors at the limits of their laws
  double per_drift = 0.0;  // for a mm that the contact goes along the surface
  // For a mm that the end of the window has come nearer; of others, for a mm that the contact has
  // moved in the workpiece, where the blank's surface stays.
  double per_nearer = 0.0;
};

// Pieces in a row.
struct WindowStretch {
  std::uint32_t first_piece = 0, pieces = 0;  // of WindowTables
  // The distance of the middle machine's contact from the cutter at both ends (mm), and what of the
  // path comes before and after.
  double at_first = 0.0, at_last = 0.0;
  Closeness before{}, after{};
};

struct ProbeWindow {
  std::array<double, 3> point{}, normal{};  // as planned, in the frame of approach
  std::uint32_t face = 0;                   // of WindowTables
  // One for each time that the path comes by; their pieces follow each other in the table.
  std::uint32_t first_stretch = 0, stretches = 0;
  std::uint32_t first_piece = 0, pieces = 0;
  std::uint32_t own_piece = 0;  // of the window's, where the middle machine's contact is
  double ball = 0.0;            // mm, radius
  double travel = 0.0;          // of the middle machine
  // The middle machine's cutter at its contact: tip, axis, and the contact point.
  std::array<double, 3> tip{}, axis{}, touched{};
  Closeness others{};
};
// No window has more.
inline constexpr std::uint32_t kMostWindowPieces = 48;

struct WindowTables {
  std::vector<LaneFace> faces{};
  std::vector<WindowStretch> stretches{};
  std::vector<LanePiece> pieces{};
};

// Bits of why a contact is not proven.
enum class Doubt : std::uint32_t {
  none = 0,
  unsettled = 1,  // the solution did not settle
  off_face = 2,   // on another face of the cutter
  edges = 4,      // more than one edge, or one that is too blunt for its planes
  before = 8,     // what comes before or after a stretch of the window
  after = 16,
  others = 32,  // other parts of the path
};

struct LaneContact {
  Lanes travel{};
  // Of the contact from where the middle machine's was carried by its cutter, and from there (mm).
  Lanes drift{}, moved{};
  std::array<std::uint32_t, kLanes> doubt{};  // sums of Doubt
};

}  // namespace frustum::trials

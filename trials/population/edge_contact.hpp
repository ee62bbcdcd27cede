// Where the probe's ball rests on edges between the surfaces that pieces of motion leave, for one
// machine: what the lanes leave in doubt.
//
// Model    : each piece bounds the material by the surface that it sweeps. In turn, these surfaces
//            are replaced by their tangent planes at the contact so far, and the ball is laid on
//            what all planes leave: on one of them or on the edge of two, so that no other one
//            covers the point (the dual of the deepest point of a convex body; both are found by
//            taking in the plane that covers most). Proven as lane_contact.hpp does
// Units    : mm; frame: workpiece
// Errors   : nothing where it does not settle, where the contact leaves the cutter's face, and
//            where other parts of the path are not proven to keep away
// Accuracy : 1e-10 mm for the pieces given
// Source   : ours
#pragma once

#include <optional>
#include <span>

#include "trials/population/lane_contact.hpp"
#include "trials/population/middle_contact.hpp"

namespace frustum::trials {

struct EdgeSurroundings {
  const ProbeWindow& window;
  const WindowTables& tables;
  std::span<const PosesOfPiece> pieces{};  // of the window
  const ContactOrigin& origin;
  PosesOfPiece own{};  // of the origin's piece
  double scale = 1.0;
};

// How far past the place where the ball touches the planned point, along the line's normal.
[[nodiscard]] std::optional<double> edge_travel(const EdgeSurroundings& near,
                                                const CentreLine& line);

}  // namespace frustum::trials

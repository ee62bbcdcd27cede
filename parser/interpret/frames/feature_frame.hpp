// The frame of a tilted working plane from the words that describe it: G68.2 and G68.4, in each of
// their forms.
//
//   P0  turns I about Z, J about the new X, K about the new Z (Euler angles)
//   P1  turns I about X, J about Y, K about Z, all axes of the untilted frame, in the order that Q
//       names (123: X first, then Y, then Z)
//   P2  three points: Q1 the origin, Q2 a place on +X, Q3 a place on the side of +Y; Q0, when it is
//       given, shifts the origin by X Y Z along the new axes and turns the plane by R about its
//       normal
//   P3  two vectors: Q1 the origin X Y Z and the direction I J K of +X, Q2 the direction I J K of
//       the normal
//   P4  two lines of the plane: X turned by I about Y, and Y turned by J about X; the normal is
//       their cross product, +X is the first line turned by K about it
//
// Model    : right-handed turns; the result is program_from_plane
// Units    : mm, rad; Q is a plain number
// Shape    : P2 and P3 come on several blocks, gathered by FeatureWords
// Errors   : an order that is none, points on one line, a vector without direction, vectors more
//            than 5 degrees off the right angle, lines that are parallel. Without place: the caller
//            knows the word
// Accuracy : 1e-15 relative
// Source   : Fanuc 30i operator's manual, tilted working plane command
#pragma once

#include "core/pose.hpp"
#include "core/result.hpp"
#include "parser/interpret/state/feature_words.hpp"

namespace frustum::parser {

[[nodiscard]] Result<Pose> feature_frame(const FeatureWords& words);

}  // namespace frustum::parser

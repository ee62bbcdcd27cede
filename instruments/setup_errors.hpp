// How an instrument is mounted wrongly: unknowns of every test, part of the model from the start.
//
// Units  : mm; `ball` in the tool frame (origin: tip, +Z: to the spindle), `table_ball` in the
//          table frame
// Errors : none
#pragma once

#include "core/pose.hpp"

namespace frustum::instruments {

struct SetupErrors {
  Vec3 ball = Vec3::Zero();        // spindle ball off the programmed tip, common to all tests while
                                   // it stays in the spindle
  Vec3 table_ball = Vec3::Zero();  // table ball off its nominal place, of each mounting
  double length = 0.0;             // bar longer than its nominal length
};

}  // namespace frustum::instruments

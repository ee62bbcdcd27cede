// What the script of the player's page reads, as JSON.
//
// Units : mm, rad, s; packed numbers say their step, which is 0.1 um for places, 1 nm for
//         deviations, 0.1 urad for angles, 1 um/min for feeds and a microsecond for times of up to
//         an hour. Steps of places and times are too coarse to tell the feed of a short motion
// Errors: none
#pragma once

#include <string>

#include "report/player/player_page.hpp"

namespace frustum::report {

[[nodiscard]] std::string player_data(const PlayerPage& page);

}  // namespace frustum::report

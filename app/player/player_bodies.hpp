// Machine, fixtures and tools as the player draws them.
//
// Units    : mm, rad; arcs of cutters as chords within 0.01 mm
// Errors   : meshes that cannot be read, with their file; tools that are none
#pragma once

#include "app/job/job.hpp"
#include "core/result.hpp"
#include "report/player/player_page.hpp"

namespace frustum::app {

// Fills joints, offsets, bodies and the tools with these numbers.
[[nodiscard]] Result<report::PlayerPage> with_bodies(const Job& job, const std::vector<int>& tools,
                                                     report::PlayerPage page);

}  // namespace frustum::app

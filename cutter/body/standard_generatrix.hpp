// The generatrix of each type of cutter, from its dimensions.
//
// Model    : a chain of lines and arcs from the axis round the end and up the flank to the height
//            of the
//            flutes; the radius error is in the diameter already
// Units    : mm, rad; heights from the tip
// Errors   : which dimension does not fit the others, and the limit
#pragma once

#include <vector>

#include "core/result.hpp"
#include "cutter/body/cutter_spec.hpp"
#include "cutter/body/generatrix.hpp"

namespace frustum::cutter {

using GeneratrixChain = std::vector<GeneratrixSegment>;

// Flat, bull nose and taper end mills.
[[nodiscard]] Result<GeneratrixChain> end_mill_generatrix(const CutterSpec& spec);
[[nodiscard]] Result<GeneratrixChain> ball_generatrix(const CutterSpec& spec);
[[nodiscard]] Result<GeneratrixChain> taper_ball_generatrix(const CutterSpec& spec);
// Drills and chamfer mills.
[[nodiscard]] Result<GeneratrixChain> pointed_generatrix(const CutterSpec& spec);
[[nodiscard]] Result<GeneratrixChain> lollipop_generatrix(const CutterSpec& spec);
[[nodiscard]] Result<GeneratrixChain> t_slot_generatrix(const CutterSpec& spec);
[[nodiscard]] Result<GeneratrixChain> dovetail_generatrix(const CutterSpec& spec);
[[nodiscard]] Result<GeneratrixChain> barrel_generatrix(const CutterSpec& spec);
[[nodiscard]] Result<GeneratrixChain> lens_generatrix(const CutterSpec& spec);
[[nodiscard]] Result<GeneratrixChain> apt_generatrix(const CutterSpec& spec);
[[nodiscard]] Result<GeneratrixChain> profile_generatrix(const CutterSpec& spec);
[[nodiscard]] Result<GeneratrixChain> measured_generatrix(const CutterSpec& spec);

}  // namespace frustum::cutter

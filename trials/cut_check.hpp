// Whether what was measured is what the program meant to cut.
//
// Model    : a feature that an operation makes must have been cut, at every measured point, by the
//            lines of that operation; elsewhere the blank shows through, or another pass has cut
//            deeper. What cut a point is what the probe's answer says (core/provenance.hpp)
// Units    : mm
// Errors   : none; features that were not measured are passed over
// Accuracy : exact
// Source   : ours
#pragma once

#include "core/diagnostic.hpp"
#include "kinematics/path/tool_path.hpp"
#include "metrology/measurement.hpp"
#include "programs/test_piece.hpp"
#include "stock/solid/workpiece.hpp"

namespace frustum::trials {

// A tool that covers nothing of the blank's box from the beginning of the program to its end.
[[nodiscard]] std::optional<Diagnostic> away_from_blank(const stock::Workpiece& workpiece,
                                                        const programs::TestPiece& piece);

// Cuts with the spindle turning against the hand of the tool: one warning for each stretch without
// a change of tool or spindle.
[[nodiscard]] Diagnostics against_hand(const stock::Workpiece& workpiece,
                                       const programs::TestPiece& piece);

// One warning for each feature with points that its operation did not make.
[[nodiscard]] Diagnostics wrongly_cut_features(const programs::TestPiece& piece,
                                               const kinematics::ToolPath& path,
                                               const metrology::Measurement& measurement);

}  // namespace frustum::trials

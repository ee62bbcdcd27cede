// The results as JSON with stable names, for other programs.
//
// Contract : {"schema":"frustum/result/1",
//            "title","status":"pass|fail|uncertain","machine","features":[{"name","kind",
//            "points","parameters",
//            "form":{"value_um"}}],"characteristics":[{"name","kind","value","unit","tolerance",
//            "expanded_uncertainty","pass","verdict":"pass|fail|uncertain","coverage","interval":
//            [low, high],"interval_holds_value","standard_uncertainty","draws","stable"}], from
//            coverage on where there is one, the last two where uncertainties are simulated,
//            "timing":{name: seconds},"diagnostics":[..]}; names are added, never renamed.
// Units    : as the names say (value_um, *_mm3); parameters mm and rad; axis ranges mm and deg;
//            characteristics in their own unit.
// Errors   : none; a number that is not finite becomes null, bytes that are not UTF-8 are replaced.
#pragma once

#include <string>

#include "core/diagnostic.hpp"
#include "report/run_report.hpp"

namespace frustum::report {

// Indented, ending with a line end; keys in the order of the contract.
[[nodiscard]] std::string json_report(const RunReport& report);

// {"looked_for","bodies","smallest_distance_mm","between":[a, b],"line","text"}: a part of the
// document, under "machine_collisions".
[[nodiscard]] std::string machine_bodies_json(const MachineBodies& bodies);

// [{"severity","id","message","file","line","column","key","hint"}, ..]: a part of the document,
// under "diagnostics"; keys that would say nothing are left out.
[[nodiscard]] std::string diagnostics_json(const Diagnostics& diagnostics);

// What a command prints instead where it has no result: {"status":"error","diagnostics":[..]}.
[[nodiscard]] std::string json_failure(const Diagnostics& diagnostics);

}  // namespace frustum::report

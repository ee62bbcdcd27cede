// Virtual coordinate measuring machine: probes a part by an inspection plan and evaluates it.
//
// Model    : a ball approaches each planned point along the nominal normal; its centre at contact
//            is x + r n(x) on the approach line. The machine's errors are added to the centre
//            (cmm_errors.hpp). Elements are fitted to ball centres and offset by the qualified ball
//            radius along the fitted normal, or to centres less the radius against the approach, as
//            the plan's probe says. Datum features are probed first, again where the part is
//            askew, and the others are approached in the frame they give
// Units    : mm, rad; everything in the workpiece frame of the plan
// Shape    : one pass over all planned points; a pure function, safe to call from many threads
// Errors   : a plan that cannot be measured (see inspection_plan.hpp), a point that meets no
//            surface, starts inside material or is beyond the travels, a fit that fails; each
//            names the feature. A stylus that runs into the part is a warning in the measurement
// Accuracy : ball centre 1e-9 mm on smooth surfaces (tests/metrology/cmm_test.cpp)
// Source   : Bossoni 2010, appendix A.4 for the datum system
#pragma once

#include <span>
#include <string>
#include <vector>

#include "core/result.hpp"
#include "metrology/measurement.hpp"
#include "metrology/plan/inspection_plan.hpp"
#include "metrology/points/feature_points.hpp"
#include "metrology/probing/cmm_model.hpp"
#include "metrology/probing/surface_probe.hpp"

namespace frustum::metrology {

// Whether a part whose datum system is found there is measured once more, in that system: probing
// along the planned lines would show.
[[nodiscard]] bool lies_askew(const Pose& planned_from_found);

[[nodiscard]] Result<Measurement> measure(const InspectionPlan& plan, SurfaceProbeRef part,
                                          const CmmModel& cmm = {},
                                          NoErrors mean = NoErrors::ideal);

// Evaluates real CMM points. `cmm` states the machine's accuracy for the uncertainties only; one
// without errors states none.
[[nodiscard]] Result<Measurement> evaluate(const InspectionPlan& plan,
                                           std::span<const FeaturePoints> features,
                                           PointMeaning meaning = PointMeaning::surface,
                                           const CmmModel& cmm = {});

}  // namespace frustum::metrology

// The error maps of a touch-trigger calibration as a document, for a terminal, on a page and as an
// error file.
//
// Units  : um and urad, as named
// Errors : none
#pragma once

#include <optional>
#include <vector>

#include "app/motion/motion_answer.hpp"
#include "instruments/table_maps.hpp"

namespace frustum::app {

struct TouchFindings {
  std::vector<double> readings{};  // of touches; empty where something else was measured
  instruments::TableMaps identified{};
  instruments::TableMaps sd{};  // propagated from the noise of a touch
  std::optional<instruments::TableMaps>
      visible{};  // what a virtual machine's errors of A and C make
  int runs = 1;
  std::optional<instruments::TableMaps> scatter{};  // of that many runs
};

void add_touch_findings(MotionAnswer& answer, const kinematics::Machine& machine,
                        const instruments::TouchPlan& plan, const TouchFindings& found);

}  // namespace frustum::app

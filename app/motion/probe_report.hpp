// A part on its machine beside the same part on a CMM, and which errors cancel there.
//
// Units  : each characteristic in its own; gains in um and urad, as named
// Errors : none
#pragma once

#include <string>
#include <vector>

#include "app/job/job.hpp"
#include "app/motion/motion_answer.hpp"
#include "trials/part_gains.hpp"

namespace frustum::app {

struct PartFindings {
  std::vector<double> readings{};
  metrology::Measurement on_cmm{}, on_machine{};
  std::vector<kinematics::AxisState> at{};
  trials::PartGains gains{};
  std::string log{};  // that the readings come from; empty: they are simulated
};

void add_part_findings(MotionAnswer& answer, const Job& job, const trials::PartTouches& plan,
                       const PartFindings& found);

}  // namespace frustum::app

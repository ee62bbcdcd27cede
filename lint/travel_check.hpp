// The program on a machine: axes beyond their travels, axes that cannot follow the feed, what the
// controller refuses.
//
// Model    : the controller of kinematics/controller/controller.hpp executes every motion, whatever
//            is beyond the travels, and each move is looked at along its whole way. What goes on
//            being outside is one finding, with the worst place
// Units    : mm, rad
// Shape    : O(1) memory; a bent move is looked at in its parts and its peaks between them are
//            searched
// Errors   : none; tool lengths and work offsets that the setup lacks are taken as zero, which is a
//            finding
// Accuracy : peaks within 1e-6 of a part
#pragma once

#include <array>
#include <functional>
#include <memory>

#include "kinematics/controller/setup.hpp"
#include "kinematics/model/machine.hpp"
#include "lint/finding_list.hpp"
#include "parser/dialect.hpp"
#include "parser/motion.hpp"

namespace frustum::lint {

class TravelCheck {
 public:
  // The machine and the list must outlive the check.
  TravelCheck(const kinematics::Machine& machine, kinematics::Setup setup, parser::Dialect dialect,
              FindingList& findings);
  ~TravelCheck();
  TravelCheck(const TravelCheck&) = delete;
  TravelCheck& operator=(const TravelCheck&) = delete;

  void see(const parser::Motion& motion);
  void finish();
  // Positions that have been looked at so far: what the check costs.
  [[nodiscard]] std::uint64_t samples() const;

 private:
  class State;
  std::unique_ptr<State> state_;
};

}  // namespace frustum::lint

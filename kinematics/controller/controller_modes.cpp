#include "kinematics/controller/controller_modes.hpp"

#include <variant>

namespace frustum::kinematics {
namespace {

// What one command switches.
struct ModeSwitch {
  ControllerModes& modes;

  void operator()(const parser::ToolChange& change) const { modes.tool = change.tool; }
  void operator()(const parser::SpindleChange& change) const {
    modes.spindle = change;
    modes.halted = false;
  }
  void operator()(const parser::CompensationChange& change) const { modes.compensation = change; }
  void operator()(const parser::WorkOffsetChange& change) const {
    modes.work_offset = change.number;
  }
  void operator()(const parser::TiltedPlaneChange& change) const {
    modes.plane = change.program_from_plane;
  }
  void operator()(const parser::OrientationPathChange& change) const {
    modes.orientation_path = change.path;
  }
  void operator()(const parser::RotaryPathChange& change) const {
    for (std::size_t i = 0; i < change.axes.size(); ++i) {
      if (change.axes.at(i)) modes.rotary_paths.at(i) = change.path;
    }
  }
  void operator()(const parser::Stop& stop) const {
    if (stop.kind != parser::StopKind::optional_stop) modes.halted = true;
  }
  template <typename Other>
  void operator()(const Other& /*command*/) const {}
};

}  // namespace

void ControllerModes::follow(const parser::Command& command) {
  std::visit(ModeSwitch{*this}, command);
}

}  // namespace frustum::kinematics

#include "kinematics/model/machine.hpp"

#include <cmath>
#include <stdexcept>
#include <variant>

#include "dynamics/model_file.hpp"
#include "dynamics/modes.hpp"
#include "dynamics/response.hpp"
#include "tests/fuzz/files/file_checks.hpp"
#include "tests/fuzz/files/one_file.hpp"

namespace frustum::fuzz {
namespace {

using namespace kinematics;

void check_joint(const Joint& joint) {
  check_finite(joint.offset, "offset");
  check_finite(joint.functional_point.point, "functional_point");
  check_finite(joint.travel.lo, "travel");
  check_finite(joint.travel.hi, "travel");
  for (const double limit : {joint.dynamics.velocity, joint.dynamics.acceleration,
                             joint.dynamics.jerk, joint.dynamics.servo_gain}) {
    check_finite(limit, "a limit of an axis");
  }
  const bool turned = !(std::abs(joint.direction.norm() - 1.0) < 1e-12);
  if (turned || !(joint.travel.lo < joint.travel.hi) ||
      !(joint.endless || joint.travel.contains(joint.home))) {
    throw std::runtime_error("an axis without a unit direction, a travel or a home in it");
  }
}

void check_body(const MachineBody& body) {
  check_finite(body.part_from_body.translation, "origin");
  check_finite(body.part_from_body.rotation.determinant(), "tilt");
  if (const auto* box = std::get_if<BoxBody>(&body.shape)) check_finite(box->size, "size");
  if (const auto* round = std::get_if<CylinderBody>(&body.shape)) {
    check_finite(round->diameter, "diameter");
    check_finite(round->height, "height");
  }
}

void check_body(const dynamics::RigidBody& body) {
  check_finite(body.mass, "mass");
  check_finite(body.centre, "com");
  check_finite(body.inertia.determinant(), "inertia");
}

// What is read has natural frequencies and a tip that yields, or is refused.
void check_dynamics(std::string_view text, const Machine& machine) {
  const auto model = dynamics::read_model(text, kTriedFile, machine);
  if (!model) return check_failures(model.error(), kTriedFile, Placed::always);
  if (!*model) return;
  check_body((*model)->bed);
  for (const dynamics::AxisModel& axis : (*model)->axes) check_body(axis.body);
  const auto structure = structure_at(**model, machine.home(), 0.0);
  for (const double frequency : natural_frequencies(structure)) {
    check_finite(frequency, "a natural frequency");
    if (!(frequency > 0.0)) throw std::runtime_error("a body that nothing holds");
  }
  const auto rest = static_response(**model, structure);
  for (const double each : rest.compliance.reshaped()) check_finite(each, "a compliance");
}

}  // namespace

void run_one_machine(std::string_view text) {
  const auto machine = Machine::read(text, kTriedFile);
  if (!machine) return check_failures(machine.error(), kTriedFile, Placed::always);
  for (const Joint& joint : machine->joints()) check_joint(joint);
  check_finite(machine->spindle_offset(), "offset of the spindle");
  check_finite(machine->table_offset(), "offset of the table");
  for (const auto& [symbol, alias] : machine->aliases()) check_finite(alias.scale, "scale");
  for (const MachineBody& body : machine->bodies()) check_body(body);
  check_dynamics(text, *machine);
  if (machine->error_names().empty()) throw std::runtime_error("a machine without errors");
}

}  // namespace frustum::fuzz

#include "dynamics/model_file.hpp"

#include <fmt/format.h>

#include <cmath>

#include "core/constants.hpp"
#include "core/toml_document.hpp"
#include "dynamics/body_reader.hpp"
#include "dynamics/structure.hpp"

namespace frustum::dynamics {
namespace {

using kinematics::Joint;
using kinematics::Machine;

// What a number of a spring or damper is written in, and the largest that is not in another unit.
struct SpringUnit {
  double si = 1.0;
  double most = 0.0;
  const char* name = "";
};
constexpr SpringUnit kStiffness{1e6, 1e6, "N/um"};
constexpr SpringUnit kDamping{1e3, 1e6, "kN s/m"};
constexpr SpringUnit kTurnStiffness{1.0, 1e12, "N m/rad"};
constexpr SpringUnit kTurnDamping{1.0, 1e10, "N m s/rad"};

struct SpringUnits {
  SpringUnit stiffness, damping;
};
constexpr SpringUnits kStraight{kStiffness, kDamping};
constexpr SpringUnits kTurning{kTurnStiffness, kTurnDamping};

double in_si(const TomlTable& table, const char* key, double value, const SpringUnit& unit) {
  if (value < 0.0) {
    table.fail(key, "out-of-range"_id, fmt::format("must not be negative, is {:g}", value),
               fmt::format("in {}", unit.name));
  } else if (value > unit.most) {
    table.fail(key, "out-of-range"_id,
               fmt::format("{:g} {} is beyond {:g}, more than any machine has", value, unit.name,
                           unit.most),
               fmt::format("in {}", unit.name));
  }
  return value * unit.si;
}

double spring_number(const TomlTable& table, const char* key, const SpringUnit& unit) {
  return in_si(table, key, table.number(key), unit);
}

void refuse_count(const TomlTable& table, const char* key, const char* what, std::size_t expected,
                  std::size_t found) {
  table.fail(key, "wrong-type"_id, fmt::format("expected {} numbers, found {}", expected, found),
             what);
}

// As many numbers as `what` has names.
template <std::size_t Count>
std::array<double, Count> numbers_of(const TomlTable& table, const char* key, const char* what) {
  std::array<double, Count> found{};
  const bool was_sound = table.is_sound();
  const std::vector<double> values = table.numbers(key);
  if (values.size() == Count) {
    std::copy(values.begin(), values.end(), found.begin());
  } else if (!was_sound || table.is_sound()) {
    refuse_count(table, key, what, Count, values.size());
  }
  return found;
}

// [k, d] of one direction.
SpringDamper pair_of(const TomlTable& table, const char* key, const SpringUnits& units) {
  const std::string what =
      fmt::format("[stiffness, damping] in {} and {}", units.stiffness.name, units.damping.name);
  const auto values = numbers_of<2>(table, key, what.c_str());
  return {in_si(table, key, values[0], units.stiffness),
          in_si(table, key, values[1], units.damping)};
}

Attached attached(const TomlTable& table) {
  return static_cast<Attached>(table.choice_or("on", {"moving", "fixed"}, 0));
}

// From `least` to `most`; beyond them it is in another unit.
double number_within(const TomlTable& table, const char* key, double least, double most,
                     const char* unit) {
  const double value = table.number(key);
  if (!(value >= least && value <= most)) {
    table.fail(key, "out-of-range"_id,
               fmt::format("{:g} is not within {:g} and {:g}", value, least, most),
               fmt::format("in {}", unit));
    return least;
  }
  return value;
}

Mount read_mount(const TomlTable& table) {
  Mount mount{.at = point_of(table, "at")};
  const Vec3 stiffness = table.vector("stiffness"), damping = table.vector("damping");
  for (Eigen::Index i = 0; i < 3; ++i) {
    mount.stiffness[i] = in_si(table, "stiffness", stiffness[i], kStiffness);
    mount.damping[i] = in_si(table, "damping", damping[i], kDamping);
  }
  return mount;
}

// A normal has length 1 and is perpendicular to the axis, but for the digits in which it is
// written.
constexpr double kWrittenDigits = 1e-9;

Carriage read_carriage(const TomlTable& table, const Joint& joint) {
  Carriage carriage{.at = point_of(table, "at")};
  carriage.normal = table.vector("normal");
  const double length = carriage.normal.norm();
  const double along = carriage.normal.dot(joint.direction);
  if (!table.is_sound()) {
    // What was no vector has been reported.
  } else if (std::abs(length - 1.0) > kWrittenDigits) {
    table.fail("normal", "axis-directions"_id,
               fmt::format("the direction has length {}, not 1", length), "give a unit vector");
  } else if (std::abs(along) > kWrittenDigits) {
    table.fail(
        "normal", "axis-directions"_id,
        std::abs(along) > 1.0 - kWrittenDigits
            ? fmt::format("the normal is along the axis {}", to_char(joint.letter))
            : fmt::format("the normal is not perpendicular to the axis {}: its share along "
                          "it is {:.6g}",
                          to_char(joint.letter), along),
        fmt::format("{} moves along [{:g}, {:g}, {:g}]; a carriage leaves that direction free",
                    to_char(joint.letter), joint.direction.x(), joint.direction.y(),
                    joint.direction.z()));
  } else {
    carriage.normal.normalize();
  }
  const char* two = "[along the normal, lateral]";
  const auto stiffness = numbers_of<2>(table, "stiffness", two);
  const auto damping = numbers_of<2>(table, "damping", two);
  carriage.along_normal = {in_si(table, "stiffness", stiffness[0], kStiffness),
                           in_si(table, "damping", damping[0], kDamping)};
  carriage.lateral = {in_si(table, "stiffness", stiffness[1], kStiffness),
                      in_si(table, "damping", damping[1], kDamping)};
  carriage.on = attached(table);
  return carriage;
}

Bearing read_bearing(const TomlTable& table) {
  Bearing bearing{.at = point_of(table, "at")};
  bearing.axial = pair_of(table, "axial", kStraight);
  bearing.radial = pair_of(table, "radial", kStraight);
  if (table.has("tilt")) bearing.tilt = pair_of(table, "tilt", kTurning);
  bearing.on = attached(table);
  return bearing;
}

SpringDamper read_spring(const TomlTable& table, const SpringUnits& units) {
  return {spring_number(table, "stiffness", units.stiffness),
          spring_number(table, "damping", units.damping)};
}

Drive read_drive(const TomlTable& table, const SpringUnits& units) {
  return {point_of(table, "at"), read_spring(table, units), attached(table)};
}

std::optional<Control> read_control(const TomlTable& table, const Joint& joint) {
  enum : std::size_t { kSpring, kDirect, kScrew };
  const std::size_t kind = table.choice_or("kind", {"spring", "direct", "screw"}, kSpring);
  if (kind == kSpring) return std::nullopt;
  const SpringUnits& units = joint.rotary() ? kTurning : kStraight;
  Control control{.kind = kind == kScrew ? Control::Kind::screw : Control::Kind::direct};
  const char* mass = joint.rotary() ? "kg m^2" : "kg";
  const auto share = [&](const char* key) {
    return table.has(key) ? number_within(table, key, 0.0, 2.0, "shares of 1") : 0.0;
  };
  control.position_gain = number_within(table, "kv", 1e-3, 1e5, "1/s");
  control.velocity_gain =
      number_within(table, "kp", 1e-9, units.damping.most, units.damping.name) * units.damping.si;
  if (table.has("tn")) {
    control.integral_time = number_within(table, "tn", 1e-3, 1e6, "ms") / kMillisecondsPerSecond;
  }
  control.feed_forward_velocity = share("feed_forward_velocity");
  control.feed_forward_acceleration = share("feed_forward_acceleration");
  const bool forward = control.feed_forward_acceleration != 0.0;
  if (forward || table.has("reference_inertia")) {
    control.reference_inertia = number_within(table, "reference_inertia", 1e-9, 1e7, mass);
  }
  if (kind == kScrew) {
    control.motor_inertia = number_within(table, "motor_inertia", 1e-9, 1e7, mass);
    control.screw = read_spring(table, units);
    if (control.screw.stiffness == 0.0) {
      table.fail("stiffness", "out-of-range"_id, "a screw without stiffness moves nothing",
                 fmt::format("in {}", units.stiffness.name));
    }
  }
  if (table.has("scale")) {
    control.scale = Control::Scale{point_of(table, "scale"), attached(table)};
  }
  return control;
}

AxisModel read_axis(const TomlTable& table, const Joint& joint, int previous,
                    const RigidBody& body) {
  AxisModel axis{.joint = joint, .previous = previous, .body = body};
  const SpringUnits& units = joint.rotary() ? kTurning : kStraight;
  const char* other = joint.rotary() ? "carriage" : "bearing";
  if (table.has(other)) {
    table.fail(other, "wrong-connection"_id,
               joint.rotary() ? "carriages are of linear axes" : "bearings are of rotary axes",
               joint.rotary() ? "write bearing" : "write carriage");
  } else if (joint.rotary()) {
    for (const TomlTable& entry : table.tables("bearing")) {
      axis.bearings.push_back(read_bearing(entry));
    }
  } else {
    for (const TomlTable& entry : table.tables("carriage")) {
      axis.carriages.push_back(read_carriage(entry, joint));
    }
  }
  axis.drive = read_drive(table.table("drive"), units);
  if (const auto control = table.table_if("control")) axis.control = read_control(*control, joint);
  return axis;
}

DynamicModel read_tables(const TomlTable& table, const Machine& machine) {
  DynamicModel model{.name = machine.name(),
                     .tool_axes = machine.tool_chain().size(),
                     .spindle_offset = machine.spindle_offset()};
  model.workpiece_on_ground = table.choice_or("workpiece", {"bed", "ground"}, 0) == 1;
  if (model.workpiece_on_ground && !machine.work_chain().empty()) {
    table.fail(
        "workpiece", "wrong-connection"_id,
        fmt::format("the structure {} has axes that move the workpiece", machine.structure()),
        "only a table that no axis moves is on the ground");
  }
  const TomlTable bodies = table.table("body");
  model.bed = read_body(bodies.table("bed"));
  for (const TomlTable& entry : table.tables("mount")) model.mounts.push_back(read_mount(entry));
  const TomlTable axes = table.table("axis");
  const std::vector<Joint> joints = machine.joints();
  for (std::size_t k = 0; k < joints.size(); ++k) {
    const std::string letter(1, to_char(joints[k].letter));
    const bool first = k == 0 || k == model.tool_axes;
    model.axes.push_back(read_axis(axes.table(letter), joints[k],
                                   first ? -1 : static_cast<int>(k) - 1,
                                   read_body(bodies.table(letter))));
  }
  return model;
}

// Where the tables of the controls are; the document says it of what is wrong with them.
void find_places(const TomlDocument& document, const TomlTable& table, DynamicModel& model) {
  const TomlTable axes = table.table("axis");
  for (AxisModel& axis : model.axes) {
    if (!axis.control) continue;
    axes.table(std::string(1, to_char(axis.joint.letter)))
        .fail("control", "unstable-control"_id, "here");
    const Diagnostic place = document.finish().back();
    axis.control->place = {place.file, place.line, place.column};
  }
}

Result<std::optional<DynamicModel>> read_document(const TomlDocument& document,
                                                  const Machine& machine) {
  const TomlTable& root = document.root();
  // The rest of the file has been read by kinematics.
  for (const std::string& key : root.keys()) (void)root.has(key);
  const auto table = root.table_if("dynamics");
  if (!table) return std::optional<DynamicModel>{};
  DynamicModel model = read_tables(*table, machine);
  if (Diagnostics problems = document.finish(); has_error(problems)) return problems;
  if (const auto loose = loose_body(model, structure_at(model, machine.home(), 0.0))) {
    table->fail(loose->key, loose->problem);
    return document.finish();
  }
  find_places(document, *table, model);
  return std::optional(std::move(model));
}

}  // namespace

Result<std::optional<DynamicModel>> load_model(const std::filesystem::path& file,
                                               const Machine& machine) {
  return TomlDocument::load(file).and_then(
      [&](const TomlDocument& document) { return read_document(document, machine); });
}

Result<std::optional<DynamicModel>> read_model(std::string_view text,
                                               const std::filesystem::path& file,
                                               const Machine& machine) {
  return TomlDocument::parse(text, file).and_then([&](const TomlDocument& document) {
    return read_document(document, machine);
  });
}

Diagnostic no_dynamics(const Machine& machine, const std::filesystem::path& file) {
  Diagnostic problem = error("no-dynamics"_id,
                             fmt::format("machine {} states no masses and springs", machine.name()),
                             "add [dynamics] to its file: docs/dynamics.md");
  problem.file = file.string();
  problem.key = "dynamics";
  return problem;
}

}  // namespace frustum::dynamics

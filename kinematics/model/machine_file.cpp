// Reads a machine from its TOML file.
#include <fmt/format.h>

#include <Eigen/LU>
#include <cmath>
#include <numbers>

#include "core/toml_document.hpp"
#include "kinematics/model/machine.hpp"
#include "kinematics/model/structure_code.hpp"

namespace frustum::kinematics {
namespace {

Vec3 default_direction(AxisLetter letter) {
  return Vec3::Unit(static_cast<Eigen::Index>(letter) % 3);
}

// A direction must be given as a unit vector, so that a typing mistake is not scaled away.
Vec3 unit_direction(const TomlTable& table, std::string_view key, const Vec3& fallback) {
  const Vec3 direction = table.vector_or(key, fallback);
  constexpr double kWrittenDigits = 1e-9;  // a direction written with ten digits passes
  if (std::abs(direction.norm() - 1.0) > kWrittenDigits) {
    table.fail(key, "axis-directions"_id,
               fmt::format("the direction has length {}, not 1", direction.norm()),
               "give a unit vector");
    return fallback;
  }
  return direction.normalized();
}

}  // namespace

class MachineReader {
 public:
  static Result<Machine> read(const TomlDocument& document) {
    Machine machine;
    const TomlTable& root = document.root();
    machine.name_ = root.text("name");
    machine.title_ = root.text_or("title", machine.name_);
    (void)root.text_or("source", "");
    machine.structure_ = root.text("structure");
    machine.rotation_order_ =
        static_cast<RotationOrder>(root.choice_or("rotation_order", {"zyx", "xyz"}, 0));
    machine.rotary_error_frame_ =
        static_cast<RotaryErrorFrame>(root.choice_or("rotary_error_frame", {"stator", "rotor"}, 0));
    const auto structure = parse_structure(machine.structure_);
    if (!structure) {
      // Without a structure the rest has no meaning, but its keys are known.
      for (const char* key :
           {"datum", "spindle", "table", "axis", "alias", "controller", "bodies", "dynamics"}) {
        (void)root.has(key);
      }
      // One that is missing or no text has been reported.
      if (!machine.structure_.empty() || !has_error(document.finish())) {
        root.fail("structure", structure.error().front());
      }
      return document.finish();
    }
    if (const auto spindle = root.table_if("spindle")) {
      machine.spindle_offset_ = spindle->vector_or("offset", Vec3::Zero());
    }
    if (const auto table = root.table_if("table")) {
      machine.table_offset_ = table->vector_or("offset", Vec3::Zero());
    }
    const TomlTable axes = root.table("axis");
    for (const AxisLetter letter : structure->tool) {
      machine.tool_chain_.push_back(joint(axes, letter, +1));
    }
    for (const AxisLetter letter : structure->work) {
      machine.work_chain_.push_back(joint(axes, letter, -1));
    }
    for (const std::string& key : axes.keys()) {
      const auto letter = axis_letter(key);
      if (letter && machine.joint(*letter) != nullptr) continue;
      (void)axes.has(key);  // told here, not once more as an unknown key
      axes.fail(key, "structure-code"_id,
                letter ? fmt::format("axis {} is not in the structure {}", key, machine.structure_)
                       : fmt::format("'{}' is not an axis", key),
                letter ? "add it to the structure code or take its table away" : "X Y Z A B C");
    }
    check_space(root, machine);
    read_datum(root, machine);
    read_aliases(root, machine);
    read_controller(root, machine);
    machine.bodies_ = read_bodies(root, machine);
    (void)root.has("dynamics");  // read by the module dynamics
    if (Diagnostics problems = document.finish(); has_error(problems)) return problems;
    return machine;
  }

 private:
  static std::optional<AxisLetter> axis_letter(const std::string& text) {
    for (const AxisLetter letter : kAxisLetters) {
      if (text.size() == 1 && text[0] == to_char(letter)) return letter;
    }
    return std::nullopt;
  }

  static Joint joint(const TomlTable& axes, AxisLetter letter, int side) {
    const TomlTable table = axes.table(std::string(1, to_char(letter)));
    Joint joint{.letter = letter, .side = side};
    const double scale = is_rotary(letter) ? kRadPerDeg : 1.0;
    joint.direction = unit_direction(table, "direction", default_direction(letter));
    joint.offset = table.vector_or("offset", Vec3::Zero());
    joint.endless = table.boolean_or("endless", false);
    if (joint.endless && !joint.rotary()) {
      table.fail("endless", "axis-travel"_id, "a linear axis has a travel",
                 "write travel = [lowest, highest] in mm");
    }
    if (joint.endless) {
      joint.travel = {-std::numbers::pi, std::numbers::pi};
    } else {
      const auto travel = table.numbers("travel");
      if (travel.size() == 2 && travel[0] < travel[1]) {
        joint.travel = {travel[0] * scale, travel[1] * scale};
        constexpr double kMostDegrees = 360'000.0;  // 1000 turns
        if (is_rotary(letter) && std::max(-travel[0], travel[1]) > kMostDegrees) {
          table.fail("travel", "axis-travel"_id, "more than 1000 turns", "write endless = true");
          joint.travel = {-std::numbers::pi, std::numbers::pi};
        }
      } else if (!travel.empty()) {
        table.fail("travel", "axis-travel"_id, "expected [lowest, highest]",
                   is_rotary(letter) ? "in degrees, or endless = true" : "in mm");
      }
    }
    joint.dynamics = dynamics(table, scale);
    joint.home = table.number_or("home", 0.0) * scale;
    if (!joint.endless && !joint.travel.contains(joint.home)) {
      table.fail("home", "outside-travel"_id,
                 fmt::format("{} is outside the travel", joint.home / scale));
    }
    if (table.is_array("functional_point")) {
      joint.functional_point.point = table.vector("functional_point");
    } else if (table.has("functional_point")) {
      (void)table.choice("functional_point", {"tip"});
      joint.functional_point.at_tip = true;
    }
    return joint;
  }

  // The file writes mm/s or deg/s and so on; a limit of zero would be an axis that cannot move.
  static AxisDynamics dynamics(const TomlTable& axis, double scale) {
    const auto limit = [&](std::string_view key, double unit) {
      return axis.has(key) ? axis.number(key, Bound::positive) * unit : 0.0;
    };
    return {.velocity = limit("velocity", scale),
            .acceleration = limit("acceleration", scale),
            .jerk = limit("jerk", scale),
            .servo_gain = limit("servo_gain", 1.0)};
  }

  static void check_space(const TomlTable& root, const Machine& machine) {
    Mat3 directions = Mat3::Zero();
    std::vector<Vec3> rotary;
    for (const Joint& joint : machine.joints()) {
      if (joint.rotary()) {
        rotary.push_back(joint.direction);
      } else {
        directions.col(static_cast<Eigen::Index>(joint.letter)) = joint.direction;
      }
    }
    // 1e-3: axes within 0.06 deg of one plane are a mistake in the file, not a machine.
    if (std::abs(directions.determinant()) < 1e-3) {
      root.fail("axis", "axis-directions"_id, "the directions of X, Y and Z are in one plane",
                "they must span space");
    }
    if (rotary.size() == 2 && rotary[0].cross(rotary[1]).norm() < 1e-3) {
      root.fail("axis", "axis-directions"_id, "the two rotary axes are parallel",
                "they must orient the tool in two ways");
    }
  }

  static void read_datum(const TomlTable& root, Machine& machine) {
    for (const std::string& text : root.texts_or("datum", {})) {
      const auto letter = axis_letter(text);
      if (!letter || is_rotary(*letter)) {
        root.fail("datum", "reference-axes"_id, fmt::format("'{}' is not a linear axis", text),
                  "name the primary and the secondary reference axis, for example [\"X\", \"Y\"]");
        return;
      }
      machine.datum_.push_back(*letter);
    }
    if (machine.datum_.size() > 2 ||
        (machine.datum_.size() == 2 && machine.datum_[0] == machine.datum_[1])) {
      root.fail("datum", "reference-axes"_id, "expected at most two different axes");
      machine.datum_.clear();
    }
  }

  static void read_controller(const TomlTable& root, Machine& machine) {
    const auto table = root.table_if("controller");
    if (!table) return;
    for (const std::string& text : table->texts_or("words", {})) {
      if (const auto word = parser::control_word(text)) {
        machine.controller_.words.push_back(*word);
      } else {
        table->fail("words", word.error().front());
        return;
      }
    }
    if (table->has("units")) {
      std::vector<std::string> units;
      for (const auto unit : parser::kStartUnits) units.emplace_back(name_of(unit));
      machine.controller_.units = parser::kStartUnits.at(table->choice_or("units", units, 0));
    }
    if (table->has("max_blocks")) {
      machine.controller_.max_blocks =
          static_cast<std::uint64_t>(table->integer("max_blocks", Bound::positive));
    }
    if (!table->has("decimal_point")) return;
    std::vector<std::string> rules;
    for (const auto rule : parser::kDecimalPoints) rules.emplace_back(name_of(rule));
    machine.controller_.decimal_point =
        parser::kDecimalPoints.at(table->choice_or("decimal_point", rules, 0));
  }

  static void read_aliases(const TomlTable& root, Machine& machine) {
    const auto aliases = root.table_if("alias");
    if (!aliases) return;
    for (const std::string& symbol : aliases->keys()) {
      const TomlTable table = aliases->table(symbol);
      ErrorAlias alias;
      const std::string name = table.text("error");
      if (name.empty() && !table.has("error")) continue;
      const auto error = ErrorName::parse(name);
      if (!error) {
        table.fail("error", "unknown-error"_id, fmt::format("unknown error name '{}'", name),
                   "E, the direction X Y Z A B C, 0 for a location error, the axis: EXX, EB0C");
        continue;
      }
      if (machine.joint(error->axis) == nullptr) {
        table.fail("error", "unknown-axis"_id,
                   fmt::format("error {}: the structure {} has no axis {}", name,
                               machine.structure_, to_char(error->axis)));
        continue;
      }
      alias.error = *error;
      alias.scale = table.number_or("scale", 1.0);
      alias.carries = table.boolean_or("carries", false);
      alias.meaning = table.text_or("meaning", error->meaning());
      if (alias.carries &&
          (is_rotary(error->axis) || !error->location || !is_rotation(error->direction))) {
        table.fail("carries", "error-kind"_id,
                   "only an orientation error of a linear axis can carry");
      }
      machine.aliases_.emplace(symbol, std::move(alias));
    }
  }
};

Result<Machine> Machine::load(const std::filesystem::path& file) {
  return TomlDocument::load(file).and_then(
      [](const TomlDocument& document) { return MachineReader::read(document); });
}

Result<Machine> Machine::read(std::string_view text, const std::filesystem::path& file) {
  return TomlDocument::parse(text, file).and_then([](const TomlDocument& document) {
    return MachineReader::read(document);
  });
}

}  // namespace frustum::kinematics

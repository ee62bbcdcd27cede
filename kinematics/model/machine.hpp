// A machine tool: two chains of joints from the bed, read from a structure code and a TOML file.
//
// Model    : bed -> ... -> spindle gauge point and bed -> ... -> table, joints in the order of the
//            structure code "t-(C)-Z-Y-b-X-B-C-w" (tool first, b the bed, workpiece last; a letter
//            in parentheses is the spindle). Three linear and up to two rotary axes in any order,
//            on either side, in any direction.
// Units    : mm, rad inside; the file writes mm and degrees
// Errors   : every mistake of the file is reported with key and line: axis twice, no path from tool
//            to workpiece, directions that are not unit or do not span space, unknown error names,
//            ...
// Source   : ISO 10791 structure codes; ISO 841: +q moves the tool, relative to the work, in the
//            named direction, so that a workpiece-side axis moves by -q
#pragma once

#include <filesystem>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "core/pose.hpp"
#include "core/result.hpp"
#include "kinematics/model/axes.hpp"
#include "kinematics/model/geometric_errors.hpp"
#include "kinematics/model/machine_body.hpp"
#include "parser/control_settings.hpp"

namespace frustum::kinematics {

enum class RotationOrder : std::uint8_t { zyx, xyz };  // Rz Ry Rx, or Rx Ry Rz
enum class RotaryErrorFrame : std::uint8_t { stator, rotor };

// About which point an axis's angular component errors turn.
struct FunctionalPoint {
  bool at_tip = false;        // the tool tip, wherever it nominally is
  Vec3 point = Vec3::Zero();  // else: in the joint's moving frame
};

// What an axis's drive can do. Zero: no limit stated, an axis that follows at once.
struct AxisDynamics {
  double velocity = 0.0;      // mm/s or rad/s
  double acceleration = 0.0;  // mm/s^2 or rad/s^2
  double jerk = 0.0;          // mm/s^3 or rad/s^3
  double servo_gain = 0.0;    // 1/s: position loop gain Kv of a first-order lag
};

struct Joint {
  AxisLetter letter = AxisLetter::X;
  int side = +1;                   // +1 tool side, -1 workpiece side
  Vec3 direction = Vec3::UnitX();  // unit: of +q of the tool relative to the work
  Vec3 offset = Vec3::Zero();      // of the joint's frame in the one before, at q = 0
  AxisRange travel{};
  bool endless = false;  // rotary axis without limits (travel spans one turn)
  double home = 0.0;
  FunctionalPoint functional_point{};
  AxisDynamics dynamics{};

  [[nodiscard]] bool rotary() const { return is_rotary(letter); }
};

// A symbol of a paper that represents an ISO error, perhaps with another sign.
struct ErrorAlias {
  ErrorName error{};
  double scale = 1.0;
  bool carries = false;  // linear axis: the tilt also turns what the axis carries
  std::string meaning{};
};

// How the machine's control reads programs, as far as its builder or its parameters decide it.
struct ControllerWords {
  std::vector<parser::ControlWord> words{};  // of the builder, which move nothing: M31
  std::optional<parser::DecimalPoint> decimal_point{};
  std::optional<parser::LengthUnit> units{};  // before G20 and G21
  std::optional<std::uint64_t> max_blocks{};  // that run again

  [[nodiscard]] parser::ControlSettings settings() const;
};

class Machine {
 public:
  [[nodiscard]] static Result<Machine> load(const std::filesystem::path& file);
  // From the text of such a file; `file` names it in diagnostics.
  [[nodiscard]] static Result<Machine> read(std::string_view text,
                                            const std::filesystem::path& file);

  [[nodiscard]] const std::string& name() const { return name_; }
  [[nodiscard]] const std::string& title() const { return title_; }
  [[nodiscard]] const std::string& structure() const { return structure_; }
  // Bed outwards.
  [[nodiscard]] const std::vector<Joint>& tool_chain() const { return tool_chain_; }
  [[nodiscard]] const std::vector<Joint>& work_chain() const { return work_chain_; }
  [[nodiscard]] const Vec3& spindle_offset() const { return spindle_offset_; }
  [[nodiscard]] const Vec3& table_offset() const { return table_offset_; }
  [[nodiscard]] RotationOrder rotation_order() const { return rotation_order_; }
  [[nodiscard]] RotaryErrorFrame rotary_error_frame() const { return rotary_error_frame_; }
  [[nodiscard]] const std::map<std::string, ErrorAlias>& aliases() const { return aliases_; }

  [[nodiscard]] const ControllerWords& controller() const { return controller_; }
  // What may collide; none: the file states no bodies.
  [[nodiscard]] const std::vector<MachineBody>& bodies() const { return bodies_; }

  // All joints: tool chain, then work chain.
  [[nodiscard]] std::vector<Joint> joints() const;
  [[nodiscard]] const Joint* joint(AxisLetter letter) const;
  [[nodiscard]] AxisPositions home() const;
  // The primary and the secondary reference axis of ISO 230-1, as far as the file names them.
  [[nodiscard]] const std::vector<AxisLetter>& datum() const { return datum_; }
  // Why the choice of reference axes makes this error zero; nothing when it is accepted.
  [[nodiscard]] std::optional<std::string> refused(const ErrorName& error) const {
    return refused(error, datum_);
  }
  // The same for another choice.
  [[nodiscard]] std::optional<std::string> refused(const ErrorName& error,
                                                   std::span<const AxisLetter> datum) const;
  // Every ISO error name that the machine accepts, axis by axis.
  [[nodiscard]] std::vector<ErrorName> error_names() const;

 private:
  friend class MachineReader;
  Machine() = default;

  std::string name_;
  std::string title_;
  std::string structure_;
  std::vector<Joint> tool_chain_;
  std::vector<Joint> work_chain_;
  Vec3 spindle_offset_ = Vec3::Zero();
  Vec3 table_offset_ = Vec3::Zero();
  RotationOrder rotation_order_ = RotationOrder::zyx;
  RotaryErrorFrame rotary_error_frame_ = RotaryErrorFrame::stator;
  std::vector<AxisLetter> datum_;  // ISO 230-1 primary and secondary axis
  std::map<std::string, ErrorAlias> aliases_;
  ControllerWords controller_;
  std::vector<MachineBody> bodies_;
};

}  // namespace frustum::kinematics

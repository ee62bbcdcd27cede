#include "app/motion/setup_sheet.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "app/motion/bar_clearance.hpp"
#include "core/constants.hpp"
#include "core/decimal.hpp"
#include "kinematics/model/chain.hpp"
#include "kinematics/model/inverse.hpp"

namespace frustum::app {
namespace {

using report::Wording;

// mm with three decimals, inches with four.
std::string shown_mm(double mm, const Wording& words) {
  return words.number(fixed_decimal(words.shown(mm, "mm"), words.is_inch() ? 4 : 3));
}

std::string place_text(const Vec3& v, const Wording& words) {
  return fmt::format("X {} Y {} Z {}", shown_mm(v.x(), words), shown_mm(v.y(), words),
                     shown_mm(v.z(), words));
}

// Corners of a body in the frame of the table.
std::vector<Vec3> corners_of(const kinematics::MachineBody& body, const Pose& table_from_part) {
  std::vector<Vec3> corners;
  if (const auto* box = std::get_if<kinematics::BoxBody>(&body.shape)) {
    for (int k = 0; k < 8; ++k) {
      corners.emplace_back(((k & 1) != 0 ? 0.5 : -0.5) * box->size.x(),
                           ((k & 2) != 0 ? 0.5 : -0.5) * box->size.y(),
                           (k & 4) != 0 ? box->size.z() : 0.0);
    }
  } else if (const auto* round = std::get_if<kinematics::CylinderBody>(&body.shape)) {
    constexpr int kCorners = 48;
    for (int k = 0; k < kCorners; ++k) {
      const double angle = kTurn * k / kCorners, r = 0.5 * round->diameter;
      corners.emplace_back(r * std::cos(angle), r * std::sin(angle), 0.0);
      corners.emplace_back(r * std::cos(angle), r * std::sin(angle), round->height);
    }
  }
  for (Vec3& corner : corners) corner = (table_from_part * body.part_from_body).point(corner);
  return corners;
}

// The line of a rotary axis in the frame of the table, with the direction about which its part
// turns as it grows.
std::optional<report::BarDrawing::Axis> turning_axis(const kinematics::Machine& machine,
                                                     const std::string& letter_text,
                                                     const kinematics::AxisPositions& q) {
  const auto letter = kinematics::axis_named(letter_text);
  const kinematics::Joint* joint = letter ? machine.joint(*letter) : nullptr;
  if (joint == nullptr || !joint->rotary()) return std::nullopt;
  const kinematics::GeometricErrors none;
  const kinematics::ForwardChain nominal(machine, none, 0.0);
  constexpr double kStep = 0.5;  // rad: far from nothing and from half a turn
  kinematics::AxisPositions on = q;
  on[*letter] += kStep;
  const auto part = [&](const kinematics::AxisPositions& at) {
    return joint->side > 0 ? nominal.bed_from_tool(at) : nominal.bed_from_table(at);
  };
  const Pose moved = part(on) * part(q).inverse();
  const Mat3& r = moved.rotation;
  const Vec3 direction = Vec3(r(2, 1) - r(1, 2), r(0, 2) - r(2, 0), r(1, 0) - r(0, 1)).normalized();
  const Vec3 across = moved.translation - moved.translation.dot(direction) * direction;
  const Vec3 point = 0.5 * (across + direction.cross(across) / std::tan(0.5 * kStep));
  const Pose table_from_bed = nominal.bed_from_table(q).inverse();
  return report::BarDrawing::Axis{table_from_bed.point(point), table_from_bed.direction(direction)};
}

// What is on the table, with the bar where the program stops for it.
report::BarDrawing drawing_of(const SetupSheet& sheet, const programs::BarPass& pass,
                              const Wording& words) {
  const auto& machine = sheet.machine;
  const auto& test = sheet.test;
  report::BarDrawing drawing{.title = words("Set-up on the table"),
                             .table_ball = test.table_ball,
                             .offset = sheet.program.work_offsets.at(1),
                             .tool_length = test.tool_length,
                             .parameter = words("{0} grows", sheet.parameter)};
  constexpr int kLooks = 180;
  constexpr double kFeedIn = 1.5;  // mm
  for (int i = 0; i <= kLooks; ++i) {
    const auto q = test.motion.axes(std::lerp(pass.from, pass.to, i / double{kLooks}));
    const Pose tool = nominal_pose(machine, q, test.tool_length);
    if (i == 0) {
      drawing.tool_axis = tool.rotation.col(2);
      const Vec3 outward = (tool.translation - test.table_ball).normalized();
      drawing.path.push_back(tool.translation + kFeedIn * outward);
    }
    drawing.path.push_back(tool.translation);
  }
  drawing.turning = turning_axis(machine, sheet.parameter, test.motion.axes(pass.from));
  const kinematics::MachinePart table{-1, machine.work_chain().size()};
  const Pose table_from_part = Pose::translated(-machine.table_offset());
  for (const kinematics::MachineBody& body : machine.bodies()) {
    const bool on_bed = table.joints == 0 && body.part.side == 0;
    if (!on_bed && !(body.part == table)) continue;
    drawing.bodies.push_back({words.word(body.name), corners_of(body, table_from_part)});
  }
  return drawing;
}

// The rows of the sheet as the page shows them, and of setup.csv, which is in English and mm.
class SheetRows {
 public:
  explicit SheetRows(const Wording& words)
      : words_(words),
        table_{.heading = words("Set-up sheet"),
               .columns = {words("what"), words("where or how much")}} {}

  template <typename Name, typename Value>
  void add(const Name& name, const Value& value) {
    table_.rows.push_back({name(words_), value(words_)});
    const Wording plain;
    csv_ += fmt::format("\"{}\",\"{}\"\n", name(plain), value(plain));
  }
  [[nodiscard]] const report::MotionTable& table() const { return table_; }
  [[nodiscard]] const std::string& csv() const { return csv_; }

 private:
  const Wording& words_;
  report::MotionTable table_;
  std::string csv_ = "what,value\n";
};

// Of an axis over the pass, mm or degrees.
void add_travel(SheetRows& rows, const kinematics::Joint& joint, double low, double high) {
  const char* const unit = joint.rotary() ? "deg" : "mm";
  const double factor = joint.rotary() ? kDegPerRad : 1.0;
  rows.add(
      [&](const Wording& w) { return fmt::format("{}, {}", to_char(joint.letter), w.unit(unit)); },
      [&](const Wording& w) {
        const auto three = [&](double value) {
          return w.number(fmt::format("{:.3f}", w.shown(value, unit)));
        };
        const auto stated = [&](double value) {
          return w.general(w.shown(as_stated(value * factor), unit));
        };
        if (joint.endless) return w("{0} to {1}, endless", three(low), three(high));
        return w("{0} to {1} of {2} to {3}", three(low), three(high), stated(joint.travel.lo),
                 stated(joint.travel.hi));
      });
}

std::string distance_text(double mm, const Wording& words) {
  return words.number(fmt::format("{:.{}f}", words.shown(mm, "mm"), words.is_inch() ? 2 : 1)) +
         " " + std::string(words.unit("mm"));
}

}  // namespace

std::optional<Diagnostics> add_setup_sheet(MotionAnswer& answer, const SetupSheet& sheet) {
  const auto& [machine, test, program, parameter, stroke, readings] = sheet;
  SheetRows rows(answer.words);
  const Vec3& origin = program.work_offsets.at(1);
  const auto positions = place_tip(machine, origin, 0.0, {});
  const Vec3 machine_origin(positions[kinematics::AxisLetter::X],
                            positions[kinematics::AxisLetter::Y],
                            positions[kinematics::AxisLetter::Z]);
  rows.add([&](const Wording& w) { return w("NC program"); },
           [&](const Wording&) { return program.program_file; });
  const auto add_place = [&](const auto& name, const Vec3& v) {
    rows.add(name, [&](const Wording& w) { return place_text(v, w); });
  };
  add_place([](const Wording& w) { return w("G54 in the frame of the table, {0}", w.unit("mm")); },
            origin);
  add_place(
      [](const Wording& w) {
        return w("G54 in machine coordinates, without tool, {0}", w.unit("mm"));
      },
      machine_origin);
  rows.add([](const Wording& w) { return w("T1: spindle ball, length, {0}", w.unit("mm")); },
           [&](const Wording& w) { return w.general(w.shown(test.tool_length, "mm")); });
  add_place(
      [](const Wording& w) { return w("table ball in the frame of the table, {0}", w.unit("mm")); },
      test.table_ball);
  rows.add([](const Wording& w) { return w("bar, {0}", w.unit("mm")); },
           [&](const Wording& w) { return shown_mm(test.bar, w); });
  const auto [least, most] =
      std::ranges::minmax_element(test.poses, {}, &instruments::TestPose::parameter);
  const programs::BarPass pass = programs::pass_of(machine, test);
  const auto six_digits = [](double value, const Wording& w) {
    return w.number(fmt::format("{:.6g}", value));
  };
  rows.add([&](const Wording& w) { return w("capture, deg of {0}", parameter); },
           [&](const Wording& w) {
             return w("{0} to {1}", six_digits(least->parameter * kDegPerRad, w),
                      six_digits(most->parameter * kDegPerRad, w));
           });
  rows.add([](const Wording& w) { return w("with overshoot, deg"); },
           [&](const Wording& w) {
             return w("{0} to {1}", w.general(as_stated(pass.from * kDegPerRad)),
                      w.general(as_stated(pass.to * kDegPerRad)));
           });
  constexpr int kLooks = 720;  // of a pass, for the travels that it takes
  Document travels;
  for (const kinematics::Joint& joint : machine.joints()) {
    double low = 0.0, high = 0.0;
    for (int i = 0; i <= kLooks; ++i) {
      const double q =
          test.motion.axes(pass.from + (pass.to - pass.from) * i / kLooks)[joint.letter];
      low = i == 0 ? q : std::min(low, q);
      high = i == 0 ? q : std::max(high, q);
    }
    const double unit = joint.rotary() ? kDegPerRad : 1.0;
    const std::string name(1, to_char(joint.letter));
    add_travel(rows, joint, low * unit, high * unit);
    travels[name] = std::vector<double>{low * unit, high * unit};
  }
  double largest = 0.0;
  for (const double reading : readings) largest = std::max(largest, std::abs(reading));
  rows.add([](const Wording& w) { return w("largest reading, of the stroke"); },
           [&](const Wording& w) {
             return w("{0} {2} of {1} {2}",
                      w.number(fmt::format("{:.1f}", w.shown(largest * kUmPerMm, "um"))),
                      w.general(w.shown(stroke * kUmPerMm, "um")), w.unit("um"));
           });
  const auto clearance = bar_clearance(machine, test, pass);
  if (!clearance) return clearance.error();
  if (*clearance && !((*clearance)->distance > 0.0)) {
    const BarClearance& met = **clearance;
    return Diagnostics{error(
        "setup-collides"_id,
        fmt::format("{} and {} meet at {} = {:.4g} deg", met.first, met.second, parameter,
                    met.parameter * kDegPerRad),
        "put the table ball higher or farther from there, take a longer tool, or capture less "
        "(--angles)")};
  }
  const auto nearest_in = [&](const Wording& w) {
    if (!*clearance) return w("the machine file has no bodies: not looked for");
    const double at = as_stated((*clearance)->parameter * kDegPerRad);
    return w("{0} between {1} and {2}, at {3} deg", distance_text((*clearance)->distance, w),
             w.word((*clearance)->first), w.word((*clearance)->second),
             w.number(fmt::format("{:.4g}", at)));
  };
  rows.add([](const Wording& w) { return w("nearest approach"); }, nearest_in);
  if (const double least_angle = least_angle_at_stem(machine, test, pass);
      least_angle < kBarBesideStem) {
    answer.warnings.push_back(warning(
        "bar-along-stem"_id,
        fmt::format("the bar comes within {:.3g} deg of the stem of its own spindle ball, above "
                    "which the spindle is",
                    least_angle * kDegPerRad),
        "capture less (--angles): upright circles are usually run from -20 to 200 deg"));
  }
  report::MotionTable table = rows.table();
  constexpr double kMountedLonger = 1.5;  // mm
  table.note = answer.words(
      "The bar is mounted {0} too long, where the program stops. Travels are those of the pass.",
      answer.words.amount(kMountedLonger, "mm"));
  if (*clearance && !(*clearance)->spindle) {
    table.note +=
        answer.words(" Without a tool length of {0} or more the spindle is not looked at.",
                     answer.words.amount(kLeastStem, "mm"));
  }
  answer.page.setup = drawing_of(sheet, pass, answer.words);
  answer.document["setup_sheet"] =
      Document{{"g54_in_table_mm", coordinates(origin)},
               {"capture_deg",
                std::vector<double>{least->parameter * kDegPerRad, most->parameter * kDegPerRad}},
               {"pass_deg", std::vector<double>{pass.from * kDegPerRad, pass.to * kDegPerRad}},
               {"travels", travels},
               {"largest_reading_um", largest * kUmPerMm},
               {"stroke_um", stroke * kUmPerMm},
               {"nearest_mm", *clearance ? std::optional((*clearance)->distance) : std::nullopt},
               {"nearest", nearest_in(Wording())}};
  answer.page.tables.push_back(std::move(table));
  answer.files["setup.csv"] = rows.csv();
  return std::nullopt;
}

}  // namespace frustum::app

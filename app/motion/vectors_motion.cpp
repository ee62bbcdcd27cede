#include "app/motion/vectors_motion.hpp"

#include <fmt/format.h>

#include "app/view/text_table.hpp"
#include "core/decimal.hpp"
#include "kinematics/errors/axis_vectors.hpp"

namespace frustum::app {
namespace {

using kinematics::AxisVectors;

constexpr report::Phrase kSigns(
    "Signs: a direction is that of +q by the right-hand rule. +q of an axis of the head turns the "
    "tool about it; +q of an axis of the table turns the table the other way (ISO 841).\n"
    "\n"
    "      Z                    table: point = X Y Z at which the gauge point of the spindle,\n"
    "      |   / direction             without a tool, is on the axis\n"
    "      |  o point           head:  point = from the axis to the gauge point, the axes at zero\n"
    "      | /\n"
    "      |/________ X         A control whose table is zero where it stands at q = 0 needs no\n"
    "     /                     more than these: along an axis its point is free.\n"
    "    Y\n");

// Of a vector in the shown unit of `unit`, which its numbers times `factor` are in; `decimals` of
// millimetres, two more of inches.
std::string vector_text(const Vec3& v, double factor, const char* unit, int decimals,
                        const report::Wording& words) {
  const int more = words.shown(1.0, unit) < 0.1 ? 2 : 0;
  const auto one = [&](double value) {
    return words.number(fixed_decimal(words.shown(value * factor, unit), decimals + more));
  };
  return one(v.x()) + between(words) + one(v.y()) + between(words) + one(v.z());
}

// "EXC", not "EX0C" or "dx_AY".
bool is_of_motion(const kinematics::ErrorEntry& entry) {
  constexpr std::size_t kLetters = 3;
  return entry.grid != nullptr || entry.name.size() == kLetters;
}

}  // namespace

Result<MotionAnswer> vectors_answer(const MotionWords& words) {
  const auto setup = motion_setup(words);
  if (!setup) return setup.error();
  const auto vectors = kinematics::axis_vectors(setup->machine, setup->errors);
  if (vectors.empty()) {
    return error("no-rotary-axis"_id,
                 fmt::format("machine {} has no rotary axes", setup->machine.name()));
  }
  MotionAnswer answer =
      answer_of("vectors", setup->words("Kinematic vectors of the rotary axes"), *setup);
  for (const kinematics::ErrorEntry& entry : setup->entries) {
    if (!is_of_motion(entry)) continue;
    answer.warnings.push_back(warning(
        "error-not-used"_id,
        fmt::format(
            "{} is an error of motion, which changes along its axis: the lines are those of "
            "the location errors alone",
            entry.name),
        "a table of the control for each axis takes errors of motion; frustum identify states "
        "location errors"));
  }
  const report::Wording& wording = answer.words;
  const std::vector<std::string> columns{wording("axis"),
                                         wording("of the"),
                                         wording("point {0}", wording.unit("mm")),
                                         wording("off by {0}", wording.unit("um")),
                                         wording("direction"),
                                         wording("off by {0}", "urad")};
  TextTable table(columns);
  report::MotionTable shown{.heading = wording("Lines of the rotary axes, all axes at zero"),
                            .columns = columns};
  Document axes;
  std::string csv = "axis,side,x_mm,y_mm,z_mm,i,j,k,dx_um,dy_um,dz_um,di_urad,dj_urad,dk_urad\n";
  for (const AxisVectors& each : vectors) {
    const std::string name(1, to_char(each.axis)), side = each.side < 0 ? "table" : "head";
    const Vec3 off = each.actual.point - each.nominal.point;
    const Vec3 turned = each.actual.direction - each.nominal.direction;
    const std::vector<std::string> cells{name,
                                         wording.word(side),
                                         vector_text(each.actual.point, 1.0, "mm", 4, wording),
                                         vector_text(off, kUmPerMm, "um", 2, wording),
                                         vector_text(each.actual.direction, 1.0, "", 7, wording),
                                         vector_text(turned, kUradPerRad, "urad", 2, wording)};
    table.row(cells);
    shown.rows.push_back(cells);
    axes[name] = Document{{"side", side},
                          {"point_mm", coordinates(each.actual.point)},
                          {"direction", coordinates(each.actual.direction)},
                          {"nominal_point_mm", coordinates(each.nominal.point)},
                          {"nominal_direction", coordinates(each.nominal.direction)},
                          {"from_previous_mm", coordinates(each.from_previous)},
                          {"point_off_um", coordinates(off, kUmPerMm)},
                          {"direction_off_urad", coordinates(turned, kUradPerRad)}};
    csv += name + "," + side;
    for (const auto& [v, factor] :
         {std::pair{each.actual.point, 1.0}, std::pair{each.actual.direction, 1.0},
          std::pair{off, kUmPerMm}, std::pair{turned, kUradPerRad}}) {
      for (Eigen::Index k = 0; k < 3; ++k) csv += "," + shortest_decimal(v[k] * factor);
    }
    csv += "\n";
  }
  shown.note = wording("Between the axes of a side: from_previous_mm of the document.");
  answer.page.tables.push_back(std::move(shown));
  answer.document["vectors"] = axes;
  answer.files["vectors.csv"] = std::move(csv);
  answer.text += table.text() + "\n" + wording(kSigns);
  return answer;
}

}  // namespace frustum::app

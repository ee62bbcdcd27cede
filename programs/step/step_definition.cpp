// The eleven patterns and the two workpieces as tables.
#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "programs/step/step_pattern.hpp"

namespace frustum::programs {
namespace {

constexpr double kQuarter = 0.5 * std::numbers::pi;
constexpr double kEighth = 0.25 * std::numbers::pi;

const Vec3 kX = Vec3::UnitX();
const Vec3 kY = Vec3::UnitY();

StepPass pass(double tilt, double turn, const Vec3& feed, const Vec3& side) {
  return {tilt, turn, feed, side};
}

// Reference steps fed along X, first on the -Y side, or along Y, first on the +X side.
std::array<StepPass, 4> fed_along_x(double turn, const StepPass& c, const StepPass& d) {
  return {pass(0, turn, -kX, -kY), pass(0, turn, kX, kY), c, d};
}
std::array<StepPass, 4> fed_along_y(double turn, const StepPass& c, const StepPass& d) {
  return {pass(0, turn, -kY, kX), pass(0, turn, kY, -kX), c, d};
}

std::vector<StepPattern> all_patterns() {
  using enum StepKind;
  using enum SideCutBy;
  const double q = kQuarter;
  const double e = kEighth;
  const Vec3 down_y = Vec3(0, -1, -1).normalized();
  const Vec3 down_minus_y = Vec3(0, 1, -1).normalized();
  constexpr double kSlope = 10.0;  // mm: the side edge reaches so far below the line on a chamfer
  // Leaning over the feed, the tool cuts an ellipse below its tip: no deeper, for the sake of
  // pattern 3.
  constexpr double kLeaning = 3.0;
  return {
      {"1-a", step, side_edge, fed_along_x(0, pass(0, 0, -kX, -kY), pass(0, -2 * q, -kX, -kY)), 0.0,
       kX, kY, kY, ""},
      {"1-b", step, side_edge, fed_along_x(-q, pass(0, -q, -kX, -kY), pass(0, -3 * q, -kX, -kY)),
       0.0, -kY, kX, kX, ""},
      {"2-a", step, side_edge, fed_along_y(0, pass(0, 0, -kY, kX), pass(0, -2 * q, -kY, kX)), 0.0,
       kY, -kX, -kX, ""},
      {"2-b", step, side_edge, fed_along_y(-q, pass(0, -q, -kY, kX), pass(0, -3 * q, -kY, kX)), 0.0,
       kX, kY, kY, ""},
      {"3", step, bottom_edge, fed_along_y(0, pass(-q, -q, -kX, -kY), pass(-q, -3 * q, -kX, -kY)),
       0.0, kY, -kX, -kX, "ref", "3 or 4"},
      {"4", step, bottom_edge, fed_along_y(0, pass(-q, -q, -kX, -kY), pass(q, -q, kX, kY)), 0.0, kY,
       -kX, -kX, "ref", "3 or 4"},
      {"5-a", chamfer, side_edge, fed_along_y(0, pass(-e, 0, -kX, -kY), pass(e, 0, kX, kY)), kSlope,
       kX, kY, -kX, "ref"},
      {"5-b", chamfer, side_edge, fed_along_y(0, pass(-e, -q, -kX, -kY), pass(-e, q, -kX, -kY)),
       kSlope, -kY, kX, -kX, "ref"},
      {"6-a", chamfer, bottom_edge, fed_along_y(0, pass(e, 0, kX, kY), pass(-e, 0, -kX, -kY)), 0.0,
       kX, kY, -kX, "ref"},
      {"6-b", chamfer, bottom_edge, fed_along_y(0, pass(-e, q, -kX, -kY), pass(-e, -q, -kX, -kY)),
       0.0, -kY, kX, -kX, "ref"},
      {"7", side, side_edge, fed_along_y(0, pass(-e, 0, down_y, kX), pass(e, 0, down_minus_y, -kX)),
       kLeaning, kY, -kX, -kX, "ref"},
  };
}

// A stack of four levels, each 5 mm high and wide, on a base.
StepWorkpiece workpiece_1() {
  StepWorkpiece piece{.number = 1, .centre_x = 3.941, .centre_y = -96.376};
  piece.sizes = {{"1-a", 175.4, 61.0, 56.8, 170.4, 71.0},
                 {"1-b", 165.4, 76.8, 81.0, 160.4, 86.8},
                 {"2-a", 175.4, 56.8, 61.0, 170.4, 66.8},
                 {"2-b", 165.4, 81.0, 76.8, 160.4, 91.0}};
  piece.body.sections = {{130.0, 106.8, 111.0}, {160.4, 106.8, 111.0}, {160.4, 86.8, 91.0},
                         {165.4, 86.8, 91.0},   {165.4, 76.8, 81.0},   {170.4, 76.8, 81.0},
                         {170.4, 66.8, 71.0},   {175.4, 66.8, 71.0},   {175.4, 56.8, 61.0},
                         {180.4, 56.8, 61.0}};
  return piece;
}

// Reference level, step of pattern 3, block of pattern 7, and a pyramid of 45 deg faces that
// patterns 5 (upper half) and 6 (lower half) share.
StepWorkpiece workpiece_2() {
  StepWorkpiece piece{.number = 2, .centre_x = 3.677, .centre_y = -97.15};
  piece.sizes = {{"3", 143.9, 86.5, 91.0, 138.9, 96.5},   {"4", 143.9, 86.5, 91.0, 138.9, 96.5},
                 {"5-a", 179.2, 37.5, 29.4, 138.9, 96.5}, {"5-b", 179.2, 33.0, 33.9, 138.9, 96.5},
                 {"6-a", 169.2, 57.5, 49.4, 138.9, 96.5}, {"6-b", 169.2, 53.0, 53.9, 138.9, 96.5},
                 {"7", 160.9, 76.5, 81.0, 138.9, 96.5}};
  // The foot of the pyramid is just below what the tool of pattern 6 reaches (162.13), so that no
  // ridge is left, and above the line of pattern 7.
  constexpr double kFoot = 162.0;
  constexpr double kTop = 184.0;
  const auto pyramid = [](double z) {
    return stock::LoftSection{z, 33.0 + 2.0 * (179.2 - z), 37.5 + 2.0 * (179.2 - z)};
  };
  piece.body.sections = {{110.0, 116.5, 121.0}, {138.9, 116.5, 121.0}, {138.9, 96.5, 101.0},
                         {143.9, 96.5, 101.0},  {143.9, 86.5, 91.0},   {151.0, 86.5, 91.0},
                         {151.0, 76.5, 81.0},   {kFoot, 76.5, 81.0},   pyramid(kFoot),
                         pyramid(kTop)};
  return piece;
}

}  // namespace

char to_char(StepName step) { return static_cast<char>('a' + static_cast<int>(step)); }

std::span<const StepPattern> step_patterns() {
  static const std::vector<StepPattern> kPatterns = all_patterns();
  return kPatterns;
}

const StepPattern* find_step_pattern(std::string_view name) {
  for (const StepPattern& pattern : step_patterns()) {
    if (pattern.name == name) return &pattern;
  }
  return nullptr;
}

bool cut_the_same_surfaces(const StepPattern& a, const StepPattern& b) {
  return a.name == b.name || (!a.shared_steps.empty() && a.shared_steps == b.shared_steps);
}

std::vector<const StepPattern*> reference_patterns(std::span<const std::string> patterns) {
  std::vector<const StepPattern*> owners;
  for (const std::string& name : patterns) {
    const StepPattern* pattern = find_step_pattern(name);
    const bool known = std::any_of(owners.begin(), owners.end(), [&](const StepPattern* owner) {
      return owner->reference() == pattern->reference();
    });
    if (!known) owners.push_back(pattern);
  }
  return owners;
}

const StepSize* StepWorkpiece::size(std::string_view pattern) const {
  const auto found = std::find_if(sizes.begin(), sizes.end(),
                                  [&](const StepSize& s) { return s.pattern == pattern; });
  return found == sizes.end() ? nullptr : &*found;
}

std::optional<StepWorkpiece> step_workpiece(int number) {
  if (number == 1) return workpiece_1();
  if (number == 2) return workpiece_2();
  return std::nullopt;
}

StepWorkpiece raised(StepWorkpiece workpiece, double mm) {
  for (StepSize& size : workpiece.sizes) {
    size.height += mm;
    size.reference_height += mm;
  }
  for (stock::LoftSection& section : workpiece.body.sections) section.z += mm;
  return workpiece;
}

std::vector<std::string> patterns_together(const StepWorkpiece& workpiece) {
  std::vector<std::string> names;
  for (const StepPattern& pattern : step_patterns()) {
    const bool cut_already = std::any_of(names.begin(), names.end(), [&](const std::string& other) {
      return cut_the_same_surfaces(pattern, *find_step_pattern(other));
    });
    if (workpiece.size(pattern.name) != nullptr && !cut_already) names.emplace_back(pattern.name);
  }
  return names;
}

StepLine step_line(const StepWorkpiece& workpiece, const StepPattern& pattern, StepName step,
                   double tool_radius, std::optional<double> depth) {
  const StepSize& size = *workpiece.size(pattern.name);
  const bool reference = step == StepName::a || step == StepName::b;
  const StepPass& pass = pattern.pass(step);
  const Mat3 workpiece_from_machine = rotation_z(pass.turn) * rotation_x(pass.tilt);
  StepLine line;
  line.feed = workpiece_from_machine * pass.feed;
  line.side = workpiece_from_machine * pass.side;
  line.axis = workpiece_from_machine * Vec3::UnitZ();
  const bool second = step == StepName::b || step == StepName::d;
  const double half = 0.5 * (reference ? size.reference_width : size.width);
  const Vec3& across = reference ? pattern.across_reference : pattern.across;
  line.on_side = workpiece.centre() + (second ? half : -half) * across +
                 (reference ? size.reference_height : size.height) * Vec3::UnitZ();
  // On a chamfer cut by the bottom edge the tip runs on the line itself.
  const bool on_line = !reference && pattern.kind == StepKind::chamfer &&
                       pattern.side_cut_by == SideCutBy::bottom_edge;
  const Vec3 up = (line.axis - line.feed * line.feed.dot(line.axis)).normalized();
  line.tip = line.on_side + (on_line ? 0.0 : tool_radius) * line.side -
             (reference ? 0.0 : depth.value_or(pattern.depth)) * up;
  return line;
}

}  // namespace frustum::programs

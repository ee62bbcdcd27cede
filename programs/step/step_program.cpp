#include "programs/step/step_program.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <initializer_list>
#include <map>
#include <utility>

#include "kinematics/model/inverse.hpp"
#include "parser/writing/number_text.hpp"
#include "programs/step/step_path.hpp"

namespace frustum::programs {
namespace {

using kinematics::AxisLetter;
using kinematics::AxisPositions;
using kinematics::Machine;

Vec3 linear_part(const AxisPositions& q) {
  return {q[AxisLetter::X], q[AxisLetter::Y], q[AxisLetter::Z]};
}

// "-Y", for a machine direction along an axis.
std::string direction_name(const Vec3& direction) {
  Eigen::Index k = 0;
  direction.cwiseAbs().maxCoeff(&k);
  return fmt::format("{}{}", direction[k] < 0.0 ? '-' : '+', "XYZ"[k]);
}

std::string upper(std::string text) {
  for (char& c : text) {
    if (c >= 'a' && c <= 'z') c = static_cast<char>(c - 'a' + 'A');
  }
  return text;
}

double radius_of(const stock::LoftShape& blank, const Vec3& centre) {
  double radius = 0.0;
  for (const stock::LoftSection& s : blank.sections) {
    const Vec3 farthest(std::abs(centre.x()) + 0.5 * s.size_x,
                        std::abs(centre.y()) + 0.5 * s.size_y, s.z);
    radius = std::max(radius, farthest.norm());
  }
  return radius;
}

class Places {
 public:
  Places(const StepTest& test, const Machine& machine, const TiltingTable& table,
         const stock::LoftShape& blank, const Placement& placement)
      : test_(test),
        machine_(machine),
        table_(table),
        blank_(blank),
        placement_(placement),
        origin_(kinematics::place_tip(machine, table.crossing, test.tool_length.value, {})) {}

  void add(const StepPattern& pattern, StepName step, std::string name, std::string owner) {
    const StepPass& pass = pattern.pass(step);
    const double radius = 0.5 * test_.tool_diameter.value;
    const StepLine line = step_line(test_.workpiece, pattern, step, radius);
    const StepRun run = step_run(line, test_.workpiece.size(pattern.name)->length, radius, blank_,
                                 test_.workpiece.centre());
    StepPlace place{.name = std::move(name), .owner = std::move(owner)};
    place.rotary = table_.positions(machine_, pass.tilt, pass.turn);
    place.clear_z = run.clear;
    const Mat3 machine_from_definition = rotation_z(table_.orientation);
    place.side = machine_from_definition * pass.side;
    place.heading = upper(fmt::format(
        "{}, step {}: side {}, {}{:g} {}{:g}", place.owner, to_char(step),
        direction_name(place.side), to_char(table_.tilt), place.rotary[table_.tilt] * kDegPerRad,
        to_char(table_.turn), place.rotary[table_.turn] * kDegPerRad));
    place.makes = made_features(pattern, step);
    StepCut& cut = place.cut;
    cut.name = place.name;
    const bool reference = step == StepName::a || step == StepName::b;
    cut.cuts = what_is_cut(pattern, reference);
    const StepSize& size = *test_.workpiece.size(pattern.name);
    const StepName partner = step == StepName::a   ? StepName::b
                             : step == StepName::b ? StepName::a
                             : step == StepName::c ? StepName::d
                                                   : StepName::c;
    const Vec3 half = 0.5 * size.length * line.feed;
    cut.line_from = line.on_side - half;
    cut.line_to = line.on_side + half;
    cut.opposite = step_line(test_.workpiece, pattern, partner, radius).on_side;
    cut.height = reference ? size.reference_height : size.height;
    cut.width = reference ? size.reference_width : size.width;
    cut.machine_from_workpiece =
        machine_from_definition * (rotation_z(pass.turn) * rotation_x(pass.tilt)).transpose();
    cut.from = placed(line.tip - run.before * line.feed, place.rotary);
    cut.to = placed(line.tip + run.after * line.feed, place.rotary);
    cut.words_from = linear_part(cut.from) - linear_part(origin_);
    cut.words_to = linear_part(cut.to) - linear_part(origin_);
    AxisPositions above = cut.from;
    above[AxisLetter::Z] = origin_[AxisLetter::Z] + place.clear_z;
    for (const AxisPositions& q : {cut.from, cut.to, above}) note(place, q);
    places_.steps.push_back(std::move(place));
  }

  // The retract plane: above a ball around all that the table can swing round.
  void choose_safe_z() {
    constexpr double kAbove = 20.0, kLeast = 1.0;  // mm
    const double radius = radius_of(blank_, test_.workpiece.centre());
    const double wanted = 10.0 * std::ceil((radius + kAbove) / 10.0);
    const double highest = machine_.joint(AxisLetter::Z)->travel.hi - origin_[AxisLetter::Z];
    places_.safe_z = std::min(wanted, std::floor(highest));
    if (places_.safe_z >= radius + kLeast) return;
    AxisPositions q = origin_;
    q[AxisLetter::Z] += wanted;
    for (Shortfall& s : shortfalls(machine_, q)) {
      if (s.axis == AxisLetter::Z)
        worst_[{"clearing the workpiece in every table position", s.axis}] = s;
    }
  }

  Result<StepPlaces> places() && {
    if (worst_.empty()) return std::move(places_);
    Diagnostics refused;
    for (const auto& [where, shortfall] : worst_) {
      refused.push_back(
          error("axis-over-travel"_id, fmt::format("{}: {}", where.first, shortfall.text),
                "leave the pattern out, move the workpiece with --center or --raise, or choose a "
                "machine with more travel"));
    }
    return refused;
  }

 private:
  // The plan's features that this step cuts, as step_plan() names them.
  static std::vector<std::string> made_features(const StepPattern& pattern, StepName step) {
    const bool reference = step == StepName::a || step == StepName::b;
    const std::string_view owner = reference ? pattern.reference() : pattern.name;
    std::vector<std::string> features{fmt::format("{}.S_{}", owner, to_char(step))};
    if (reference || pattern.kind == StepKind::step) {
      features.push_back(fmt::format("{}.B_{}", owner, to_char(step)));
    }
    return features;
  }

  static std::string what_is_cut(const StepPattern& pattern, bool reference) {
    if (reference) return "S by the side edge, B by the bottom edge";
    const bool by_side = pattern.side_cut_by == SideCutBy::side_edge;
    std::string side = by_side ? "S by the side edge" : "S by the bottom edge";
    if (pattern.kind != StepKind::step) return side;
    return side + (by_side ? ", B by the bottom edge" : ", B by the side edge");
  }

  [[nodiscard]] AxisPositions placed(const Vec3& tip, const AxisPositions& rotary) const {
    return kinematics::place_tip(machine_, placement_.table_from_workpiece().point(tip),
                                 test_.tool_length.value, rotary);
  }

  // Keeps what is short the most, for each owner and axis.
  void note(const StepPlace& place, const AxisPositions& q) {
    std::vector<Shortfall> found = shortfalls(machine_, q);
    // With the table out of reach, where the linear axes would be means nothing.
    const bool rotary = std::any_of(found.begin(), found.end(), [](const Shortfall& s) {
      return kinematics::is_rotary(s.axis);
    });
    for (Shortfall& s : found) {
      if (rotary && !kinematics::is_rotary(s.axis)) continue;
      Shortfall& worst = worst_[{place.owner, s.axis}];
      if (s.missing > worst.missing) worst = std::move(s);
    }
  }

  const StepTest& test_;
  const Machine& machine_;
  const TiltingTable& table_;
  const stock::LoftShape& blank_;
  const Placement& placement_;
  AxisPositions origin_;  // tip on the crossing
  StepPlaces places_;
  std::map<std::pair<std::string, AxisLetter>, Shortfall> worst_;
};

parser::Command traverse(std::initializer_list<std::pair<AxisLetter, double>> words) {
  parser::Traverse move;
  for (const auto& [letter, value] : words) move.end[letter] = value;
  return move;
}

constexpr int kLengthDecimals = 6;  // mm: as words are written

// One pass from above its beginning to its end; the tool is left in the cut.
void add_pass(PieceProgram& nc, const StepTest& test, const Vec3& from, const Vec3& to,
              std::string what) {
  nc.block({traverse({{AxisLetter::X, from.x()}, {AxisLetter::Y, from.y()}})});
  nc.block({traverse({{AxisLetter::Z, from.z()}})});
  parser::LinearFeed cut{.feed = {test.feed}};
  for (const AxisLetter letter : parser::kLinearAxes) {
    const auto k = static_cast<Eigen::Index>(letter);
    if (parser::fixed(from[k], kLengthDecimals) != parser::fixed(to[k], kLengthDecimals))
      cut.end[letter] = to[k];
  }
  nc.block({parser::Event{.name = "comment", .text = std::move(what)}, cut});
}

void add_step(PieceProgram& nc, const StepTest& test, const TiltingTable& table, StepPlace& place,
              double safe_z) {
  StepCut& cut = place.cut;
  const parser::Command up = traverse({{AxisLetter::Z, place.clear_z}});
  nc.comment(place.heading);
  nc.block(
      {traverse({{table.tilt, place.rotary[table.tilt]}, {table.turn, place.rotary[table.turn]}})});
  cut.first_line = nc.next_block();
  if (test.allowance.value > test.semi_finishing.value) {
    const Vec3 off = test.semi_finishing.value * (place.side + Vec3::UnitZ());
    add_pass(nc, test, cut.words_from + off, cut.words_to + off, "ROUGHING");
    nc.block({up});
  }
  add_pass(nc, test, cut.words_from, cut.words_to, "SEMI-FINISHING");
  nc.block({up});
  add_pass(nc, test, cut.words_from, cut.words_to, "FINISHING");
  cut.last_line = nc.next_block() - 1;
  nc.block({traverse({{AxisLetter::Z, safe_z}})});
}

}  // namespace

Result<StepPlaces> StepPlaces::of(const StepTest& test, std::span<const std::string> patterns,
                                  const Machine& machine, const TiltingTable& table,
                                  const stock::LoftShape& blank, const Placement& placement) {
  Places places(test, machine, table, blank, placement);
  for (const StepPattern* pattern : reference_patterns(patterns)) {
    const bool shared = !pattern->shared_reference.empty();
    for (const StepName step : {StepName::a, StepName::b}) {
      places.add(*pattern, step, fmt::format("{} {}", pattern->reference(), to_char(step)),
                 shared ? "reference" : fmt::format("pattern {}", pattern->name));
    }
  }
  for (const std::string& name : patterns) {
    for (const StepName step : {StepName::c, StepName::d}) {
      places.add(*find_step_pattern(name), step, fmt::format("{} {}", name, to_char(step)),
                 "pattern " + name);
    }
  }
  places.choose_safe_z();
  return std::move(places).places();
}

PieceProgram step_program(const StepTest& test, std::span<const std::string> patterns,
                          const Machine& machine, const TiltingTable& table, StepPlaces& places) {
  parser::AxisTarget home;
  home[AxisLetter::Z] = machine.joint(AxisLetter::Z)->home;
  PieceProgram nc("1001", "STEP PATTERNS");
  nc.restate_feed();
  nc.comment(upper(fmt::format("patterns {} on workpiece {}, machine {}", fmt::join(patterns, " "),
                               test.workpiece.number, machine.name())));
  nc.comment(fmt::format("G54: CROSSING OF {} AND {}, ALL ROTARY AXES AT ZERO", to_char(table.tilt),
                         to_char(table.turn)));
  nc.comment(fmt::format("T{} = END MILL D{:g}, LENGTH {:g} MM", kStepTool,
                         test.tool_diameter.value, test.tool_length.value));
  nc.without_compensation();
  nc.block({machine_traverse(home)});
  nc.block({parser::ToolChange{kStepTool}});
  nc.block({parser::SpindleChange{parser::SpindleDirection::clockwise, test.spindle_speed}});
  nc.block({parser::CoolantChange{true}});
  nc.block({parser::CompensationChange{.mode = parser::LengthCompensation::length,
                                       .offset_number = kStepTool},
            parser::WorkOffsetChange{1}});
  nc.block({traverse({{AxisLetter::Z, places.safe_z}})});
  for (StepPlace& place : places.steps) add_step(nc, test, table, place, places.safe_z);
  nc.block({parser::CoolantChange{false}});
  nc.block({parser::SpindleChange{}});
  nc.block({parser::CompensationChange{}});
  nc.block({machine_traverse(home)});
  nc.block({parser::Stop{}});
  return nc;
}

}  // namespace frustum::programs

#include "calibration/design/step_catalogue.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "calibration/identify/piece_observations.hpp"
#include "programs/step/tilting_table.hpp"

namespace frustum::calibration {
namespace {

using programs::StepTest;

StepTest test_for(int workpiece, const CatalogueSetup& setup) {
  StepTest test = setup.test;
  test.workpiece = programs::raised(*programs::step_workpiece(workpiece), setup.raise);
  if (setup.centre) {
    test.workpiece.centre_x = setup.centre->first;
    test.workpiece.centre_y = setup.centre->second;
  }
  return test;
}

// Patterns that are cut together on one workpiece.
struct Group {
  int workpiece = 1;
  StepTest test{};
  std::vector<std::string> patterns{};
};

// What the paper's workpieces have. Of patterns that cut the same surfaces the first is on the
// workpiece and the other gets one of its own, or the other way round without the first.
std::vector<Group> groups_of(const CatalogueSetup& setup, Pattern4 pattern_4) {
  std::vector<Group> groups;
  for (const int number : {1, 2}) {
    const StepTest test = test_for(number, setup);
    std::vector<std::string> together = programs::patterns_together(test.workpiece);
    std::vector<std::string> left_over;
    for (const programs::StepSize& size : test.workpiece.sizes) {
      if (std::find(together.begin(), together.end(), size.pattern) == together.end()) {
        left_over.push_back(size.pattern);
      }
    }
    if (pattern_4 == Pattern4::in_the_place_of_3 && !left_over.empty()) {
      std::replace(together.begin(), together.end(), std::string("3"), left_over.front());
      left_over.clear();
    }
    groups.push_back({number, test, std::move(together)});
    if (!left_over.empty()) groups.push_back({number + 1, test, std::move(left_over)});
  }
  return groups;
}

// Drops the patterns that are out of the machine's travel and says why; anything else that is wrong
// is wrong for all of them.
Result<std::vector<UnreachablePattern>> drop_unreachable(const kinematics::Machine& machine,
                                                         Group& group) {
  std::vector<UnreachablePattern> dropped;
  std::vector<std::string> kept;
  for (const std::string& pattern : group.patterns) {
    StepTest alone = group.test;
    alone.patterns = {pattern};
    const auto piece = programs::step_pattern(alone, machine);
    if (piece) {
      kept.push_back(pattern);
      continue;
    }
    // Sizes and tools are refused by key, positions by axis.
    if (!piece.error().front().key.empty()) return piece.error();
    dropped.push_back({pattern, piece.error().front().message});
  }
  group.patterns = std::move(kept);
  return dropped;
}

// Patterns in the order of their definitions, whatever workpiece they are on.
void sort_as_defined(StepCatalogue& catalogue) {
  StepCatalogue sorted;
  for (const programs::StepPattern& pattern : programs::step_patterns()) {
    for (std::size_t i = 0; i < catalogue.patterns.size(); ++i) {
      if (catalogue.patterns[i].name != pattern.name) continue;
      sorted.patterns.push_back(catalogue.patterns[i]);
      sorted.workpiece.push_back(catalogue.workpiece[i]);
    }
  }
  catalogue.patterns = std::move(sorted.patterns);
  catalogue.workpiece = std::move(sorted.workpiece);
}

// A part that measures exactly nothing, so that rows and covariances follow from the plan.
MeasuredPart nothing_measured(const metrology::InspectionPlan& plan) {
  MeasuredPart part;
  for (const auto& characteristic : plan.characteristics)
    part.emplace(characteristic.name, MeasuredValue{});
  return part;
}

}  // namespace

Candidate StepCatalogue::candidate(std::size_t pattern) const {
  const Observations own = observations.selected(patterns[pattern].rows);
  return {patterns[pattern].name, own.rows, own.gain, own.covariance};
}

Result<StepCatalogue> step_catalogue(const kinematics::Machine& machine,
                                     std::vector<Unknown> unknowns,
                                     const std::vector<Cause>& causes,
                                     const metrology::CmmModel& cmm, const CatalogueSetup& setup,
                                     Pattern4 pattern_4) {
  if (const auto table = programs::TiltingTable::of(machine); !table) return table.error();
  StepCatalogue catalogue;
  std::vector<MeasuredPiece> pieces;
  std::vector<int> workpieces;
  for (Group& group : groups_of(setup, pattern_4)) {
    const auto dropped = drop_unreachable(machine, group);
    if (!dropped) return dropped.error();
    catalogue.unreachable.insert(catalogue.unreachable.end(), dropped->begin(), dropped->end());
    if (group.patterns.empty()) continue;
    group.test.patterns = group.patterns;
    auto piece = programs::step_pattern(group.test, machine);
    if (!piece) return std::move(piece).error();
    MeasuredPiece measured;
    measured.name = piece->piece.title;
    measured.parts = {nothing_measured(piece->piece.plan)};
    measured.piece = std::move(piece->piece);
    measured.cmm = cmm;
    pieces.push_back(std::move(measured));
    workpieces.push_back(group.workpiece);
  }
  if (pieces.empty()) {
    Diagnostics reasons;
    for (const UnreachablePattern& u : catalogue.unreachable) {
      reasons.push_back(error("pattern-not-possible"_id,
                              fmt::format("pattern {}: {}", u.pattern, u.reason),
                              "choose another machine, or place the workpiece elsewhere"));
    }
    return reasons;
  }
  auto found = observations_of(machine, pieces, std::move(unknowns), causes);
  if (!found) return std::move(found).error();
  catalogue.observations = std::move(found->observations);
  Eigen::Index row = 0;
  for (std::size_t i = 0; i < pieces.size(); ++i) {
    for (std::size_t k = 0; k < pieces[i].parts.front().size(); ++k, ++row) {
      const std::string& name = catalogue.observations.rows[static_cast<std::size_t>(row)].group;
      auto block = std::find_if(catalogue.patterns.begin(), catalogue.patterns.end(),
                                [&](const DesignBlock& b) { return b.name == name; });
      if (block == catalogue.patterns.end()) {
        catalogue.patterns.push_back({name, {}});
        catalogue.workpiece.push_back(workpieces[i]);
        block = std::prev(catalogue.patterns.end());
      }
      block->rows.push_back(row);
    }
  }
  sort_as_defined(catalogue);
  return catalogue;
}

}  // namespace frustum::calibration

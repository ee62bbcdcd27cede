#include "stock/collision/machine_collision.hpp"

#include <fmt/format.h>
#include <oneapi/tbb/parallel_for.h>

#include <algorithm>
#include <utility>

#include "kinematics/model/chain.hpp"
#include "kinematics/path/axis_polyline.hpp"
#include "stock/collision/pair_watch.hpp"

namespace frustum::stock {
namespace {

using kinematics::CommandedMove;
using kinematics::CommandedProgram;
using kinematics::EvenPart;

constexpr std::size_t kVerticesAtOnce = 1U << 18U;  // some 20 MB

bool both_of_the_machine(const PairWatch& watch) {
  return watch.first().kind == SceneBody::Kind::machine &&
         watch.second().kind == SceneBody::Kind::machine;
}

struct Watches {
  std::vector<PairWatch> pairs{};
  std::vector<TouchingPair> touching{};
};

Watches watches_of(const MachineScene& scene) {
  Watches watches;
  const AxisPositions home = scene.machine->home();
  for (std::size_t i = 0; i < scene.bodies.size(); ++i) {
    for (std::size_t j = i + 1; j < scene.bodies.size(); ++j) {
      const SceneBody& a = scene.bodies[i];
      const SceneBody& b = scene.bodies[j];
      if (!may_meet(a, b)) continue;
      PairWatch watch(*scene.machine, a, b);
      if (both_of_the_machine(watch) && watch.separation_at(home).lower <= kMeeting) {
        watches.touching.push_back({a.name, b.name});
      } else {
        watches.pairs.push_back(std::move(watch));
      }
    }
  }
  return watches;
}

// The motion as vertices, handed on in portions.
class Vertices {
 public:
  Vertices(const CommandedProgram& program, std::vector<PairWatch>& pairs)
      : program_(program), pairs_(pairs) {
    vertices_.push_back({program.start, 0, 0});
  }

  void go() {
    std::uint32_t number = 0;
    for (const kinematics::CommandedStep& step : program_.steps) {
      const auto* move = std::get_if<CommandedMove>(&step);
      if (move != nullptr) add(*move, number++);
      if (vertices_.size() >= kVerticesAtOnce) hand_on();
    }
    hand_on();
  }

 private:
  void add(const CommandedMove& move, std::uint32_t number) {
    constexpr kinematics::PolylineTolerance kEven{.linear = 0.005, .rotary = 1e-5};
    if (move.motion.straight()) {
      vertices_.push_back({move.motion.end(), number, move.tool});
      return;
    }
    for (const EvenPart& part :
         kinematics::even_parts([&move](double u) { return move.motion.at(u); },
                                move.motion.least_parts(), move.motion.breaks(), kEven)) {
      vertices_.push_back({part.to, number, move.tool});
    }
  }

  void hand_on() {
    if (vertices_.size() < 2) return;
    tbb::parallel_for(std::size_t{0}, pairs_.size(),
                      [&](std::size_t k) { pairs_[k].follow(vertices_); });
    vertices_ = {vertices_.back()};
  }

  const CommandedProgram& program_;
  std::vector<PairWatch>& pairs_;
  std::vector<AxisVertex> vertices_{};
};

// Of each motion: what is told of it, and its number in the path, in which those without a tool
// have none.
struct MoveOfPath {
  const CommandedMove* move = nullptr;
  std::uint32_t block = 0;
};
std::vector<MoveOfPath> moves_of(const CommandedProgram& program) {
  std::vector<MoveOfPath> moves;
  std::uint32_t block = 0;
  for (const kinematics::CommandedStep& step : program.steps) {
    const auto* move = std::get_if<CommandedMove>(&step);
    if (move == nullptr) continue;
    moves.push_back({move, block});
    if (move->tool != 0) ++block;
  }
  return moves;
}

Collision described(const kinematics::ForwardChain& chain, const Pose& workpiece_from_table,
                    const std::vector<MoveOfPath>& moves, const PairWatch& watch,
                    const PairWatch::Meeting& meeting) {
  const MoveOfPath& at = moves[meeting.first_move];
  const Pose table_from_bed = chain.bed_from_table(meeting.q).inverse();
  return {.kind = CollisionKind::bodies_meet,
          .block = at.block,
          .source_line = at.move->source_line,
          .source_file = at.move->source_file,
          .last_line = moves[meeting.last_move].move->source_line,
          .tool = at.move->tool,
          .point = workpiece_from_table.point(table_from_bed.point(meeting.point)),
          .first = watch.first().name,
          .second = watch.second().name};
}

Diagnostic touching(const TouchingPair& pair) {
  return warning("bodies-touch"_id,
                 fmt::format("the bodies '{}' and '{}' of the machine touch each other where the "
                             "axes are at home: whether they collide was not looked for",
                             pair.first, pair.second),
                 fmt::format("make one of them smaller, or write ignore = [\"{}\"] in [[bodies]] "
                             "'{}' of the machine file",
                             pair.second, pair.first));
}

}  // namespace

std::vector<TouchingPair> touching_at_home(const MachineScene& scene) {
  return watches_of(scene).touching;
}

MachineCollisions find_machine_collisions(const MachineScene& scene, const kinematics::Setup& setup,
                                          const CommandedProgram& program) {
  MachineCollisions found{.bodies = scene.stated};
  if (scene.stated == 0) return found;
  Watches watches = watches_of(scene);
  for (const TouchingPair& pair : watches.touching) found.warnings.push_back(touching(pair));
  Vertices(program, watches.pairs).go();
  const std::vector<MoveOfPath> moves = moves_of(program);
  const kinematics::GeometricErrors none;
  const kinematics::ForwardChain chain(*scene.machine, none, 0.0);
  const Pose workpiece_from_table = setup.table_from_workpiece.inverse();
  for (const PairWatch& watch : watches.pairs) {
    for (const PairWatch::Meeting& meeting : watch.meetings()) {
      found.collisions.push_back(described(chain, workpiece_from_table, moves, watch, meeting));
    }
    const auto& nearest = watch.nearest();
    if (!nearest || (found.closest && found.closest->distance <= nearest->distance)) continue;
    const CommandedMove& move = *moves[nearest->move].move;
    found.closest = ClosestApproach{nearest->distance, watch.first().name, watch.second().name,
                                    move.source_line, move.source_file};
  }
  std::ranges::stable_sort(found.collisions, {}, &Collision::block);
  return found;
}

}  // namespace frustum::stock

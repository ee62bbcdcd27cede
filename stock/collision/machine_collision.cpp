#include "stock/collision/machine_collision.hpp"

#include <fmt/format.h>
#include <oneapi/tbb/parallel_for.h>
#include <oneapi/tbb/task_group.h>

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

// Enough for some milliseconds of work.
constexpr std::size_t kVerticesAtOnce = 2048;

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

// The motion as vertices, followed in portions while the next ones are added.
class Vertices {
 public:
  Vertices(const AxisPositions& start, std::vector<PairWatch>& pairs) : pairs_(pairs) {
    next_.push_back({start, 0, 0});
  }
  ~Vertices() {
    work_.cancel();  // what is left is wanted by nobody
    try {
      work_.wait();
    } catch (...) {
    }
  }
  Vertices(const Vertices&) = delete;
  Vertices& operator=(const Vertices&) = delete;

  void add(const CommandedMove& move, std::uint32_t number) {
    constexpr kinematics::PolylineTolerance kEven{.linear = 0.005, .rotary = 1e-5};
    if (move.motion.straight()) {
      next_.push_back({move.motion.end(), number, move.tool});
    } else {
      for (const EvenPart& part :
           kinematics::even_parts([&move](double u) { return move.motion.at(u); },
                                  move.motion.least_parts(), move.motion.breaks(), kEven)) {
        next_.push_back({part.to, number, move.tool});
      }
    }
    if (next_.size() >= kVerticesAtOnce) hand_on();
  }

  void finish() {
    hand_on();
    work_.wait();
  }

 private:
  void hand_on() {
    work_.wait();
    if (next_.size() < 2) return;
    std::swap(next_, at_work_);
    next_ = {at_work_.back()};
    work_.run([this] {
      tbb::parallel_for(std::size_t{0}, pairs_.size(),
                        [this](std::size_t k) { pairs_[k].follow(at_work_); });
    });
  }

  std::vector<PairWatch>& pairs_;
  std::vector<AxisVertex> next_{}, at_work_{};
  tbb::task_group work_{};
};

// Of each motion: what is told of it, and its number in the path, in which those without a tool
// have none.
class MovesOfPath {
 public:
  struct Move {
    std::uint32_t source_line = 0;
    std::uint32_t block = 0;
    int tool = 0;
    std::uint32_t file = 0;
  };

  void add(const CommandedMove& move) {
    if (move.source_file != files_.back()) files_.push_back(move.source_file);
    moves_.push_back(
        {move.source_line, block_, move.tool, static_cast<std::uint32_t>(files_.size() - 1)});
    if (move.tool != 0) ++block_;
  }
  [[nodiscard]] const Move& operator[](std::size_t number) const { return moves_[number]; }
  [[nodiscard]] std::uint32_t count() const { return static_cast<std::uint32_t>(moves_.size()); }
  [[nodiscard]] const std::shared_ptr<const std::string>& file_of(const Move& move) const {
    return files_[move.file];
  }

 private:
  std::vector<Move> moves_{};
  std::vector<std::shared_ptr<const std::string>> files_{nullptr};
  std::uint32_t block_ = 0;
};

Collision described(const kinematics::ForwardChain& chain, const Pose& workpiece_from_table,
                    const MovesOfPath& moves, const PairWatch& watch,
                    const PairWatch::Meeting& meeting) {
  const MovesOfPath::Move& at = moves[meeting.first_move];
  const Pose table_from_bed = chain.bed_from_table(meeting.q).inverse();
  return {.kind = CollisionKind::bodies_meet,
          .block = at.block,
          .source_line = at.source_line,
          .source_file = moves.file_of(at),
          .last_line = moves[meeting.last_move].source_line,
          .tool = at.tool,
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

class MachineCollisionSearch::State {
 public:
  State(const MachineScene& scene, const AxisPositions& start)
      : scene_(scene),
        watches_(scene.stated == 0 ? Watches{} : watches_of(scene)),
        vertices_(start, watches_.pairs) {}

  void follow(const CommandedMove& move) {
    if (scene_.stated == 0) return;
    vertices_.add(move, moves_.count());
    moves_.add(move);
  }

  [[nodiscard]] MachineCollisions finish(const kinematics::Setup& setup) {
    MachineCollisions found{.bodies = scene_.stated};
    if (scene_.stated == 0) return found;
    for (const TouchingPair& pair : watches_.touching) found.warnings.push_back(touching(pair));
    vertices_.finish();
    const kinematics::GeometricErrors none;
    const kinematics::ForwardChain chain(*scene_.machine, none, 0.0);
    const Pose workpiece_from_table = setup.table_from_workpiece.inverse();
    for (const PairWatch& watch : watches_.pairs) {
      for (const PairWatch::Meeting& meeting : watch.meetings()) {
        found.collisions.push_back(described(chain, workpiece_from_table, moves_, watch, meeting));
      }
      const auto& nearest = watch.nearest();
      if (!nearest || (found.closest && found.closest->distance <= nearest->distance)) continue;
      const MovesOfPath::Move& move = moves_[nearest->move];
      found.closest = ClosestApproach{nearest->distance, watch.first().name, watch.second().name,
                                      move.source_line, moves_.file_of(move)};
    }
    std::ranges::stable_sort(found.collisions, {}, &Collision::block);
    return found;
  }

 private:
  const MachineScene& scene_;
  Watches watches_;
  Vertices vertices_;
  MovesOfPath moves_{};
};

MachineCollisionSearch::MachineCollisionSearch(const MachineScene& scene,
                                               const AxisPositions& start)
    : state_(std::make_unique<State>(scene, start)) {}
MachineCollisionSearch::MachineCollisionSearch(MachineCollisionSearch&&) noexcept = default;
MachineCollisionSearch::~MachineCollisionSearch() = default;

void MachineCollisionSearch::follow(const CommandedMove& move) { state_->follow(move); }
MachineCollisions MachineCollisionSearch::finish(const kinematics::Setup& setup) {
  return state_->finish(setup);
}

MachineCollisions find_machine_collisions(const MachineScene& scene, const kinematics::Setup& setup,
                                          const CommandedProgram& program) {
  MachineCollisionSearch search(scene, program.start);
  for (const kinematics::CommandedStep& step : program.steps) {
    if (const auto* move = std::get_if<CommandedMove>(&step)) search.follow(*move);
  }
  return search.finish(setup);
}

}  // namespace frustum::stock

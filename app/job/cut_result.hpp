// What `frustum cut` found, as JSON and as a summary for people.
//
// JSON names are only ever added to; what was not asked for is left out.
// Units: mm, mm3, s; deviations in um. Errors: none.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "app/job/job.hpp"
#include "report/run_report.hpp"
#include "stock/collision/collision.hpp"
#include "stock/mesh/deviation.hpp"
#include "stock/mesh/refine_surface.hpp"
#include "stock/mesh/surface_mesh.hpp"
#include "stock/solid/program_state.hpp"
#include "stock/solid/removal.hpp"

namespace frustum::app {

struct CutSurface {
  std::size_t vertices = 0;
  std::size_t triangles = 0;
  stock::MeshMeasure measure{};
  stock::WorstDeviations deviations{};
  double lowest = 0.0, highest = 0.0;  // mm, of all deviations; 0 without any
  std::optional<Mm> faceted_within{};  // of the polyhedral engine: its bound
  std::optional<stock::Refinement> refinement{};
};

struct Snapshot {
  std::string file{};
  stock::ProgramState program_state{};
  double volume = 0.0;  // mm3
};

struct RemovalTotal {
  std::string file{};
  std::size_t blocks = 0;
  double volume = 0.0;  // mm3
};

// mm; nothing: no limit.
struct DeviationLimits {
  std::optional<double> gouge{};
  std::optional<double> excess{};
};

struct CutResult {
  stock::ProgramState until{};
  bool finished = true;  // `until` is the end of the program
  double blank_volume = 0.0;
  std::optional<CutSurface> surface{};
  DeviationLimits limits{};
  std::vector<stock::Collision> collisions{};
  report::MachineBodies machine_bodies{};  // over the whole program
  std::optional<Vec3> asked_point{};
  std::optional<stock::OriginatingBlock> originating_block{};
  std::vector<Snapshot> snapshots{};
  std::optional<RemovalTotal> removal{};

  // No collision, no deviation beyond a limit, and a surface where one was asked for.
  [[nodiscard]] bool passes() const;
};

[[nodiscard]] std::string cut_json(const CutResult& result);
[[nodiscard]] std::string cut_text(const CutResult& result);
// Of it, what --point asks for: the answer itself, which no wish for silence takes away.
[[nodiscard]] std::string originating_block_text(const CutResult& result);
// The index of a series of snapshots.
[[nodiscard]] std::string snapshot_index(const std::vector<Snapshot>& snapshots);

}  // namespace frustum::app

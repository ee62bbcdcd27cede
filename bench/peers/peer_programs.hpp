// The programs that cut a scene: each makes a closed mesh of what is left.
//
// Units: mm; frame: workpiece. Errors: nothing where the program is not built in, or gave up.
#pragma once

#include <optional>
#include <string>

#include "bench/peers/faceted_cutter.hpp"
#include "stock/mesh/surface_mesh.hpp"

namespace frustum::bench {

enum class Program { ready, ours, dexel, manifold, cgal };

// One row of the table.
struct PeerCase {
  Program program = Program::ours;
  double pitch = 0.0;  // mm, of ours and of dexels
  double chord = 0.0;  // mm; 0: not refined
  int facets = 0;      // of Boolean programs
  Facing facing = Facing::fixed;
  bool by_halves = false;  // Manifold: unions in the order of the program, not one batch
  double pushed = 0.0;     // mm, outwards at every vertex: what the measure must see
};

[[nodiscard]] const char* name_of(Program program);
[[nodiscard]] std::string setting_of(const PeerCase& each);
// Whether this build has it.
[[nodiscard]] bool is_built_in(Program program);
[[nodiscard]] std::optional<stock::SurfaceMesh> make_mesh(const PeerScene& scene,
                                                          const PeerCase& each);

// A mesh of a tri-dexel alone: a vertex a cell, the mean of where its edges cross the surface
// (surface nets; Gibson 1998, MICCAI). No normals, no sharp edges.
[[nodiscard]] stock::SurfaceMesh plain_dexel_mesh(const stock::TriDexel& dexels);
// Blank minus the union of the hulls.
[[nodiscard]] std::optional<stock::SurfaceMesh> manifold_mesh(const PeerScene& scene,
                                                              const PeerCase& each);
[[nodiscard]] std::optional<stock::SurfaceMesh> cgal_mesh(const PeerScene& scene, int facets,
                                                          Facing facing);

}  // namespace frustum::bench

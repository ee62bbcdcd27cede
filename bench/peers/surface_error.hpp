// How far a mesh is from the true surface of a tool path, the same way for every program.
//
// Model    : random lines, of any direction and place alike, meet every part of a surface in
//            proportion to its area (Crofton). Where they cross the mesh, and at its vertices, the
//            true surface is asked for its distance; where they cross the true surface, the mesh is
//            asked for its own. Both count, on all surfaces that the cutter made. What is within
//            1 mm of the cut surface and of the blank's at once, and points of the true sharp edges
//            themselves, are a sum of their own: a mesh may be good on faces and blunt at edges
// Units    : mm
// Errors   : none; the mesh must be closed
// Accuracy : of each distance 1e-9 mm; the worst is that of the points asked, not of all
// Source   : path_truth.hpp for the distance from the true surface; Embree's candidates and doubles
//            for crossings of the mesh (stock/solid/facet_solid.hpp)
#pragma once

#include <vector>

#include "bench/peers/path_truth.hpp"
#include "stock/mesh/surface_mesh.hpp"

namespace frustum::bench {

struct ErrorSum {
  double worst = 0.0;  // of the absolute values
  double squares = 0.0;
  double sum = 0.0;
  long points = 0;

  void add(double error);
  [[nodiscard]] double rms() const;
  [[nodiscard]] double mean() const;
};

struct SurfaceError {
  ErrorSum from_mesh{};   // faces: crossings and vertices, to the truth; outside positive
  ErrorSum from_truth{};  // faces: ends of the same lines, to the mesh
  ErrorSum at_edges{};    // both, and points of the true sharp edges
  // Faces along the same line, mesh against our exact engine, times the cosine to the true normal.
  ErrorSum along_lines{};
  long lines = 0;
  long parted_lines = 0;  // one of the two met an edge that the other passed: not in along_lines

  [[nodiscard]] double worst_on_faces() const;
  [[nodiscard]] double rms_on_faces() const;
};

struct ErrorOptions {
  int lines = 4000;
  int vertices = 4000;
  int edges = 1000;  // lines that look for them
};

// What is measured against, prepared once a scene.
class ErrorMeasure {
 public:
  ErrorMeasure(const PeerScene& scene, const ErrorOptions& options);

  [[nodiscard]] SurfaceError of(const stock::SurfaceMesh& mesh) const;
  // Of our exact engine's ends on the same lines, against standing cutters.
  [[nodiscard]] const ErrorSum& exact_ends() const { return exact_ends_; }

 private:
  struct TrueEnd {
    double s = 0.0;
    Vec3 point = Vec3::Zero();
    double cosine = 0.0;  // between the line and the normal
    PathTruth::Offset off{};
  };
  [[nodiscard]] Ray line(std::uint64_t k) const;
  void find_ends(const stock::Workpiece& part);
  void find_edges(const PeerScene& scene, const stock::Workpiece& part);

  PathTruth truth_;
  ErrorOptions options_;
  Box box_{};
  std::vector<std::vector<TrueEnd>> ends_{};  // of each line
  std::vector<Vec3> edges_{};
  ErrorSum exact_ends_{};
};

}  // namespace frustum::bench

// A faceted solid with exact corners, for Boolean operations.
//
// Units    : mm
// Shape    : a closed triangle mesh with outward facets and without self-contact
// Errors   : united() and minus() give nothing where the result would not be such a mesh, or CGAL
//            gives up
// Accuracy : exact until the corners are rounded to double. Vertices that are no corners are taken
//            away after each operation, so that digits do not multiply from one to the next
// Source   : CGAL 5.5, Polygon Mesh Processing, corefinement
#pragma once

#include <cstddef>
#include <memory>
#include <optional>

#include "stock/mesh/surface_mesh.hpp"

namespace frustum::stock {

class ExactSolid {
 public:
  explicit ExactSolid(const SurfaceMesh& mesh);
  ~ExactSolid();
  ExactSolid(ExactSolid&&) noexcept;
  ExactSolid& operator=(ExactSolid&&) noexcept;

  [[nodiscard]] std::optional<ExactSolid> united(const ExactSolid& other) const;
  [[nodiscard]] std::optional<ExactSolid> minus(const ExactSolid& other) const;

  [[nodiscard]] std::size_t facet_count() const;
  [[nodiscard]] SurfaceMesh rounded() const;

 private:
  struct Mesh;
  explicit ExactSolid(std::unique_ptr<Mesh> mesh);
  std::unique_ptr<Mesh> mesh_;
};

}  // namespace frustum::stock

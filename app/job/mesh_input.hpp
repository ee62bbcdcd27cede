// Meshes that a job names: the blank's body and the nominal shape.
//
// Units: mm. Errors: noted at the key: a file that cannot be read, a mesh that does not bound one
// body, and any mesh when Frustum was built without CGAL, which checks that.
#pragma once

#include <memory>
#include <string_view>

#include "core/toml_document.hpp"
#include "stock/solid/facet_solid.hpp"

namespace frustum::app {

// Nothing after an error; corners are moved by `origin`.
[[nodiscard]] std::shared_ptr<const stock::FacetSolid> read_closed_mesh(const TomlTable& table,
                                                                        std::string_view key,
                                                                        const Vec3& origin);

}  // namespace frustum::app

#include "bench/peers/peer_programs.hpp"

#include <fmt/format.h>

#include <utility>

#include "stock/mesh/refine_surface.hpp"

namespace frustum::bench {
namespace {

std::optional<stock::SurfaceMesh> our_mesh(const PeerScene& scene, const PeerCase& each) {
  const stock::Workpiece part = scene.cut();
  auto mesh = stock::extract_surface(part, part.blank().bounds(), Mm{each.pitch});
  if (!mesh) return std::nullopt;
  if (each.chord > 0.0) {
    auto refined = stock::refine_surface(part, *std::move(mesh), {.chord = Mm{each.chord}});
    if (!refined) return std::nullopt;
    return std::move(refined->mesh);
  }
  return *std::move(mesh);
}

std::optional<stock::SurfaceMesh> dexel_mesh(const PeerScene& scene, double pitch) {
  const stock::Workpiece part = scene.cut();
  const auto dexels = stock::TriDexel::sample(part, part.blank().bounds(), Mm{pitch});
  if (!dexels) return std::nullopt;
  return plain_dexel_mesh(*dexels);
}

}  // namespace

const char* name_of(Program program) {
  switch (program) {
    case Program::ready:
      return "Frustum, workpiece";
    case Program::ours:
      return "Frustum, mesh";
    case Program::dexel:
      return "plain tri-dexel";
    case Program::manifold:
      return "Manifold";
    case Program::cgal:
      return "CGAL";
  }
  return "";
}

std::string setting_of(const PeerCase& each) {
  std::string text;
  if (each.program == Program::ready) return "exact rays";
  if (each.program == Program::ours || each.program == Program::dexel) {
    text = fmt::format("pitch {} mm", each.pitch);
    if (each.chord > 0.0) text += fmt::format(", chord {} um", each.chord * 1e3);
  } else {
    text = fmt::format("{} facets", each.facets);
    if (each.by_halves) text += ", by halves";
    if (each.facing == Facing::contact) text += ", one vertex at the contact";
  }
  if (each.pushed != 0.0) text += fmt::format(", pushed {} um", each.pushed * 1e3);
  return text;
}

bool is_built_in(Program program) {
#ifndef FRUSTUM_PEERS_MANIFOLD
  if (program == Program::manifold) return false;
#endif
#ifndef FRUSTUM_PEERS_CGAL
  if (program == Program::cgal) return false;
#endif
  return program >= Program::ready;
}

std::optional<stock::SurfaceMesh> make_mesh(const PeerScene& scene, const PeerCase& each) {
  std::optional<stock::SurfaceMesh> mesh;
  switch (each.program) {
    case Program::ready:
      break;
    case Program::ours:
      mesh = our_mesh(scene, each);
      break;
    case Program::dexel:
      mesh = dexel_mesh(scene, each.pitch);
      break;
    case Program::manifold:
#ifdef FRUSTUM_PEERS_MANIFOLD
      mesh = manifold_mesh(scene, each);
#endif
      break;
    case Program::cgal:
#ifdef FRUSTUM_PEERS_CGAL
      mesh = cgal_mesh(scene, each.facets, each.facing);
#endif
      break;
  }
  if (!mesh || each.pushed == 0.0) return mesh;
  for (std::size_t v = 0; v < mesh->vertices.size(); ++v) {
    mesh->vertices[v] += each.pushed * mesh->normals[v];
  }
  return mesh;
}

}  // namespace frustum::bench

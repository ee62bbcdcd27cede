#include "app/job/cut_result.hpp"

#include <fmt/format.h>

#include <cmath>
#include <filesystem>
#include <nlohmann/json.hpp>

#include "app/job/job_report.hpp"
#include "core/counted.hpp"
#include "core/program_version.hpp"
#include "report/exchange/json_report.hpp"

namespace frustum::app {
namespace {

using Json = nlohmann::ordered_json;

Json point_json(const Vec3& p) { return {p.x(), p.y(), p.z()}; }

// Of a program state, a block or a point; "program_file" only where it is not the main program's.
template <class Place>
Json line_json(const Place& place) {
  Json json{{"line", place.source_line}};
  if (place.source_file) json["program_file"] = *place.source_file;
  return json;
}
template <class Place>
std::string line_text(const Place& place) {
  std::string text = fmt::format("line {}", place.source_line);
  if (place.source_file) {
    text += fmt::format(" of {}", std::filesystem::path(*place.source_file).filename().string());
  }
  return text;
}

Json state_json(const stock::ProgramState& program_state) {
  Json json = line_json(program_state);
  json["block"] = program_state.block ? Json(*program_state.block) : Json(nullptr);
  json["time_s"] = program_state.time;
  return json;
}

Json worst_json(const std::optional<stock::WorstPoint>& worst) {
  if (!worst) return nullptr;
  Json json{{"deviation_um", worst->deviation * kUmPerMm}, {"point", point_json(worst->point)}};
  json.update(line_json(*worst));
  json["block"] = worst->block ? Json(*worst->block) : Json(nullptr);
  return json;
}

const char* name_of(stock::CollisionBody body) {
  constexpr const char* kNames[] = {"cutter", "shank", "holder"};
  return kNames[static_cast<std::size_t>(body)];
}

const char* name_of(stock::CollisionKind kind) {
  constexpr const char* kNames[] = {"rapid_through_material", "feed_with_spindle_off",
                                    "body_in_material", "bodies_meet"};
  return kNames[static_cast<std::size_t>(kind)];
}

Json collision_json(const stock::Collision& c) {
  const bool meet = c.kind == stock::CollisionKind::bodies_meet;
  Json json = line_json(c);
  json.update({{"text", collision_text(c)},
               {"kind", name_of(c.kind)},
               {"body", meet ? c.first : std::string(name_of(c.body))},
               {"tool", c.tool},
               {"depth_mm", meet ? Json(nullptr) : Json(c.depth)},
               {"point", point_json(c.point)},
               {"last_line", c.last_line}});
  if (meet) json["other_body"] = c.second;
  return json;
}

Json snapshot_json(const Snapshot& snapshot) {
  Json json{{"file", snapshot.file}};
  json.update(state_json(snapshot.program_state));
  json["volume_mm3"] = snapshot.volume;
  return json;
}

Json snapshots_json(const std::vector<Snapshot>& snapshots) {
  Json all = Json::array();
  for (const Snapshot& s : snapshots) all.push_back(snapshot_json(s));
  return all;
}

void add_surface(Json& json, const CutResult& result) {
  const CutSurface& surface = *result.surface;
  json["engine"] = surface.faceted_within ? "polyhedral" : "ray";
  if (surface.faceted_within) json["facet_bound_um"] = surface.faceted_within->value * kUmPerMm;
  if (surface.refinement) {
    json["worst_chord_um"] = surface.refinement->worst_chord * kUmPerMm;
    json["unresolved_edges"] = surface.refinement->unresolved_edges;
    json["unresolved_vertices"] = surface.refinement->unresolved_vertices;
  }
  json["vertices"] = surface.vertices;
  json["triangles"] = surface.triangles;
  json["closed"] = surface.measure.is_closed;
  json["manifold"] = surface.measure.is_manifold;
  json["volume_mm3"] = surface.measure.volume;
  json["blank_volume_mm3"] = result.blank_volume;
  json["removed_volume_mm3"] = removed_volume(result.blank_volume, surface.measure.volume);
  json["vertices_with_nominal"] = surface.deviations.points;
  json["deviation_um"] = {surface.lowest * kUmPerMm, surface.highest * kUmPerMm};
  json["gouge"] = worst_json(surface.deviations.gouge);
  json["excess"] = worst_json(surface.deviations.excess);
}

Json originating_block_json(const CutResult& result) {
  Json json{{"point", point_json(*result.asked_point)}};
  json["on_surface"] = result.originating_block.has_value();
  if (!result.originating_block) return json;
  json.update(line_json(*result.originating_block));
  json["block"] =
      result.originating_block->block ? Json(*result.originating_block->block) : Json(nullptr);
  json["normal"] = point_json(result.originating_block->normal);
  return json;
}

bool exceeds(const std::optional<stock::WorstPoint>& worst, const std::optional<double>& limit) {
  return worst && limit && std::abs(worst->deviation) > *limit;
}

std::string worst_text(const char* name, const std::optional<stock::WorstPoint>& worst,
                       const std::optional<double>& limit) {
  if (!worst) return "";
  const Vec3& p = worst->point;
  std::string text = fmt::format("{} {:.3f} um at ({:.3f}, {:.3f}, {:.3f}){}", name,
                                 std::abs(worst->deviation) * kUmPerMm, p.x(), p.y(), p.z(),
                                 worst->block ? ", " + line_text(*worst) : "");
  if (exceeds(worst, limit)) {
    text += fmt::format(": beyond the limit of {:g} um", *limit * kUmPerMm);
  }
  return text + '\n';
}

std::string surface_text(const CutResult& result) {
  const CutSurface& s = *result.surface;
  std::string text = fmt::format(
      "{} vertices, {} triangles, {}\nvolume {:.3f} mm3 of {:.3f}, removed {:.3f}\n", s.vertices,
      s.triangles,
      s.measure.is_closed && s.measure.is_manifold ? "closed and manifold" : "NOT closed",
      s.measure.volume, result.blank_volume, removed_volume(result.blank_volume, s.measure.volume));
  if (s.deviations.points > 0) {
    text += fmt::format("deviation {:.3f} .. {:.3f} um on {} with a nominal\n", s.lowest * kUmPerMm,
                        s.highest * kUmPerMm, counted(s.deviations.points, "vertex", "vertices"));
  }
  if (s.faceted_within) {
    text += fmt::format("facets within {:g} um of the exact surface\n",
                        s.faceted_within->value * kUmPerMm);
  }
  if (s.refinement) {
    text += fmt::format("largest distance found between triangles and surface {:.3f} um",
                        s.refinement->worst_chord * kUmPerMm);
    const std::size_t edges = s.refinement->unresolved_edges;
    const std::size_t vertices = s.refinement->unresolved_vertices;
    if (edges > 0) text += fmt::format("; beside {} it was not found", counted(edges, "edge"));
    if (vertices > 0)
      text += fmt::format("; {} not on it", counted(vertices, "vertex is", "vertices are"));
    if (edges + vertices > 0) text += ": try a smaller --pitch";
    text += '\n';
  }
  return text + worst_text("worst gouge", s.deviations.gouge, result.limits.gouge) +
         worst_text("worst excess", s.deviations.excess, result.limits.excess);
}

}  // namespace

bool CutResult::passes() const {
  const bool within = !surface || (!exceeds(surface->deviations.gouge, limits.gouge) &&
                                   !exceeds(surface->deviations.excess, limits.excess));
  return collisions.empty() && within && (!asked_point || originating_block);
}

std::string snapshot_index(const std::vector<Snapshot>& snapshots) {
  std::vector<Snapshot> beside = snapshots;
  for (Snapshot& s : beside) s.file = std::filesystem::path(s.file).filename().string();
  return Json{{"schema", "frustum/snapshots/1"},
              {"version", program_version()},
              {"snapshots", snapshots_json(beside)}}
             .dump(2) +
         '\n';
}

std::string cut_json(const CutResult& result) {
  Json json{{"schema", "frustum/cut/1"}, {"version", program_version()}};
  if (result.surface) add_surface(json, result);
  json["until"] = state_json(result.until);
  json["finished"] = result.finished;
  json["collisions"] = result.collisions.size();
  json["collision_list"] = Json::array();
  for (const auto& c : result.collisions) json["collision_list"].push_back(collision_json(c));
  json["machine_collisions"] = Json::parse(report::machine_bodies_json(result.machine_bodies));
  if (result.asked_point) json["made_by"] = originating_block_json(result);
  if (!result.snapshots.empty()) json["snapshots"] = snapshots_json(result.snapshots);
  if (result.removal) {
    json["removal"] = {{"file", result.removal->file},
                       {"blocks", result.removal->blocks},
                       {"volume_mm3", result.removal->volume}};
  }
  json["passes"] = result.passes();
  return json.dump(2) + '\n';
}

std::string originating_block_text(const CutResult& result) {
  if (!result.asked_point) return {};
  if (!result.originating_block) return "no surface within 1 um of the point\n";
  if (!result.originating_block->block) return "the point is on the blank's own surface\n";
  return fmt::format("the point was made by {}, block {}\n", line_text(*result.originating_block),
                     *result.originating_block->block);
}

std::string cut_text(const CutResult& result) {
  std::string text;
  if (!result.finished) {
    text += fmt::format("after {}, {:.3f} s into the program\n", line_text(result.until),
                        result.until.time);
  }
  if (result.surface) text += surface_text(result);
  text += report::machine_bodies_text(result.machine_bodies) + '\n';
  text += originating_block_text(result);
  if (!result.snapshots.empty()) {
    text += fmt::format("{}, {} to {}\n", counted(result.snapshots.size(), "snapshot"),
                        result.snapshots.front().file, result.snapshots.back().file);
  }
  if (result.removal) {
    text += fmt::format("{:.3f} mm3 removed by {} block{}: {}\n", result.removal->volume,
                        result.removal->blocks, result.removal->blocks == 1 ? "" : "s",
                        result.removal->file);
  }
  return text;
}

}  // namespace frustum::app

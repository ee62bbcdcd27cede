#include "stock/dexel/tri_dexel.hpp"

#include <fmt/format.h>
#include <oneapi/tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <numeric>

namespace frustum::stock {
namespace {

// Irrational, and neither equal nor summing to one in pairs, so that planes at 45 degrees are safe
// too: sqrt(7) - 2, sqrt(2) - 1, 2 - sqrt(3).
constexpr std::array<double, 3> kShift{0.64575131106459059, 0.41421356237309505,
                                       0.26794919243112270};

// Rays of a tile, in each direction.
constexpr int kTile = 16;

// Nodes that the box needs along one axis, as a double because nobody has checked its size yet.
double nodes_needed(double from, double to, double pitch, double shift) {
  return std::ceil((to - from) / pitch + 1.0 + shift) + 2.0;
}

std::array<double, 3> nodes_needed(const BoundingBox& box, double pitch) {
  std::array<double, 3> nodes{};
  for (int d = 0; d < 3; ++d) {
    const auto at = static_cast<std::size_t>(d);
    nodes[at] = nodes_needed(box.min[d], box.max[d], pitch, kShift[at]);
  }
  return nodes;
}

double rays_needed(const BoundingBox& box, double pitch) {
  const auto n = nodes_needed(box, pitch);
  return n[0] * n[1] + n[1] * n[2] + n[2] * n[0];
}

Diagnostic too_fine(const BoundingBox& box, double pitch) {
  // The count falls at most with the square of the pitch; a few rounds of a tenth each end the
  // search.
  double enough = pitch;
  while (rays_needed(box, enough) > static_cast<double>(TriDexel::kMaxRays)) enough *= 1.1;
  return error(
      "mesh-pitch"_id,
      fmt::format("a pitch of {} mm needs {:.3g} rays for {:.6g} x {:.6g} x {:.6g} mm; {} "
                  "is the limit",
                  pitch, rays_needed(box, pitch), box.max.x() - box.min.x(),
                  box.max.y() - box.min.y(), box.max.z() - box.min.z(), TriDexel::kMaxRays),
      fmt::format("use a pitch of {:.2g} mm or more", enough));
}

}  // namespace

DexelGrid DexelGrid::over(const BoundingBox& box, double pitch) {
  DexelGrid grid;
  grid.pitch = pitch;
  const auto nodes = nodes_needed(box, pitch);
  for (int d = 0; d < 3; ++d) {
    const auto at = static_cast<std::size_t>(d);
    grid.origin[d] = box.min[d] - pitch * (1.0 + kShift[at]);
    grid.nodes[at] = static_cast<int>(nodes[at]);
  }
  return grid;
}

Ray DexelGrid::ray(int axis, int u, int v) const {
  Vec3 at = origin;
  at[(axis + 1) % 3] += pitch * u;
  at[(axis + 2) % 3] += pitch * v;
  return {at, Vec3::Unit(axis)};
}

std::int64_t DexelGrid::rays() const {
  const std::int64_t x = nodes[0];
  const std::int64_t y = nodes[1];
  const std::int64_t z = nodes[2];
  return x * y + y * z + z * x;
}

TriDexel::Family TriDexel::sample_family(SolidView solid, const DexelGrid& grid, int axis) {
  const int nu = grid.nodes[static_cast<std::size_t>((axis + 1) % 3)];
  const int nv = grid.nodes[static_cast<std::size_t>((axis + 2) % 3)];
  const int nodes = grid.nodes[static_cast<std::size_t>(axis)];
  const RaySpan span{0.5 * grid.pitch, (nodes - 1.5) * grid.pitch};

  Family family;
  family.first.assign(static_cast<std::size_t>(nu) * static_cast<std::size_t>(nv) + 1, 0);
  const auto index = [nu](int u, int v) {
    return static_cast<std::size_t>(v) * static_cast<std::size_t>(nu) + static_cast<std::size_t>(u);
  };
  // Tiles of rays share their search.
  const int tiles_u = (nu - 2 + kTile - 1) / kTile, tiles_v = (nv - 2 + kTile - 1) / kTile;
  std::vector<std::vector<IntervalSet>> tiles(static_cast<std::size_t>(tiles_u * tiles_v));
  tbb::parallel_for(0, tiles_u * tiles_v, [&](int tile) {
    const int u0 = 1 + kTile * (tile % tiles_u), v0 = 1 + kTile * (tile / tiles_u);
    const int u1 = std::min(u0 + kTile, nu - 1), v1 = std::min(v0 + kTile, nv - 1);
    std::vector<Ray> rays;
    rays.reserve(static_cast<std::size_t>(kTile) * kTile);
    for (int v = v0; v < v1; ++v) {
      for (int u = u0; u < u1; ++u) rays.push_back(grid.ray(axis, u, v));
    }
    auto& found = tiles[static_cast<std::size_t>(tile)];
    found = solid.material_along_all(rays, static_cast<std::size_t>(u1 - u0), span);
    for (std::size_t r = 0; r < found.size(); ++r) {
      const int u = u0 + static_cast<int>(r) % (u1 - u0), v = v0 + static_cast<int>(r) / (u1 - u0);
      family.first[index(u, v) + 1] = found[r].intervals().size();
    }
  });
  std::partial_sum(family.first.begin(), family.first.end(), family.first.begin());
  family.intervals.resize(family.first.back());
  tbb::parallel_for(0, tiles_u * tiles_v, [&](int tile) {
    const int u0 = 1 + kTile * (tile % tiles_u), v0 = 1 + kTile * (tile / tiles_u);
    const int width = std::min(u0 + kTile, nu - 1) - u0;
    const auto& found = tiles[static_cast<std::size_t>(tile)];
    for (std::size_t r = 0; r < found.size(); ++r) {
      const int u = u0 + static_cast<int>(r) % width, v = v0 + static_cast<int>(r) / width;
      std::ranges::copy(
          found[r].intervals(),
          family.intervals.begin() + static_cast<std::ptrdiff_t>(family.first[index(u, v)]));
    }
  });
  return family;
}

Result<TriDexel> TriDexel::sample(SolidView solid, const BoundingBox& box, Mm pitch) {
  if (!std::isfinite(pitch.value) || pitch.value <= 0.0) {
    return error("mesh-pitch"_id, fmt::format("the mesh pitch is {} mm", pitch.value),
                 "it must be a finite number above 0");
  }
  if (!box.min.allFinite() || !box.max.allFinite() || (box.max - box.min).minCoeff() <= 0.0) {
    return error("mesh-box"_id, "the box to be meshed is empty or not finite");
  }
  if (rays_needed(box, pitch.value) > static_cast<double>(kMaxRays)) {
    return too_fine(box, pitch.value);
  }
  TriDexel dexels(DexelGrid::over(box, pitch.value));
  for (int axis = 0; axis < 3; ++axis) {
    dexels.families_[static_cast<std::size_t>(axis)] = sample_family(solid, dexels.grid_, axis);
  }
  return dexels;
}

std::span<const Interval> TriDexel::material(int axis, int u, int v) const {
  const Family& family = families_[static_cast<std::size_t>(axis)];
  const auto nu = static_cast<std::size_t>(grid_.nodes[static_cast<std::size_t>((axis + 1) % 3)]);
  const std::size_t ray = static_cast<std::size_t>(v) * nu + static_cast<std::size_t>(u);
  return std::span(family.intervals)
      .subspan(family.first[ray], family.first[ray + 1] - family.first[ray]);
}

std::size_t TriDexel::interval_count() const {
  return families_[0].intervals.size() + families_[1].intervals.size() +
         families_[2].intervals.size();
}

std::array<double, 3> TriDexel::volumes() const {
  std::array<double, 3> volumes{};
  for (std::size_t d = 0; d < 3; ++d) {
    double length = 0.0;
    for (const Interval& material : families_[d].intervals) length += material.length();
    volumes[d] = length * grid_.pitch * grid_.pitch;
  }
  return volumes;
}

double TriDexel::volume() const {
  const auto each = volumes();
  return (each[0] + each[1] + each[2]) / 3.0;
}

}  // namespace frustum::stock

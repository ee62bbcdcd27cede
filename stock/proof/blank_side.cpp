#include "stock/proof/blank_side.hpp"

#include <limits>
#include <span>
#include <variant>
#include <vector>

#include "stock/proof/enclosure.hpp"

namespace frustum::stock {
namespace {

// How deep below a face the point is, and about where the face looks.
struct Depth {
  Enclosure depth;
  Vec3 outward;
};

// Below the face that is at half + growth z from the middle of a direction `axis`, on either side.
void add_pair(std::vector<Depth>& faces, const Enclosure& at, const Enclosure& half,
              const Enclosure& growth, const Vec3& axis) {
  const Enclosure scale =
      Enclosure(1.0) / boost::numeric::sqrt(1.0 + boost::numeric::square(growth));
  const Vec3 up = median(growth) * Vec3::UnitZ();
  faces.push_back({(half - at) * scale, (axis - up).normalized()});
  faces.push_back({(half + at) * scale, (-axis - up).normalized()});
}

using Slab = std::vector<Depth>;

// `p` counts from the blank's origin.
std::vector<Slab> slabs(const BoxShape& box, const Enclosure3& p) {
  Slab faces;
  add_pair(faces, p.x, 0.5 * Enclosure(box.size_x), 0.0, Vec3::UnitX());
  add_pair(faces, p.y, 0.5 * Enclosure(box.size_y), 0.0, Vec3::UnitY());
  faces.push_back({p.z, -Vec3::UnitZ()});
  faces.push_back({Enclosure(box.height) - p.z, Vec3::UnitZ()});
  return {faces};
}

std::vector<Slab> slabs(const FrustumShape& f, const Enclosure3& p) {
  const Enclosure growth = (Enclosure(f.top_radius) - f.bottom_radius) / Enclosure(f.height);
  const Enclosure radius = f.bottom_radius + growth * p.z;
  const Enclosure across =
      boost::numeric::sqrt(boost::numeric::square(p.x) + boost::numeric::square(p.y));
  const Enclosure scale =
      Enclosure(1.0) / boost::numeric::sqrt(1.0 + boost::numeric::square(growth));
  const Vec3 away = Vec3(median(p.x), median(p.y), 0.0).normalized();
  return {{{(radius - across) * scale, (away - median(growth) * Vec3::UnitZ()).normalized()},
           {p.z, -Vec3::UnitZ()},
           {Enclosure(f.height) - p.z, Vec3::UnitZ()}}};
}

std::vector<Slab> slabs(const LoftShape& loft, const Enclosure3& p) {
  std::vector<Slab> all;
  for (const auto& [bottom, top] : slabs_of(loft)) {
    const Enclosure height = Enclosure(top.z) - bottom.z, up = p.z - bottom.z;
    Slab faces;
    const auto add_sides = [&](double from, double to, const Enclosure& at, const Vec3& axis) {
      const Enclosure growth = 0.5 * (Enclosure(to) - from) / height;
      add_pair(faces, at, 0.5 * Enclosure(from) + growth * up, growth, axis);
    };
    add_sides(bottom.size_x, top.size_x, p.x, Vec3::UnitX());
    add_sides(bottom.size_y, top.size_y, p.y, Vec3::UnitY());
    faces.push_back({up, -Vec3::UnitZ()});
    faces.push_back({Enclosure(top.z) - p.z, Vec3::UnitZ()});
    all.push_back(std::move(faces));
  }
  return all;
}

BlankSide side_of_slabs(std::span<const Slab> all, double margin) {
  BlankSide side{.outside = true};
  double nearest = -std::numeric_limits<double>::infinity();
  for (const Slab& slab : all) {
    bool inside = true, outside = false;
    const Depth* least = &slab.front();
    for (const Depth& face : slab) {
      inside = inside && face.depth.lower() > margin;
      outside = outside || face.depth.upper() < -margin;
      if (median(face.depth) < median(least->depth)) least = &face;
    }
    side.inside = side.inside || inside;
    side.outside = side.outside && outside;
    if (median(least->depth) <= nearest) continue;
    nearest = median(least->depth);
    side.outward = least->outward;
  }
  return side;
}

}  // namespace

BlankSide side_of(const Blank& blank, const Vec3& point, double margin) {
  if (const auto* mesh = std::get_if<MeshShape>(&blank.shape())) {
    constexpr double kMeshAccuracy = 1e-10;  // mm, of meshes below a metre
    const Vec3 p = point - blank.origin();
    const double distance = mesh->solid->signed_distance(p);
    return {distance<-margin - kMeshAccuracy, distance> margin + kMeshAccuracy,
            mesh->solid->normal(mesh->solid->nearest(p).facet)};
  }
  const Enclosure3 p = enclose(point) - enclose(blank.origin());
  if (const auto* box = std::get_if<BoxShape>(&blank.shape())) {
    return side_of_slabs(slabs(*box, p), margin);
  }
  if (const auto* frustum = std::get_if<FrustumShape>(&blank.shape())) {
    return side_of_slabs(slabs(*frustum, p), margin);
  }
  return side_of_slabs(slabs(std::get<LoftShape>(blank.shape()), p), margin);
}

}  // namespace frustum::stock

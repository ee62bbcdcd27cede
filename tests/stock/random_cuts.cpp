#include "tests/stock/random_cuts.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>
#include <vector>

#include "core/ray.hpp"
#include "stock/solid/workpiece.hpp"
#include "tests/cutter/cutter_kinds.hpp"
#include "tests/cutter/random_paths.hpp"

namespace frustum::proof {
namespace {

using kinematics::ToolPath;
using kinematics::ToolPose;
using stock::Blank;

Blank random_blank(Draw& draw) {
  const Vec3 origin = draw.point(Vec3(-3, -3, -3), Vec3(3, 3, 3));
  const double height = draw.between(1.0, 12.0);
  if (draw.chance(0.6)) {
    return Blank::make(stock::BoxShape{draw.between(2.0, 20.0), draw.between(2.0, 20.0), height},
                       origin)
        .value();
  }
  return Blank::make(stock::FrustumShape{draw.between(2.0, 12.0), draw.between(2.0, 12.0), height},
                     origin)
      .value();
}

// Steps that people and controllers make: straight, turning, along the axis, none at all, back, off
// by a hair.
ToolPose next_pose(const std::vector<ToolPose>& poses, Draw& draw) {
  const ToolPose& last = poses.back();
  switch (draw.below(9)) {
    case 0:
      return last;
    case 1:
      return {last.tip, draw.axis(3.1)};
    case 2:
      return {last.tip + draw.between(-15.0, 15.0) * last.axis, last.axis};
    case 3:
      return poses[static_cast<std::size_t>(draw.below(static_cast<int>(poses.size())))];
    case 4:
      return {last.tip + draw.decades(1e-14, 1e-3) * draw.direction(), last.axis};
    case 5:
      return {last.tip, (last.axis + draw.decades(1e-16, 1e-4) * draw.direction()).normalized()};
    case 6:
      return {draw.point(Vec3(-12, -12, -4), Vec3(12, 12, 14)), draw.axis(1.5)};
    case 7: {  // on whole millimetres, where faces meet faces
      const Vec3 at = draw.point(Vec3(-12, -12, -2), Vec3(12, 12, 10));
      return {Vec3(std::round(at.x()), std::round(at.y()), std::round(at.z())), last.axis};
    }
    default:
      return {draw.point(Vec3(-12, -12, -2), Vec3(12, 12, 10)), last.axis};
  }
}

double length_left(const stock::Workpiece& left, const Ray& ray, std::uint32_t segments) {
  return left.material_along(ray, {-200.0, 200.0}, segments).length();
}

// Along a few rays: more segments never leave more.
std::string grows(const stock::Workpiece& left, const Vec3& middle, std::size_t segments,
                  Draw& draw) {
  // Sweeps are 1 nm exact normal to their surface; a grazing ray is cut that much longer or
  // shorter.
  constexpr double kGrazing = 1e-2;  // mm
  for (int k = 0; k < 4; ++k) {
    const Ray ray{middle + draw.point(Vec3(-6, -6, -6), Vec3(6, 6, 6)), draw.direction()};
    double before = length_left(left, ray, 0);
    if (!(before >= 0.0) || !std::isfinite(before)) return "a length that is no length";
    for (std::uint32_t n = 1; n <= segments; ++n) {
      const double now = length_left(left, ray, n);
      if (!(now >= 0.0)) return "a negative length";
      if (now > before + kGrazing) return "more is left after more path segments";
      before = now;
    }
  }
  return {};
}

bool finite(const stock::SurfaceMesh& mesh) {
  return std::all_of(mesh.vertices.begin(), mesh.vertices.end(),
                     [](const Vec3& v) { return v.allFinite(); }) &&
         std::all_of(mesh.normals.begin(), mesh.normals.end(), [](const Vec3& n) {
           return n.allFinite() && std::abs(n.norm() - 1.0) < 1e-6;
         });
}

double enclosed(const stock::SurfaceMesh& mesh) {
  double six = 0.0;
  for (const auto& [a, b, c] : mesh.triangles) {
    six += mesh.vertices[a].dot(mesh.vertices[b].cross(mesh.vertices[c]));
  }
  return six / 6.0;
}

}  // namespace

RandomCut random_cut(std::uint64_t seed) {
  Draw draw(seed, 77);
  std::vector<ToolPose> poses = {
      {draw.point(Vec3(-12, -12, -4), Vec3(12, 12, 14)),
       draw.chance(0.4) ? Vec3(Vec3::UnitZ()) : draw.axis(draw.chance(0.1) ? 3.1 : 0.6)}};
  const int segments = draw.below(9);
  for (int i = 0; i < segments; ++i) poses.push_back(next_pose(poses, draw));
  ToolPath path = path_through(poses);
  const std::vector<Kind>& kinds = cutter_kinds();
  const auto any = [&] {
    return kinds[static_cast<std::size_t>(draw.below(static_cast<int>(kinds.size())))].cutter;
  };
  std::map<int, cutter::Cutter> tools;
  tools.emplace(1, any());
  tools.emplace(2, any());
  for (kinematics::PathBlock& block : path.blocks) block.tool = draw.chance(0.7) ? 1 : 2;
  stock::Blank blank = random_blank(draw);
  const stock::BoundingBox bounds = blank.bounds();
  const double pitch = (bounds.max - bounds.min).maxCoeff() / draw.between(2.0, 6.0);
  return {std::move(blank), std::move(path), std::move(tools), pitch};
}

std::string broken_law(const RandomCut& cut) {
  const auto swept = cutter::SweptCutter::sweep(cut.path, cut.tools);
  if (!swept) return "refused: " + to_string(swept.error().front());
  const stock::Workpiece left(cut.blank, *swept);
  const stock::BoundingBox bounds = cut.blank.bounds();
  Draw draw(1, 78);
  if (std::string fault =
          grows(left, 0.5 * (bounds.min + bounds.max), cut.path.segments.size(), draw);
      !fault.empty()) {
    return fault;
  }
  const auto dexels = stock::TriDexel::sample(left, bounds, Mm{cut.pitch});
  if (!dexels) return "refused: " + to_string(dexels.error().front());
  const auto nothing = cutter::SweptCutter::sweep({}, {});
  const auto uncut =
      stock::TriDexel::sample(stock::Workpiece(cut.blank, *nothing), bounds, Mm{cut.pitch});
  for (std::size_t d = 0; d < 3; ++d) {
    const double volume = dexels->volumes()[d];
    if (!(volume >= 0.0) || volume > uncut->volumes()[d] * (1.0 + 1e-12))
      return "a volume that cannot be";
  }
  const stock::SurfaceMesh mesh = stock::extract_surface(left, *dexels);
  if (!finite(mesh)) return "a vertex or normal that is not finite";
  if (std::string fault = open_or_not_manifold(mesh); !fault.empty()) return fault;
  // Triangles leave the surface by a share of the pitch; detail below it may turn inside out there.
  if (!(enclosed(mesh) > -cut.pitch * cut.pitch * cut.pitch)) return "a mesh of negative volume";
  return {};
}

std::string open_or_not_manifold(const stock::SurfaceMesh& mesh) {
  // Corner: at `of`, the triangle runs on from `first` to `second`.
  struct Corner {
    std::uint32_t of, first, second;
    auto operator<=>(const Corner&) const = default;
  };
  std::vector<Corner> corners;
  for (const auto& [a, b, c] : mesh.triangles) {
    if (std::max({a, b, c}) >= mesh.vertices.size()) return "a triangle of a vertex that is none";
    if (a == b || b == c || c == a) return "a triangle of two vertices";
    corners.push_back({a, b, c});
    corners.push_back({b, c, a});
    corners.push_back({c, a, b});
  }
  std::sort(corners.begin(), corners.end());
  const auto find = [&](std::uint32_t of, std::uint32_t first) {
    return std::lower_bound(corners.begin(), corners.end(), Corner{of, first, 0});
  };
  for (std::size_t i = 1; i < corners.size(); ++i) {
    if (corners[i].of == corners[i - 1].of && corners[i].first == corners[i - 1].first) {
      return "an edge of two triangles on one side";
    }
  }
  for (auto begin = corners.begin(); begin != corners.end();) {
    const auto end =
        std::find_if(begin, corners.end(), [&](const Corner& c) { return c.of != begin->of; });
    std::size_t round = 0;
    auto at = begin;
    do {
      const auto next = find(at->of, at->second);
      if (next == corners.end() || next->of != at->of || next->first != at->second)
        return "an open edge";
      at = next;
      ++round;
    } while (at != begin && round <= static_cast<std::size_t>(end - begin));
    if (round != static_cast<std::size_t>(end - begin)) return "a vertex of two fans";
    begin = end;
  }
  return {};
}

}  // namespace frustum::proof

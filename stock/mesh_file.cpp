#include "stock/mesh_file.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <bit>
#include <iterator>

#include "core/whole_file.hpp"

namespace frustum::stock {
namespace {

namespace fs = std::filesystem;

constexpr const char* kChoices = "use one of .stl, .ply, .obj";

// Appends numbers with the lowest byte first, whatever the machine does.
template <typename Word>
void put_word(std::string& out, Word word) {
  for (std::size_t byte = 0; byte < sizeof word; ++byte) {
    out.push_back(static_cast<char>(static_cast<unsigned char>(word >> 8 * byte & 0xFFU)));
  }
}
void put(std::string& out, float number) { put_word(out, std::bit_cast<std::uint32_t>(number)); }
void put(std::string& out, double number) { put_word(out, std::bit_cast<std::uint64_t>(number)); }
void put_floats(std::string& out, const Vec3& v) {
  for (const double x : v) put(out, static_cast<float>(x));
}

Vec3 triangle_normal(const SurfaceMesh& mesh, const std::array<std::uint32_t, 3>& triangle) {
  const Vec3& a = mesh.vertices[triangle[0]];
  const Vec3 across = (mesh.vertices[triangle[1]] - a).cross(mesh.vertices[triangle[2]] - a);
  const double length = across.norm();
  // STL's own way of saying that a triangle has no normal.
  return length > 0.0 ? Vec3(across / length) : Vec3(Vec3::Zero());
}

std::string stl_bytes(const SurfaceMesh& mesh) {
  std::string out = "binary STL, mm";  // must not begin with "solid", the mark of text STL
  out.resize(80, ' ');
  out.reserve(84 + 50 * mesh.triangles.size());
  put_word(out, static_cast<std::uint32_t>(mesh.triangles.size()));
  for (const auto& triangle : mesh.triangles) {
    put_floats(out, triangle_normal(mesh, triangle));
    for (const std::uint32_t vertex : triangle) put_floats(out, mesh.vertices[vertex]);
    put_word(out, std::uint16_t{0});
  }
  return out;
}

std::string ply_bytes(const SurfaceMesh& mesh) {
  std::string out = fmt::format(
      "ply\n"
      "format binary_little_endian 1.0\n"
      "comment lengths in mm, deviations in micrometres\n"
      "element vertex {}\n"
      "property double x\nproperty double y\nproperty double z\n"
      "property float nx\nproperty float ny\nproperty float nz\n"
      "property float deviation_um\n"
      "property float quality\n"
      "property uchar has_nominal\n"
      "element face {}\n"
      "property list uchar uint vertex_indices\n"
      "end_header\n",
      mesh.vertices.size(), mesh.triangles.size());
  out.reserve(out.size() + 45 * mesh.vertices.size() + 13 * mesh.triangles.size());
  for (std::size_t v = 0; v < mesh.vertices.size(); ++v) {
    for (const double x : mesh.vertices[v]) put(out, x);
    put_floats(out, v < mesh.normals.size() ? mesh.normals[v] : Vec3(Vec3::Zero()));
    const auto deviation = v < mesh.deviation.size() ? mesh.deviation[v] : std::nullopt;
    const auto um = static_cast<float>(deviation.value_or(0.0) * kUmPerMm);
    put(out, um);
    put(out, um);
    out.push_back(deviation ? '\1' : '\0');
  }
  for (const auto& triangle : mesh.triangles) {
    out.push_back('\3');
    for (const std::uint32_t vertex : triangle) put_word(out, vertex);
  }
  return out;
}

std::string obj_bytes(const SurfaceMesh& mesh) {
  std::string out = "# lengths in mm\n";
  const auto to = std::back_inserter(out);
  // 0.1 nm: a digit more than the surface is known to.
  for (const Vec3& v : mesh.vertices) {
    fmt::format_to(to, "v {:.7f} {:.7f} {:.7f}\n", v.x(), v.y(), v.z());
  }
  const bool normals = mesh.normals.size() == mesh.vertices.size();
  if (normals) {
    for (const Vec3& n : mesh.normals) {
      fmt::format_to(to, "vn {:.6f} {:.6f} {:.6f}\n", n.x(), n.y(), n.z());
    }
  }
  for (const auto& [a, b, c] : mesh.triangles) {
    if (normals) {
      fmt::format_to(to, "f {0}//{0} {1}//{1} {2}//{2}\n", a + 1, b + 1, c + 1);
    } else {
      fmt::format_to(to, "f {} {} {}\n", a + 1, b + 1, c + 1);
    }
  }
  return out;
}

}  // namespace

Result<MeshFormat> mesh_format_of(const fs::path& file) {
  std::string extension = file.extension().string();
  std::transform(extension.begin(), extension.end(), extension.begin(), [](char c) {
    return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c;
  });
  if (extension == ".stl") return MeshFormat::stl;
  if (extension == ".ply") return MeshFormat::ply;
  if (extension == ".obj") return MeshFormat::obj;
  Diagnostic unknown =
      error(extension.empty() ? std::string("the mesh file has no extension to tell its format")
                              : fmt::format("{} is not a mesh format known here", extension),
            kChoices);
  unknown.file = file.string();
  return unknown;
}

std::string mesh_bytes(const SurfaceMesh& mesh, MeshFormat format) {
  switch (format) {
    case MeshFormat::stl:
      return stl_bytes(mesh);
    case MeshFormat::ply:
      return ply_bytes(mesh);
    case MeshFormat::obj:
      break;
  }
  return obj_bytes(mesh);
}

Result<std::uintmax_t> write_mesh(const SurfaceMesh& mesh, const fs::path& file) {
  const auto format = mesh_format_of(file);
  if (!format) return format.error();
  const std::string bytes = mesh_bytes(mesh, *format);
  const auto written = write_whole_file(file, bytes);
  if (!written) return written.error();
  return std::uintmax_t{bytes.size()};
}

}  // namespace frustum::stock

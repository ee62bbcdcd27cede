#include "stock/mesh/io/mesh_file.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <bit>
#include <iterator>
#include <limits>

#include "core/base64.hpp"
#include "core/made_by.hpp"
#include "core/whole_file.hpp"
#include "stock/mesh/io/zip_archive.hpp"

namespace frustum::stock {
namespace {

namespace fs = std::filesystem;

constexpr const char* kChoices = "use one of .stl, .ply, .obj, .3mf, .vtp";

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
  // It must not begin with "solid", the mark of text STL.
  std::string out = "binary STL, mm. " + made_by();
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

void put_faces(std::string& out, const SurfaceMesh& mesh) {
  for (const auto& triangle : mesh.triangles) {
    out.push_back('\3');
    for (const std::uint32_t vertex : triangle) put_word(out, vertex);
  }
}

// Without anything that nobody has said.
std::string bare_ply_bytes(const SurfaceMesh& mesh) {
  std::string out = fmt::format(
      "ply\n"
      "format binary_little_endian 1.0\n"
      "comment {}\n"
      "comment lengths in mm\n"
      "element vertex {}\n"
      "property double x\nproperty double y\nproperty double z\n"
      "element face {}\n"
      "property list uchar uint vertex_indices\n"
      "end_header\n",
      made_by(), mesh.vertices.size(), mesh.triangles.size());
  out.reserve(out.size() + 24 * mesh.vertices.size() + 13 * mesh.triangles.size());
  for (const Vec3& vertex : mesh.vertices) {
    for (const double x : vertex) put(out, x);
  }
  put_faces(out, mesh);
  return out;
}

std::string ply_bytes(const SurfaceMesh& mesh) {
  if (mesh.normals.empty() && mesh.deviation.empty()) return bare_ply_bytes(mesh);
  std::string out = fmt::format(
      "ply\n"
      "format binary_little_endian 1.0\n"
      "comment {}\n"
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
      made_by(), mesh.vertices.size(), mesh.triangles.size());
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
  put_faces(out, mesh);
  return out;
}

std::string obj_bytes(const SurfaceMesh& mesh) {
  std::string out = "# " + made_by() + "\n# lengths in mm\n";
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

constexpr std::string_view kContentTypes =
    R"(<?xml version="1.0" encoding="UTF-8"?>
<Types xmlns="http://schemas.openxmlformats.org/package/2006/content-types">
<Default Extension="rels" ContentType="application/vnd.openxmlformats-package.relationships+xml"/>
<Default Extension="model" ContentType="application/vnd.ms-package.3dmanufacturing-3dmodel+xml"/>
</Types>
)";
constexpr std::string_view kRelationships =
    R"(<?xml version="1.0" encoding="UTF-8"?>
<Relationships xmlns="http://schemas.openxmlformats.org/package/2006/relationships">
<Relationship Id="model" Target="/3D/3dmodel.model" Type="http://schemas.microsoft.com/3dmanufacturing/2013/01/3dmodel"/>
</Relationships>
)";

// An archive of three XML files (3MF Core Specification 1.2).
std::string three_mf_bytes(const SurfaceMesh& mesh) {
  std::string model =
      R"(<?xml version="1.0" encoding="UTF-8"?>
<model unit="millimeter" xml:lang="en-US" xmlns="http://schemas.microsoft.com/3dmanufacturing/core/2015/02">
<metadata name="Application">Frustum )" +
      std::string(program_version()) + R"(</metadata>
<resources><object id="1" type="model"><mesh>
<vertices>
)";
  const auto to = std::back_inserter(model);
  for (const Vec3& v : mesh.vertices) {
    fmt::format_to(to, "<vertex x=\"{:.7f}\" y=\"{:.7f}\" z=\"{:.7f}\"/>\n", v.x(), v.y(), v.z());
  }
  model += "</vertices>\n<triangles>\n";
  for (const auto& [a, b, c] : mesh.triangles) {
    fmt::format_to(to, "<triangle v1=\"{}\" v2=\"{}\" v3=\"{}\"/>\n", a, b, c);
  }
  model +=
      "</triangles>\n</mesh></object></resources>\n<build><item "
      "objectid=\"1\"/></build>\n</model>\n";
  return zip_archive(std::array{ZipEntry{"[Content_Types].xml", kContentTypes},
                                ZipEntry{"_rels/.rels", kRelationships},
                                ZipEntry{"3D/3dmodel.model", model}});
}

// One array of a VTP: its length in bytes and its numbers, in base64 so that the file is XML.
template <typename Fill>
std::string vtp_array(std::string_view type, std::string_view name, int components,
                      std::size_t bytes, const Fill& fill) {
  std::string data;
  data.reserve(8 + bytes);
  put_word(data, std::uint64_t{bytes});
  fill(data);
  return fmt::format(
      "<DataArray type=\"{}\" Name=\"{}\" NumberOfComponents=\"{}\" format=\"binary\">\n{}\n"
      "</DataArray>\n",
      type, name, components,
      base64({reinterpret_cast<const unsigned char*>(data.data()), data.size()}));
}

std::string vtp_bytes(const SurfaceMesh& mesh) {
  const std::size_t n = mesh.vertices.size();
  const std::size_t m = mesh.triangles.size();
  std::string out = fmt::format(
      "<?xml version=\"1.0\"?>\n<!-- {} -->\n"
      "<VTKFile type=\"PolyData\" version=\"1.0\" byte_order=\"LittleEndian\" "
      "header_type=\"UInt64\">\n<PolyData>\n<Piece NumberOfPoints=\"{}\" NumberOfVerts=\"0\" "
      "NumberOfLines=\"0\" NumberOfStrips=\"0\" NumberOfPolys=\"{}\">\n",
      made_by(), n, m);
  out += "<PointData Normals=\"Normals\" Scalars=\"deviation_um\">\n";
  out += vtp_array("Float32", "Normals", 3, 12 * n, [&](std::string& data) {
    for (std::size_t v = 0; v < n; ++v) {
      put_floats(data, v < mesh.normals.size() ? mesh.normals[v] : Vec3(Vec3::Zero()));
    }
  });
  out += vtp_array("Float32", "deviation_um", 1, 4 * n, [&](std::string& data) {
    for (std::size_t v = 0; v < n; ++v) {
      const auto known = v < mesh.deviation.size() ? mesh.deviation[v] : std::nullopt;
      put(data,
          known ? static_cast<float>(*known * kUmPerMm) : std::numeric_limits<float>::quiet_NaN());
    }
  });
  out += vtp_array("UInt8", "kind", 1, n, [&](std::string& data) {
    for (std::size_t v = 0; v < n; ++v) {
      data.push_back(v < mesh.kinds.size() ? static_cast<char>(mesh.kinds[v]) : '\0');
    }
  });
  out += "</PointData>\n<Points>\n";
  out += vtp_array("Float64", "Points", 3, 24 * n, [&](std::string& data) {
    for (const Vec3& v : mesh.vertices) {
      for (const double x : v) put(data, x);
    }
  });
  out += "</Points>\n<Polys>\n";
  out += vtp_array("Int64", "connectivity", 1, 24 * m, [&](std::string& data) {
    for (const auto& triangle : mesh.triangles) {
      for (const std::uint32_t v : triangle) put_word(data, std::uint64_t{v});
    }
  });
  out += vtp_array("Int64", "offsets", 1, 8 * m, [&](std::string& data) {
    for (std::size_t t = 1; t <= m; ++t) put_word(data, std::uint64_t{3 * t});
  });
  return out + "</Polys>\n</Piece>\n</PolyData>\n</VTKFile>\n";
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
  if (extension == ".3mf") return MeshFormat::three_mf;
  if (extension == ".vtp") return MeshFormat::vtp;
  Diagnostic unknown =
      error("mesh-format"_id,
            extension.empty() ? std::string("the mesh file has no extension to show its format")
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
    case MeshFormat::three_mf:
      return three_mf_bytes(mesh);
    case MeshFormat::vtp:
      return vtp_bytes(mesh);
    case MeshFormat::obj:
      break;
  }
  return obj_bytes(mesh);
}

Result<std::uintmax_t> write_mesh(const SurfaceMesh& mesh, const fs::path& file) {
  const auto format = mesh_format_of(file);
  if (!format) return format.error();
  // A vertex takes up to 90 bytes of XML, a triangle up to 60.
  const std::uint64_t most = 90 * std::uint64_t{mesh.vertices.size()} + 60 * mesh.triangles.size();
  if (*format == MeshFormat::three_mf && most > 0xFFFF'0000U) {
    Diagnostic large = error(
        "mesh-size"_id, fmt::format("{} triangles are too many for a 3MF", mesh.triangles.size()),
        "decimate the mesh, or write .ply");
    large.file = file.string();
    return large;
  }
  const std::string bytes = mesh_bytes(mesh, *format);
  const auto written = write_whole_file(file, bytes);
  if (!written) return written.error();
  return std::uintmax_t{bytes.size()};
}

}  // namespace frustum::stock

#include "stock/mesh/io/mesh_reader.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <zlib.h>

#include <algorithm>
#include <cstring>
#include <string>

#include "core/program_version.hpp"

namespace frustum::stock {
namespace {

using ::testing::HasSubstr;

SurfaceMesh one_tetrahedron() {
  SurfaceMesh mesh;
  mesh.vertices = {Vec3(0, 0, 0), Vec3(1, 0, 0), Vec3(0, 1, 0), Vec3(0, 0, 0.25)};
  mesh.triangles = {{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {2, 0, 3}};
  mesh.normals.assign(4, Vec3::UnitZ());
  mesh.kinds.assign(4, VertexKind::feature);
  mesh.deviation = {0.001, std::nullopt, -0.002, 0.0};
  return mesh;
}

// What a file says is wrong, with its line.
std::string fault(std::string_view bytes, MeshFormat format) {
  const auto mesh = parse_mesh(bytes, format);
  if (mesh) return "nothing";
  const Diagnostic& first = mesh.error().front();
  return (first.line > 0 ? std::to_string(first.line) + ": " : std::string()) + first.message;
}

void expect_tetrahedron(std::string_view bytes, MeshFormat format) {
  const auto mesh = parse_mesh(bytes, format);
  ASSERT_TRUE(mesh.has_value()) << mesh.error().front().message;
  EXPECT_EQ(mesh->vertices.size(), 4U);
  const MeshMeasure measured = measure(*mesh);
  EXPECT_TRUE(measured.is_closed);
  EXPECT_TRUE(measured.is_manifold);
  EXPECT_DOUBLE_EQ(measured.volume, 0.25 / 6.0);
}

TEST(MeshReader, ReadsBackWhatIsWritten) {
  for (const MeshFormat format : {MeshFormat::stl, MeshFormat::ply, MeshFormat::obj}) {
    SCOPED_TRACE(static_cast<int>(format));
    expect_tetrahedron(mesh_bytes(one_tetrahedron(), format), format);
  }
  const auto again = parse_mesh(mesh_bytes(one_tetrahedron(), MeshFormat::ply), MeshFormat::ply);
  EXPECT_EQ(again->vertices, one_tetrahedron().vertices);
  EXPECT_EQ(again->triangles, one_tetrahedron().triangles);
}

constexpr const char* kTextPly =
    "ply\nformat ascii 1.0\ncomment by hand\nelement vertex 4\nproperty float x\nproperty float y\n"
    "property float z\nelement face 4\nproperty list uchar int vertex_index\nend_header\n"
    "0 0 0\n1 0 0\n0 1 0\n0 0 0.25\n3 0 2 1\n3 0 1 3\n3 1 2 3\n3 2 0 3\n";

TEST(MeshReader, ReadsTextFilesOfOtherPrograms) {
  std::string stl = "solid by hand\n";
  for (const auto& triangle : one_tetrahedron().triangles) {
    stl += "facet normal 0 0 0\n outer loop\n";
    for (const auto v : triangle) {
      const Vec3 p = one_tetrahedron().vertices[v];
      stl += "  vertex " + std::to_string(p.x()) + " " + std::to_string(p.y()) + " " +
             std::to_string(p.z()) + "\r\n";
    }
    stl += " endloop\nendfacet\n";
  }
  expect_tetrahedron(stl + "endsolid by hand\n", MeshFormat::stl);
  expect_tetrahedron(kTextPly, MeshFormat::ply);
  expect_tetrahedron(
      "# by hand\nv 0 0 0\nv +1 0 0\nv 0 1 0\nv 0 0 0.25\nvt 0 0\n"
      "f 1/1/1 3/1/1 2/1/1\nf 1//1 2//1 4//1\nf 2 3 4\nf -2 -4 -1",
      MeshFormat::obj);
}

TEST(MeshReader, ReadsPlyOfBigEndianMachinesAndSplitsPolygons) {
  // A square pyramid with its base in one polygon.
  std::string ply =
      "ply\nformat binary_big_endian 1.0\nelement vertex 5\nproperty double x\nproperty double y\n"
      "property double z\nproperty uchar red\nelement face 5\n"
      "property list uchar ushort vertex_indices\nend_header\n";
  const auto put = [&](const auto& value) {
    char raw[sizeof value];
    std::memcpy(raw, &value, sizeof value);
    std::reverse(raw, raw + sizeof value);  // the test machine keeps the lowest byte first
    ply.append(raw, sizeof value);
  };
  for (const Vec3& p :
       {Vec3(0, 0, 0), Vec3(1, 0, 0), Vec3(1, 1, 0), Vec3(0, 1, 0), Vec3(0, 0, 3)}) {
    for (const double x : p) put(x);
    put(std::uint8_t{7});
  }
  const auto face = [&](std::initializer_list<int> corners) {
    put(static_cast<std::uint8_t>(corners.size()));
    for (const int v : corners) put(static_cast<std::uint16_t>(v));
  };
  face({3, 2, 1, 0});
  face({0, 1, 4});
  face({1, 2, 4});
  face({2, 3, 4});
  face({3, 0, 4});
  const auto mesh = parse_mesh(ply, MeshFormat::ply);
  ASSERT_TRUE(mesh.has_value()) << mesh.error().front().message;
  EXPECT_EQ(mesh->triangles.size(), 6U);
  EXPECT_TRUE(measure(*mesh).is_closed);
  EXPECT_DOUBLE_EQ(measure(*mesh).volume, 1.0);
  ply.resize(ply.size() - 3);
  EXPECT_THAT(fault(ply, MeshFormat::ply), HasSubstr("within the body of the PLY"));
}

TEST(MeshReader, SaysWhatIsWrongAndWhere) {
  std::string stl = mesh_bytes(one_tetrahedron(), MeshFormat::stl);
  stl.pop_back();
  EXPECT_THAT(fault(stl, MeshFormat::stl),
              HasSubstr("4 triangles has 284 bytes, this file has 283"));
  EXPECT_THAT(fault("", MeshFormat::stl), HasSubstr("within the header"));
  EXPECT_THAT(fault("solid a\nfacet normal 0 0 1\nouter loop\nvertex 0 zero 0\n", MeshFormat::stl),
              HasSubstr("4: 'zero' is not a finite coordinate"));
  EXPECT_THAT(fault("solid a\nvertex 0 0 0\nendfacet\n", MeshFormat::stl),
              HasSubstr("3: a facet with 1 vertex"));
  EXPECT_THAT(fault("solid a\nendsolid\n", MeshFormat::stl), HasSubstr("no triangles"));
  EXPECT_THAT(fault("polygon\n", MeshFormat::ply), HasSubstr("1: a PLY begins"));
  std::string ply = kTextPly;
  ply.replace(ply.find("3 2 0 3"), 7, "3 2 0 4");
  EXPECT_THAT(fault(ply, MeshFormat::ply), HasSubstr("18: face 4 names vertex 4; there are 4"));
  ply = kTextPly;
  ply.replace(ply.find("float z"), 7, "real z ");
  EXPECT_THAT(fault(ply, MeshFormat::ply), HasSubstr("7: 'real' is no type"));
  EXPECT_THAT(fault("v 0 0 0\nv 1 0 0\nf 1 2 3\n", MeshFormat::obj),
              HasSubstr("3: '3' is no vertex: 2 are known"));
  EXPECT_THAT(fault("v 0 nan 0\n", MeshFormat::obj), HasSubstr("1: 'nan' is not a finite"));
  EXPECT_THAT(fault("", MeshFormat::vtp), HasSubstr("written here, not read"));
  EXPECT_THAT(read_mesh("/nowhere/a.stl").error().front().file, HasSubstr("a.stl"));
}

TEST(MeshReader, AnyCutOrChangedFileIsRefusedOrReadButNeverWorse) {
  for (const MeshFormat format : {MeshFormat::stl, MeshFormat::ply, MeshFormat::obj}) {
    const std::string whole = mesh_bytes(one_tetrahedron(), format);
    for (std::size_t k = 0; k < whole.size(); ++k) {
      (void)parse_mesh(std::string_view(whole).substr(0, k), format);
      std::string changed = whole;
      changed[k] = static_cast<char>(changed[k] ^ 0x55);
      const auto mesh = parse_mesh(changed, format);
      if (!mesh) continue;
      for (const auto& triangle : mesh->triangles) {
        for (const auto v : triangle) ASSERT_LT(v, mesh->vertices.size());
      }
    }
  }
}

// Unpacks the entry of that name, as its local header has it.
std::string unzipped(const std::string& archive, const std::string& name) {
  const std::size_t at = archive.find(name);
  if (at == std::string::npos || at < 30) return {};
  std::uint32_t packed = 0;
  std::uint32_t size = 0;
  std::uint32_t crc = 0;
  std::memcpy(&crc, archive.data() + at - 16, 4);
  std::memcpy(&packed, archive.data() + at - 12, 4);
  std::memcpy(&size, archive.data() + at - 8, 4);
  std::string out(size, '\0');
  z_stream stream{};
  inflateInit2(&stream, -15);
  std::string in = archive.substr(at + name.size(), packed);
  stream.next_in = reinterpret_cast<Bytef*>(in.data());
  stream.avail_in = packed;
  stream.next_out = reinterpret_cast<Bytef*>(out.data());
  stream.avail_out = size;
  EXPECT_EQ(inflate(&stream, Z_FINISH), Z_STREAM_END);
  inflateEnd(&stream);
  EXPECT_EQ(crc32(0, reinterpret_cast<const Bytef*>(out.data()), size), crc);
  return out;
}

TEST(ThreeMf, IsAnArchiveOfAModelAndWhatPointsToIt) {
  const std::string bytes = mesh_bytes(one_tetrahedron(), MeshFormat::three_mf);
  EXPECT_EQ(bytes.substr(0, 4), "PK\3\4");
  EXPECT_EQ(bytes.substr(bytes.size() - 22, 4), "PK\5\6");
  EXPECT_THAT(unzipped(bytes, "[Content_Types].xml"), HasSubstr("Extension=\"model\""));
  EXPECT_THAT(unzipped(bytes, "_rels/.rels"), HasSubstr("Target=\"/3D/3dmodel.model\""));
  const std::string model = unzipped(bytes, "3D/3dmodel.model");
  EXPECT_THAT(model, HasSubstr("unit=\"millimeter\""));
  EXPECT_THAT(model, HasSubstr("<metadata name=\"Application\">Frustum " +
                               std::string(program_version()) + "</metadata>\n<resources>"));
  EXPECT_THAT(model, HasSubstr("<vertex x=\"0.0000000\" y=\"0.0000000\" z=\"0.2500000\"/>"));
  EXPECT_THAT(model, HasSubstr("<triangle v1=\"2\" v2=\"0\" v3=\"3\"/>\n</triangles>"));
  EXPECT_EQ(bytes, mesh_bytes(one_tetrahedron(), MeshFormat::three_mf));
}

// What base64 says.
std::string bytes_of(const std::string& text) {
  const std::string alphabet = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string bytes;
  std::uint32_t group = 0;
  unsigned bits = 0;
  for (const char c : text.substr(0, text.find('='))) {
    group = group << 6U | static_cast<std::uint32_t>(alphabet.find(c));
    bits += 6;
    if (bits < 8) continue;
    bits -= 8;
    bytes.push_back(static_cast<char>(group >> bits & 255U));
  }
  return bytes;
}

TEST(Vtp, HoldsItsArraysAsText) {
  const std::string file = mesh_bytes(one_tetrahedron(), MeshFormat::vtp);
  const auto array = [&](const std::string& name) {
    const std::size_t begin = file.find('\n', file.find("Name=\"" + name + "\"")) + 1;
    const std::string bytes = bytes_of(file.substr(begin, file.find('\n', begin) - begin));
    std::uint64_t length = 0;
    std::memcpy(&length, bytes.data(), 8);
    EXPECT_EQ(length, bytes.size() - 8) << name;
    return bytes.substr(8);
  };
  EXPECT_EQ(array("Points").size(), 4U * 24U);
  EXPECT_EQ(array("Normals").size(), 4U * 12U);
  EXPECT_EQ(array("deviation_um").size(), 4U * 4U);
  EXPECT_EQ(array("kind").size(), 4U);
  EXPECT_EQ(array("connectivity").size(), 4U * 24U);
  EXPECT_EQ(array("offsets").size(), 4U * 8U);
  double z = 0.0;
  std::memcpy(&z, array("Points").data() + 11 * 8, 8);
  EXPECT_EQ(z, 0.25);
  float um = 0.0F;
  std::memcpy(&um, array("deviation_um").data(), 4);
  EXPECT_EQ(um, 1.0F);
  std::int64_t end = 0;
  std::memcpy(&end, array("offsets").data() + 24, 8);
  EXPECT_EQ(end, 12);
}

}  // namespace
}  // namespace frustum::stock

#include "stock/mesh/io/mesh_file.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstring>
#include <fstream>
#include <iterator>
#include <string>

#include "stock/mesh/io/mesh_reader.hpp"

namespace frustum::stock {
namespace {

namespace fs = std::filesystem;
using ::testing::HasSubstr;
using ::testing::StartsWith;

SurfaceMesh tetrahedron() {
  SurfaceMesh mesh;
  mesh.vertices = {Vec3(0, 0, 0), Vec3(1, 0, 0), Vec3(0, 1, 0), Vec3(0, 0, 1.0 / 3.0)};
  mesh.triangles = {{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {2, 0, 3}};
  mesh.normals.assign(4, Vec3::UnitZ());
  mesh.deviation = {0.001, std::nullopt, -0.002, 0.0};
  return mesh;
}

// As the test machine, like every one the project builds for, keeps numbers: lowest byte first.
template <typename T>
T read(const std::string& bytes, std::size_t at) {
  T value;
  std::memcpy(&value, bytes.data() + at, sizeof value);
  return value;
}

std::string content_of(const fs::path& file) {
  std::ifstream in(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

class MeshFile : public ::testing::Test {
 protected:
  void SetUp() override {
    const auto* info = ::testing::UnitTest::GetInstance()->current_test_info();
    folder_ = fs::path(::testing::TempDir()) / (std::string("mesh_file_") + info->name());
    fs::remove_all(folder_);
    fs::create_directories(folder_);
  }
  void TearDown() override { fs::remove_all(folder_); }

  fs::path folder_;
};

TEST_F(MeshFile, StlHasEightyBytesOfHeaderAndFiftyATriangle) {
  const std::string bytes = mesh_bytes(tetrahedron(), MeshFormat::stl);
  ASSERT_EQ(bytes.size(), 84U + 4U * 50U);
  EXPECT_THAT(bytes, ::testing::Not(StartsWith("solid")));
  EXPECT_EQ(read<std::uint32_t>(bytes, 80), 4U);
  EXPECT_EQ(read<float>(bytes, 84 + 8), -1.0F);              // the first triangle faces down
  EXPECT_EQ(read<float>(bytes, 84 + 12 + 12 + 4), 1.0F);     // y of its second vertex
  EXPECT_EQ(read<float>(bytes, 84 + 50 + 44), 1.0F / 3.0F);  // z of the second triangle's last
  EXPECT_EQ(read<std::uint16_t>(bytes, 84 + 48), 0U);
}

TEST_F(MeshFile, PlyOfPositionsAndFacetsAloneHoldsNothingElse) {
  SurfaceMesh mesh = tetrahedron();
  mesh.normals.clear();
  mesh.deviation.clear();
  const std::string bytes = mesh_bytes(mesh, MeshFormat::ply);
  EXPECT_EQ(bytes.find("property float"), std::string::npos);
  const std::string end = "end_header\n";
  ASSERT_EQ(bytes.size(), bytes.find(end) + end.size() + 4 * (3 * 8) + 4 * (1 + 3 * 4));
  const auto again = parse_mesh(bytes, MeshFormat::ply);
  ASSERT_TRUE(again);
  EXPECT_EQ(again->vertices, mesh.vertices);
  EXPECT_EQ(again->triangles, mesh.triangles);
}

TEST_F(MeshFile, PlyCarriesDeviationInMicrometresAndSaysWhereThereIsNone) {
  const std::string bytes = mesh_bytes(tetrahedron(), MeshFormat::ply);
  EXPECT_THAT(bytes, StartsWith("ply\nformat binary_little_endian 1.0\n"));
  EXPECT_THAT(bytes, HasSubstr("element vertex 4\n"));
  EXPECT_THAT(bytes, HasSubstr("property float deviation_um\nproperty float quality\n"
                               "property uchar has_nominal\n"));
  const std::string end = "end_header\n";
  const std::size_t body = bytes.find(end) + end.size();
  constexpr std::size_t kVertex = 3 * 8 + 3 * 4 + 2 * 4 + 1;
  constexpr std::size_t kTriangle = 1 + 3 * 4;
  ASSERT_EQ(bytes.size(), body + 4 * kVertex + 4 * kTriangle);
  EXPECT_EQ(read<double>(bytes, body + 3 * kVertex + 16), 1.0 / 3.0);
  EXPECT_EQ(read<float>(bytes, body + 32), 1.0F);  // nz
  EXPECT_EQ(read<float>(bytes, body + 36), 1.0F);  // 0.001 mm
  EXPECT_EQ(read<float>(bytes, body + 40), 1.0F);
  EXPECT_EQ(bytes[body + 44], '\1');
  EXPECT_EQ(read<float>(bytes, body + kVertex + 36), 0.0F);
  EXPECT_EQ(bytes[body + kVertex + 44], '\0');
  EXPECT_EQ(read<float>(bytes, body + 2 * kVertex + 40), -2.0F);
  EXPECT_EQ(bytes[body + 4 * kVertex], '\3');
  EXPECT_EQ(read<std::uint32_t>(bytes, body + 4 * kVertex + 5), 2U);
}

TEST_F(MeshFile, PlyOfAMeshWithoutNominalSaysSoAtEveryVertex) {
  SurfaceMesh mesh = tetrahedron();
  mesh.deviation.clear();
  const std::string bytes = mesh_bytes(mesh, MeshFormat::ply);
  const std::size_t body = bytes.find("end_header\n") + 11;
  for (std::size_t v = 0; v < 4; ++v) EXPECT_EQ(bytes[body + v * 45 + 44], '\0');
}

TEST_F(MeshFile, ObjCountsFromOne) {
  const std::string text = mesh_bytes(tetrahedron(), MeshFormat::obj);
  EXPECT_THAT(text, HasSubstr("v 0.0000000 0.0000000 0.3333333\n"));
  EXPECT_THAT(text, HasSubstr("vn 0.000000 0.000000 1.000000\n"));
  EXPECT_THAT(text, HasSubstr("f 1//1 3//3 2//2\n"));
}

TEST_F(MeshFile, TakesTheFormatFromTheExtension) {
  EXPECT_EQ(mesh_format_of("part.STL").value(), MeshFormat::stl);
  EXPECT_EQ(mesh_format_of("a.b/part.ply").value(), MeshFormat::ply);
  EXPECT_EQ(mesh_format_of("part.obj").value(), MeshFormat::obj);
  for (const char* name : {"part.step", "part", "stl"}) {
    const auto format = mesh_format_of(name);
    ASSERT_FALSE(format) << name;
    EXPECT_EQ(format.error()[0].file, name);
    EXPECT_THAT(format.error()[0].hint, HasSubstr(".stl, .ply, .obj"));
  }
}

TEST_F(MeshFile, WritesWholeFilesAndNothingElse) {
  const fs::path file = folder_ / "part.ply";
  const auto size = write_mesh(tetrahedron(), file);
  ASSERT_TRUE(size);
  EXPECT_EQ(*size, fs::file_size(file));
  EXPECT_EQ(content_of(file), mesh_bytes(tetrahedron(), MeshFormat::ply));
  EXPECT_EQ(std::distance(fs::directory_iterator(folder_), {}), 1);
}

TEST_F(MeshFile, ReplacesAFileAndLeavesForeignPartsAlone) {
  const fs::path file = folder_ / "part.stl";
  std::ofstream(file) << "old";
  std::ofstream(folder_ / "part.stl.part") << "another writer's";
  ASSERT_TRUE(write_mesh(tetrahedron(), file));
  EXPECT_EQ(fs::file_size(file), 284U);
  EXPECT_EQ(content_of(folder_ / "part.stl.part"), "another writer's");
}

TEST_F(MeshFile, NamesAPathThatCannotBeWritten) {
  const fs::path file = folder_ / "no" / "part.stl";
  const auto size = write_mesh(tetrahedron(), file);
  ASSERT_FALSE(size);
  EXPECT_EQ(size.error()[0].file, file.string());
  EXPECT_THAT(size.error()[0].message, HasSubstr("No such file or directory"));
}

TEST_F(MeshFile, WillNotReplaceAFolder) {
  const fs::path file = folder_ / "part.stl";
  fs::create_directory(file);
  ASSERT_FALSE(write_mesh(tetrahedron(), file));
  EXPECT_EQ(std::distance(fs::directory_iterator(folder_), {}), 1);
}

TEST_F(MeshFile, KeepsTheOldFileWhenNoPartFileCanBeMade) {
  const fs::path file = folder_ / "part.stl";
  std::ofstream(file) << "old";
  for (int k = 0; k < 100; ++k) {
    fs::create_directory(folder_ /
                         (k == 0 ? "part.stl.part" : "part.stl.part" + std::to_string(k)));
  }
  ASSERT_FALSE(write_mesh(tetrahedron(), file));
  EXPECT_EQ(content_of(file), "old");
}

}  // namespace
}  // namespace frustum::stock

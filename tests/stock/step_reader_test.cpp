#include "stock/step/step_reader.hpp"

#include <gtest/gtest.h>

#include <BRepAlgoAPI_Cut.hxx>
#include <BRepBuilderAPI_MakeVertex.hxx>
#include <BRepPrimAPI_MakeCone.hxx>
#include <BRepPrimAPI_MakeCylinder.hxx>
#include <Interface_Static.hxx>
#include <Message.hxx>
#include <Message_Messenger.hxx>
#include <Message_PrinterOStream.hxx>
#include <STEPControl_Writer.hxx>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <numbers>

#include "stock/mesh/open_edges.hpp"
#include "stock/mesh/weld_mesh.hpp"
#include "stock/solid/nominal_mesh.hpp"

namespace frustum::stock {
namespace {

namespace fs = std::filesystem;

class StepReader : public testing::Test {
 protected:
  void SetUp() override {
    Message::DefaultMessenger()->RemovePrinters(STANDARD_TYPE(Message_PrinterOStream));
    file_ = fs::path(testing::TempDir()) / "frustum_step_reader.step";
  }
  void TearDown() override { fs::remove(file_); }

  // In the unit that the file is to state.
  void write(const TopoDS_Shape& shape, const char* unit = "MM") const {
    Interface_Static::SetCVal("write.step.unit", unit);
    STEPControl_Writer writer;
    ASSERT_EQ(writer.Transfer(shape, STEPControl_AsIs), IFSelect_RetDone);
    ASSERT_EQ(writer.Write(file_.string().c_str()), IFSelect_RetDone);
    Interface_Static::SetCVal("write.step.unit", "MM");
  }
  fs::path file_;
};

TEST_F(StepReader, ACylinderIsWithinTheDeflectionOfItsSurface) {
  constexpr double kRadius = 20.0, kHeight = 30.0;
  for (const double deflection : {0.02, 0.001}) {
    write(BRepPrimAPI_MakeCylinder(kRadius, kHeight).Shape());
    const auto mesh = read_step(file_, Mm{deflection});
    ASSERT_TRUE(mesh) << mesh.error().front().message;
    const SurfaceMesh closed = welded(*mesh).mesh;
    EXPECT_FALSE(open_edges(closed));
    const FacetSolid solid(closed.vertices, closed.triangles);
    // The exact surface away from its edges: outside of the facets, by no more than that.
    std::vector<Vec3> points;
    for (int i = 0; i < 1000; ++i) {
      const double angle = 2.0 * std::numbers::pi * (i + 0.37) / 1000.0;
      points.emplace_back(kRadius * std::cos(angle), kRadius * std::sin(angle), 0.029 * i + 0.3);
    }
    double highest = 0.0;
    for (const auto& deviation : deviations_from(solid, points)) {
      ASSERT_TRUE(deviation);
      EXPECT_GE(*deviation, -1e-9);
      EXPECT_LE(*deviation, deflection);
      highest = std::max(highest, *deviation);
    }
    EXPECT_GT(highest, 0.05 * deflection);  // it is a mesh, no finer than it was asked for
    EXPECT_NEAR(solid.volume(), std::numbers::pi * kRadius * kRadius * kHeight,
                2.0 * std::numbers::pi * kRadius * kHeight * deflection);
  }
}

TEST_F(StepReader, AConeFrustumWithABoreFacesOutwardsEverywhere) {
  const TopoDS_Shape cone = BRepPrimAPI_MakeCone(40.0, 20.0, 20.0).Shape();
  const TopoDS_Shape bore = BRepPrimAPI_MakeCylinder(8.0, 20.0).Shape();
  write(BRepAlgoAPI_Cut(cone, bore).Shape());
  constexpr double kDeflection = 1e-3;
  const auto mesh = read_step(file_, Mm{kDeflection});
  ASSERT_TRUE(mesh) << mesh.error().front().message;
  const SurfaceMesh closed = welded(*mesh).mesh;
  EXPECT_FALSE(open_edges(closed));
  const FacetSolid solid(closed.vertices, closed.triangles);
  const double volume = std::numbers::pi * (20.0 / 3.0 * (1600.0 + 800.0 + 400.0) - 64.0 * 20.0);
  EXPECT_NEAR(solid.volume(), volume, 10.0);
  std::vector<Vec3> bored, coned;
  for (int i = 0; i < 500; ++i) {
    const double angle = 2.0 * std::numbers::pi * (i + 0.41) / 500.0, z = 0.5 + 0.038 * i;
    bored.emplace_back(8.0 * std::cos(angle), 8.0 * std::sin(angle), z);
    coned.emplace_back((40.0 - z) * std::cos(angle), (40.0 - z) * std::sin(angle), z);
  }
  // Chords of a bore leave too much within it: its exact surface is in their material.
  for (const auto& d : deviations_from(solid, bored)) EXPECT_TRUE(*d <= 1e-9 && *d >= -kDeflection);
  for (const auto& d : deviations_from(solid, coned)) EXPECT_TRUE(*d >= -1e-9 && *d <= kDeflection);
}

TEST_F(StepReader, MillimetresWhateverTheFileStates) {
  write(BRepPrimAPI_MakeCylinder(25.4, 50.8).Shape(), "INCH");
  const auto mesh = read_step(file_, Mm{0.01});
  ASSERT_TRUE(mesh);
  double highest = 0.0;
  for (const Vec3& p : mesh->vertices) highest = std::max(highest, p.z());
  EXPECT_NEAR(highest, 50.8, 1e-6);
}

TEST_F(StepReader, SaysWhatIsWrong) {
  const auto fault = [&](const std::string& text, double deflection) {
    std::ofstream(file_) << text;
    const auto mesh = read_step(file_, Mm{deflection});
    return mesh ? std::string() : std::string(mesh.error().front().id.text());
  };
  EXPECT_EQ(fault("", 0.001), "step-unreadable");
  EXPECT_EQ(fault("solid cube\nendsolid\n", 0.001), "step-unreadable");
  EXPECT_EQ(fault("ISO-10303-21;\nHEADER;\nENDSEC;\nDATA;\nENDSEC;\nEND-ISO-10303-21;\n", 0.001),
            "step-unreadable");
  EXPECT_EQ(fault("", 0.0), "out-of-range");
  write(BRepBuilderAPI_MakeVertex(gp_Pnt(1.0, 2.0, 3.0)).Shape());
  const auto point = read_step(file_, Mm{0.001});
  ASSERT_FALSE(point);
  EXPECT_EQ(point.error().front().id.text(), "step-empty");
  fs::remove(file_);
  const auto missing = read_step(file_, Mm{0.001});
  ASSERT_FALSE(missing);
  EXPECT_EQ(missing.error().front().id.text(), "file-unreadable");
}

}  // namespace
}  // namespace frustum::stock

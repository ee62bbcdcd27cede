// Lofts of rectangles as blanks: rays, normals, volume, and what is no body; how far blanks reach.
#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include "stock/mesh/surface_mesh.hpp"
#include "stock/solid/blank.hpp"
#include "stock/solid/workpiece.hpp"

namespace frustum::stock {
namespace {

// A base, a step, and a pyramid with a wider head: rays meet it in up to two pieces.
LoftShape stepped() {
  return {{{-2, 40, 30}, {6, 40, 30}, {6, 30, 22}, {16, 10, 8}, {16, 20, 18}, {20, 20, 18}}};
}
const Vec3 kOrigin(5.0, -3.0, 10.0);

Blank blank_of(const LoftShape& shape) { return Blank::make(shape, kOrigin).value(); }

constexpr RaySpan kAll{0.0, 200.0};

TEST(LoftBlank, AnswersRaysAcrossLedgesAndOverhangs) {
  const Blank blank = blank_of(stepped());
  // Down the middle: one piece, although it passes every slab.
  const auto middle = blank.along({kOrigin + Vec3(0, 0, 100), -Vec3::UnitZ()}, kAll);
  ASSERT_EQ(middle.intervals().size(), 1U);
  EXPECT_DOUBLE_EQ(middle.intervals()[0].lo, 80.0);
  EXPECT_DOUBLE_EQ(middle.intervals()[0].hi, 102.0);
  // Beside the neck: the head, a gap, the slope and the base.
  const auto neck = blank.along({kOrigin + Vec3(9, 0, 100), -Vec3::UnitZ()}, kAll);
  ASSERT_EQ(neck.intervals().size(), 2U);
  EXPECT_DOUBLE_EQ(neck.intervals()[0].hi, 84.0);
  EXPECT_DOUBLE_EQ(neck.intervals()[1].lo, 88.0);  // half a size of 9 is at z = 12
  EXPECT_DOUBLE_EQ(neck.intervals()[1].hi, 102.0);
  EXPECT_TRUE(blank.along({kOrigin + Vec3(21, 0, 100), -Vec3::UnitZ()}, kAll).empty());
}

TEST(LoftBlank, NormalsPointOutOfEveryFaceThatARayMeets) {
  const Blank blank = blank_of(stepped());
  for (int i = 0; i < 400; ++i) {
    const double a = 2.399963 * i, z = 1.0 - 2.0 * (i + 0.5) / 400.0;
    const Vec3 d(std::sqrt(1 - z * z) * std::cos(a), std::sqrt(1 - z * z) * std::sin(a), z);
    const Vec3 aim = kOrigin + Vec3(0.3 * (i % 11) - 1.5, 0.2 * (i % 7) - 0.6, 0.05 * i - 2.0);
    const Ray ray{aim - 100.0 * d, d};
    for (const Interval& piece : blank.along(ray, kAll).intervals()) {
      EXPECT_LT(blank.normal(piece.lo_tag, ray.at(piece.lo)).dot(d), 0.0);
      EXPECT_GT(blank.normal(piece.hi_tag, ray.at(piece.hi)).dot(d), 0.0);
    }
  }
  const auto slope = blank.along({kOrigin + Vec3(50, 0, 11), -Vec3::UnitX()}, kAll);
  const Interval& met = slope.intervals().front();
  EXPECT_LT(
      (blank.normal(met.lo_tag, kOrigin + Vec3(10, 0, 11)) - Vec3(1, 0, 1).normalized()).norm(),
      1e-12);
}

TEST(LoftBlank, VolumeBoundsAndMeshAgree) {
  const Blank blank = blank_of(stepped());
  // Prisms 8 x 40 x 30 and 4 x 20 x 18; the pyramid by the prismatoid formula.
  const double pyramid = 10.0 / 6.0 * (30 * 22 + 4 * 20 * 15 + 10 * 8);
  EXPECT_NEAR(blank.volume(), 8 * 40 * 30 + 4 * 20 * 18 + pyramid, 1e-9);
  EXPECT_EQ(blank.bounds().min, kOrigin + Vec3(-20, -15, -2));
  EXPECT_EQ(blank.bounds().max, kOrigin + Vec3(20, 15, 20));
  const Workpiece uncut(blank, cutter::SweptCutter::sweep({}, {}).value());
  const auto mesh = extract_surface(uncut, blank.bounds(), Mm{0.5});
  ASSERT_TRUE(mesh);
  const MeshMeasure measure = stock::measure(*mesh);
  EXPECT_TRUE(measure.is_closed);
  EXPECT_NEAR(measure.volume, blank.volume(), 2e-3 * blank.volume());
}

TEST(LoftBlank, SaysWhatIsNoBody) {
  const auto message = [](std::vector<LoftSection> sections) {
    const auto made = Blank::make(LoftShape{std::move(sections)}, Vec3::Zero());
    return made ? std::string("no error") : made.error().front().message;
  };
  EXPECT_NE(message({{0, 1, 1}}).find("two sections or more, given are 1"), std::string::npos);
  EXPECT_NE(message({{0, 1, 1}, {2, 0, 1}}).find("section 2 of the loft is [2, 0, 1]"),
            std::string::npos);
  EXPECT_NE(message({{0, 1, 1}, {NAN, 1, 1}}).find("section 2"), std::string::npos);
  EXPECT_NE(message({{0, 1, 1}, {2, 1, 1}, {1, 1, 1}}).find("is below the one before"),
            std::string::npos);
  EXPECT_NE(message({{0, 1, 1}, {0, 2, 2}, {1, 1, 1}}).find("is the bottom"), std::string::npos);
  EXPECT_NE(message({{0, 1, 1}, {1, 2, 2}, {1, 1, 1}}).find("is the top"), std::string::npos);
  EXPECT_NE(message({{0, 3, 3}, {1, 3, 3}, {1, 2, 2}, {1, 1, 1}, {2, 1, 1}})
                .find("has two sections already"),
            std::string::npos);
}

TEST(Blank, OfAKilometreIsRefused) {
  EXPECT_TRUE(Blank::make(BoxShape{100.0, 100.0, 1e5}, Vec3::Zero()));
  for (const auto& [shape, origin] : std::vector<std::pair<BlankShape, Vec3>>{
           {BoxShape{100.0, 100.0, 1e6}, Vec3::Zero()},
           {FrustumShape{55.0, 55.0, 36.0}, Vec3(0.0, 0.0, -1e300)},
           {FrustumShape{1e9, 55.0, 36.0}, Vec3::Zero()}}) {
    const auto made = Blank::make(shape, origin);
    ASSERT_FALSE(made);
    EXPECT_EQ(made.error().front().id, "blank-too-far"_id);
  }
}

}  // namespace
}  // namespace frustum::stock

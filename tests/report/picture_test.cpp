#include "report/picture/picture.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <oneapi/tbb/task_arena.h>
#include <png.h>

#include <filesystem>
#include <limits>
#include <vector>

#include "report/colour_scale.hpp"
#include "sample_report.hpp"

namespace frustum::report {
namespace {

struct Pixels {
  int width = 0;
  int height = 0;
  std::vector<unsigned char> rgb{};

  [[nodiscard]] std::array<int, 3> at(int x, int y) const {
    const std::size_t k = 3 * (static_cast<std::size_t>(y) * static_cast<std::size_t>(width) +
                               static_cast<std::size_t>(x));
    return {rgb[k], rgb[k + 1], rgb[k + 2]};
  }
};

Pixels read_png(const std::filesystem::path& path) {
  png_image png{};
  png.version = PNG_IMAGE_VERSION;
  if (png_image_begin_read_from_file(&png, path.c_str()) == 0) return {};
  png.format = PNG_FORMAT_RGB;
  Pixels pixels{static_cast<int>(png.width), static_cast<int>(png.height), {}};
  pixels.rgb.resize(PNG_IMAGE_SIZE(png));
  if (png_image_finish_read(&png, nullptr, pixels.rgb.data(), 0, nullptr) == 0) return {};
  return pixels;
}

std::filesystem::path scratch(const std::string& name) {
  return std::filesystem::path(testing::TempDir()) / name;
}

// A square of 10 mm in the xy plane, seen from above.
SurfacePicture square(std::optional<float> deviation) {
  SurfacePicture picture;
  picture.vertices = {{0, 0, 0}, {10, 0, 0}, {10, 10, 0}, {0, 10, 0}};
  picture.triangles = {{0, 1, 2}, {0, 2, 3}};
  picture.deviation.assign(4, deviation);
  return picture;
}

TEST(Picture, HasTheSizeAskedForAndALightBackground) {
  PictureOptions options;
  options.width = 300;
  options.height = 200;
  const auto path = scratch("frustum_picture_size.png");
  const auto written = write_picture(path, sample_report(60, 4).surface, options);
  ASSERT_TRUE(written.has_value());
  const Pixels pixels = read_png(path);
  EXPECT_EQ(pixels.width, 300);
  EXPECT_EQ(pixels.height, 200);
  const auto background = pixels.at(0, 0);
  EXPECT_EQ(pixels.at(299, 0), background);
  for (const int channel : background) EXPECT_GE(channel, 200);
  EXPECT_NE(pixels.at(130, 100), background);
  std::filesystem::remove(path);
}

TEST(Picture, ShowsMissingMaterialBlueAndMaterialLeftRed) {
  PictureOptions options;
  options.width = 200;
  options.height = 200;
  options.elevation = 90.0;
  options.deviation_span = 0.002;
  const auto centre = [&](std::optional<float> deviation) {
    const auto path = scratch("frustum_picture_colour.png");
    EXPECT_TRUE(write_picture(path, square(deviation), options).has_value());
    const std::array<int, 3> colour = read_png(path).at(80, 100);
    std::filesystem::remove(path);
    return colour;
  };
  const auto left = centre(0.001F);
  EXPECT_GT(left[0], left[2] + 60);
  const auto missing = centre(-0.001F);
  EXPECT_GT(missing[2], missing[0] + 60);
  const auto unknown = centre(std::nullopt);
  EXPECT_LT(std::abs(unknown[0] - unknown[2]), 20);
}

TEST(Picture, ComplainsAboutWhatItCannotDraw) {
  const auto path = scratch("frustum_picture_bad.png");
  EXPECT_FALSE(write_picture(path, SurfacePicture{}).has_value());
  SurfacePicture broken = square(0.0F);
  broken.triangles.push_back({0, 1, 7});
  EXPECT_FALSE(write_picture(path, broken).has_value());
  broken = square(0.0F);
  broken.vertices[2][1] = std::numeric_limits<float>::quiet_NaN();
  EXPECT_FALSE(write_picture(path, broken).has_value());
  PictureOptions options;
  options.width = 3;
  EXPECT_FALSE(write_picture(path, square(0.0F), options).has_value());
  options = {};
  options.deviation_span = 0.0;
  EXPECT_FALSE(write_picture(path, square(0.0F), options).has_value());
  EXPECT_FALSE(std::filesystem::exists(path));
}

// A floor and a wall that meet at y = 0, seen from the front and above.
SurfacePicture corner() {
  SurfacePicture picture;
  picture.vertices = {{-50, -50, 0}, {50, -50, 0}, {50, 0, 0},
                      {-50, 0, 0},   {50, 0, 50},  {-50, 0, 50}};
  picture.triangles = {{0, 1, 2}, {0, 2, 3}, {3, 2, 4}, {3, 4, 5}};
  return picture;
}

TEST(Picture, IsDarkerWhereTheSkyIsHidden) {
  PictureOptions options;
  options.width = options.height = 200;
  options.azimuth = -90.0;
  options.elevation = 45.0;
  const auto path = scratch("frustum_picture_corner.png");
  ASSERT_TRUE(write_picture(path, corner(), options).has_value());
  const Pixels pixels = read_png(path);
  std::filesystem::remove(path);
  // The floor in the picture's lower half, from its front edge to the wall.
  EXPECT_LT(pixels.at(100, 106)[0] + 12, pixels.at(100, 140)[0]);
  EXPECT_LT(pixels.at(100, 106)[0] + 12, pixels.at(100, 130)[0]);
}

// Thousands of triangles that meet in edges and corners, seen along an axis too: none lets the
// background through.
TEST(Picture, HasNoGapsBetweenTriangles) {
  SurfacePicture sheet;
  constexpr std::uint32_t kSide = 60;
  for (std::uint32_t y = 0; y <= kSide; ++y) {
    for (std::uint32_t x = 0; x <= kSide; ++x) {
      sheet.vertices.push_back({static_cast<float>(x), static_cast<float>(y), 0.0F});
    }
  }
  for (std::uint32_t y = 0; y < kSide; ++y) {
    for (std::uint32_t x = 0; x < kSide; ++x) {
      const std::uint32_t at = y * (kSide + 1) + x;
      sheet.triangles.push_back({at, at + 1, at + kSide + 2});
      sheet.triangles.push_back({at, at + kSide + 2, at + kSide + 1});
    }
  }
  PictureOptions options;
  options.width = options.height = 240;
  options.elevation = 90.0;
  options.azimuth = 0.0;
  const auto path = scratch("frustum_picture_sheet.png");
  ASSERT_TRUE(write_picture(path, sheet, options).has_value());
  const Pixels pixels = read_png(path);
  std::filesystem::remove(path);
  const auto middle = pixels.at(120, 120);
  for (int y = 30; y < 210; ++y) {
    for (int x = 30; x < 210; ++x) ASSERT_EQ(pixels.at(x, y), middle) << x << ", " << y;
  }
}

TEST(Picture, HasTheSameBitsForAnyNumberOfThreads) {
  PictureOptions options;
  options.width = 320;
  options.height = 240;
  const SurfacePicture part = sample_report(60, 4).surface;
  const auto drawn_with = [&](int threads) {
    const auto path = scratch("frustum_picture_threads.png");
    tbb::task_arena arena(threads);
    arena.execute([&] { EXPECT_TRUE(write_picture(path, part, options).has_value()); });
    Pixels pixels = read_png(path);
    std::filesystem::remove(path);
    return pixels.rgb;
  };
  const auto alone = drawn_with(1);
  EXPECT_FALSE(alone.empty());
  EXPECT_EQ(alone, drawn_with(2));
  EXPECT_EQ(alone, drawn_with(8));
}

TEST(Picture, NamesTheFileThatCannotBeWritten) {
  PictureOptions options;
  options.width = options.height = 64;
  const auto result = write_picture("/no/such/folder/x.png", square(0.0F), options);
  ASSERT_FALSE(result.has_value());
  EXPECT_THAT(result.error().front().message, testing::HasSubstr("/no/such/folder/x.png"));
}

TEST(ColourScale, HoldsNearlyAllDeviations) {
  SurfacePicture picture = square(0.0013F);
  EXPECT_DOUBLE_EQ(natural_span(picture), 0.002);
  picture.deviation.assign(4, std::nullopt);
  EXPECT_DOUBLE_EQ(natural_span(picture), 0.001);
  picture.deviation.assign(1000, 0.0004F);
  picture.deviation[7] = 5.0F;
  EXPECT_DOUBLE_EQ(natural_span(picture), 0.0005);
}

TEST(ColourScale, IsNearWhiteAtNominal) {
  const Colour nominal = deviation_colour(0.0, 1e-3);
  for (const double channel : nominal) EXPECT_GT(channel, 0.9);
}

}  // namespace
}  // namespace frustum::report

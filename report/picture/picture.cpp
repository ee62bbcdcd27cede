#include "report/picture/picture.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/units.hpp"
#include "core/whole_file.hpp"
#include "report/colour_scale.hpp"
#include "report/number_text.hpp"
#include "report/picture/ground_shadow.hpp"
#include "report/picture/lettering.hpp"
#include "report/picture/picture_shading.hpp"
#include "report/picture/png_file.hpp"

namespace frustum::report {
namespace {

std::optional<Diagnostic> complaint_about(const SurfacePicture& picture,
                                          const PictureOptions& options) {
  if (picture.empty())
    return error("picture-empty"_id, "the picture has no surface", "cut the workpiece first");
  if (!picture.is_valid()) {
    return error("picture-inconsistent"_id,
                 "the surface is inconsistent: a triangle names a vertex that does not exist, "
                 "a coordinate is not finite, or deviations and vertices differ in number");
  }
  const auto [low, high] = std::minmax(options.width, options.height);
  if (low < 64 || high > 8192) {
    return error("picture-size"_id,
                 fmt::format("picture size {} x {} px", options.width, options.height),
                 "width and height from 64 to 8192 px");
  }
  if (options.samples < 1 || options.samples > 4) {
    return error("picture-samples"_id, fmt::format("{} samples a pixel", options.samples),
                 "1 to 4");
  }
  if (options.deviation_span && !(*options.deviation_span > 0.0)) {
    return error("picture-span"_id, fmt::format("deviation span {} mm", *options.deviation_span),
                 "a positive length");
  }
  return std::nullopt;
}

// The part of the image that the workpiece may fill, in image pixels.
struct Frame {
  double left, top, right, bottom;
};

View fitted_view(const SurfacePicture& picture, const PictureOptions& options, const Frame& frame) {
  View view;
  view.camera_from_workpiece =
      camera_from_workpiece(options.azimuth * kRadPerDeg, options.elevation * kRadPerDeg);
  Eigen::Array2f low = Eigen::Array2f::Constant(std::numeric_limits<float>::max());
  Eigen::Array2f high = -low;
  for (const auto& vertex : picture.vertices) {
    const Eigen::Vector3f in_camera =
        view.camera_from_workpiece * Eigen::Map<const Eigen::Vector3f>(vertex.data());
    low = low.min(in_camera.head<2>().array());
    high = high.max(in_camera.head<2>().array());
  }
  const Eigen::Array2d size = (high - low).cast<double>().max(1e-6);  // a point still has a scale
  const double scale =
      std::min((frame.right - frame.left) / size.x(), (frame.bottom - frame.top) / size.y());
  view.pixels_per_mm = static_cast<float>(scale * options.samples);
  view.centre = ((low + high) / 2.0F).matrix();
  view.centre_pixel = Eigen::Vector2f(static_cast<float>((frame.left + frame.right) / 2.0),
                                      static_cast<float>((frame.top + frame.bottom) / 2.0)) *
                      static_cast<float>(options.samples);
  return view;
}

// Light from above, so that pale parts stand out: a change too slow to be seen as such.
void paint_background(Image& image) {
  const LinearColour top = linear_from_srgb({0.835, 0.862, 0.893});
  const LinearColour bottom = linear_from_srgb({0.985, 0.988, 0.990});
  for (int y = 0; y < image.height; ++y) {
    const float share = static_cast<float>(y) / static_cast<float>(image.height - 1);
    for (int x = 0; x < image.width; ++x) {
      image.at(x, y) = top;
      image.blend(x, y, bottom, share);
    }
  }
}

void draw_colour_bar(Image& image, double span) {
  const double unit = image.height / 100.0;
  const int width = std::max(4, static_cast<int>(2.2 * unit));
  const int left = static_cast<int>(image.width - 14.5 * unit);
  const int top = static_cast<int>(27.0 * unit);
  const int bottom = static_cast<int>(79.0 * unit);
  for (int y = top; y <= bottom; ++y) {
    const double deviation = span * (1.0 - 2.0 * (y - top) / (bottom - top));
    const LinearColour colour = linear_from_srgb(deviation_colour(deviation, span));
    for (int x = left; x < left + width; ++x) image.blend(x, y, colour, 1.0F);
  }
  const LinearColour ink = linear_from_srgb({0.16, 0.18, 0.21});
  const double line = std::max(1.0, 0.14 * unit);
  const LetterStyle letters{2.0 * unit, std::max(1.1, 0.24 * unit), ink};
  const bool in_nm = span < 0.5e-3;
  const double shown_span = span * (in_nm ? 1e6 : kUmPerMm);
  const double right = left + width;
  draw_stroke(image, right, top, right, bottom, line, ink);
  for (int k = -2; k <= 2; ++k) {
    const double y = top + (bottom - top) * (2 - k) / 4.0;
    draw_stroke(image, right, y, right + 0.9 * unit, y, line, ink);
    const double value = shown_span * k / 2.0;
    // Half of 1 or 5 needs one decimal more than the span itself.
    const std::string sign = k > 0 ? "+" : "";
    const std::string text = k == 0 ? "0" : sign + fmt::format("{:.4g}", value);
    const double indent = k == 0 ? text_width("+", letters) : 0.0;
    draw_text(image, right + 1.7 * unit + indent, y + letters.height / 2.0, text, letters);
  }
  draw_text(image, left, top - 2.6 * unit, in_nm ? "nm" : "um", letters);
}

}  // namespace

Result<std::string> picture_png(const SurfacePicture& picture, const PictureOptions& options) {
  if (std::optional<Diagnostic> complaint = complaint_about(picture, options)) {
    return std::move(*complaint);
  }
  const bool has_deviation =
      std::any_of(picture.deviation.begin(), picture.deviation.end(),
                  [](const auto& deviation) { return deviation.has_value(); });
  const bool has_bar = options.colour_bar && has_deviation;
  const double margin = 0.07 * options.height;
  const Frame frame{margin, margin, options.width - (has_bar ? 0.20 * options.height : margin),
                    options.height - margin};

  const Scene scene(picture, fitted_view(picture, options, frame), options.width, options.height,
                    options.samples);
  const double span = options.deviation_span.value_or(natural_span(picture));
  Image image(options.width, options.height, {1.0F, 1.0F, 1.0F});
  paint_background(image);
  cast_ground_shadow(scene, image);
  shade(scene, span, image);
  if (has_bar) draw_colour_bar(image, span);
  return png_bytes(image);
}

Result<std::filesystem::path> write_picture(const std::filesystem::path& path,
                                            const SurfacePicture& picture,
                                            const PictureOptions& options) {
  const auto bytes = picture_png(picture, options);
  if (!bytes) return bytes.error();
  return write_whole_file(path, *bytes);
}

}  // namespace frustum::report

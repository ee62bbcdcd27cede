#include <optional>
#include <stdexcept>
#include <vector>

#include "metrology/points/ply_points.hpp"
#include "metrology/points/point_file.hpp"
#include "tests/fuzz/files/file_checks.hpp"
#include "tests/fuzz/files/one_file.hpp"

namespace frustum::fuzz {
namespace {

using metrology::FeaturePoints;
using metrology::LengthUnit;

void check_points(const std::vector<FeaturePoints>& features) {
  if (features.empty()) throw std::runtime_error("accepted, and no points");
  for (const FeaturePoints& f : features) {
    for (const Vec3& point : f.points) check_finite(point, "a coordinate");
    const std::size_t count = f.points.size();
    if (count == 0 || f.lines.size() != count ||
        (!f.sections.empty() && f.sections.size() != count)) {
      throw std::runtime_error("points without lines or sections of their own");
    }
  }
}

}  // namespace

void run_one_points(std::string_view text) {
  for (const auto& unit : {std::optional<LengthUnit>(), metrology::length_unit("inch")}) {
    const auto found = metrology::parse_feature_points(text, kTriedFile, unit);
    if (found) {
      check_points(*found);
    } else {
      check_failures(found.error(), kTriedFile, Placed::by_line);
    }
  }
  if (!text.starts_with("ply")) return;
  const auto ply = metrology::parse_ply_points(text);
  if (!ply) return check_failures(ply.error(), "", Placed::without_column);
  for (const Vec3& point : ply->points) check_finite(point, "a coordinate");
}

}  // namespace frustum::fuzz

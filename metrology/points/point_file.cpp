#include "metrology/points/point_file.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cctype>

#include "core/spelling.hpp"
#include "core/whole_file.hpp"
#include "metrology/points/ply_points.hpp"
#include "metrology/points/qif_points.hpp"
#include "metrology/points/text_points.hpp"

namespace frustum::metrology {
namespace {

Result<std::vector<FoundPoints>> parse_ply(std::string_view bytes,
                                           const std::filesystem::path& file,
                                           const std::optional<LengthUnit>& unit) {
  auto ply = parse_ply_points(bytes);
  Diagnostics problems = ply ? Diagnostics() : ply.error();
  if (ply && ply->points.empty())
    problems.push_back(error("file-without-points"_id, "the file holds no points"));
  if (ply && ply->unit && unit && *ply->unit != *unit) {
    problems.push_back(unlike_units(*ply->unit, *unit));
  }
  for (Diagnostic& d : problems) d.file = file.string();
  if (!problems.empty()) return problems;
  const double mm = ply->unit ? ply->unit->mm : unit ? unit->mm : 1.0;
  for (Vec3& point : ply->points) {
    point *= mm;
    if (point.allFinite()) continue;
    Diagnostic d = error("point-not-finite"_id, "a vertex of the PLY is no finite number of mm",
                         "correct the vertex or the unit");
    d.file = file.string();
    return d;
  }
  FoundPoints found;
  found.feature.points = std::move(ply->points);
  found.feature.file = file.string();
  return std::vector<FoundPoints>{std::move(found)};
}

// The document has its own unit.
Result<std::vector<FoundPoints>> parse_qif(std::string_view bytes,
                                           const std::filesystem::path& file,
                                           const std::optional<LengthUnit>& unit,
                                           PointMeaning meaning) {
  auto qif = parse_qif_points(bytes, meaning);
  Diagnostics problems = qif ? Diagnostics() : qif.error();
  if (qif && unit && unit->mm != qif->unit) {
    problems.push_back(unlike_units({fmt::format("{:g} mm", qif->unit), qif->unit}, *unit));
  }
  for (Diagnostic& d : problems) d.file = file.string();
  if (!problems.empty()) return problems;
  std::vector<FoundPoints> found;
  for (FeaturePoints& feature : qif->features) {
    feature.file = file.string();
    found.push_back({.feature = std::move(feature)});
  }
  return found;
}

Result<std::vector<FoundPoints>> parse_file(std::string_view text,
                                            const std::filesystem::path& file,
                                            const std::optional<LengthUnit>& unit,
                                            PointMeaning meaning = PointMeaning::surface) {
  std::string extension = file.extension().string();
  for (char& c : extension) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  if (extension == ".ply") return parse_ply(text, file, unit);
  if (extension == ".qif") return parse_qif(text, file, unit, meaning);
  return parse_text_points(text, file, unit);
}

Result<std::vector<FoundPoints>> read_file(const std::filesystem::path& file,
                                           const std::optional<LengthUnit>& unit) {
  const auto bytes = read_point_bytes(file);
  if (!bytes) return bytes.error();
  return parse_file(*bytes, file, unit);
}

Result<std::vector<FeaturePoints>> without_weights(Result<std::vector<FoundPoints>> found,
                                                   const std::filesystem::path& file) {
  if (!found) return std::move(found).error();
  std::vector<FeaturePoints> features;
  for (FoundPoints& f : *found) {
    if (!f.weights.empty()) {
      Diagnostic d = error("point-columns"_id, "points of a plan have no weights",
                           "leave the column weight out");
      d.file = file.string();
      return d;
    }
    features.push_back(std::move(f.feature));
  }
  return features;
}

}  // namespace

Result<std::string> read_point_bytes(const std::filesystem::path& file) {
  std::error_code unknown;
  if (std::filesystem::is_directory(file, unknown)) {
    Diagnostic d = error("file-unreadable"_id, "this is a directory, not a file of points",
                         "name one of the files in it");
    d.file = file.string();
    return d;
  }
  return read_whole_file(file);
}

Result<std::vector<FeaturePoints>> parse_feature_points(std::string_view text,
                                                        const std::filesystem::path& file,
                                                        const std::optional<LengthUnit>& unit,
                                                        PointMeaning meaning) {
  return without_weights(parse_file(text, file, unit, meaning), file);
}

Result<std::vector<FeaturePoints>> read_feature_points(const std::filesystem::path& file,
                                                       const std::optional<LengthUnit>& unit) {
  return without_weights(read_file(file, unit), file);
}

Result<PointCloud> read_point_cloud(const std::filesystem::path& file,
                                    const std::optional<LengthUnit>& unit,
                                    const std::optional<std::string>& feature) {
  auto found = read_file(file, unit);
  if (!found) return std::move(found).error();
  std::vector<std::string> names;
  for (const FoundPoints& f : *found) names.push_back(f.feature.feature);
  if (feature) std::erase_if(*found, [&](const auto& f) { return f.feature.feature != *feature; });
  if (found->size() != 1) {
    Diagnostic unclear =
        feature ? error("unknown-feature"_id, fmt::format("no points of feature '{}'", *feature),
                        suggestion(*feature, names))
                : error("several-features"_id,
                        fmt::format("the file has points of {} features: {}", names.size(),
                                    fmt::join(names, ", ")),
                        "one element goes through the points of one feature: name it "
                        "(fit: --feature NAME)");
    unclear.file = file.string();
    return unclear;
  }
  PointCloud cloud;
  for (const FoundPoints& f : *found) {
    cloud.points.insert(cloud.points.end(), f.feature.points.begin(), f.feature.points.end());
    cloud.weights.insert(cloud.weights.end(), f.weights.begin(), f.weights.end());
  }
  return cloud;
}

}  // namespace frustum::metrology

#include "programs/s_piece/control_points.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

#include "core/csv.hpp"
#include "core/printable_text.hpp"
#include "core/whole_file.hpp"

namespace frustum::programs {
namespace {

constexpr std::array<std::string_view, 4> kCurves{"C0", "C1", "D0", "D1"};
constexpr std::size_t kFewest = 4;    // a cubic
constexpr std::size_t kMost = 1000;   // of a curve
constexpr double kLevel = 1e-6;       // mm: planes of constant z
constexpr double kFarthest = 5000.0;  // mm

struct Curve {
  std::vector<Vec3> points{};
  const CsvRow* first = nullptr;
};
using Curves = std::array<Curve, kCurves.size()>;

Result<Curves> curves_of(const CsvTable& table) {
  Curves curves;
  for (const CsvRow& row : table.rows()) {
    const std::string& name = row.fields[0].text;
    const auto found = std::ranges::find(kCurves, std::string_view(name));
    if (found == kCurves.end()) {
      return table.about(row, 0, "unknown-curve"_id,
                         fmt::format("there is no curve '{}'", printable(name)),
                         "C0 and C1 are those of flank A, D0 and D1 those of flank B");
    }
    Curve& curve = curves[static_cast<std::size_t>(found - kCurves.begin())];
    Vec3 p = Vec3::Zero();
    for (std::size_t k = 0; k < 3; ++k) {
      const auto value = table.number(row, k + 1);
      if (!value) return value.error();
      if (std::abs(*value) > kFarthest) {
        return table.about(row, k + 1, "out-of-range"_id,
                           fmt::format("{:g} mm is farther than any test piece", *value),
                           fmt::format("at most {:g} mm", kFarthest));
      }
      p[static_cast<Eigen::Index>(k)] = *value;
    }
    if (curve.first == nullptr) curve.first = &row;
    if (!curve.points.empty() && std::abs(p.z() - curve.points.front().z()) > kLevel) {
      return table.about(row, 3, "curve-not-level"_id,
                         fmt::format("z = {:g} mm, but {} begins at z = {:g} mm", p.z(), name,
                                     curve.points.front().z()),
                         "the points of a curve are in a plane of constant z");
    }
    curve.points.push_back(p);
    if (curve.points.size() > kMost) {
      return table.about(row, 0, "out-of-range"_id,
                         fmt::format("{} has more than {} points", name, kMost));
    }
  }
  return curves;
}

// Both curves of a flank: as many points, the second above the first.
std::optional<Diagnostic> fault_of(const CsvTable& table, const Curve& lower, const Curve& upper,
                                   std::string_view low, std::string_view high) {
  const auto about = [&](const Curve& curve, DiagnosticId id, std::string message,
                         std::string hint) {
    if (curve.first != nullptr) return table.about(*curve.first, 0, id, message, hint);
    Diagnostic failure = error(id, std::move(message), std::move(hint));
    failure.file = table.file().string();
    return failure;
  };
  if (lower.points.size() < kFewest || upper.points.size() != lower.points.size()) {
    return about(lower.points.empty() ? upper : lower, "curve-points"_id,
                 fmt::format("{} has {} points and {} has {}", low, lower.points.size(), high,
                             upper.points.size()),
                 fmt::format("both need as many, {} or more", kFewest));
  }
  if (!(upper.points.front().z() > lower.points.front().z() + 1.0)) {
    return about(upper, "curve-order"_id,
                 fmt::format("{} is at z = {:g} mm, {} at {:g} mm", high, upper.points.front().z(),
                             low, lower.points.front().z()),
                 "the second curve must be 1 mm or more above the first");
  }
  return std::nullopt;
}

}  // namespace

Result<ControlPoints> parse_control_points(std::string_view text,
                                           const std::filesystem::path& file) {
  const auto table = CsvTable::parse(text, file, {"curve", "x", "y", "z"});
  if (!table) return table.error();
  auto curves = curves_of(*table);
  if (!curves) return std::move(curves).error();
  auto& [c0, c1, d0, d1] = *curves;
  if (auto fault = fault_of(*table, c0, c1, "C0", "C1")) return *fault;
  ControlPoints points{{std::move(c0.points), std::move(c1.points)}, std::nullopt};
  if (d0.points.empty() && d1.points.empty()) return points;
  if (auto fault = fault_of(*table, d0, d1, "D0", "D1")) return *fault;
  points.b = FlankCurves{std::move(d0.points), std::move(d1.points)};
  const auto differ = [](const std::vector<Vec3>& a, const std::vector<Vec3>& b) {
    return std::abs(a.front().z() - b.front().z()) > kLevel;
  };
  if (differ(points.a.lower, points.b->lower) || differ(points.a.upper, points.b->upper)) {
    return table->about(*d0.first, 3, "curve-not-level"_id,
                        "both flanks must reach from the same height to the same height",
                        "D0 is at the z of C0, D1 at that of C1");
  }
  return points;
}

Result<ControlPoints> read_control_points(const std::filesystem::path& file) {
  const auto text = read_whole_file(file);
  if (!text) return text.error();
  return parse_control_points(*text, file);
}

}  // namespace frustum::programs

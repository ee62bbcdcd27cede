#include "metrology/non_negative.hpp"

#include <algorithm>
#include <cmath>

namespace frustum::metrology {
namespace {

double peak_to_valley(std::span<const double> parts) {
  double low = parts.front();
  double high = parts.front();
  for (const double part : parts) {
    low = std::min(low, part);
    high = std::max(high, part);
  }
  return high - low;
}

}  // namespace

double SizeRule::operator()(std::span<const double> parts) const {
  if (parts.empty()) return 0.0;
  switch (kind) {
    case NonNegativeKind::none:
      return 0.0;
    case NonNegativeKind::peak_to_valley: {
      if (rows.empty()) return peak_to_valley(parts);
      double worst = 0.0;
      for (const std::size_t places : rows) {
        if (places == 0) continue;
        worst = std::max(worst, peak_to_valley(parts.first(places)));
        parts = parts.subspan(places);
      }
      return worst;
    }
    case NonNegativeKind::twice_largest: {
      double largest = 0.0;
      for (std::size_t i = 0; i + 2 < parts.size(); i += 3) {
        largest = std::max(largest, parts[i] * parts[i] + parts[i + 1] * parts[i + 1] +
                                        parts[i + 2] * parts[i + 2]);
      }
      return 2.0 * std::sqrt(largest);
    }
    case NonNegativeKind::twice_largest_height: {
      double largest = 0.0;
      for (const double part : parts) largest = std::max(largest, std::abs(part));
      return 2.0 * largest;
    }
    case NonNegativeKind::length:
      break;
  }
  double square = 0.0;
  for (const double part : parts) square += part * part;
  return std::sqrt(square);
}

double size_of(const NonNegative& measurand) { return measurand.rule(measurand.parts); }

NonNegative heights_along(const Vec3& direction, std::vector<Vec3> places) {
  NonNegative heights{{NonNegativeKind::peak_to_valley}, {}, std::move(places)};
  Vec3 mean = Vec3::Zero();
  for (const Vec3& p : heights.places) mean += p / static_cast<double>(heights.places.size());
  for (const Vec3& p : heights.places) heights.parts.push_back((p - mean).dot(direction));
  return heights;
}

NonNegative length_of(const Vec3& vector) {
  return {{NonNegativeKind::length}, {vector.x(), vector.y(), vector.z()}, {}};
}

}  // namespace frustum::metrology

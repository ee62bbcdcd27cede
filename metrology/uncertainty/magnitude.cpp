#include "metrology/uncertainty/magnitude.hpp"

#include <algorithm>
#include <cmath>

namespace frustum::metrology {

double size_of(MagnitudeKind kind, std::span<const double> parts) {
  if (parts.empty()) return 0.0;
  switch (kind) {
    case MagnitudeKind::none:
      return 0.0;
    case MagnitudeKind::peak_to_valley: {
      double low = parts.front();
      double high = parts.front();
      for (const double part : parts) {
        low = std::min(low, part);
        high = std::max(high, part);
      }
      return high - low;
    }
    case MagnitudeKind::twice_largest: {
      double largest = 0.0;
      for (std::size_t i = 0; i + 2 < parts.size(); i += 3) {
        largest = std::max(largest, parts[i] * parts[i] + parts[i + 1] * parts[i + 1] +
                                        parts[i + 2] * parts[i + 2]);
      }
      return 2.0 * std::sqrt(largest);
    }
    case MagnitudeKind::length:
      break;
  }
  double square = 0.0;
  for (const double part : parts) square += part * part;
  return std::sqrt(square);
}

}  // namespace frustum::metrology

#include "report/points_csv.hpp"

#include <fmt/format.h>

namespace frustum::report {
namespace {

// A name with a separator, quote or line end is quoted as RFC 4180 says.
std::string csv_field(const std::string& text) {
  if (text.find_first_of(",\"\r\n") == std::string::npos) return text;
  std::string quoted = "\"";
  for (const char c : text) {
    if (c == '"') quoted += '"';
    quoted += c;
  }
  return quoted + '"';
}

}  // namespace

std::string points_csv(const metrology::Measurement& measurement) {
  std::string csv = "feature,section,x,y,z\n";
  for (const metrology::MeasuredFeature& feature : measurement.features) {
    const std::string name = csv_field(feature.name);
    for (const metrology::MeasuredPoint& p : feature.points) {
      if (!p.point.allFinite()) continue;
      csv += fmt::format("{},{},{:.17g},{:.17g},{:.17g}\n", name, p.section, p.point.x(),
                         p.point.y(), p.point.z());
    }
  }
  return csv;
}

}  // namespace frustum::report

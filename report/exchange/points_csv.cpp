#include "report/exchange/points_csv.hpp"

#include <fmt/format.h>

#include "report/exchange/csv_field.hpp"

namespace frustum::report {

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

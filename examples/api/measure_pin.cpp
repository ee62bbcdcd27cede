// Fits a cylinder to points, measures a pin on the virtual CMM, writes the results as QIF.
#include <cmath>
#include <fstream>
#include <iostream>

#include "metrology/cmm.hpp"
#include "metrology/fit/association.hpp"
#include "report/exchange/qif_results.hpp"

namespace metrology = frustum::metrology;
using frustum::UnitVec3;
using frustum::Vec3;

// A pin along Z. Whatever has such a function can be measured (the SurfaceProbe concept).
struct Pin {
  double radius = 10.002;  // mm, 2 um more than the plan says

  // The first surface point on the way from `start` along `direction`, at most `length` mm.
  std::optional<metrology::Touch> touch(const Vec3& start, const UnitVec3& direction,
                                        double length) const {
    const Vec3 d = direction.vec();
    const double a = d.x() * d.x() + d.y() * d.y();
    const double b = start.x() * d.x() + start.y() * d.y();
    const double c = start.x() * start.x() + start.y() * start.y() - radius * radius;
    const double root = b * b - a * c;
    if (c <= 0.0 || a == 0.0 || root < 0.0) return std::nullopt;  // inside, or no surface there
    const double way = (-b - std::sqrt(root)) / a;
    if (way < 0.0 || way > length) return std::nullopt;
    const Vec3 point = start + way * d;
    return metrology::Touch{point, Vec3(point.x(), point.y(), 0.0).normalized()};
  }
};

// The plan could be read from a file as well: metrology::load_plan("pin.plan.toml").
metrology::InspectionPlan pin_plan() {
  metrology::PlannedFeature pin;
  pin.name = "pin";
  pin.kind = metrology::FeatureKind::cylinder;
  pin.radius = 10.0;  // mm
  pin.strategy =
      metrology::SectionStrategy{.sections = {0.0, 10.0, 20.0}, .points_per_section = 24};
  metrology::PlannedCharacteristic diameter;
  diameter.name = "pin.diameter";
  diameter.kind = metrology::CharacteristicKind::diameter;
  diameter.features = {"pin"};
  diameter.tolerance = 0.010;  // mm
  metrology::PlannedCharacteristic form = diameter;
  form.name = "pin.cylindricity";
  form.kind = metrology::CharacteristicKind::cylindricity;
  metrology::InspectionPlan plan;
  plan.title = "Pin";
  plan.features = {pin};
  plan.characteristics = {diameter, form};
  return plan;
}

// What went wrong, in the form that editors jump to; no function here throws for bad input.
int refuse(const frustum::Diagnostics& problems) {
  print(std::cerr, problems);
  return 2;
}

int main(int argc, char** argv) {
  std::vector<Vec3> points;  // mm, in any frame
  for (int i = 0; i < 30; ++i) {
    const double turn = 0.7 * i;
    const double radius = 5.0 + 0.001 * std::cos(3.0 * turn);  // three lobes of 1 um
    points.emplace_back(radius * std::cos(turn), radius * std::sin(turn), 0.5 * i);
  }
  const auto fitted = metrology::associate(metrology::ElementKind::cylinder, points);
  if (!fitted) return refuse(fitted.error());
  const auto& cylinder = std::get<metrology::Cylinder>(fitted->fit.element);
  std::cout << "fitted radius " << cylinder.radius << " mm, form " << fitted->fit.form * 1e3
            << " um\n";

  // A CMM of E0 = 0.5 um + L/600; the seed makes its errors repeatable.
  const metrology::CmmModel cmm{.e0_mm = 0.5e-3, .length_per_error = 600.0, .seed = 1};
  const metrology::InspectionPlan plan = pin_plan();
  const auto measurement = metrology::measure(plan, Pin{}, cmm);
  if (!measurement) return refuse(measurement.error());
  for (const auto& c : measurement->characteristics) {
    std::cout << c.name << ' ' << c.value << ' ' << c.unit << " +- " << c.expanded_uncertainty
              << (c.pass ? ", pass" : ", fail") << '\n';
  }

  frustum::report::RunReport report;
  report.title = plan.title;
  report.measurement = *measurement;
  if (argc > 1) std::ofstream(argv[1]) << frustum::report::qif_results(report, plan);
  return measurement->passes() ? 0 : 1;
}

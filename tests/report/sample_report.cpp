#include "sample_report.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <numbers>

#include "core/random.hpp"
#include "core/units.hpp"

namespace frustum::report {
namespace {

constexpr double kPi = std::numbers::pi;
constexpr double kTilt = 20.0 * kPi / 180.0;
constexpr double kBaseTop = 14.0;  // mm

double cone_deviation(double phi) {  // mm
  return 1e-3 * (1.4 * std::cos(2.0 * phi + 0.4) + 0.5 * std::cos(3.0 * phi) +
                 0.06 * std::sin(41.0 * phi));
}
double cylinder_deviation(double phi) {  // mm
  return 1e-3 * (0.6 * std::cos(2.0 * phi - 0.3) + 0.12 * std::sin(17.0 * phi));
}

using Deviation = std::function<double(double phi)>;

// Builds closed bodies from rings of the same number of points.
class RingMesh {
 public:
  explicit RingMesh(std::size_t steps) : steps_(steps) {}

  // A ring of points at each angle; joined to the ring before.
  void ring(const std::function<Vec3(double phi)>& point, const Deviation& deviation = {}) {
    const auto first = static_cast<std::uint32_t>(picture.vertices.size());
    for (std::size_t k = 0; k < steps_; ++k) {
      const double phi = 2.0 * kPi * static_cast<double>(k) / static_cast<double>(steps_);
      const Vec3 p = point(phi);
      add(p, deviation ? std::optional<float>(static_cast<float>(deviation(phi))) : std::nullopt);
    }
    if (rings_++ == 0) return;
    for (std::size_t k = 0; k < steps_; ++k) {
      const auto here = static_cast<std::uint32_t>(k);
      const auto next = static_cast<std::uint32_t>((k + 1) % steps_);
      const auto below = first - static_cast<std::uint32_t>(steps_);
      picture.triangles.push_back({below + here, below + next, first + next});
      picture.triangles.push_back({below + here, first + next, first + here});
    }
  }
  // Closes the last ring (or the first, turned over) with a fan around `centre`.
  void cap(const Vec3& centre, std::uint32_t first, bool is_bottom) {
    const auto middle = static_cast<std::uint32_t>(picture.vertices.size());
    add(centre, std::nullopt);
    for (std::size_t k = 0; k < steps_; ++k) {
      const auto here = first + static_cast<std::uint32_t>(k);
      const auto next = first + static_cast<std::uint32_t>((k + 1) % steps_);
      picture.triangles.push_back(is_bottom ? std::array{middle, next, here}
                                            : std::array{middle, here, next});
    }
  }

  SurfacePicture picture;

 private:
  void add(const Vec3& p, std::optional<float> deviation) {
    picture.vertices.push_back(
        {static_cast<float>(p.x()), static_cast<float>(p.y()), static_cast<float>(p.z())});
    picture.deviation.push_back(deviation);
  }
  std::size_t steps_;
  std::size_t rings_ = 0;
};

Vec3 around(double radius, double phi, double z) {
  return {radius * std::cos(phi), radius * std::sin(phi), z};
}

// A point of the inclined part, whose axis leaves the base top at its middle.
Vec3 inclined(double radius, double phi, double along) {
  return rotation_y(kTilt) * around(radius, phi, along) + Vec3(0.0, 0.0, kBaseTop);
}

// Where the inclined cylinder enters the base top.
Vec3 foot(double radius, double phi) {
  return inclined(radius, phi, radius * std::cos(phi) * std::tan(kTilt));
}

SurfacePicture inclined_cone(std::size_t steps, std::size_t rings) {
  constexpr double kRadius = 36.0;
  RingMesh mesh(steps);
  mesh.ring([](double phi) { return around(55.0, phi, 0.0); });
  mesh.ring([](double phi) { return around(55.0, phi, kBaseTop); });
  mesh.ring([](double phi) { return foot(kRadius, phi); });
  for (std::size_t k = 0; k <= rings; ++k) {
    const double along = 16.0 + 10.0 * static_cast<double>(k) / static_cast<double>(rings);
    mesh.ring([&](double phi) { return inclined(kRadius, phi, along); }, cylinder_deviation);
  }
  for (std::size_t k = 0; k <= rings; ++k) {
    const double up = 12.0 * static_cast<double>(k) / static_cast<double>(rings);
    mesh.ring([&](double phi) { return inclined(kRadius - up, phi, 26.0 + up); }, cone_deviation);
  }
  mesh.ring([](double phi) { return inclined(kRadius - 12.0, phi, 38.0); });
  const auto last = static_cast<std::uint32_t>(mesh.picture.vertices.size() - steps);
  mesh.cap(inclined(0.0, 0.0, 38.0), last, false);
  mesh.cap(Vec3::Zero(), 0, true);
  return mesh.picture;
}

metrology::CharacteristicResult characteristic(std::string name, std::string kind, double value,
                                               std::string unit, double tolerance) {
  metrology::CharacteristicResult c;
  c.name = std::move(name);
  c.kind = std::move(kind);
  c.value = value;
  c.unit = std::move(unit);
  c.tolerance = tolerance;
  c.expanded_uncertainty = 0.04 * tolerance;
  c.pass = value <= tolerance;
  return c;
}

void plot(metrology::CharacteristicResult& c, double (*deviation)(double)) {
  for (int k = 0; k < 720; ++k) {
    const double phi = 2.0 * kPi * k / 720.0;
    c.plot_angle.push_back(phi);
    c.plot_deviation.push_back(deviation(phi));
  }
}

metrology::MeasuredFeature feature(std::string name, std::string kind, double radius, double form) {
  metrology::MeasuredFeature f;
  f.name = std::move(name);
  f.kind = std::move(kind);
  for (int k = 0; k < 360; ++k) {
    const double phi = 2.0 * kPi * k / 360.0;
    f.points.push_back({around(radius, phi, 10.0), around(1.0, phi, 0.0), 0.0, 0});
  }
  f.parameters = {{"point", {0.0, 0.0, 10.0}}, {"axis", {0.0, 0.0, 1.0}}, {"radius", {radius}}};
  f.form = form;
  f.rms = form / 5.0;
  return f;
}

AxisTrace cone_trace() {
  AxisTrace trace{"Cone, finishing pass", Abscissa::cone_angle, {}, {}};
  trace.axes = {{"X", false, {}, {}},
                {"Y", false, {}, {}},
                {"Z", false, {}, {}},
                {"B", true, {}, {}},
                {"C", true, {}, {}}};
  for (int k = 0; k <= 360; k += 2) {
    const double phi = k * kPi / 180.0;
    trace.abscissa.push_back(k);
    const double tilt = std::acos(std::sqrt(0.375) + std::sqrt(0.125) * std::cos(phi));
    const double values[] = {97.2 - 92.8 * std::cos(phi), 45.0 * std::sin(phi),
                             40.6 + 92.8 * std::cos(phi), -tilt * 180.0 / kPi,
                             k + 25.0 * std::sin(phi)};
    for (std::size_t axis = 0; axis < 5; ++axis) trace.axes[axis].values.push_back(values[axis]);
  }
  return trace;
}

}  // namespace

RunReport sample_report(std::size_t steps, std::size_t rings) {
  RunReport report;
  report.title = "Cone frustum 45° inclined by 30°, C axis 10 µm off centre";
  report.machine = "Tilting rotary table, B below C";
  report.structure = "t-(C)-Z-Y-b-X-B-C-w";
  report.program = "cone.nc";
  report.tools = {{1, {.diameter = Mm{12.0}, .length = Mm{150.0}}}};
  report.errors = {{"EX0C", "10 um", "offset of axis C from its place, in X"},
                   {"EB0C", "30 urad", "tilt of axis C about Y"},
                   {"EXX", "linear 10um over 186 mm", "positioning of axis X"}};
  auto form = characteristic("cone.equivalent_form", "equivalent_form", 3.987, "um", 10.0);
  plot(form, cone_deviation);
  auto roundness = characteristic("cylinder.roundness", "circularity", 1.402, "um", 1.0);
  plot(roundness, cylinder_deviation);
  auto half_angle = characteristic("cone.half_angle", "half_angle", 45.00123, "deg", 0.01718);
  half_angle.nominal = 45.0;
  half_angle.pass = true;
  report.measurement.characteristics = {
      form, characteristic("cone.form", "cone_form", 4.112, "um", 10.0), roundness,
      characteristic("cone.concentricity", "concentricity", 0.318, "um", 10.0), half_angle};
  report.measurement.features = {feature("cone", "cone", 33.941, 4.112e-3),
                                 feature("cylinder", "cylinder", 36.0, 1.402e-3)};
  report.measurement.features.front().parameters["half_angle"] = {kPi / 4.0};
  report.traces = {cone_trace()};
  report.surface = inclined_cone(steps, rings);
  report.volumes = {380132.7, 251204.1, 128928.6};
  report.timings = {{"parse", 0.04}, {"tool path", 0.61}, {"cut", 3.2}, {"measure", 1.13}};
  report.budget = {{"tool path chord", 0.01, 0.0098, "um"}, {"ray and sweep", 1.0, {}, "nm"}};
  report.diagnostics = {
      warning("no-program-end"_id, "the program ends without M30", "add M30 as the last block")};
  report.notes = {"The C axis turns at up to 2.7 degrees per degree of cone angle near phi = 0."};
  return report;
}

RunReport step_report(std::size_t patterns) {
  constexpr std::array<const char*, 11> kPatterns{"1-a", "1-b", "2-a", "2-b", "3", "4",
                                                  "5-a", "5-b", "6-a", "6-b", "7"};
  RunReport report;
  report.title = "Step patterns, workpiece 1";
  report.machine = "zx-yac";
  report.program = "steps.nc";
  report.errors = {{"EC0Y", "30 urad", "tilt of axis Y about Z"}};
  const RandomKey key{.seed = 3};
  std::uint64_t drawn = 0;
  const auto line = [&](std::string feature, double offset, double slope) {
    metrology::LineProfile profile{std::move(feature), {}, {}, offset, slope};
    for (int k = 0; k < 12; ++k) {
      profile.position.push_back(-27.5 + 5.0 * k);
      profile.deviation.push_back(offset + slope * profile.position.back() +
                                  0.3e-3 * normal(key, drawn++));
    }
    return profile;
  };
  for (std::size_t i = 0; i < std::min(patterns, kPatterns.size()); ++i) {
    const std::string name = kPatterns.at(i);
    const auto draw = [&](double deviation) { return deviation * normal(key, drawn++); };
    const auto add = [&](const char* what, const std::vector<metrology::LineProfile>& lines,
                         bool is_angle) {
      const double value = is_angle ? kUradPerRad * (lines[1].fit_slope - lines[0].fit_slope)
                                    : kUmPerMm * (lines[1].fit_offset - lines[0].fit_offset);
      auto c = characteristic(name + what, is_angle ? "line_angle" : "line_distance", value,
                              is_angle ? "urad" : "um", is_angle ? 400.0 : 40.0);
      c.nominal = 0.0;
      c.pass = std::abs(value) <= c.tolerance;
      c.profiles = lines;
      report.measurement.characteristics.push_back(std::move(c));
    };
    const std::vector sides{line(name + ".S_c", draw(6e-3), draw(60e-6)),
                            line(name + ".S_d", draw(6e-3), draw(60e-6))};
    const std::vector bottoms{line(name + ".B_c", draw(6e-3), draw(60e-6)),
                              line(name + ".B_d", draw(6e-3), draw(60e-6))};
    const std::vector references{line(name + ".S_a", draw(3e-3), draw(5e-6)),
                                 line(name + ".S_b", draw(3e-3), draw(5e-6))};
    add(".dL", sides, false);
    add(".dH", bottoms, false);
    add(".theta", sides, true);
    add(".phi", bottoms, true);
    add(".dL0", references, false);
  }
  return report;
}

RunReport small_report() {
  RunReport report;
  report.title = "Small part";
  report.machine = "iwf-bc";
  report.structure = "t-(C)-Z-Y-b-X-B-C-w";
  report.program = "part.nc";
  report.errors = {{"EB0C", "30 urad", "tilt of axis C about Y"}};
  auto half_angle = characteristic("cone.half_angle", "half_angle", 45.00123, "deg", 0.01718);
  half_angle.nominal = 45.0;
  half_angle.pass = true;
  report.measurement.characteristics = {
      characteristic("cone.form", "cone_form", 12.3456, "um", 10.0), half_angle};
  report.collisions = {{17, "rapid move through material, 0.8 mm deep"}};
  report.timings = {{"cut", 1.5}, {"measure", 0.25}};
  report.files = {"out/report.html", "out/report.json"};
  return report;
}

}  // namespace frustum::report

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <array>
#include <cmath>
#include <cstdlib>

#include "core/spline_surface.hpp"
#include "core/units.hpp"
#include "metrology/plan/inspection_plan.hpp"
#include "metrology/plan/plan_names.hpp"

namespace frustum::metrology {
namespace {

// The number that `scale` turns into exactly `value`, the shortest one there is.
std::optional<double> written_in(double value, double scale) {
  const double quotient = value / scale;
  // What people typed has few digits; what was computed is a few roundings away from the quotient.
  std::array<double, 8> candidates{};
  candidates[0] = std::strtod(fmt::format("{:.12g}", quotient).c_str(), nullptr);
  candidates[1] = quotient;
  for (std::size_t i = 0; i < 3; ++i) {
    candidates[2 + 2 * i] = std::nextafter(i == 0 ? quotient : candidates[2 * i], HUGE_VAL);
    candidates[3 + 2 * i] = std::nextafter(i == 0 ? quotient : candidates[1 + 2 * i], -HUGE_VAL);
  }
  for (const double candidate : candidates) {
    if (candidate * scale == value) return candidate;
  }
  return std::nullopt;
}

// A bare number of degrees, or text in rad when no number of degrees gives the same bits.
std::string angle(double rad) {
  if (const auto degrees = written_in(rad, kRadPerDeg)) return fmt::format("{}", *degrees);
  return fmt::format("\"{} rad\"", rad);
}

std::string tolerance(const PlannedCharacteristic& c) {
  const bool angular = is_angle(c.kind);
  std::string plain = fmt::format("\"{} {}\"", c.tolerance, angular ? "rad" : "mm");
  const auto micro = written_in(c.tolerance, angular ? 1e-6 : 1e-3);
  if (!micro) return plain;
  // 0.0002 rad would be 200.00000000000003 urad: the shorter one is what was meant.
  std::string text = fmt::format("\"{} {}\"", *micro, angular ? "urad" : "um");
  return text.size() <= plain.size() + 2 ? text : plain;
}

std::string vector(const Vec3& v) { return fmt::format("[{}, {}, {}]", v.x(), v.y(), v.z()); }

// "points = 12", or "pitch = 0.5", and "scan = true".
template <typename S>
std::string spacing(std::string_view points, int number, const S& s) {
  return (s.pitch > 0.0 ? fmt::format("pitch = {}", s.pitch)
                        : fmt::format("{} = {}", points, number)) +
         (s.scan ? ", scan = true" : "");
}

template <typename S>
std::string sweep(const S& s) {
  return fmt::format("start_angle = {}, sweep = {}", angle(s.start_angle), angle(s.sweep));
}

std::string text_of(const SectionStrategy& s) {
  return fmt::format("{{ sections = [{}], {}, {} }}", fmt::join(s.sections, ", "),
                     spacing("points_per_section", s.points_per_section, s), sweep(s));
}
std::string text_of(const RingStrategy& s) {
  return fmt::format("{{ rings = [{}], {}, {} }}", fmt::join(s.rings, ", "),
                     spacing("points_per_ring", s.points_per_ring, s), sweep(s));
}
std::string text_of(const GridStrategy& s) {
  return fmt::format("{{ u = {}, v = {}, {}, rows = {} }}", vector(s.u), vector(s.v),
                     spacing("columns", s.columns, s), s.rows);
}
std::string text_of(const LineStrategy& s) {
  return fmt::format("{{ from = {}, to = {}, {} }}", s.from, s.to, spacing("points", s.points, s));
}
std::string text_of(const GeneratrixStrategy& s) {
  return fmt::format("{{ generatrices = {}, from = {}, to = {}, {}, {} }}", s.generatrices, s.from,
                     s.to, spacing("points", s.points, s), sweep(s));
}
std::string text_of(const SpiralStrategy& s) {
  return fmt::format("{{ from = {}, to = {}, turns = {}, {}, start_angle = {} }}", s.from, s.to,
                     s.turns, spacing("points", s.points, s), angle(s.start_angle));
}
std::string text_of(const SphereStrategy& s) {
  return fmt::format(
      "{{ points = [{}], polar_from = {}, polar_to = {}, start_angle = {}, twist = {} }}",
      fmt::join(s.points, ", "), angle(s.polar_from), angle(s.polar_to), angle(s.start_angle),
      angle(s.twist));
}

// Deviations in um, to a picometre.
std::string text_of(const SurfaceLineStrategy& s) {
  std::string text = fmt::format("{{ heights = [{}], from = {}, to = {}, points = {}{}",
                                 fmt::join(s.heights, ", "), s.from, s.to, s.points,
                                 s.scan ? ", scan = true" : "");
  if (!s.geometric.empty()) {
    std::vector<double> um;
    for (const double mm : s.geometric) {
      um.push_back(written_in(mm, 1.0 / kUmPerMm).value_or(mm * kUmPerMm));
    }
    text += fmt::format(", geometric_um = [{}]", fmt::join(um, ", "));
  }
  return text + " }";
}

std::string text_of(const std::monostate&) { return {}; }
std::string text_of(const AxialExtent& e) {
  return fmt::format("{{ from = {}, to = {} }}", e.from, e.to);
}
std::string text_of(const RadialExtent& e) {
  return fmt::format("{{ inner = {}, outer = {} }}", e.inner, e.outer);
}
std::string text_of(const RectangleExtent& e) {
  return fmt::format("{{ u = {}, v = {} }}", vector(e.u), vector(e.v));
}

constexpr std::array<std::string_view, kFeatureNames.size()> kAxisMeaning{
    "outward normal",
    "along the axis",
    "along the axis, toward growing radius",
    "normal of the circle's plane",
    "along the line",
    "toward the pole",
    "outward normal",
    ""};

// One curve of a ruled surface: its control points.
std::string rows(const NominalNet& net, std::size_t row) {
  std::string text = "[";
  const std::size_t columns = net.surface->columns();
  for (std::size_t i = 0; i < columns; ++i) {
    text += (i == 0 ? "" : ", ") + vector(net.surface->net()[row * columns + i]);
  }
  return text + "]";
}

std::string text_of(const PlannedFeature& f) {
  std::string out = "\n[[feature]]\n";
  const auto line = [&](std::string_view key, const std::string& value,
                        std::string_view comment = {}) {
    out += comment.empty() ? fmt::format("{} = {}\n", key, value)
                           : fmt::format("{} = {}  # {}\n", key, value, comment);
  };
  line("name", toml_text(f.name));
  line("kind", toml_text(name_of(f.kind)));
  if (f.kind == FeatureKind::ruled) {
    line("lower", rows(f.net, 0));
    line("upper", rows(f.net, 1));
    line("strategy", std::visit([](const auto& s) { return text_of(s); }, f.strategy));
    return out;
  }
  line("point", vector(f.point));
  line("axis", vector(f.axis), kAxisMeaning.at(static_cast<std::size_t>(f.kind)));
  if (is_round(f.kind) && f.kind != FeatureKind::cone) {
    line("radius", fmt::format("{}", f.radius));
  }
  if (f.kind == FeatureKind::cone) {
    line("section_radius", fmt::format("{}", f.radius), "across the axis, in the section at point");
    line("half_angle", angle(f.half_angle));
  }
  if (f.kind == FeatureKind::point) return out;
  if (f.kind == FeatureKind::line) {
    line("normal", vector(f.normal), "outward normal of the surface it is on");
  } else {
    if (is_round(f.kind)) {
      line("side", toml_text(kSideNames.at(static_cast<std::size_t>(f.side))),
           f.side == Side::outside ? "a boss" : "a hole");
    }
    if (f.zero) line("zero", vector(*f.zero), "where angles about the axis start");
  }
  line("strategy", std::visit([](const auto& s) { return text_of(s); }, f.strategy));
  const std::string extent = std::visit([](const auto& e) { return text_of(e); }, f.extent);
  if (!extent.empty()) line("extent", extent);
  return out;
}

std::vector<std::string> toml_texts(const std::vector<std::string>& texts) {
  std::vector<std::string> written;
  written.reserve(texts.size());
  for (const std::string& text : texts) written.push_back(toml_text(text));
  return written;
}

std::string text_of(const PlannedFrame& f) {
  return fmt::format(
      "\n[[frame]]\nname = {}\nplanes = [{}]  # Z: outward normal through all their points\n"
      "line = {}  # X: along it; the origin keeps its place across\n",
      toml_text(f.name), fmt::join(toml_texts(f.planes), ", "), toml_text(f.line));
}

std::string text_of(const InspectionPlan& plan, const DatumSystem& datum) {
  std::string out = "\n[datum]\n";
  // What a plane and an axis across it give can be said in a word.
  const auto is = [&](const std::string& name, FeatureKind kind) {
    const PlannedFeature* feature = find_feature(plan, name);
    return feature != nullptr && feature->kind == kind;
  };
  const bool plane_and_axis =
      is(datum.primary, FeatureKind::plane) &&
      (is(datum.secondary, FeatureKind::cylinder) || is(datum.secondary, FeatureKind::cone));
  const auto line = [&](std::string_view key, const std::string& name, std::string_view comment) {
    if (name.empty()) return;
    out += fmt::format("{} = {}", key, toml_text(name));
    if (plane_and_axis && !comment.empty()) out += fmt::format("  # {}", comment);
    out += '\n';
  };
  line("primary", datum.primary, "Z: its outward normal");
  line("secondary", datum.secondary, "origin: its axis pierced with the primary");
  line("tertiary", datum.tertiary,
       is(datum.tertiary, FeatureKind::plane) ? "Y: its trace in the primary" : "");
  if (datum.base) out += "criterion = \"base\"\n";
  if (datum.criterion != Criterion::least_squares) {
    out += fmt::format("criterion = {}\n", toml_text(name_of(datum.criterion)));
  }
  if (!datum.best_fit.empty()) {
    out += fmt::format("best_fit = [{}]  # all at once, least squares\n",
                       fmt::join(toml_texts(datum.best_fit), ", "));
  }
  if (!datum.locked.empty()) {
    out += fmt::format("locked = [{}]  # as planned\n", fmt::join(toml_texts(datum.locked), ", "));
  }
  return out;
}

std::string text_of(const ProfileFilter& filter) {
  std::vector<std::string> parts;
  const auto part = [&](std::string_view key, double value, bool is_length) {
    if (value == 0.0) return;
    parts.push_back(is_length ? fmt::format("{} = \"{} mm\"", key, value)
                              : fmt::format("{} = {}", key, value));
  };
  part("upr", filter.upr, false);
  part("upr_from", filter.upr_from, false);
  part("cutoff", filter.cutoff, true);
  part("cutoff_long", filter.cutoff_long, true);
  return fmt::format("{{ {} }}", fmt::join(parts, ", "));
}

// The keys that say how a value is found, where they are not the usual ones.
std::string text_of_evaluation(const PlannedCharacteristic& c) {
  std::string out;
  if (c.criterion != Criterion::least_squares) {
    out += fmt::format("criterion = {}\n", toml_text(name_of(c.criterion)));
  }
  if (c.datum_criterion != Criterion::least_squares) {
    out += fmt::format("datum_criterion = {}\n", toml_text(name_of(c.datum_criterion)));
  }
  if (c.parameter) {
    out += fmt::format("parameter = {}\n",
                       toml_text(kParameterNames.at(static_cast<std::size_t>(*c.parameter))));
  }
  if (c.filter) out += fmt::format("filter = {}\n", text_of(*c.filter));
  if (c.harmonics > 0) out += fmt::format("harmonics = {}\n", c.harmonics);
  if (c.floating) out += "floating = true\n";
  if (c.deviation) out += "deviation = true\n";
  if (c.point) out += fmt::format("point = {}\n", *c.point);
  if (c.seam) {
    out += fmt::format("seam = {{ at = {}, within = {} }}\n", angle(c.seam->at),
                       angle(c.seam->within));
  }
  return out;
}

std::string text_of(const PlannedCharacteristic& c) {
  const std::vector<std::string> names = toml_texts(c.features);
  std::string out = fmt::format("\n[[characteristic]]\nname = {}\nkind = {}\n", toml_text(c.name),
                                toml_text(name_of(c.kind)));
  out += names.size() == 1 ? fmt::format("feature = {}\n", names.front())
                           : fmt::format("features = [{}]\n", fmt::join(names, ", "));
  if (c.sections.size() == 1) out += fmt::format("section = {}  # first = 0\n", c.sections.front());
  if (c.sections.size() > 1) {
    out += fmt::format("sections = [{}]  # first = 0\n", fmt::join(c.sections, ", "));
  }
  if (!c.frame.empty()) out += fmt::format("frame = {}\n", toml_text(c.frame));
  if (c.direction != Vec3::Zero()) {
    out += fmt::format("direction = {}  # {}\n", vector(c.direction),
                       is_angle(c.kind) ? "right-handed about it, second less first"
                                        : "measured along it, second less first");
  }
  out += text_of_evaluation(c);
  return out + fmt::format("tolerance = {}\n", tolerance(c));
}

}  // namespace

std::string to_toml(const InspectionPlan& plan) {
  std::string out =
      "# Inspection plan. Lengths in mm, angles in degrees; a text carries its own unit.\n";
  out += fmt::format("title = {}\n", toml_text(plan.title));
  out += fmt::format("alignment = {}  # datum: results in the datum system; plan: as probed\n",
                     toml_text(kAlignmentNames.at(static_cast<std::size_t>(plan.alignment))));
  if (plan.decision != DecisionRule::simple) {
    out += fmt::format("decision = {}\n",
                       toml_text(kDecisionNames.at(static_cast<std::size_t>(plan.decision))));
  }
  if (plan.monte_carlo) out += fmt::format("uncertainty = {}\n", to_toml(*plan.monte_carlo));
  out += to_toml(plan.header);
  out += "\n[probe]\n";
  out += fmt::format("ball_diameter = {}  # mm\n", plan.probe.ball_diameter);
  out += fmt::format("clearance = {}  # mm, where the approach starts\n", plan.probe.clearance);
  out += fmt::format("reach = {}  # mm, how far past the nominal surface it searches\n",
                     plan.probe.reach);
  if (plan.probe.compensation != Compensation::fitted) {
    out += fmt::format(
        "compensation = {}  # surface points: centres less the radius against the approach\n",
        toml_text(kCompensationNames.at(static_cast<std::size_t>(plan.probe.compensation))));
  }
  if (plan.datum) out += text_of(plan, *plan.datum);
  for (const PlannedFrame& frame : plan.frames) out += text_of(frame);
  for (const PlannedFeature& feature : plan.features) out += text_of(feature);
  for (const PlannedCharacteristic& c : plan.characteristics) out += text_of(c);
  return out;
}

}  // namespace frustum::metrology

#include "report/measuring_statement.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <string_view>

#include "core/units.hpp"
#include "metrology/plan/plan_names.hpp"
#include "metrology/uncertainty/linear_uncertainty.hpp"
#include "metrology/uncertainty/point_uncertainty.hpp"
#include "report/form_parameter.hpp"

namespace frustum::report {
namespace {

using metrology::CmmModel;
using metrology::InspectionPlan;
using metrology::PlannedCharacteristic;

std::string source_text(const CmmModel& cmm, PointSource source, const Wording& words) {
  if (source == PointSource::measured_points) {
    return words("points of a CMM, read from a file");
  }
  const std::string probed =
      source == PointSource::mesh ? words("virtual CMM on a mesh") : words("virtual CMM");
  if (metrology::point_uncertainty(cmm).is_zero()) return probed;
  const bool is_field = cmm.kind == metrology::CmmKind::field;
  return words("{0}, {1}, seed {2}", probed,
               is_field ? words("21 parametric errors") : words("linear error field and noise"),
               cmm.seed);
}

// "5 µm + L/300 (L in mm, E in µm)": in inches L is in mil, so that the divisor stays.
std::string limit_text(const CmmModel& cmm, const Wording& words) {
  const std::string e0 = words.amount(cmm.e0_mm * kUmPerMm, "um");
  const std::string divisor = words.general(*cmm.length_per_error);
  return words.is_inch() ? words("{0} + L/{1} (L in mil, E in µin)", e0, divisor)
                         : words("{0} + L/{1} (L in mm, E in µm)", e0, divisor);
}

std::string accuracy_text(const CmmModel& cmm, PointSource source, const Wording& words) {
  if (metrology::point_uncertainty(cmm).is_zero()) {
    switch (source) {
      case PointSource::virtual_cmm:
        return words("ideal, E0 = 0: the machine makes no error, and every U is 0");
      case PointSource::mesh:
        return words("not stated: the mesh counts as the part, and every U is 0");
      case PointSource::measured_points:
        return words("not stated: every U is 0, which says nothing about the machine");
    }
  }
  std::string text = "E0 = " + words.amount(cmm.e0_mm * kUmPerMm, "um");
  if (source == PointSource::measured_points && !cmm.length_per_error) {
    return text + words("; how errors grow with length is not stated, no U contains it");
  }
  if (cmm.length_per_error) {
    text += "; E = " + limit_text(cmm, words);
  }
  return text;
}

std::string probe_text(const metrology::ProbeSettings& probe, PointSource source,
                       const Wording& words) {
  const bool is_fitted = probe.compensation == metrology::Compensation::fitted;
  const std::string ball = words("ball diameter {0}", words.amount(probe.ball_diameter, "mm"));
  if (source == PointSource::measured_points) return ball;
  return ball + (is_fitted ? words(", compensated along the normal of the fitted element")
                           : words(", compensated against the approach"));
}

std::string stylus_text(const metrology::Stylus& stylus, const Wording& words) {
  const Vec3 to_head = stylus.direction.vec();
  return words("length {0}, shank {1}, from the ball along ({2}, {3}, {4})",
               words.amount(stylus.length, "mm"), words.amount(stylus.diameter, "mm"),
               words.general(to_head.x()), words.general(to_head.y()), words.general(to_head.z()));
}

std::string temperature_text(const metrology::ThermalState& state, const Wording& words) {
  constexpr double kMicro = 1e-6;
  // µm/(m K) is a millionth per kelvin, whatever the unit of length.
  std::string text =
      words("part {0} °C, {1} µm/(m K); scales {2} °C, {3} µm/(m K); {4}",
            words.general(state.part), words.general(state.part_expansion / kMicro),
            words.general(state.scales), words.general(state.scale_expansion / kMicro),
            state.compensated ? words("compensated") : words("not compensated"));
  if (state.compensated) {
    text += words(", sensors right to ± {0} K, coefficients to ± {1} µm/(m K)",
                  words.general(state.sensor_error), words.general(state.expansion_error / kMicro));
  }
  return text;
}

std::string alignment_text(const InspectionPlan& plan, const Wording& words) {
  if (plan.alignment == metrology::Alignment::plan || !plan.datum) {
    return words("none: results are in the frame in which the points come");
  }
  const metrology::DatumSystem& datum = *plan.datum;
  if (!datum.best_fit.empty()) {
    return words("best fit of {0} by least squares",
                 fmt::format("{}", fmt::join(datum.best_fit, ", ")));
  }
  std::string text = words("datums {0}", datum.primary);
  for (const std::string& next : {datum.secondary, datum.tertiary}) {
    if (!next.empty()) text += " | " + next;
  }
  const bool is_outside = datum.criterion == metrology::Criterion::outside_material;
  return text + (datum.base   ? words(", each by its own least-squares element")
                 : is_outside ? words(", touched from outside the material (ISO 5459)")
                              : words(", by least squares in this order"));
}

std::string filter_text(const metrology::ProfileFilter& filter, const Wording& words) {
  std::string text;
  const auto add = [&](double value, Phrase form, const std::string& shown) {
    if (value > 0.0) text += (text.empty() ? "" : ", ") + words(form, shown);
  };
  add(filter.upr, "to {0} UPR", words.general(filter.upr));
  add(filter.upr_from, "from {0} UPR", words.general(filter.upr_from));
  add(filter.cutoff, "cut-off {0}", words.amount(filter.cutoff, "mm"));
  add(filter.cutoff_long, "long waves from {0} removed", words.amount(filter.cutoff_long, "mm"));
  return text;
}

// What noise alone makes of a perfect circle: the mean range of 36 and of 360 normal numbers.
std::string noise_text(const CmmModel& cmm, const Wording& words) {
  constexpr double kRangeOf36 = 4.24, kRangeOf360 = 5.87;
  const double noise = kUmPerMm * metrology::point_uncertainty(cmm).probing;
  if (!(noise > 0.0)) return "";
  const auto rounded = [&](double um) {
    return words.number(fmt::format("{:.2g}", words.shown(um, "um"))) + " " + words.symbol("um");
  };
  return words("; its {0} a point make a perfect circle of 36 points {1}, of 360 points {2}",
               rounded(noise), rounded(kRangeOf36 * noise), rounded(kRangeOf360 * noise));
}

std::string filters_text(const InspectionPlan& plan, const CmmModel& cmm, const Wording& words) {
  std::string text;
  for (const PlannedCharacteristic& c : plan.characteristics) {
    if (!c.filter) continue;
    text += (text.empty() ? "" : "; ") +
            words("{0}: Gaussian, {1}", c.name, filter_text(*c.filter, words));
  }
  if (text.empty()) {
    return words("none: forms hold all undulations and the noise of the machine") +
           noise_text(cmm, words);
  }
  return text + words("; all others none");
}

std::string association_text(const InspectionPlan& plan, const Wording& words) {
  constexpr std::array<Phrase, 5> kWords{"least squares", "minimum zone", "maximum inscribed",
                                         "minimum circumscribed", "outside the material"};
  const auto criterion_text = [&](metrology::Criterion criterion) {
    return words(kWords.at(static_cast<std::size_t>(criterion)));
  };
  constexpr auto kUsual = metrology::Criterion::least_squares;
  std::string text = words("least squares");
  for (const PlannedCharacteristic& c : plan.characteristics) {
    std::vector<std::string> others;
    if (c.criterion != kUsual) others.push_back(criterion_text(c.criterion));
    if (c.datum_criterion != kUsual) {
      others.push_back(words("datum {0}", criterion_text(c.datum_criterion)));
    }
    if (c.floating) others.push_back(words("floating, planned geometry fitted to the points"));
    if (!others.empty()) text += fmt::format("; {}: {}", c.name, fmt::join(others, ", "));
  }
  return text;
}

// Of the forms whose plan states one; empty when none does.
std::string parameters_text(const InspectionPlan& plan, const Wording& words) {
  std::string text;
  for (const PlannedCharacteristic& c : plan.characteristics) {
    if (!c.parameter) continue;
    const auto parameter = metrology::kParameterNames.at(static_cast<std::size_t>(*c.parameter));
    text += fmt::format("{}{}: {}", text.empty() ? "" : "; ", c.name,
                        parameter_text(name_of(c.kind), parameter, words));
  }
  return text;
}

std::string uncertainty_text_of(const InspectionPlan& plan, const CmmModel& cmm, PointSource source,
                                const Wording& words) {
  const bool is_zero = metrology::point_uncertainty(cmm).is_zero();
  if (is_zero && source != PointSource::virtual_cmm) {
    return words("not stated: nothing is said of how far the values are from the truth");
  }
  std::vector<std::string> unproven;
  for (const PlannedCharacteristic& c : plan.characteristics) {
    if (!is_zero && !metrology::is_coverage_proven(plan, c)) unproven.push_back(c.name);
  }
  return words(
             "value +- U holds the true value in 95 % of measurements, by what is stated of the "
             "machine") +
         (unproven.empty() ? ""
                           : words("; not proven where single touched points decide: {0}",
                                   fmt::format("{}", fmt::join(unproven, ", ")))) +
         (plan.monte_carlo ? words("; the interval is simulated (Monte Carlo)") : "");
}

std::string decision_text(metrology::DecisionRule rule, const Wording& words) {
  constexpr std::array<Phrase, 2> kRules{
      "simple acceptance: the value is within the tolerance; U is not taken into account "
      "(ISO 14253-1 is not applied)",
      "ISO 14253-1: pass where value + U, and value - U of a value with two limits, is within the "
      "tolerance, fail where all of value +- U is outside, uncertain otherwise and where U is not "
      "proven or not stated"};
  return words(kRules.at(static_cast<std::size_t>(rule)));
}

}  // namespace

std::vector<Fact> measuring_statement(const InspectionPlan& plan, const CmmModel& cmm,
                                      PointSource source, const Wording& words) {
  std::vector<Fact> facts{{"source", words("Measured by"), source_text(cmm, source, words)},
                          {"accuracy", words("Accuracy"), accuracy_text(cmm, source, words)},
                          {"probe", words("Probe"), probe_text(plan.probe, source, words)}};
  if (cmm.stylus) facts.push_back({"stylus", words("Stylus"), stylus_text(*cmm.stylus, words)});
  if (cmm.temperature) {
    facts.push_back(
        {"temperature", words("Temperature"), temperature_text(*cmm.temperature, words)});
  }
  facts.push_back({"alignment", words("Alignment"), alignment_text(plan, words)});
  facts.push_back({"filter", words("Filter"), filters_text(plan, cmm, words)});
  facts.push_back({"association", words("Association"), association_text(plan, words)});
  if (const std::string text = parameters_text(plan, words); !text.empty()) {
    facts.push_back({"parameter", words("Form parameter"), text});
  }
  facts.push_back(
      {"uncertainty", words("Uncertainty"), uncertainty_text_of(plan, cmm, source, words)});
  facts.push_back({"decision_rule", words("Decision rule"), decision_text(plan.decision, words)});
  return facts;
}

}  // namespace frustum::report

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

std::string source_text(const CmmModel& cmm, PointSource source) {
  if (source == PointSource::measured_points) return "points of a CMM, read from a file";
  const char* const probed = source == PointSource::mesh ? "virtual CMM on a mesh" : "virtual CMM";
  if (metrology::point_uncertainty(cmm).is_zero()) return probed;
  const bool is_field = cmm.kind == metrology::CmmKind::field;
  return fmt::format("{}, {}, seed {}", probed,
                     is_field ? "21 parametric errors" : "linear error field and noise", cmm.seed);
}

std::string accuracy_text(const CmmModel& cmm, PointSource source) {
  if (metrology::point_uncertainty(cmm).is_zero()) {
    switch (source) {
      case PointSource::virtual_cmm:
        return "ideal, E0 = 0: the machine makes no error, and every U is 0";
      case PointSource::mesh:
        return "not stated: the mesh counts as the part, and every U is 0";
      case PointSource::measured_points:
        return "not stated: every U is 0, which says nothing about the machine";
    }
  }
  std::string text = fmt::format("E0 = {:g} µm", cmm.e0_mm * kUmPerMm);
  if (source == PointSource::measured_points && !cmm.length_per_error) {
    return text + "; how errors grow with length is not stated, no U contains it";
  }
  if (cmm.length_per_error) {
    text += fmt::format("; E = {:g} µm + L/{:g} (L in mm, E in µm)", cmm.e0_mm * kUmPerMm,
                        *cmm.length_per_error);
  }
  return text;
}

std::string probe_text(const metrology::ProbeSettings& probe, PointSource source) {
  const bool is_fitted = probe.compensation == metrology::Compensation::fitted;
  const std::string ball = fmt::format("ball diameter {:g} mm", probe.ball_diameter);
  if (source == PointSource::measured_points) return ball;
  return ball + (is_fitted ? ", compensated along the normal of the fitted element"
                           : ", compensated against the approach");
}

std::string stylus_text(const metrology::Stylus& stylus) {
  const Vec3 to_head = stylus.direction.vec();
  return fmt::format("length {:g} mm, shank {:g} mm, from the ball along ({:g}, {:g}, {:g})",
                     stylus.length, stylus.diameter, to_head.x(), to_head.y(), to_head.z());
}

std::string temperature_text(const metrology::ThermalState& state) {
  constexpr double kMicro = 1e-6;
  std::string text =
      fmt::format("part {:g} °C, {:g} µm/(m K); scales {:g} °C, {:g} µm/(m K); {}", state.part,
                  state.part_expansion / kMicro, state.scales, state.scale_expansion / kMicro,
                  state.compensated ? "compensated" : "not compensated");
  if (state.compensated) {
    text += fmt::format(", sensors right to ± {:g} K, coefficients to ± {:g} µm/(m K)",
                        state.sensor_error, state.expansion_error / kMicro);
  }
  return text;
}

std::string alignment_text(const InspectionPlan& plan) {
  if (plan.alignment == metrology::Alignment::plan || !plan.datum) {
    return "none: results are in the frame in which the points come";
  }
  const metrology::DatumSystem& datum = *plan.datum;
  if (!datum.best_fit.empty()) {
    return fmt::format("best fit of {} by least squares", fmt::join(datum.best_fit, ", "));
  }
  std::string text = "datums " + datum.primary;
  for (const std::string& next : {datum.secondary, datum.tertiary}) {
    if (!next.empty()) text += " | " + next;
  }
  const bool is_outside = datum.criterion == metrology::Criterion::outside_material;
  return text + (datum.base   ? ", each by its own least-squares element"
                 : is_outside ? ", touched from outside the material (ISO 5459)"
                              : ", by least squares in this order");
}

std::string filter_text(const metrology::ProfileFilter& filter) {
  std::string text;
  const auto add = [&](double value, const char* form) {
    if (value > 0.0) text += (text.empty() ? "" : ", ") + fmt::format(fmt::runtime(form), value);
  };
  add(filter.upr, "to {:g} UPR");
  add(filter.upr_from, "from {:g} UPR");
  add(filter.cutoff, "cut-off {:g} mm");
  add(filter.cutoff_long, "long waves from {:g} mm removed");
  return text;
}

// What noise alone makes of a perfect circle: the mean range of 36 and of 360 normal numbers.
std::string noise_text(const CmmModel& cmm) {
  constexpr double kRangeOf36 = 4.24, kRangeOf360 = 5.87;
  const double noise = kUmPerMm * metrology::point_uncertainty(cmm).probing;
  if (!(noise > 0.0)) return "";
  return fmt::format(
      "; its {:.2g} µm a point make a perfect circle of 36 points {:.2g} µm, of 360 points {:.2g} "
      "µm",
      noise, kRangeOf36 * noise, kRangeOf360 * noise);
}

std::string filters_text(const InspectionPlan& plan, const CmmModel& cmm) {
  std::string text;
  for (const PlannedCharacteristic& c : plan.characteristics) {
    if (!c.filter) continue;
    text +=
        fmt::format("{}{}: Gaussian, {}", text.empty() ? "" : "; ", c.name, filter_text(*c.filter));
  }
  if (text.empty()) {
    return "none: forms hold all undulations and the noise of the machine" + noise_text(cmm);
  }
  return text + "; all others none";
}

std::string association_text(const InspectionPlan& plan) {
  constexpr std::array<std::string_view, 5> kWords{"least squares", "minimum zone",
                                                   "maximum inscribed", "minimum circumscribed",
                                                   "outside the material"};
  const auto words = [&](metrology::Criterion criterion) {
    return kWords.at(static_cast<std::size_t>(criterion));
  };
  constexpr auto kUsual = metrology::Criterion::least_squares;
  std::string text = "least squares";
  for (const PlannedCharacteristic& c : plan.characteristics) {
    std::vector<std::string> others;
    if (c.criterion != kUsual) others.emplace_back(words(c.criterion));
    if (c.datum_criterion != kUsual) {
      others.push_back(fmt::format("datum {}", words(c.datum_criterion)));
    }
    if (c.floating) others.emplace_back("floating, planned geometry fitted to the points");
    if (!others.empty()) text += fmt::format("; {}: {}", c.name, fmt::join(others, ", "));
  }
  return text;
}

// Of the forms whose plan states one; empty when none does.
std::string parameters_text(const InspectionPlan& plan) {
  std::string text;
  for (const PlannedCharacteristic& c : plan.characteristics) {
    if (!c.parameter) continue;
    const auto parameter = metrology::kParameterNames.at(static_cast<std::size_t>(*c.parameter));
    text += fmt::format("{}{}: {}", text.empty() ? "" : "; ", c.name,
                        parameter_text(name_of(c.kind), parameter));
  }
  return text;
}

std::string uncertainty_text_of(const InspectionPlan& plan, const CmmModel& cmm,
                                PointSource source) {
  const bool is_zero = metrology::point_uncertainty(cmm).is_zero();
  if (is_zero && source != PointSource::virtual_cmm) {
    return "not stated: nothing is said of how far the values are from the truth";
  }
  std::vector<std::string> unproven;
  for (const PlannedCharacteristic& c : plan.characteristics) {
    if (!is_zero && !metrology::is_coverage_proven(plan, c)) unproven.push_back(c.name);
  }
  return std::string(
             "value +- U holds the true value in 95 % of measurements, by what is stated of the "
             "machine") +
         (unproven.empty() ? ""
                           : fmt::format("; not proven where single touched points decide: {}",
                                         fmt::join(unproven, ", "))) +
         (plan.monte_carlo ? "; the interval is simulated (Monte Carlo)" : "");
}

std::string decision_text(metrology::DecisionRule rule) {
  constexpr std::array<std::string_view, 2> kRules{
      "simple acceptance: the value is within the tolerance; U is not taken into account "
      "(ISO 14253-1 is not applied)",
      "ISO 14253-1: pass where value + U, and value - U of a value with two limits, is within the "
      "tolerance, fail where all of value +- U is outside, uncertain otherwise and where U is not "
      "proven or not stated"};
  return std::string(kRules.at(static_cast<std::size_t>(rule)));
}

}  // namespace

std::vector<Fact> measuring_statement(const InspectionPlan& plan, const CmmModel& cmm,
                                      PointSource source) {
  std::vector<Fact> facts{{"source", "Measured by", source_text(cmm, source)},
                          {"accuracy", "Accuracy", accuracy_text(cmm, source)},
                          {"probe", "Probe", probe_text(plan.probe, source)}};
  if (cmm.stylus) facts.push_back({"stylus", "Stylus", stylus_text(*cmm.stylus)});
  if (cmm.temperature) {
    facts.push_back({"temperature", "Temperature", temperature_text(*cmm.temperature)});
  }
  facts.push_back({"alignment", "Alignment", alignment_text(plan)});
  facts.push_back({"filter", "Filter", filters_text(plan, cmm)});
  facts.push_back({"association", "Association", association_text(plan)});
  if (const std::string text = parameters_text(plan); !text.empty()) {
    facts.push_back({"parameter", "Form parameter", text});
  }
  facts.push_back({"uncertainty", "Uncertainty", uncertainty_text_of(plan, cmm, source)});
  facts.push_back({"decision_rule", "Decision rule", decision_text(plan.decision)});
  return facts;
}

}  // namespace frustum::report

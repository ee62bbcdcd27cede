#include "app/view/identification_view.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "app/view/shown_unit.hpp"
#include "app/view/text_table.hpp"
#include "calibration/identify/distributions.hpp"
#include "core/counted.hpp"
#include "core/program_version.hpp"
#include "report/number_text.hpp"

namespace frustum::app {
namespace {

using calibration::Estimate;
using calibration::Recipe;
using calibration::RecipeErrors;
using Json = nlohmann::ordered_json;

const char* unit_of(bool angular) { return shown_unit(angular).name; }

std::string number(double value, bool angular) {
  return report::fixed_text(shown(value, angular), 1);
}

// Motion tests know errors to hundredths.
std::string estimated(const Study& study, double value, bool angular) {
  return report::fixed_text(shown(value, angular), study.motions.empty() ? 1 : 2);
}

std::string optional_number(const std::optional<double>& value, bool angular) {
  return value ? number(*value, angular) : "";
}

// What a recipe gives for a name, when it is one of its eight.
std::optional<double> recipe_value(const std::optional<Recipe>& recipe, const std::string& name) {
  if (!recipe) return std::nullopt;
  const RecipeErrors& e = recipe->errors;
  for (const auto& [known, value] :
       {std::pair{"alpha_AY", e.alpha_AY}, std::pair{"beta_AY", e.beta_AY},
        std::pair{"gamma_AY", e.gamma_AY}, std::pair{"beta_CA", e.beta_CA},
        std::pair{"dx_AY", e.dx_AY}, std::pair{"dy_AY", e.dy_AY}, std::pair{"dz_AY", e.dz_AY},
        std::pair{"dy_CA", e.dy_CA}}) {
    if (name == known) return value;
  }
  return std::nullopt;
}

std::string known_text(const Study& study, const Estimate& estimate) {
  for (const KnownError& k : study.known) {
    if (k.name != estimate.name) continue;
    return k.uncertainty > 0.0
               ? fmt::format("{} ± {}", number(k.value, estimate.angular),
                             number(calibration::coverage_factor(0.95, {}) * k.uncertainty,
                                    estimate.angular))
               : number(k.value, estimate.angular) + " exact";
  }
  return "";
}

std::string estimates_table(const Study& study, const StudyResult& result) {
  std::vector<std::string> headings{"error", "unit", "estimate", "± 95 %", "known before"};
  if (result.recipe) {
    headings.emplace_back("recipe");
    headings.emplace_back("recipe corrected");
  }
  for (const OtherEstimate& other : study.others) headings.push_back(other.name);
  TextTable table(headings);
  for (const Estimate& e : result.identification.estimates) {
    const std::string half =
        e.upper && e.lower ? estimated(study, 0.5 * (*e.upper - *e.lower), e.angular) : "";
    std::vector<std::string> cells{
        e.name, unit_of(e.angular),
        e.value ? estimated(study, *e.value, e.angular) : "not identified", half,
        known_text(study, e)};
    if (result.recipe) {
      cells.push_back(optional_number(recipe_value(result.recipe, e.name), e.angular));
      cells.push_back(optional_number(recipe_value(result.corrected_recipe, e.name), e.angular));
    }
    for (const OtherEstimate& other : study.others) {
      const auto at = other.values.find(e.name);
      cells.push_back(at == other.values.end() ? "" : number(at->second, e.angular));
    }
    table.row(std::move(cells));
  }
  return table.text();
}

// A sum of angles is an angle; with a length in it, it is a length.
bool is_angle(const calibration::Combination& combination, const StudyResult& result) {
  return std::all_of(combination.terms.begin(), combination.terms.end(), [&](const auto& term) {
    return result.identification.estimates[static_cast<std::size_t>(term.unknown)].angular;
  });
}

std::string combinations_text(const Study& study, const StudyResult& result) {
  std::string out;
  for (const auto& c : result.identification.combinations) {
    const bool angular = is_angle(c.combination, result);
    out +=
        fmt::format("  {} = {} ± {} {}\n", c.combination.text, estimated(study, c.value, angular),
                    estimated(study, 0.5 * (c.upper - c.lower), angular), unit_of(angular));
  }
  return out.empty() ? out : "\nWhat can be identified instead (± 95 %):\n" + out;
}

std::string joined(const std::vector<std::string>& names) {
  std::string out;
  for (const std::string& name : names) out += (out.empty() ? "" : ", ") + name;
  return out;
}

std::string remedy_text(const Remedy& remedy) {
  std::string out = remedy.patterns.empty()
                        ? "No further step patterns on this machine would identify them all"
                        : fmt::format("The fewest step patterns that would identify them: {}",
                                      joined(remedy.patterns));
  if (!remedy.unreachable.empty()) {
    out += fmt::format(" (out of this machine's travel: {})", joined(remedy.unreachable));
  }
  return '\n' + out + ".\n";
}

std::string residual_table(const Study& study, const StudyResult& result) {
  std::vector<const calibration::Residual*> worst;
  for (const auto& r : result.identification.residuals) {
    if (r.normalised) worst.push_back(&r);
  }
  std::stable_sort(worst.begin(), worst.end(), [](const auto* a, const auto* b) {
    return std::abs(*a->normalised) > std::abs(*b->normalised);
  });
  constexpr std::size_t kShown = 6;
  if (worst.size() > kShown) worst.resize(kShown);
  TextTable table(
      {"largest residuals", "unit", "measured", "predicted", "residual", "in deviations"});
  for (const auto* r : worst) {
    table.row({r->name, unit_of(r->angular), estimated(study, r->measured, r->angular),
               estimated(study, r->predicted, r->angular),
               estimated(study, r->residual, r->angular),
               fmt::format("{:+.1f}{}", *r->normalised, r->outlier ? " !" : "")});
  }
  return worst.empty() ? "" : '\n' + table.text();
}

std::string agreement_text(const StudyResult& result) {
  const auto& a = result.identification.agreement;
  if (!a.probability) return "\nNothing checks the estimates: no degrees of freedom are left.\n";
  std::string out = fmt::format(
      "\nAgreement: chi2 {:.4g} with {} degree{} of freedom, probability {:.2g}", a.chi_square,
      a.degrees_of_freedom, a.degrees_of_freedom == 1 ? "" : "s", *a.probability);
  if (!result.changes.empty()) {
    out += fmt::format("; settled after {} of all parts", counted(result.changes.size(), "run"));
  }
  return out + ".\n";
}

// Of the tests' set-ups: where their balls, bars and artefacts seem to be.
std::string mountings_text(const StudyResult& result) {
  if (result.mountings.empty()) return "";
  TextTable table({"set-up found of", "", "value", "unit"});
  for (const auto& mounting : result.mountings) {
    for (std::size_t k = 0; k < mounting.unknowns.size(); ++k) {
      const auto& unknown = mounting.unknowns[k];
      table.row({k == 0 ? mounting.test : "", unknown.name,
                 number(mounting.values[static_cast<Eigen::Index>(k)], unknown.angular),
                 unit_of(unknown.angular)});
    }
  }
  return '\n' + table.text();
}

Json mountings_json(const StudyResult& result) {
  Json list = Json::array();
  for (const auto& mounting : result.mountings) {
    Json json{{"test", mounting.test}};
    for (std::size_t k = 0; k < mounting.unknowns.size(); ++k) {
      const auto& unknown = mounting.unknowns[k];
      json[unknown.name + (unknown.angular ? " urad" : " um")] =
          shown(mounting.values[static_cast<Eigen::Index>(k)], unknown.angular);
    }
    list.push_back(std::move(json));
  }
  return list;
}

std::string recipe_text(const Recipe& recipe) {
  TextTable table({"recipe as printed", "equation", "quantity", "value", "unit", "", "from"});
  for (const auto& step : recipe.steps) {
    std::string from;
    for (const auto& input : step.inputs) {
      from += fmt::format("{}{} = {}", from.empty() ? "" : ", ", input.name,
                          number(input.value, input.angular));
    }
    table.row({step.step, step.equation, step.quantity, number(step.value, step.angular),
               unit_of(step.angular), "", from});
  }
  return '\n' + table.text();
}

Json optional_json(const std::optional<double>& value, bool angular) {
  return value && std::isfinite(*value) ? Json(shown(*value, angular)) : Json(nullptr);
}

Json estimates_json(const Study& study, const StudyResult& result) {
  Json list = Json::array();
  for (const Estimate& e : result.identification.estimates) {
    Json json;
    json["name"] = e.name;
    json["unit"] = unit_of(e.angular);
    json["value"] = optional_json(e.value, e.angular);
    json["standard_uncertainty"] = optional_json(e.standard_uncertainty, e.angular);
    json["lower"] = optional_json(e.lower, e.angular);
    json["upper"] = optional_json(e.upper, e.angular);
    json["fixed"] = e.fixed;
    Json others = Json::object();
    for (const OtherEstimate& other : study.others) {
      const auto at = other.values.find(e.name);
      if (at != other.values.end()) others[other.name] = shown(at->second, e.angular);
    }
    if (const auto value = recipe_value(result.recipe, e.name)) {
      others["recipe as printed"] = shown(*value, e.angular);
      others["recipe corrected"] = shown(*recipe_value(result.corrected_recipe, e.name), e.angular);
    }
    if (!others.empty()) json["others"] = std::move(others);
    list.push_back(std::move(json));
  }
  return list;
}

// Rows and columns in the units of the estimates.
Json covariance_json(const StudyResult& result) {
  const auto& estimates = result.identification.estimates;
  Json rows = Json::array();
  for (std::size_t i = 0; i < estimates.size(); ++i) {
    Json row = Json::array();
    for (std::size_t k = 0; k < estimates.size(); ++k) {
      if (!estimates[i].value || !estimates[k].value) {
        row.push_back(nullptr);
        continue;
      }
      const double value = result.identification.covariance(static_cast<Eigen::Index>(i),
                                                            static_cast<Eigen::Index>(k));
      row.push_back(shown(shown(value, estimates[i].angular), estimates[k].angular));
    }
    rows.push_back(std::move(row));
  }
  return rows;
}

Json observability_json(const StudyResult& result) {
  const auto& o = result.identification.observability;
  Json json{{"unknowns", o.unknowns}, {"rank", o.rank}, {"singular_values", o.singular_values}};
  json["condition"] = o.condition_columns ? Json(*o.condition_columns) : Json(nullptr);
  json["null_space"] = Json::array();
  for (const auto& direction : o.null_space) json["null_space"].push_back(direction.text);
  json["estimable"] = Json::array();
  for (const auto& c : o.estimable) json["estimable"].push_back(c.text);
  if (result.remedy) json["separating_patterns"] = result.remedy->patterns;
  return json;
}

Json combinations_json(const StudyResult& result) {
  Json list = Json::array();
  for (const auto& c : result.identification.combinations) {
    const bool angular = is_angle(c.combination, result);
    list.push_back({{"text", c.combination.text},
                    {"unit", unit_of(angular)},
                    {"value", shown(c.value, angular)},
                    {"standard_uncertainty", shown(c.standard_uncertainty, angular)},
                    {"lower", shown(c.lower, angular)},
                    {"upper", shown(c.upper, angular)}});
  }
  return list;
}

// What hangs on each pattern, by error.
Json shares_json(const StudyResult& result) {
  Json shares = Json::object();
  const auto& estimates = result.identification.estimates;
  for (std::size_t k = 0; k < estimates.size(); ++k) {
    Json own = Json::object();
    for (std::size_t g = 0; g < result.shares.groups.size(); ++g) {
      own[result.shares.groups[g]] =
          result.shares.shares(static_cast<Eigen::Index>(k), static_cast<Eigen::Index>(g));
    }
    shares[estimates[k].name] = std::move(own);
  }
  return shares;
}

Json residuals_json(const StudyResult& result) {
  Json list = Json::array();
  for (const auto& r : result.identification.residuals) {
    Json json{{"name", r.name},
              {"unit", unit_of(r.angular)},
              {"prior", r.prior},
              {"measured", shown(r.measured, r.angular)},
              {"predicted", shown(r.predicted, r.angular)},
              {"residual", shown(r.residual, r.angular)}};
    json["normalised"] = r.normalised ? Json(*r.normalised) : Json(nullptr);
    json["w"] = r.w ? Json(*r.w) : Json(nullptr);
    json["outlier"] = r.outlier;
    list.push_back(std::move(json));
  }
  return list;
}

Json recipe_json(const Recipe& recipe) {
  Json list = Json::array();
  for (const auto& step : recipe.steps) {
    list.push_back({{"step", step.step},
                    {"equation", step.equation},
                    {"quantity", step.quantity},
                    {"formula", step.formula},
                    {"value", shown(step.value, step.angular)},
                    {"unit", unit_of(step.angular)}});
  }
  return list;
}

std::string counted(std::size_t count, const char* what) {
  return fmt::format("{} {}{}", count, what, count == 1 ? "" : "s");
}

// "2 parts and 9 motion tests"
std::string sources_text(const Study& study) {
  const std::string parts = counted(study.parts.size(), "part");
  const std::string tests = counted(study.motions.size(), "motion test");
  if (study.motions.empty()) return parts;
  return study.parts.empty() ? tests : parts + " and " + tests;
}

}  // namespace

std::string identification_text(const Study& study, const StudyResult& result) {
  const auto& identification = result.identification;
  std::size_t rows = 0;
  for (const auto& r : identification.residuals) rows += r.prior ? 0 : 1;
  std::string out = fmt::format(
      "{}\n{}: {} on {}, {}\n\n", study.title.empty() ? study.file.string() : study.title,
      study.machine().title(), counted(rows, "measured characteristic"), sources_text(study),
      counted(static_cast<std::size_t>(identification.observability.unknowns), "unknown"));
  out += estimates_table(study, result);
  out += combinations_text(study, result);
  if (!identification.diagnostics.empty() || !result.left_out.empty()) out += '\n';
  if (!result.left_out.empty()) {
    out += fmt::format("note: forms and zones do not enter, since they have no derivative: {}\n",
                       joined(result.left_out));
  }
  for (const Diagnostic& d : identification.diagnostics) {
    out += fmt::format("note: {}\n", d.message);
    if (!d.hint.empty()) out += fmt::format("      {}\n", d.hint);
  }
  if (result.remedy) out += remedy_text(*result.remedy);
  out += agreement_text(result);
  out += residual_table(study, result);
  out += mountings_text(result);
  if (result.recipe) out += recipe_text(*result.recipe);
  return out;
}

std::string identification_json(const Study& study, const StudyResult& result) {
  const auto& agreement = result.identification.agreement;
  Json json;
  json["schema"] = "frustum/identification/1";
  json["version"] = program_version();
  json["title"] = study.title;
  json["machine"] = study.machine().name();
  json["complete"] = result.identification.observability.complete();
  json["answered"] = is_answered(result);
  json["estimates"] = estimates_json(study, result);
  json["covariance"] = covariance_json(result);
  json["combinations"] = combinations_json(result);
  json["information_shares"] = shares_json(result);
  json["observability"] = observability_json(result);
  json["agreement"] = {{"chi2", agreement.chi_square},
                       {"degrees_of_freedom", agreement.degrees_of_freedom},
                       {"rejected", agreement.rejected}};
  json["agreement"]["probability"] =
      agreement.probability ? Json(*agreement.probability) : Json(nullptr);
  json["agreement"]["birge"] = agreement.birge ? Json(*agreement.birge) : Json(nullptr);
  json["left_out"] = result.left_out;
  json["setup_found"] = mountings_json(result);
  json["residuals"] = residuals_json(result);
  const auto& suspect = result.identification.suspect;
  json["suspect"] = suspect ? Json(result.identification.residuals[*suspect].name) : Json(nullptr);
  if (result.recipe) {
    json["recipe"] = recipe_json(*result.recipe);
    json["recipe_corrected"] = recipe_json(*result.corrected_recipe);
  }
  json["diagnostics"] = Json::array();
  for (const Diagnostic& d : result.identification.diagnostics) {
    json["diagnostics"].push_back({{"id", d.id.text()}, {"message", d.message}, {"hint", d.hint}});
  }
  return json.dump() + '\n';
}

}  // namespace frustum::app

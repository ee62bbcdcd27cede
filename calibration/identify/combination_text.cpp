#include "calibration/identify/combination_text.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "core/units.hpp"

namespace frustum::calibration {
namespace {

const Unknown& of(const Term& term, std::span<const Unknown> unknowns) {
  return unknowns[static_cast<std::size_t>(term.unknown)];
}

bool mixed(std::span<const Term> terms, std::span<const Unknown> unknowns) {
  return std::any_of(terms.begin(), terms.end(), [&](const Term& term) {
    return of(term, unknowns).angular != of(terms.front(), unknowns).angular;
  });
}

// Coefficients as multiples of the smallest, whole where they nearly are (sensitivities carry about
// four digits).
void to_whole(std::vector<Term>& terms) {
  double smallest = std::abs(terms.front().coefficient);
  for (const Term& term : terms) smallest = std::min(smallest, std::abs(term.coefficient));
  if (terms.front().coefficient < 0.0) smallest = -smallest;
  for (Term& term : terms) {
    term.coefficient /= smallest;
    const double whole = std::round(term.coefficient);
    if (std::abs(term.coefficient - whole) < 1e-3) term.coefficient = whole;
  }
}

void divide_by_first(std::vector<Term>& terms, std::span<const Unknown> unknowns, bool angular) {
  const auto first = std::find_if(terms.begin(), terms.end(), [&](const Term& term) {
    return of(term, unknowns).angular == angular;
  });
  const double divisor = first->coefficient;
  for (Term& term : terms) term.coefficient /= divisor;
}

std::string text_of(std::span<const Term> terms, std::span<const Unknown> unknowns) {
  const bool lengths_and_angles = mixed(terms, unknowns);
  std::string text;
  for (const Term& term : terms) {
    const double size = std::abs(term.coefficient);
    const bool arm = lengths_and_angles && of(term, unknowns).angular;
    if (text.empty()) {
      if (term.coefficient < 0.0) text += '-';
    } else {
      text += term.coefficient < 0.0 ? " - " : " + ";
    }
    if (arm) {
      text += fmt::format("{:.4g} mm * ", size);
    } else if (size != 1.0) {
      text += fmt::format("{:.4g} ", size);
    }
    text += of(term, unknowns).name;
  }
  return text;
}

std::string listed(std::span<const Term> terms, std::span<const Unknown> unknowns) {
  std::string text;
  for (std::size_t i = 0; i < terms.size(); ++i) {
    if (i > 0) text += i + 1 == terms.size() ? " and " : ", ";
    text += of(terms[i], unknowns).name;
  }
  return text;
}

// "beta_AY by +1 urad, dy_AY by -0.178 um".
std::string change_text(std::span<const Term> terms, std::span<const Unknown> unknowns) {
  const bool scaled = mixed(terms, unknowns);
  std::string text;
  for (const Term& term : terms) {
    const Unknown& unknown = of(term, unknowns);
    // mm for one rad, written as um for one urad.
    const double size =
        scaled && !unknown.angular ? term.coefficient * kUmPerMm / kUradPerRad : term.coefficient;
    if (!text.empty()) text += ", ";
    text += fmt::format("{} by {:+.4g} {}", unknown.name, size, unknown.angular ? "urad" : "um");
  }
  return text;
}

}  // namespace

Combination readable(std::vector<Term> terms, std::span<const Unknown> unknowns) {
  if (terms.empty()) return {};
  if (mixed(terms, unknowns)) {
    divide_by_first(terms, unknowns, false);
  } else {
    to_whole(terms);
  }
  std::string text = text_of(terms, unknowns);
  return {std::move(terms), std::move(text)};
}

NullDirection unseen(std::vector<Term> terms, std::span<const Unknown> unknowns) {
  if (terms.empty()) return {};
  if (terms.size() == 1) {
    terms.front().coefficient = 1.0;
    return {terms, fmt::format("{} cannot be identified: no measurement shows it",
                               of(terms.front(), unknowns).name)};
  }
  const std::string names = listed(terms, unknowns);
  if (mixed(terms, unknowns)) {
    divide_by_first(terms, unknowns, true);
  } else {
    to_whole(terms);
  }
  if (terms.size() == 2 && !mixed(terms, unknowns)) {
    return {terms, fmt::format("{} cannot be separated: {} cannot be identified", names,
                               text_of(terms, unknowns))};
  }
  return {
      terms,
      fmt::format("{} cannot be separated: no measurement shows it when they change together, {}",
                  names, change_text(terms, unknowns))};
}

}  // namespace frustum::calibration

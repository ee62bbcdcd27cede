#include <fmt/format.h>

#include <algorithm>

#include "app/study/study_json.hpp"

namespace frustum::app {
namespace {

using report::Wording;

const studies::QuantileEstimate* at(const std::vector<studies::QuantileEstimate>& all, double p) {
  const auto found = std::ranges::find(all, p, &studies::QuantileEstimate::p);
  return found == all.end() ? nullptr : &*found;
}

// As {:.3f} writes it, in the shown unit.
std::string three_decimals(double value, const std::string& unit, const Wording& words) {
  return words.number(fmt::format("{:.3f}", words.shown(value, unit)));
}

std::string four_decimals(double value, const Wording& words) {
  return words.number(fmt::format("{:.4f}", value));
}

std::string value_at(const studies::CharacteristicResult& c,
                     const std::vector<studies::QuantileEstimate>& all, double p,
                     const Wording& words) {
  const auto* q = at(all, p);
  return q == nullptr ? "-" : three_decimals(q->value, c.unit, words);
}

std::string conform_text(const studies::CharacteristicResult& c, const Wording& words) {
  if (!c.conform) return "-";
  return words.number(fmt::format("{:.4f} ({:.4f} .. {:.4f})", c.conform->p, c.conform->ci95[0],
                                  c.conform->ci95[1]));
}

void add_characteristics(std::string& text, const studies::StudyResult& result,
                         const Wording& words) {
  std::size_t width = 14;
  for (const auto& c : result.characteristics) width = std::max(width, c.name.size());
  text += fmt::format("{:<{}} {:>5} {:>10} {:>10} {:>10} {:>10} {:>10}  {}\n",
                      words("characteristic"), width, words("unit"), "5 %", words("median"), "95 %",
                      words("max"), words("limit"), words("P(conforms), 95 % interval"));
  for (const auto& c : result.characteristics) {
    const auto& q = c.summary.quantiles;
    text += fmt::format("{:<{}} {:>5} {:>10} {:>10} {:>10} {:>10} {:>10}  {}\n", c.name, width,
                        words.unit(c.unit), value_at(c, q, 0.05, words), value_at(c, q, 0.5, words),
                        value_at(c, q, 0.95, words), three_decimals(c.summary.max, c.unit, words),
                        c.limit ? words.general(words.shown(*c.limit, c.unit)) : "-",
                        conform_text(c, words));
  }
}

void add_risks(std::string& text, const studies::StudyResult& result, const Wording& words) {
  const auto share = [&](double value) { return words.number(fmt::format("{:.5f}", value)); };
  for (const auto& c : result.characteristics) {
    for (const auto& risk : c.risks) {
      const std::string limit =
          words.number(fmt::format("{:.4g}", words.shown(risk.acceptance_limit, c.unit)));
      text +=
          words(
              "{0}, {1}: accept up to {2} {3}; accepted {4}, consumer's risk {5}, producer's "
              "risk {6}",
              c.name, risk.rule, limit, words.unit(c.unit), four_decimals(risk.risks.accept, words),
              share(risk.risks.consumer), share(risk.risks.producer)) +
          "\n";
    }
  }
}

std::string first_line(const studies::StudyResult& result, const Wording& words) {
  const std::string scheme = words.word(result.scheme), engine = words.word(result.engine.name);
  std::string text = result.samples == 1
                         ? words("{0}: 1 machine, seed {1}, {2}, engine {3}", result.title,
                                 result.seed, scheme, engine)
                         : words("{0}: {1} machines, seed {2}, {3}, engine {4}", result.title,
                                 result.samples, result.seed, scheme, engine);
  if (result.engine.name == "linear") {
    const std::string bound =
        three_decimals(result.engine.bound_um, "um", words) + " " + std::string(words.unit("um"));
    text += result.engine.controls == 1
                ? words(" (within {0} of whole trials, by 1 control)", bound)
                : words(" (within {0} of whole trials, by {1} controls)", bound,
                        result.engine.controls);
  } else if (!result.engine.reason.empty()) {
    text += words(" ({0})", result.engine.reason);
  }
  return text;
}

void add_shares(std::string& text, const studies::StudyResult& result, const Wording& words) {
  for (const auto& of : result.shares) {
    text += "\n" +
            words("shares of {0}: mean square, total index, first order", of.characteristic) + "\n";
    for (const auto& g : of.groups) {
      text += fmt::format("  {:<16} ", g.name) +
              words.number(
                  fmt::format("{:>7.4f} {:>7.4f} {:>8.4f}\n", g.mean_square, g.total, g.first));
    }
  }
  if (const auto& a = result.allocation) {
    text +=
        "\n" + words("{0} within its limit for {1} %: all errors x {2}", a->characteristic,
                     words.general(100.0 * a->probability), four_decimals(a->equal_factor, words));
    for (std::size_t g = 0; g < a->groups.size(); ++g) {
      text += fmt::format("{} {} x {}", g == 0 ? words("; or") : ",", a->groups[g],
                          words.fixed(a->factors[g], 3));
    }
    const auto cost = [&](double value) { return words.number(fmt::format("{:.4g}", value)); };
    text += words(" (cost {0}, of one factor {1})", cost(a->cost), cost(a->equal_cost)) + "\n";
  }
}

}  // namespace

std::string study_text(const studies::StudyResult& result, const Wording& words) {
  std::string text = first_line(result, words) + "\n\n";
  add_characteristics(text, result, words);
  if (result.joint) {
    text += words("all limits: {0} ({1} .. {2})", four_decimals(result.joint->p, words),
                  four_decimals(result.joint->ci95[0], words),
                  four_decimals(result.joint->ci95[1], words)) +
            "\n";
  }
  for (const auto& c : result.characteristics) {
    if (!c.exact) continue;
    text += words("{0}, exact for normal laws: mean {1}, median {2}, 95 % {3}", c.name,
                  four_decimals(words.shown(c.exact->mean, c.unit), words),
                  value_at(c, c.exact->quantiles, 0.5, words),
                  value_at(c, c.exact->quantiles, 0.95, words)) +
            "\n";
  }
  add_risks(text, result, words);
  add_shares(text, result, words);
  for (const auto& row : result.map) {
    text += words("cone {0} deg, inclined {1} deg: rms {2} {3}, errors that show: {4}",
                  words.general(row.cone_angle_deg), words.general(row.inclination_deg),
                  three_decimals(row.rms_um, "um", words), words.unit("um"), row.shown) +
            "\n";
  }
  if (!result.failed.empty()) {
    const auto& first = result.failed.front();
    text += (result.failed.size() == 1
                 ? words("1 draw failed, the first ({0}): {1}", first.draw, first.message)
                 : words("{0} draws failed, the first ({1}): {2}", result.failed.size(), first.draw,
                         first.message)) +
            "\n";
  }
  for (const std::string& what : result.not_reached) {
    text += words("not reached: {0}", what) + "\n";
  }
  return text;
}

}  // namespace frustum::app

#include <fmt/format.h>

#include <algorithm>

#include "core/counted.hpp"

#include "app/study/study_json.hpp"

namespace frustum::app {
namespace {

const studies::QuantileEstimate* at(const std::vector<studies::QuantileEstimate>& all, double p) {
  const auto found = std::ranges::find(all, p, &studies::QuantileEstimate::p);
  return found == all.end() ? nullptr : &*found;
}

std::string value_at(const std::vector<studies::QuantileEstimate>& all, double p) {
  const auto* q = at(all, p);
  return q == nullptr ? "-" : fmt::format("{:.3f}", q->value);
}

std::string conform_text(const studies::CharacteristicResult& c) {
  if (!c.conform) return "-";
  return fmt::format("{:.4f} ({:.4f} .. {:.4f})", c.conform->p, c.conform->ci95[0],
                     c.conform->ci95[1]);
}

void add_characteristics(std::string& text, const studies::StudyResult& result) {
  std::size_t width = 14;
  for (const auto& c : result.characteristics) width = std::max(width, c.name.size());
  text +=
      fmt::format("{:<{}} {:>5} {:>10} {:>10} {:>10} {:>10} {:>10}  {}\n", "characteristic", width,
                  "unit", "5 %", "median", "95 %", "max", "limit", "P(conforms), 95 % interval");
  for (const auto& c : result.characteristics) {
    const auto& q = c.summary.quantiles;
    text +=
        fmt::format("{:<{}} {:>5} {:>10} {:>10} {:>10} {:>10.3f} {:>10}  {}\n", c.name, width,
                    c.unit, value_at(q, 0.05), value_at(q, 0.5), value_at(q, 0.95), c.summary.max,
                    c.limit ? fmt::format("{:g}", *c.limit) : "-", conform_text(c));
  }
}

void add_risks(std::string& text, const studies::StudyResult& result) {
  for (const auto& c : result.characteristics) {
    for (const auto& risk : c.risks) {
      text += fmt::format(
          "{}, {}: accept up to {:.4g} {}; accepted {:.4f}, consumer's risk {:.5f}, producer's "
          "risk {:.5f}\n",
          c.name, risk.rule, risk.acceptance_limit, c.unit, risk.risks.accept, risk.risks.consumer,
          risk.risks.producer);
    }
  }
}

}  // namespace

std::string study_text(const studies::StudyResult& result) {
  std::string text = fmt::format("{}: {}, seed {}, {}, engine {}", result.title,
                                 counted(result.samples, "machine"), result.seed, result.scheme,
                                 result.engine.name);
  if (result.engine.name == "linear") {
    text += fmt::format(" (within {:.3f} um of whole trials, by {})", result.engine.bound_um,
                        counted(result.engine.controls, "control"));
  } else if (!result.engine.reason.empty()) {
    text += fmt::format(" ({})", result.engine.reason);
  }
  text += "\n\n";
  add_characteristics(text, result);
  if (result.joint) {
    text += fmt::format("all limits: {:.4f} ({:.4f} .. {:.4f})\n", result.joint->p,
                        result.joint->ci95[0], result.joint->ci95[1]);
  }
  for (const auto& c : result.characteristics) {
    if (!c.exact) continue;
    text += fmt::format("{}, exact for normal laws: mean {:.4f}, median {}, 95 % {}\n", c.name,
                        c.exact->mean, value_at(c.exact->quantiles, 0.5),
                        value_at(c.exact->quantiles, 0.95));
  }
  add_risks(text, result);
  for (const auto& of : result.shares) {
    text +=
        fmt::format("\nshares of {}: mean square, total index, first order\n", of.characteristic);
    for (const auto& g : of.groups) {
      text += fmt::format("  {:<16} {:>7.4f} {:>7.4f} {:>8.4f}\n", g.name, g.mean_square, g.total,
                          g.first);
    }
  }
  if (const auto& a = result.allocation) {
    text += fmt::format("\n{} within its limit for {:g} %: all errors x {:.4f}", a->characteristic,
                        100.0 * a->probability, a->equal_factor);
    for (std::size_t g = 0; g < a->groups.size(); ++g) {
      text += fmt::format("{} {} x {:.3f}", g == 0 ? "; or" : ",", a->groups[g], a->factors[g]);
    }
    text += fmt::format(" (cost {:.4g}, of one factor {:.4g})\n", a->cost, a->equal_cost);
  }
  for (const auto& row : result.map) {
    text += fmt::format("cone {:g} deg, inclined {:g} deg: rms {:.3f} um, errors that show: {}\n",
                        row.cone_angle_deg, row.inclination_deg, row.rms_um, row.shown);
  }
  if (!result.failed.empty()) {
    text += fmt::format("{} failed, the first ({}): {}\n", counted(result.failed.size(), "draw"),
                        result.failed.front().draw, result.failed.front().message);
  }
  for (const std::string& what : result.not_reached) text += "not reached: " + what + "\n";
  return text;
}

}  // namespace frustum::app

#include "app/motion/circle_report.hpp"

#include <fmt/format.h>

#include "app/view/text_table.hpp"
#include "core/decimal.hpp"
#include "instruments/circle_evaluation.hpp"

namespace frustum::app {
namespace {

using instruments::CircleTrace;
using instruments::CircleValues;
using instruments::Contribution;
using instruments::kSignatureTerms;
using instruments::RunValues;
using instruments::Signature;
using instruments::SignatureTerm;

double unit_of(SignatureTerm term) {
  return term == SignatureTerm::square ? kUradPerRad : kUmPerMm;
}

// "square_urad" is a value, "square" what it makes.
std::string contribution_name(const Contribution& contribution) {
  if (!contribution.term) return "residual";
  if (*contribution.term == SignatureTerm::square) return "square";
  return std::string(text_of(*contribution.term).name);
}

Document values_of(const CircleValues& v) {
  Document doc;
  const auto um = [&](const std::string& name, const std::optional<double>& mm) {
    doc[name] = mm ? std::optional(*mm * kUmPerMm) : std::nullopt;
  };
  const auto of = [&](const std::optional<RunValues>& run, double RunValues::*member) {
    return run ? std::optional(*run.*member) : std::nullopt;
  };
  um("G_ccw_ls", of(v.ccw, &RunValues::g_least_squares));
  um("G_cw_ls", of(v.cw, &RunValues::g_least_squares));
  um("G_bi_ls", v.g_bi_least_squares);
  um("G_ccw_mz", of(v.ccw, &RunValues::g_minimum_zone));
  um("G_cw_mz", of(v.cw, &RunValues::g_minimum_zone));
  um("G_bi_mz", v.g_bi_minimum_zone);
  um("D_mean_radial", v.d_mean_radial);
  doc["centre_bi"] = std::vector{v.both.x * kUmPerMm, v.both.y * kUmPerMm};
  um("F_ccw_max", of(v.ccw, &RunValues::f_max));
  um("F_ccw_min", of(v.ccw, &RunValues::f_min));
  um("F_cw_max", of(v.cw, &RunValues::f_max));
  um("F_cw_min", of(v.cw, &RunValues::f_min));
  return doc;
}

void add_signature(Document& doc, const Signature& s, const std::vector<Contribution>& ranked) {
  Document value, sd, per_um, width, share;
  for (std::size_t k = 0; k < kSignatureTerms; ++k) {
    const auto term = static_cast<SignatureTerm>(k);
    const std::string name(text_of(term).name);
    const bool told = s.both_senses || term != SignatureTerm::servo;
    const auto known = [&](double number) { return told ? std::optional(number) : std::nullopt; };
    value[name] = known(s.value[k] * unit_of(term));
    sd[name] = known(s.sd[k] * unit_of(term));
    per_um[name] = known(s.sd_per_noise[k] * unit_of(term) / kUmPerMm);
  }
  for (const Contribution& each : ranked) {
    width[contribution_name(each)] = each.width * kUmPerMm;
    share[contribution_name(each)] = each.share;
  }
  doc["signature"] = value;
  doc["signature_sd"] = sd;
  doc["signature_sd_per_um"] = per_um;
  doc["contribution_um"] = width;
  doc["contribution_share"] = share;
  doc["residual_rms"] = s.residual_rms * kUmPerMm;
}

std::string values_text(const CircleValues& v) {
  TextTable table({"um", "G least squares", "G minimum zone", "F largest", "F smallest"});
  const auto number = [](double mm) { return fixed_decimal(mm * kUmPerMm, 3); };
  for (const auto* run : {&v.ccw, &v.cw}) {
    if (!*run) continue;
    const RunValues& r = **run;
    table.row({std::string(name_of(r.sense)), number(r.g_least_squares), number(r.g_minimum_zone),
               number(r.f_max), number(r.f_min)});
  }
  table.row({"both", number(v.g_bi_least_squares), number(v.g_bi_minimum_zone)});
  return table.text() + fmt::format("mean radial deviation D {} um, centre {}, {} um\n",
                                    number(v.d_mean_radial), number(v.both.x), number(v.both.y));
}

std::string signature_text(const Signature& s, const std::vector<Contribution>& ranked,
                           instruments::Plane plane) {
  TextTable table({"term", "value", "sd", "unit"});
  const auto [first, second] = axes_of(plane);
  for (std::size_t k = 0; k < kSignatureTerms; ++k) {
    const auto term = static_cast<SignatureTerm>(k);
    if (term == SignatureTerm::servo && !s.both_senses) continue;
    std::string name(text_of(term).name);
    if (term == SignatureTerm::square) name = "square";
    if (term == SignatureTerm::backlash_1) name = fmt::format("backlash {}", to_char(first));
    if (term == SignatureTerm::backlash_2) name = fmt::format("backlash {}", to_char(second));
    table.row({fmt::format("{}: {}", name, text_of(term).cause),
               fixed_decimal(s.value[k] * unit_of(term), 3),
               fixed_decimal(s.sd[k] * unit_of(term), 3),
               term == SignatureTerm::square ? "urad" : "um"});
  }
  std::string text = "\n" + table.text() + "\n";
  TextTable order({"contribution", "um alone", "share"});
  for (const Contribution& each : ranked) {
    order.row({contribution_name(each), fixed_decimal(each.width * kUmPerMm, 3),
               fmt::format("{:.1f} %", 100.0 * each.share)});
  }
  text += order.text();
  text += "Contributions are G of each term alone; their sum exceeds G where terms cancel.\n";
  if (!s.both_senses) {
    text += "One direction alone does not tell servo mismatch from squareness.\n";
  }
  return text;
}

void warn(MotionAnswer& answer, const Diagnostics& problems) {
  for (const Diagnostic& each : problems) {
    answer.warnings.push_back(warning(each.id, "no evaluation: " + each.message, each.hint));
  }
}

}  // namespace

void add_circle_evaluation(MotionAnswer& answer, const std::vector<CircleTrace>& traces,
                           double length, instruments::Plane plane) {
  answer.document["evaluation"] = {};
  const auto values = instruments::circle_values(traces);
  if (!values) return warn(answer, values.error());
  Document doc = values_of(*values);
  answer.text += values_text(*values);
  if (const auto found = instruments::signature(traces, length)) {
    const auto ranked = instruments::contributions(traces, *found, length);
    add_signature(doc, *found, ranked);
    answer.text += signature_text(*found, ranked, plane);
  } else {
    warn(answer, found.error());
    doc["signature"] = {};
  }
  answer.document["evaluation"] = doc;
}

}  // namespace frustum::app

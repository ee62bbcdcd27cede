#include "app/motion/circle_report.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "app/view/text_table.hpp"
#include "core/decimal.hpp"
#include "instruments/circle_evaluation.hpp"
#include "instruments/reversal_spikes.hpp"

namespace frustum::app {
namespace {

using instruments::CircleTrace;
using instruments::CircleValues;
using instruments::Contribution;
using instruments::kSignatureTerms;
using instruments::RunValues;
using instruments::Signature;
using instruments::SignatureTerm;
using report::Wording;

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
  if (!s.both_senses) width["servo"] = share["servo"] = std::optional<double>();
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

// The same rows on a terminal and on the page.
report::MotionTable values_table(const CircleValues& v, const Wording& words) {
  const auto um_text = [&](double mm) { return shown_um(mm, words); };
  report::MotionTable table{
      .heading = words("Values"),
      .columns = {std::string(words.unit("um")), ">" + words("G least squares"),
                  ">" + words("G minimum zone"), ">" + words("F largest"),
                  ">" + words("F smallest")}};
  for (const auto* run : {&v.ccw, &v.cw}) {
    if (!*run) continue;
    const RunValues& r = **run;
    table.rows.push_back({words.word(name_of(r.sense)), um_text(r.g_least_squares),
                          um_text(r.g_minimum_zone), um_text(r.f_max), um_text(r.f_min)});
  }
  table.rows.push_back(
      {words("both"), um_text(v.g_bi_least_squares), um_text(v.g_bi_minimum_zone), "", ""});
  table.note =
      words("Mean radial deviation D {0} {3}, centre {1}, {2} {3}.", um_text(v.d_mean_radial),
            um_text(v.both.x), um_text(v.both.y), words.unit("um"));
  return table;
}

std::string term_name(SignatureTerm term, instruments::Plane plane, const Wording& words) {
  const auto [first, second] = axes_of(plane);
  if (term == SignatureTerm::square) return words("square");
  if (term == SignatureTerm::backlash_1) {
    return words("backlash {0}", std::string(1, to_char(first)));
  }
  if (term == SignatureTerm::backlash_2) {
    return words("backlash {0}", std::string(1, to_char(second)));
  }
  return words.word(text_of(term).name);
}

// A term's value or standard deviation.
std::string term_text(double value, SignatureTerm term, const Wording& words) {
  if (term != SignatureTerm::square) return shown_um(value, words);
  return words.number(fixed_decimal(value * kUradPerRad, 3));
}

report::MotionTable signature_table(const Signature& s, instruments::Plane plane,
                                    const Wording& words) {
  report::MotionTable table{.heading = words("Signature"),
                            .columns = {words("term"), ">" + words("value"), ">" + words("sd"),
                                        words("unit"), words("what looks alike")}};
  for (std::size_t k = 0; k < kSignatureTerms; ++k) {
    const auto term = static_cast<SignatureTerm>(k);
    if (term == SignatureTerm::servo && !s.both_senses) continue;
    table.rows.push_back(
        {fmt::format("{}: {}", term_name(term, plane, words), words.word(text_of(term).cause)),
         term_text(s.value[k], term, words), term_text(s.sd[k], term, words),
         term == SignatureTerm::square ? "urad" : std::string(words.unit("um")),
         words.word(text_of(term).looks_alike)});
  }
  table.note = words("Residual {0} {1} rms.", shown_um(s.residual_rms, words), words.unit("um"));
  if (!s.both_senses) {
    table.note += words(" One direction alone does not separate servo mismatch from squareness.");
  }
  return table;
}

// Without its last `dropped` columns.
std::string text_of_table(const report::MotionTable& table, std::size_t dropped = 0) {
  const auto kept = [&](std::vector<std::string> cells) {
    cells.resize(cells.size() - dropped);
    for (std::string& cell : cells) {
      if (cell.starts_with('>')) cell.erase(0, 1);
    }
    return cells;
  };
  TextTable text(kept(table.columns));
  for (const auto& row : table.rows) text.row(kept(row));
  return text.text() + table.note + "\n";
}

std::string percent_text(double share, const Wording& words) {
  return words.number(fmt::format("{:.1f} %", 100.0 * share));
}

std::vector<report::BarRow> bars_of(const std::vector<Contribution>& ranked,
                                    instruments::Plane plane, const Wording& words) {
  std::vector<report::BarRow> bars;
  for (const Contribution& each : ranked) {
    bars.push_back({each.term ? term_name(*each.term, plane, words) : words("residual"), each.share,
                    fmt::format("{} {}, {}", shown_um(each.width, words), words.symbol("um"),
                                percent_text(each.share, words))});
  }
  return bars;
}

std::string contributions_text(const std::vector<Contribution>& ranked, const Wording& words) {
  TextTable order({words("contribution"), words("{0} alone", words.unit("um")), words("share")});
  for (const Contribution& each : ranked) {
    order.row({words.word(contribution_name(each)), shown_um(each.width, words),
               percent_text(each.share, words)});
  }
  return order.text() +
         words("Contributions are G of each term alone; their sum exceeds G where terms cancel.") +
         "\n";
}

// Every few samples of a run, as they are drawn.
report::PolarRound round_of(const std::vector<double>& angle, const std::vector<double>& mm,
                            const Wording& words) {
  constexpr std::size_t kMostOnPaper = 1800;
  const std::size_t stride = std::max<std::size_t>(1, angle.size() / kMostOnPaper);
  report::PolarRound round;
  for (std::size_t i = 0; i < angle.size(); i += stride) {
    round.push_back({angle[i], words.shown(mm[i] * kUmPerMm, "um"), i > 0});
  }
  return round;
}

// The deviations from the nominal circle about the centre of both runs.
std::vector<double> about_centre(const CircleTrace& trace, std::vector<double> deviation,
                                 const instruments::PolarCircle& centre) {
  for (std::size_t i = 0; i < deviation.size(); ++i) {
    deviation[i] -= centre.x * std::cos(trace.angle[i]) + centre.y * std::sin(trace.angle[i]);
  }
  return deviation;
}

// Against the position of either axis, from the centre: where cyclic errors and spikes are seen.
void draw_over_axes(MotionAnswer& answer, const std::vector<CircleTrace>& traces,
                    const instruments::PolarCircle& centre, instruments::Plane plane,
                    double length) {
  const Wording& words = answer.words;
  for (const auto letter : axes_of(plane)) {
    const bool first = letter == axes_of(plane)[0];
    report::TraceChart chart{
        .title =
            words("Deviation about the fitted centre over {0}", std::string(1, to_char(letter))),
        .along_title =
            words("{0} from the centre, {1}", std::string(1, to_char(letter)), words.symbol("mm")),
        .value_title = words("deviation, {0}", words.symbol("um"))};
    for (const CircleTrace& trace : traces) {
      std::vector<double> along;
      for (const double angle : trace.angle) {
        along.push_back(words.shown(length * (first ? std::cos(angle) : std::sin(angle)), "mm"));
      }
      chart.lines.push_back(
          {.name = words.word(name_of(trace.sense)),
           .along = std::move(along),
           .value = drawn_um(about_centre(trace, trace.deviation, centre), words)});
    }
    answer.page.charts.push_back(std::move(chart));
  }
}

void draw_traces(MotionAnswer& answer, const std::vector<CircleTrace>& traces,
                 const instruments::PolarCircle& centre, const std::optional<Signature>& fitted,
                 instruments::Plane plane, double length) {
  const Wording& words = answer.words;
  report::TraceChart chart{.title = words("Deviation about the fitted centre over the angle"),
                           .along_title = words("angle, °"),
                           .value_title = words("deviation, {0}", words.symbol("um"))};
  for (const CircleTrace& trace : traces) {
    const std::string name = words.word(name_of(trace.sense));
    const auto deviation = about_centre(trace, trace.deviation, centre);
    answer.page.polar.push_back({name, round_of(trace.angle, deviation, words)});
    chart.lines.push_back(
        {.name = name, .along = in_degrees(trace.angle), .value = drawn_um(deviation, words)});
  }
  answer.page.charts.push_back(std::move(chart));
  draw_over_axes(answer, traces, centre, plane, length);
  if (!fitted) return;
  const auto rest = residuals(traces, *fitted, length);
  for (std::size_t k = 0; k < traces.size(); ++k) {
    std::vector<double> modelled = traces[k].deviation;
    for (std::size_t i = 0; i < modelled.size(); ++i) modelled[i] -= rest[k][i];
    answer.page.polar.push_back(
        {words("{0}, fitted signature", words.word(name_of(traces[k].sense))),
         round_of(traces[k].angle, about_centre(traces[k], modelled, centre), words), true});
  }
}

// Spikes after reversals, where there are any.
void add_spikes(MotionAnswer& answer, Document& doc, const std::vector<CircleTrace>& traces,
                instruments::Plane plane, double length) {
  const auto found = instruments::reversal_spikes(traces, length);
  if (!found) return;
  Document spikes;
  const Wording& words = answer.words;
  const auto um_text = [&](double mm) { return shown_um(mm, words); };
  const std::string um(words.unit("um"));
  report::MotionTable table{
      .heading = words("Spikes after reversals"),
      .columns = {words("axis"), ">" + words("height, {0}", um), ">" + words("sd, {0}", um),
                  ">" + words("dies away over, {0}", words.unit("mm"))}};
  bool seen = false;
  for (std::size_t k = 0; k < found->axes.size(); ++k) {
    const instruments::Spike& spike = found->axes.at(k);
    const std::string axis(1, to_char(axes_of(plane)[k]));
    if (!spike.seen) {
      spikes[axis] = {};
      continue;
    }
    seen = true;
    spikes[axis] = Document{{"height_um", spike.height * kUmPerMm},
                            {"sd_um", spike.sd * kUmPerMm},
                            {"over_mm", spike.distance}};
    table.rows.push_back({axis, um_text(spike.height), um_text(spike.sd),
                          words.number(fixed_decimal(words.shown(spike.distance, "mm"), 3))});
  }
  if (seen) {
    Document value;
    for (std::size_t k = 0; k < kSignatureTerms; ++k) {
      const auto term = static_cast<SignatureTerm>(k);
      const bool known = term != SignatureTerm::servo || traces.size() > 1;
      value[text_of(term).name] =
          known ? std::optional(found->signature.at(k) * unit_of(term)) : std::nullopt;
    }
    spikes["signature_without"] = value;
    table.note = words(
        "Height: how far the axis lags just after it has turned back; it dies away as exp(-travel "
        "/ distance). Without spikes the backlash is {0} and {1} {3}; {2} {3} rms is left.",
        um_text(found->signature.at(static_cast<std::size_t>(SignatureTerm::backlash_1))),
        um_text(found->signature.at(static_cast<std::size_t>(SignatureTerm::backlash_2))),
        um_text(found->residual_rms), um);
    answer.page.tables.push_back(table);
    answer.text += "\n" + table.heading + "\n" + text_of_table(table);
  }
  spikes["residual_rms"] = found->residual_rms * kUmPerMm;
  doc["spikes"] = spikes;
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
  answer.page.tables.push_back(values_table(*values, answer.words));
  answer.text += text_of_table(answer.page.tables.back());
  const auto found = instruments::signature(traces, length);
  if (found) {
    const auto ranked = instruments::contributions(traces, *found, length);
    add_signature(doc, *found, ranked);
    answer.page.tables.push_back(signature_table(*found, plane, answer.words));
    answer.page.contributions = bars_of(ranked, plane, answer.words);
    answer.text += "\n" + text_of_table(answer.page.tables.back(), 1) + "\n" +
                   contributions_text(ranked, answer.words);
    add_spikes(answer, doc, traces, plane, length);
  } else {
    warn(answer, found.error());
    doc["signature"] = {};
  }
  draw_traces(answer, traces, values->both, found ? std::optional(*found) : std::nullopt, plane,
              length);
  answer.document["evaluation"] = doc;
}

std::string circle_csv(const std::vector<CircleTrace>& traces, instruments::Plane plane,
                       double length) {
  std::string csv = fmt::format("# plane {}\n# radius {}\nrun,angle_deg,radial_um\n",
                                name_of(plane), shortest_decimal(length));
  for (const CircleTrace& trace : traces) {
    const bool falls = trace.sense == instruments::Sense::cw;
    for (std::size_t k = 0; k < trace.angle.size(); ++k) {
      const std::size_t i = falls ? trace.angle.size() - 1 - k : k;
      csv += fmt::format("{},{},{}\n", name_of(trace.sense),
                         shortest_decimal(trace.angle[i] * kDegPerRad),
                         shortest_decimal(trace.deviation[i] * kUmPerMm));
    }
  }
  return csv;
}

}  // namespace frustum::app

#include "app/study/study_report.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

#include "app/study/sampler.hpp"
#include "report/page/study_page.hpp"
#include "studies/statistics/conformity_risk.hpp"
#include "studies/statistics/order_statistics.hpp"

namespace frustum::app {
namespace {

using report::StudyPage;
using report::Wording;
using studies::StudyResult;

// More points than these nobody tells apart on a page.
constexpr std::size_t kDistributionPoints = 400;
constexpr std::size_t kScatterPoints = 1500;

std::string number(double value, const Wording& words) {
  return words.number(fmt::format("{:.4g}", value));
}

std::string proportion(const studies::Proportion& p, const Wording& words) {
  return words.number(fmt::format("{:.2f} % ({:.2f} .. {:.2f})", 100.0 * p.p, 100.0 * p.ci95[0],
                                  100.0 * p.ci95[1]));
}

// Numbers in the shown unit of one characteristic; without a unit as they are.
struct Numbers {
  const Wording& words;
  std::string unit{};

  [[nodiscard]] std::string operator()(double value) const {
    return number(words.shown(value, unit), words);
  }
  [[nodiscard]] std::string operator()(const studies::Interval& ci) const {
    if (!ci.lo || !ci.hi) return "";
    return fmt::format(" ({} .. {})", (*this)(*ci.lo), (*this)(*ci.hi));
  }
};

const studies::QuantileEstimate* at(const studies::Summary& summary, double p) {
  const auto found = std::ranges::find(summary.quantiles, p, &studies::QuantileEstimate::p);
  return found == summary.quantiles.end() ? nullptr : &*found;
}

std::vector<double> limits_of(const studies::CharacteristicResult& c) {
  if (!c.limit) return {};
  return c.both_sides ? std::vector{-*c.limit, *c.limit} : std::vector{*c.limit};
}

report::DistributionLine distribution_of(std::vector<double> values,
                                         const studies::CharacteristicResult& c) {
  report::DistributionLine line;
  studies::sort_values(values);
  const std::size_t n = values.size(), points = std::min(n, kDistributionPoints);
  for (std::size_t i = 0; i < points; ++i) {
    const std::size_t k = points < 2 ? 0 : i * (n - 1) / (points - 1);
    line.value.push_back(values[k]);
    line.p.push_back(static_cast<double>(k + 1) / static_cast<double>(n));
  }
  line.half_width = studies::dkw_half_width(n);
  line.limits = limits_of(c);
  return line;
}

report::RiskCurve risk_of(const std::vector<double>& values, double u,
                          const studies::CharacteristicResult& c) {
  report::RiskCurve curve;
  constexpr int kSteps = 16;
  for (int i = -kSteps / 2; i <= kSteps; ++i) {
    const double guard = i * 1.5 / kSteps;
    const double limit = *c.limit - guard * 2.0 * u;
    if (!(limit > 0.0)) continue;
    const auto risks = studies::risks_of_sample(values, u, studies::within(*c.limit, c.both_sides),
                                                studies::within(limit, c.both_sides));
    curve.guard.push_back(guard);
    curve.consumer.push_back(risks.consumer);
    curve.producer.push_back(risks.producer);
  }
  return curve;
}

void add_characteristic(StudyPage& page, const StudyFile& study, const StudyModel& model,
                        std::size_t index, const studies::CharacteristicResult& c,
                        const std::vector<double>& values, const Wording& words) {
  report::StudyPageCharacteristic shown{.name = c.name, .unit = c.unit};
  const auto *low = at(c.summary, 0.05), *q1 = at(c.summary, 0.25), *median = at(c.summary, 0.5),
             *q3 = at(c.summary, 0.75), *high = at(c.summary, 0.95);
  if (low == nullptr || q1 == nullptr || median == nullptr || q3 == nullptr || high == nullptr) {
    return;
  }
  shown.box = {c.name,    c.summary.min, q1->value,   median->value,
               q3->value, c.summary.max, limits_of(c)};
  const Numbers text{words, c.unit};
  shown.row = {text(low->value), text(median->value) + text(median->ci95), text(high->value),
               c.limit ? (c.both_sides ? "±" : "") + text(*c.limit) : "",
               c.conform ? proportion(*c.conform, words) : ""};
  shown.distribution = distribution_of(values, c);
  const double u = study.measurement.u && !study.characteristics[index].angular
                       ? *study.measurement.u
                       : model.measuring_uncertainty(index);
  if (!study.questions.rules.empty() && c.limit && u > 0.0) {
    // A curve of seventeen integrals: some thousands of machines are enough for a picture.
    constexpr std::size_t kRiskDraws = 20'000;
    const std::vector<double> some(
        values.begin(),
        values.begin() + static_cast<std::ptrdiff_t>(std::min(values.size(), kRiskDraws)));
    shown.risk = risk_of(some, u, c);
  }
  page.characteristics.push_back(std::move(shown));
}

report::ScatterSeries series_of(const studies::CharacteristicResult& c,
                                const std::vector<double>& values, const Wording& words) {
  report::ScatterSeries series{
      c.name + ", " + words.symbol(c.unit),
      {values.begin(),
       values.begin() + static_cast<std::ptrdiff_t>(std::min(values.size(), kScatterPoints))},
      limits_of(c)};
  for (auto* all : {&series.values, &series.limits}) {
    for (double& each : *all) each = words.shown(each, c.unit);
  }
  return series;
}

std::optional<std::array<report::ScatterSeries, 2>> scatter_of(const StudyResult& result,
                                                               const SampleColumns& samples,
                                                               const Wording& words) {
  std::vector<report::ScatterSeries> series;
  for (const auto& c : result.characteristics) {
    const auto* values = samples.find(kCharacteristics + c.name);
    if (values == nullptr || values->empty() || series.size() == 2) continue;
    // Of one unit two forms of one surface say the same: an angle beside a form says more.
    const bool is_second = series.size() == 1;
    if (is_second && c.unit == result.characteristics.front().unit &&
        std::ranges::any_of(result.characteristics, [&](const auto& other) {
          return other.unit != result.characteristics.front().unit;
        })) {
      continue;
    }
    series.push_back(series_of(c, *values, words));
  }
  if (series.size() < 2) return std::nullopt;
  return {{series[0], series[1]}};
}

// What every machine makes, runs or is asked for.
std::array<std::string, 2> made_of(const StudyFile& study, const Wording& words) {
  if (study.job) return {words("Job"), study.job->piece.title};
  if (study.motion) return {words("Motion test"), study.motion->file.filename().string()};
  const std::string& axes = study.volumetric->axes;
  return {words("One pose"), axes.empty() ? words("home") : axes};
}

void add_facts(StudyPage& page, const StudyFile& study, const StudyResult& result,
               const Wording& words) {
  std::string engine = words.word(result.engine.name);
  if (result.engine.name == "linear") {
    const std::string bound =
        words.fixed(words.shown(result.engine.bound_um, "um"), 3) + " " + words.symbol("um");
    engine += words(", within {0} of whole trials (by {1} controls, statistically)", bound,
                    result.engine.controls);
  } else if (!result.engine.reason.empty()) {
    engine = words("{0}: {1}", engine, result.engine.reason);
  }
  page.facts = {
      {words("Machine"), study.machine().name()},
      {words("Machines drawn"), fmt::format("{}", result.samples)},
      {words("Seed and scheme"), fmt::format("{}, {}", result.seed, words.word(result.scheme))},
      {words("Engine"), engine},
      made_of(study, words)};
  if (!result.failed.empty()) {
    const auto& first = result.failed.front();
    page.remarks.push_back(
        result.failed.size() == 1
            ? words("1 draw failed, counted as not conforming; the first, {0}: {1}", first.draw,
                    first.message)
            : words("{0} draws failed, counted as not conforming; the first, {1}: {2}",
                    result.failed.size(), first.draw, first.message));
  }
  for (const std::string& what : result.not_reached) {
    page.remarks.push_back(words("Not reached: {0}", what));
  }
  if (result.joint) page.all_conform = proportion(*result.joint, words);
}

void add_shares(StudyPage& page, const StudyResult& result, const Wording& words) {
  if (!result.shares.empty()) {
    const studies::SharesResult& of = result.shares.front();
    page.share_characteristic = of.characteristic;
    constexpr std::size_t kMostRows = 24;
    for (const auto& group : of.groups) {
      if (page.shares.size() == kMostRows) break;
      page.shares.push_back({group.name, group.mean_square, group.total});
    }
  }
  if (const auto& a = result.allocation) {
    for (std::size_t g = 0; g < a->groups.size(); ++g) {
      page.allocation.push_back({a->groups[g], words.fixed(a->factors[g], 3)});
    }
    page.allocation_text = words(
        "So that {0} % of the parts keep {1}: cost {2}. One factor for all errors would be {3}, at "
        "a cost of {4}.",
        words.general(100.0 * a->probability), a->characteristic, number(a->cost, words),
        words.number(fmt::format("{:.4f}", a->equal_factor)) + Numbers{words}(a->equal_factor_ci95),
        number(a->equal_cost, words));
  }
}

// Of each quantity one map a place of the part, all in the same shades: inclination along, cone
// angle down.
std::vector<report::HeatMap> maps_of(const StudyResult& result, const Wording& words) {
  std::vector<report::HeatMap> maps;
  const auto place = [&](const studies::MapRow& row) {
    const auto mm = [&](double value) { return words.general(words.shown(value, "mm")); };
    const char* const between = words.decimal_sign() == ',' ? "; " : ", ";
    return mm(row.center_mm[0]) + between + mm(row.center_mm[1]) + between + mm(row.center_mm[2]) +
           " " + words.symbol("mm");
  };
  const auto names = [&](const std::vector<double>& angles) {
    std::vector<std::string> texts;
    for (const double angle : angles) texts.push_back(words.general(angle) + "°");
    return texts;
  };
  std::vector<double> cones, inclinations;
  std::vector<std::string> places;
  for (const studies::MapRow& row : result.map) {
    if (std::ranges::find(cones, row.cone_angle_deg) == cones.end())
      cones.push_back(row.cone_angle_deg);
    if (std::ranges::find(inclinations, row.inclination_deg) == inclinations.end())
      inclinations.push_back(row.inclination_deg);
    if (std::ranges::find(places, place(row)) == places.end()) places.push_back(place(row));
  }
  const auto map_at = [&](const std::string& title, const std::string& at_place, auto value) {
    report::HeatMap map{words("{0}, part at {1}", title, at_place),
                        words("cone half angle"),
                        words("inclination"),
                        names(cones),
                        names(inclinations),
                        {}};
    for (const double cone : cones) {
      for (const double inclination : inclinations) {
        std::optional<double> found;
        for (const studies::MapRow& row : result.map) {
          if (row.cone_angle_deg == cone && row.inclination_deg == inclination &&
              place(row) == at_place) {
            found = value(row);
          }
        }
        map.values.push_back(found);
      }
    }
    return map;
  };
  const auto add = [&](const std::string& title, auto value) {
    const std::size_t first = maps.size();
    std::optional<std::array<double, 2>> shades;
    for (const std::string& at_place : places) {
      maps.push_back(map_at(title, at_place, value));
      const auto range = report::range_of(maps.back());
      if (!range) continue;
      if (!shades) shades = range;
      shades = {std::min((*shades)[0], (*range)[0]), std::max((*shades)[1], (*range)[1])};
    }
    for (std::size_t i = first; i < maps.size(); ++i) maps[i].shades = shades;
  };
  add(words("Signal, rms {0}", words.symbol("um")),
      [&](const studies::MapRow& row) { return words.shown(row.rms_um, "um"); });
  add(words("Errors that show"), [](const studies::MapRow& row) { return double(row.shown); });
  add(words("Directions"), [](const studies::MapRow& row) { return row.directions; });
  return maps;
}

}  // namespace

std::string study_report(const StudyFile& study, const StudyModel& model, const StudyResult& result,
                         const SampleColumns& samples, const Wording& words) {
  StudyPage page{.style = words.style(), .title = result.title};
  add_facts(page, study, result, words);
  for (std::size_t i = 0; i < result.characteristics.size(); ++i) {
    const auto& c = result.characteristics[i];
    const auto* values = samples.find(kCharacteristics + c.name);
    if (values != nullptr && !values->empty()) {
      add_characteristic(page, study, model, i, c, *values, words);
    }
  }
  page.scatter = scatter_of(result, samples, Wording());
  page.shown_scatter = scatter_of(result, samples, words);
  add_shares(page, result, words);
  page.maps = maps_of(result, Wording());
  page.shown_maps = maps_of(result, words);
  return report::study_html(page);
}

}  // namespace frustum::app

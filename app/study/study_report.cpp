#include "app/study/study_report.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "app/study/sampler.hpp"
#include "core/counted.hpp"
#include "report/number_text.hpp"
#include "report/page/study_page.hpp"
#include "studies/statistics/conformity_risk.hpp"
#include "studies/statistics/order_statistics.hpp"

namespace frustum::app {
namespace {

using report::StudyPage;
using studies::StudyResult;

// More points than these nobody tells apart on a page.
constexpr std::size_t kDistributionPoints = 400;
constexpr std::size_t kScatterPoints = 1500;

std::string number(double value) { return fmt::format("{:.4g}", value); }

std::string interval(const studies::Interval& ci) {
  if (!ci.lo || !ci.hi) return "";
  return fmt::format(" ({} .. {})", number(*ci.lo), number(*ci.hi));
}

std::string proportion(const studies::Proportion& p) {
  return fmt::format("{:.2f} % ({:.2f} .. {:.2f})", 100.0 * p.p, 100.0 * p.ci95[0],
                     100.0 * p.ci95[1]);
}

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
                        const std::vector<double>& values) {
  report::StudyPageCharacteristic shown{.name = c.name, .unit = c.unit};
  const auto *low = at(c.summary, 0.05), *q1 = at(c.summary, 0.25), *median = at(c.summary, 0.5),
             *q3 = at(c.summary, 0.75), *high = at(c.summary, 0.95);
  if (low == nullptr || q1 == nullptr || median == nullptr || q3 == nullptr || high == nullptr) {
    return;
  }
  shown.box = {c.name,    c.summary.min, q1->value,   median->value,
               q3->value, c.summary.max, limits_of(c)};
  shown.row = {number(low->value), number(median->value) + interval(median->ci95),
               number(high->value), c.limit ? (c.both_sides ? "±" : "") + number(*c.limit) : "",
               c.conform ? proportion(*c.conform) : ""};
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
                                const std::vector<double>& values) {
  return {c.name + ", " + report::unit_symbol(c.unit),
          {values.begin(),
           values.begin() + static_cast<std::ptrdiff_t>(std::min(values.size(), kScatterPoints))},
          limits_of(c)};
}

void add_scatter(StudyPage& page, const StudyResult& result, const SampleColumns& samples) {
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
    series.push_back(series_of(c, *values));
  }
  if (series.size() == 2) page.scatter = {series[0], series[1]};
}

// What every machine makes, runs or is asked for.
std::array<std::string, 2> made_of(const StudyFile& study) {
  if (study.job) return {"Job", study.job->piece.title};
  if (study.motion) return {"Motion test", study.motion->file.filename().string()};
  const std::string& axes = study.volumetric->axes;
  return {"One pose", axes.empty() ? "home" : axes};
}

void add_facts(StudyPage& page, const StudyFile& study, const StudyResult& result) {
  std::string engine = result.engine.name;
  if (result.engine.name == "linear") {
    engine += fmt::format(", within {:.3f} µm of whole trials (by {} controls, statistically)",
                          result.engine.bound_um, result.engine.controls);
  } else if (!result.engine.reason.empty()) {
    engine += ": " + result.engine.reason;
  }
  page.facts = {{"Machine", study.machine().name()},
                {"Machines drawn", fmt::format("{}", result.samples)},
                {"Seed and scheme", fmt::format("{}, {}", result.seed, result.scheme)},
                {"Engine", engine},
                made_of(study)};
  if (!result.failed.empty()) {
    page.remarks.push_back(
        fmt::format("{} failed, counted as not conforming; the "
                    "first, {}: {}",
                    counted(result.failed.size(), "draw"), result.failed.front().draw,
                    result.failed.front().message));
  }
  for (const std::string& what : result.not_reached) page.remarks.push_back("Not reached: " + what);
  if (result.joint) page.all_conform = proportion(*result.joint);
}

void add_shares(StudyPage& page, const StudyResult& result) {
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
      page.allocation.push_back({a->groups[g], fmt::format("{:.3f}", a->factors[g])});
    }
    page.allocation_text = fmt::format(
        "So that {:g} % of the parts keep {}: cost {:.4g}. One factor for all errors would be "
        "{:.4f}{}, at a cost of {:.4g}.",
        100.0 * a->probability, a->characteristic, a->cost, a->equal_factor,
        interval(a->equal_factor_ci95), a->equal_cost);
  }
}

// Of each quantity one map a place of the part, all in the same shades: inclination along, cone
// angle down.
void add_maps(StudyPage& page, const StudyResult& result) {
  const auto place = [](const studies::MapRow& row) {
    return fmt::format("{:g}, {:g}, {:g} mm", row.center_mm[0], row.center_mm[1], row.center_mm[2]);
  };
  const auto names = [](const std::vector<double>& angles) {
    std::vector<std::string> texts;
    for (const double angle : angles) texts.push_back(fmt::format("{:g}°", angle));
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
    report::HeatMap map{title + ", part at " + at_place,
                        "cone half angle",
                        "inclination",
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
    const std::size_t first = page.maps.size();
    std::optional<std::array<double, 2>> shades;
    for (const std::string& at_place : places) {
      page.maps.push_back(map_at(title, at_place, value));
      const auto range = report::range_of(page.maps.back());
      if (!range) continue;
      if (!shades) shades = range;
      shades = {std::min((*shades)[0], (*range)[0]), std::max((*shades)[1], (*range)[1])};
    }
    for (std::size_t i = first; i < page.maps.size(); ++i) page.maps[i].shades = shades;
  };
  add("Signal, rms µm", [](const studies::MapRow& row) { return row.rms_um; });
  add("Errors that show", [](const studies::MapRow& row) { return double(row.shown); });
  add("Directions", [](const studies::MapRow& row) { return row.directions; });
}

}  // namespace

std::string study_report(const StudyFile& study, const StudyModel& model, const StudyResult& result,
                         const SampleColumns& samples) {
  StudyPage page;
  page.title = result.title;
  add_facts(page, study, result);
  for (std::size_t i = 0; i < result.characteristics.size(); ++i) {
    const auto& c = result.characteristics[i];
    const auto* values = samples.find(kCharacteristics + c.name);
    if (values != nullptr && !values->empty()) {
      add_characteristic(page, study, model, i, c, *values);
    }
  }
  add_scatter(page, result, samples);
  add_shares(page, result);
  add_maps(page, result);
  return report::study_html(page);
}

}  // namespace frustum::app

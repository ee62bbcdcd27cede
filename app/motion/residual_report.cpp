#include "app/motion/residual_report.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <numeric>
#include <optional>

#include "calibration/identify/reading_check.hpp"
#include "core/decimal.hpp"
#include "instruments/ball_maps.hpp"
#include "instruments/table_maps.hpp"

namespace frustum::app {
namespace {

using calibration::ReadingCheck;
using instruments::TouchPlan;
using PlaceName = std::function<std::string(std::size_t)>;

using report::Wording;

// Of messages, in um always.
std::string um_text(double mm, const Wording& words = Wording()) {
  return words.number(fmt::format("{:.4g}", words.shown(mm * kUmPerMm, "um"))) + " " +
         std::string(words.unit("um"));
}

std::vector<double> um_list(const Eigen::VectorXd& mm) {
  return in_um(std::vector<double>(mm.begin(), mm.end()));
}

// Names of readings and of what is wrong together.
struct ReadingNames {
  std::string readings{};  // "touches"
  PlaceName reading{};
  PlaceName group{};
  PlaceName shown{};  // a reading as page and text name it
  bool of_touches = true;
};

std::string probability_text(double probability, const Wording& words) {
  return words.number(fmt::format("{:.2g}", probability));
}

std::string spread_text(const ReadingCheck& check, const Wording& words = Wording()) {
  std::string text = words("{0} rms", um_text(check.rms, words));
  if (check.expected_rms) {
    text += words(" where their noise makes {0} (probability {1})",
                  um_text(*check.expected_rms, words), probability_text(*check.probability, words));
  }
  return text;
}

std::vector<std::string> suspects_of(const ReadingCheck& check, const ReadingNames& names) {
  std::vector<std::string> all;
  for (const std::size_t group : check.suspects) all.push_back(names.group(group));
  return all;
}

std::optional<Diagnostic> disagreement(const ReadingCheck& check, const ReadingNames& names) {
  if (check.consistent) return std::nullopt;
  if (check.suspects.empty()) {
    return warning("readings-disagree"_id,
                   fmt::format("the {} do not agree: what the errors of A and C do not explain is "
                               "{}, {} at {}",
                               names.readings, spread_text(check),
                               um_text(check.residuals[static_cast<Eigen::Index>(check.largest)]),
                               names.reading(check.largest)),
                   "calibrate the linear axes first, look for an artefact that has moved, and for "
                   "readings with another's name");
  }
  const std::size_t count = check.suspects.size();
  return warning("reading-suspect"_id,
                 fmt::format("{}{} off by {} against all others: without it they agree to {} rms",
                             fmt::join(suspects_of(check, names), ", or "),
                             count > 1 ? ": one of them is" : " is", um_text(check.excess.norm()),
                             um_text(check.rms_without)),
                 "measure there again: as it is it goes into the maps");
}

// As point_text, in the wording of page and text.
std::string shown_point(std::size_t point, const Wording& words) {
  const std::array<std::string, 5> faces{"+X", "-X", "+Y", "-Y", words("top")};
  return words("point {0} ({1} of column {2})", point, faces.at(point % faces.size()),
               point / faces.size() + 1);
}

// Points all of whose touches nothing checks.
std::vector<std::size_t> unchecked_points(const TouchPlan& plan, const ReadingCheck& check) {
  constexpr double kUnchecked = 1e-6;
  std::array<bool, instruments::kTouchPoints> checked{};
  for (std::size_t t = 0; t < plan.touches.size(); ++t) {
    if (check.redundancy[static_cast<Eigen::Index>(t)] > kUnchecked) {
      checked.at(plan.touches[t].point) = true;
    }
  }
  std::vector<std::size_t> points;
  for (std::size_t k = 0; k < checked.size(); ++k) {
    if (!checked.at(k)) points.push_back(k);
  }
  return points;
}

void add_residuals(MotionAnswer& answer, const ReadingCheck& check, const ReadingNames& names,
                   const std::vector<std::string>& more_suspects) {
  const auto largest = static_cast<Eigen::Index>(check.largest);
  const double largest_sd = check.standard_deviations[largest];
  std::vector<std::string> suspects = more_suspects;
  if (suspects.empty()) suspects = suspects_of(check, names);
  const auto um = [](const std::optional<double>& mm) {
    return mm ? std::optional(*mm * kUmPerMm) : std::nullopt;
  };
  const bool noisy = check.expected_rms.has_value();
  answer.document["residuals"] = Document{
      {"rms_um", check.rms * kUmPerMm},
      {"expected_rms_um", um(check.expected_rms)},
      {"degrees_of_freedom", static_cast<std::uint64_t>(std::max(check.degrees_of_freedom, 0))},
      {"probability", check.probability},
      {"largest_um", check.residuals[largest] * kUmPerMm},
      {"largest_sd_um", noisy ? std::optional(largest_sd * kUmPerMm) : std::nullopt},
      {"largest_at", names.reading(check.largest)},
      {"consistent", check.consistent && more_suspects.empty() ? "yes" : "no"},
      {"suspects", suspects},
      {"residual_um", um_list(check.residuals)},
      {"sd_um", noisy ? um_list(check.standard_deviations) : std::vector<double>{}}};
  const Wording& words = answer.words;
  const std::string heading = names.of_touches ? words("What is left over of the touches")
                                               : words("What is left over of the R-tests");
  report::MotionTable table{
      .heading = heading,
      .columns = {words("what"), ">" + std::string(words.unit("um")), words("where")}};
  const auto number = [&](double mm) { return shown_um(mm, words); };
  table.rows.push_back({words("root mean square"), number(check.rms),
                        words("{0} degrees of freedom", check.degrees_of_freedom)});
  if (check.expected_rms) {
    table.rows.push_back({words("expected of the noise"), number(*check.expected_rms),
                          words("probability {0}", probability_text(*check.probability, words))});
  }
  const std::string where = names.shown(check.largest);
  table.rows.push_back({words("largest"), number(check.residuals[largest]), where});
  if (noisy) table.rows.push_back({words("its standard deviation"), number(largest_sd), ""});
  answer.page.tables.push_back(std::move(table));
  report::TraceLine line{.name = words("residual"), .dots = true};
  line.value = drawn_um(std::vector<double>(check.residuals.begin(), check.residuals.end()), words);
  line.along.resize(line.value.size());
  std::iota(line.along.begin(), line.along.end(), 1.0);
  answer.page.charts.push_back({.title = heading,
                                .along_title = words("reading"),
                                .value_title = words.symbol("um"),
                                .lines = {std::move(line)}});
  const std::string spread = spread_text(check, words);
  const std::string most = um_text(check.residuals[largest], words);
  answer.text +=
      "\n" +
      (names.of_touches
           ? words("left over of the touches: {0}, at most {1} at {2}", spread, most, where)
           : words("left over of the R-tests: {0}, at most {1} at {2}", spread, most, where)) +
      "\n";
}

// All readings one after the other, the balls in another order.
Eigen::VectorXd in_order(const std::vector<std::vector<Vec3>>& readings,
                         const std::vector<std::size_t>& order) {
  std::vector<double> all;
  for (const std::size_t ball : order) {
    for (const Vec3& d : readings[ball]) all.insert(all.end(), d.begin(), d.end());
  }
  return Eigen::Map<const Eigen::VectorXd>(all.data(), static_cast<Eigen::Index>(all.size()));
}

// Another order of the balls in which the readings agree far better; empty: none.
std::vector<std::size_t> better_order(const Eigen::MatrixXd& model,
                                      const std::vector<std::vector<Vec3>>& readings,
                                      const ReadingCheck& as_given,
                                      const calibration::ReadingCheckOptions& options) {
  constexpr std::size_t kMostBalls = 5;  // 120 orders
  constexpr double kNegligible = 1e-5;   // mm rms: second order of the errors themselves
  std::vector<std::size_t> best;
  if (readings.size() > kMostBalls || as_given.rms < std::max(kNegligible, options.noise)) {
    return best;
  }
  double least = as_given.sum_of_squares / calibration::kSuspect;
  std::vector<std::size_t> order(readings.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  while (std::ranges::next_permutation(order).found) {
    const double squares =
        calibration::reading_check(model, in_order(readings, order), options).sum_of_squares;
    if (squares < least) {
      least = squares;
      best = order;
    }
  }
  return best;
}

}  // namespace

void add_touch_residuals(MotionAnswer& answer, const TouchPlan& plan,
                         std::span<const double> readings, double noise) {
  const Eigen::Map<const Eigen::VectorXd> all(readings.data(),
                                              static_cast<Eigen::Index>(readings.size()));
  const ReadingCheck check = calibration::reading_check(reading_model(plan), all, {.noise = noise});
  const PlaceName place = [&plan](std::size_t t) {
    return "touch of " + place_of(plan, plan.touches[t]);
  };
  const Wording& words = answer.words;
  const PlaceName shown = [&](std::size_t t) {
    const auto& touch = plan.touches[t];
    return words("touch of {0} at {1}", shown_point(touch.point, words),
                 words.number(position_text(plan, touch.tilt, touch.turn)));
  };
  const ReadingNames names{"touches", place, place, shown, true};
  if (auto problem = disagreement(check, names)) answer.warnings.push_back(*std::move(problem));
  add_residuals(answer, check, names, {});
  std::vector<std::string> unchecked, shown_points;
  for (const std::size_t point : unchecked_points(plan, check)) {
    unchecked.push_back(instruments::point_text(point));
    shown_points.push_back(shown_point(point, words));
  }
  answer.document["unchecked"] = unchecked;
  if (unchecked.empty()) return;
  const std::string note = words(
      "Nothing checks the touches of {0}: three tops give the height and the tilts of a pose and "
      "no more, and what is touched at zero alone is compared with nothing. One that is off goes "
      "into the maps without a trace.",
      fmt::format("{}", fmt::join(shown_points, ", ")));
  answer.page.tables.back().note = note;
  answer.text += note + "\n";
}

void add_ball_residuals(MotionAnswer& answer, const TouchPlan& plan, std::span<const Vec3> balls,
                        const std::vector<std::vector<Vec3>>& readings,
                        const std::vector<std::string>& ball_names, double noise) {
  std::vector<std::size_t> as_given(balls.size());
  std::iota(as_given.begin(), as_given.end(), std::size_t{0});
  const Eigen::MatrixXd model = reading_model(plan, balls);
  const calibration::ReadingCheckOptions options{.noise = noise, .group_size = 3};
  const ReadingCheck check =
      calibration::reading_check(model, in_order(readings, as_given), options);
  const std::size_t poses = readings.front().size(), turns = plan.turns.size();
  const PlaceName group = [&, poses, turns](std::size_t g) {
    const std::size_t pose = g % poses;
    return fmt::format("ball {} ({}) at {}", g / poses + 1, ball_names[g / poses],
                       position_text(plan, pose / turns, pose % turns));
  };
  const PlaceName reading = [&](std::size_t r) {
    return fmt::format("{} of {}", "xyz"[r % 3], group(r / 3));
  };
  const Wording& words = answer.words;
  const PlaceName shown = [&, poses, turns](std::size_t r) {
    const std::size_t g = r / 3, pose = g % poses;
    const std::string ball = words("ball {0} ({1}) at {2}", g / poses + 1, ball_names[g / poses],
                                   words.number(position_text(plan, pose / turns, pose % turns)));
    return words("{0} of {1}", std::string(1, "xyz"[r % 3]), ball);
  };
  const ReadingNames names{"R-tests", reading, group, shown, false};
  const auto order = better_order(model, readings, check, options);
  std::vector<std::string> exchanged;
  for (std::size_t k = 0; k < order.size(); ++k) {
    if (order[k] != k) exchanged.push_back(fmt::format("ball {} ({})", k + 1, ball_names[k]));
  }
  if (!exchanged.empty()) {
    std::vector<std::string> files;
    for (const std::size_t k : order) files.push_back(ball_names[k]);
    answer.warnings.push_back(warning(
        "balls-exchanged"_id,
        fmt::format(
            "{} seem to be exchanged: as given {} is left over, in the order {} {}",
            fmt::join(exchanged, " and "), um_text(check.rms), fmt::join(files, " "),
            um_text(calibration::reading_check(model, in_order(readings, order), options).rms)),
        "give the files and --balls in the same order"));
  } else if (auto problem = disagreement(check, names)) {
    answer.warnings.push_back(*std::move(problem));
  }
  add_residuals(answer, check, names, exchanged);
}

}  // namespace frustum::app

#include "app/motion/drawn_test.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "app/motion/circle_dynamics.hpp"
#include "app/motion/motion_dynamics.hpp"
#include "core/constants.hpp"
#include "instruments/approach.hpp"
#include "instruments/circle_evaluation.hpp"
#include "instruments/cone_test.hpp"
#include "instruments/reach.hpp"
#include "instruments/readings.hpp"
#include "instruments/signature.hpp"
#include "instruments/turn_harmonics.hpp"

namespace frustum::app {
namespace {

using instruments::CircleTrace;
using instruments::LineTest;
using instruments::MotionTest;
using instruments::SignatureTerm;
using kinematics::GeometricErrors;
using Numbers = std::vector<double>;

// A bar during one run, and what else moves the tip in each pose.
struct BarRun {
  MotionTest test{};
  std::vector<Vec3> moved{};
};

// The values of a test under its name; those of either sign by themselves.
std::vector<TestValue> lengths_of(const std::string& test, const std::vector<std::string>& names,
                                  const std::vector<std::string>& signed_names = {}) {
  std::vector<TestValue> values;
  for (const std::string& name : names) values.push_back({.name = test + "." + name});
  for (const std::string& name : signed_names) {
    values.push_back({.name = test + "." + name, .both_sides = true});
  }
  return values;
}

double range_of(std::span<const double> numbers) {
  const auto [least, most] = std::ranges::minmax(numbers);
  return most - least;
}

Numbers flat(const std::vector<Vec3>& vectors) {
  Numbers numbers;
  for (const Vec3& v : vectors) numbers.insert(numbers.end(), v.begin(), v.end());
  return numbers;
}

Vec3 vector_at(const Numbers& numbers, std::size_t i) {
  return {numbers[3 * i], numbers[3 * i + 1], numbers[3 * i + 2]};
}

auto bar_readings_of(std::vector<BarRun> runs, const MotionSetup& setup) {
  return [runs = std::move(runs), &setup](const GeometricErrors& errors) {
    const kinematics::ForwardChain actual(setup.machine, errors, setup.tool_length);
    Numbers all;
    for (const BarRun& run : runs) {
      const Numbers of_run = instruments::bar_readings(
          actual, instruments::with_approach(run.test, errors), setup.setup, run.moved);
      all.insert(all.end(), of_run.begin(), of_run.end());
    }
    return all;
  };
}

auto beyond_stroke_of(std::vector<BarRun> runs, double stroke, std::string parameter) {
  return [runs = std::move(runs), stroke,
          parameter = std::move(parameter)](const Numbers& shown) -> std::optional<Diagnostic> {
    std::span<const double> rest = shown;
    for (const BarRun& run : runs) {
      const auto of_run = rest.first(run.test.poses.size());
      rest = rest.subspan(of_run.size());
      if (auto beyond = instruments::beyond_stroke(run.test, of_run, stroke, parameter)) {
        return beyond;
      }
    }
    return std::nullopt;
  };
}

auto line_readings_of(std::vector<LineTest> runs, std::vector<std::vector<Vec3>> moved,
                      const MotionSetup& setup) {
  return [runs = std::move(runs), moved = std::move(moved), &setup](const GeometricErrors& errors) {
    const kinematics::ForwardChain actual(setup.machine, errors, setup.tool_length);
    Numbers all;
    for (std::size_t run = 0; run < runs.size(); ++run) {
      auto seen = instruments::displacements(
          actual, instruments::with_approach(runs[run].poses, runs[run].start, errors),
          setup.setup);
      for (std::size_t i = 0; i < moved[run].size(); ++i) seen[i] += moved[run][i];
      const Numbers numbers = flat(seen);
      all.insert(all.end(), numbers.begin(), numbers.end());
    }
    return all;
  };
}

Result<Numbers> circle_numbers(const std::vector<CircleTrace>& traces, double length) {
  const auto values = circle_values(traces, instruments::MinimumZones::left_out);
  if (!values) return values.error();
  const auto terms = instruments::signature(traces, length);
  if (!terms) return terms.error();
  double largest_f = 0.0;
  for (const auto* run : {&*values->ccw, &*values->cw}) {
    largest_f = std::max({largest_f, std::abs(run->f_max), std::abs(run->f_min)});
  }
  Numbers numbers{values->ccw->g_least_squares, values->cw->g_least_squares,
                  values->g_bi_least_squares, largest_f, values->d_mean_radial};
  for (const auto term : {SignatureTerm::scale, SignatureTerm::servo, SignatureTerm::backlash_1,
                          SignatureTerm::backlash_2}) {
    numbers.push_back((*terms)[term]);
  }
  numbers = in_um(std::move(numbers));
  numbers.push_back((*terms)[SignatureTerm::square] * kUradPerRad);
  return numbers;
}

// Mean, cosine and sine: what the set-up of a bar makes, and no form of its trace has.
std::vector<Numbers> first_harmonics(const Numbers& angles, std::size_t runs) {
  std::vector<Numbers> basis(3);
  for (std::size_t run = 0; run < runs; ++run) {
    for (const double angle : angles) {
      basis[0].push_back(1.0);
      basis[1].push_back(std::cos(angle));
      basis[2].push_back(std::sin(angle));
    }
  }
  return basis;
}

class TestDrawer {
 public:
  explicit TestDrawer(const MotionSetup& setup) : setup_(setup) {}

  Result<DrawnTest> operator()(const CircleWords& words) const {
    auto circle = circle_of_words(words, setup_);
    if (!circle) return circle.error();
    const std::optional<double> feed = circle->feed;
    const auto dynamics = motion_dynamics(words, setup_, feed, circle->held);
    if (!dynamics) return dynamics.error();
    if (dynamics->is_on()) circle->feed.reset();
    std::vector<BarRun> runs;
    for (const instruments::Sense sense : instruments::kSenses) {
      circle->sense = sense;
      auto test = circle_test(setup_.machine, *circle);
      if (!test) return test.error();
      BarRun run{.test = *std::move(test)};
      if (dynamics->is_on()) {
        run.moved = circle_deviations(*dynamics->model, dynamics->method, *circle, run.test, *feed);
      }
      runs.push_back(std::move(run));
    }
    auto values = lengths_of("circle", {"G_ccw", "G_cw", "G_bi", "F"},
                             {"D", "scale", "servo", "backlash_1", "backlash_2"});
    values.push_back({.name = "circle.square", .angular = true, .both_sides = true});
    for (TestValue& value : values) value.of_form = value.name.starts_with("circle.G");
    DrawnTest drawn{.values = std::move(values),
                    .readings = bar_readings_of(runs, setup_),
                    .beyond = beyond_stroke_of(runs, words.stroke, "phi")};
    drawn.unseen_by_forms = first_harmonics(circle->angles, runs.size());
    drawn.evaluate = [angles = circle->angles,
                      length = circle->length](const Numbers& shown) -> Result<Numbers> {
      std::vector<CircleTrace> traces;
      auto next = shown.begin();
      for (const instruments::Sense sense : instruments::kSenses) {
        const auto end = next + static_cast<std::ptrdiff_t>(angles.size());
        traces.push_back({sense, angles, {next, end}});
        next = end;
      }
      return circle_numbers(traces, length);
    };
    return drawn;
  }

  Result<DrawnTest> operator()(const RotaryWords& words) const {
    const auto rotary = rotary_of_words(words, setup_);
    if (!rotary) return rotary.error();
    return turn("rotary", words, rotary_test(setup_.machine, *rotary), rotary->angles, kRadPerDeg,
                words.axis);
  }

  Result<DrawnTest> operator()(const ConeMotionWords& words) const {
    const auto cone = cone_of_words(words, setup_);
    if (!cone) return cone.error();
    return turn("cone", words, cone_test(setup_.machine, *cone), cone->angles, 1.0 / cone->radius,
                "phi");
  }

  Result<DrawnTest> operator()(const ChaseWords& words) const {
    const auto test = chase_of_words(words, setup_);
    if (!test) return test.error();
    const auto feed = feed_per_second(words);
    if (!feed) return feed.error();
    const auto moved = chase_deviations(words, setup_, *test, *feed);
    if (!moved) return moved.error();
    DrawnTest drawn{.values = lengths_of("chase", {"rms", "largest", "x", "y", "z"})};
    drawn.values.front().of_form = true;
    drawn.readings = [test = *test, moved = *moved,
                      this_setup = &setup_](const GeometricErrors& errors) {
      const kinematics::ForwardChain actual(this_setup->machine, errors, this_setup->tool_length);
      auto seen = instruments::displacements(actual, instruments::with_approach(test, errors).poses,
                                             this_setup->setup);
      for (std::size_t i = 0; i < moved.size(); ++i) seen[i] += moved[i];
      return flat(seen);
    };
    drawn.evaluate = [](const Numbers& shown) -> Result<Numbers> {
      const std::size_t poses = shown.size() / 3;
      double squares = 0.0, largest = 0.0;
      std::array<Numbers, 3> along;
      for (std::size_t i = 0; i < poses; ++i) {
        const Vec3 d = vector_at(shown, i);
        squares += d.squaredNorm();
        largest = std::max(largest, d.norm());
        for (std::size_t k = 0; k < 3; ++k) along[k].push_back(d[static_cast<Eigen::Index>(k)]);
      }
      Numbers numbers{std::sqrt(squares / static_cast<double>(poses)), largest};
      for (const Numbers& each : along) numbers.push_back(range_of(each));
      return in_um(std::move(numbers));
    };
    return drawn;
  }

  Result<DrawnTest> operator()(const LineWords& words) const {
    const auto line = line_of_words(words, setup_);
    if (!line) return line.error();
    const auto feed = feed_per_second(words);
    if (!feed) return feed.error();
    std::vector<LineTest> runs;
    std::vector<std::vector<Vec3>> moved;
    for (const LineTest* run : {&line->up, &line->down}) {
      const auto of_run = deviations_of(words, setup_, *run, *feed);
      if (!of_run) return of_run.error();
      moved.push_back(*of_run);
    }
    for (int run = 0; run < words.runs; ++run) runs.insert(runs.end(), {line->up, line->down});
    for (int run = 1; run < words.runs; ++run) moved.insert(moved.end(), {moved[0], moved[1]});
    auto values = lengths_of("line", {"A", "R", "E", "M", "B"});
    const bool straight = line->targets.size() > 2;
    for (const auto across : kinematics::kLinearAxes) {
      if (!straight || across == line->axis) continue;
      values.push_back({.name = fmt::format("line.straightness_{}", to_char(across))});
    }
    DrawnTest drawn{.values = std::move(values), .readings = line_readings_of(runs, moved, setup_)};
    drawn.evaluate = [line = *line, count = runs.size()](const Numbers& shown) -> Result<Numbers> {
      std::vector<std::vector<Vec3>> of_runs(count);
      for (std::size_t i = 0; i < shown.size() / 3; ++i) {
        of_runs[i / line.targets.size()].push_back(vector_at(shown, i));
      }
      const LineDeviations deviations = by_target(line, of_runs);
      const auto found = instruments::positioning(deviations.up, deviations.down);
      if (!found) return found.error();
      Numbers numbers{found->accuracy, found->repeatability, found->systematic, found->mean_range,
                      found->largest_reversal};
      for (const auto& [across, of] : straightness_across(line, deviations.means)) {
        numbers.push_back(of.minimum_zone);
      }
      return in_um(std::move(numbers));
    };
    return drawn;
  }

  Result<DrawnTest> operator()(const DiagonalWords& words) const {
    const auto lines = diagonals_of_words(words, setup_);
    if (!lines) return lines.error();
    const auto feed = feed_per_second(words);
    if (!feed) return feed.error();
    std::vector<LineTest> runs;
    std::vector<std::vector<Vec3>> moved;
    std::vector<std::string> names;
    for (const auto& [signs, line] : *lines) {
      const auto of_line = deviations_of(words, setup_, line, *feed);
      if (!of_line) return of_line.error();
      names.push_back(signs);
      runs.push_back(line);
      moved.push_back(*of_line);
    }
    names.insert(names.end(), {"largest", "spread"});
    DrawnTest drawn{.values = lengths_of("diagonal", names),
                    .readings = line_readings_of(runs, moved, setup_)};
    drawn.evaluate = [runs](const Numbers& shown) -> Result<Numbers> {
      Numbers numbers, ends;
      std::size_t next = 0;
      for (const LineTest& run : runs) {
        Numbers along;
        for (std::size_t i = 0; i < run.poses.size(); ++i) {
          along.push_back(vector_at(shown, next++).dot(run.direction));
        }
        numbers.push_back(range_of(along));
        ends.push_back(along.back() - along.front());
      }
      numbers.insert(numbers.end(), {std::ranges::max(numbers), range_of(ends)});
      return in_um(std::move(numbers));
    };
    return drawn;
  }

  Result<DrawnTest> operator()(const TouchWords& /*words*/) const {
    return error("touch-in-study"_id,
                 "a touch-trigger calibration has maps of errors, not values with limits",
                 "tests of a study: circle, rotary, cone, chase, line, diagonal");
  }

 private:
  // A bar on one turn.
  [[nodiscard]] Result<DrawnTest> turn(const std::string& name, const MotionWords& words,
                                       const Result<MotionTest>& test, const Numbers& angles,
                                       double per_feed, const std::string& parameter) const {
    if (!test) return test.error();
    const auto feed = feed_per_second(words);
    if (!feed) return feed.error();
    const auto moved = deviations_of(words, setup_, *test, *feed, per_feed);
    if (!moved) return moved.error();
    if (const auto harmonics = instruments::turn_harmonics({angles, Numbers(angles.size())});
        !harmonics) {
      return harmonics.error();
    }
    DrawnTest drawn{.values = lengths_of(name, {"form", "amplitude_1", "amplitude_2"}, {"mean"}),
                    .readings = bar_readings_of({{*test, *moved}}, setup_),
                    .beyond = beyond_stroke_of({{*test, *moved}}, words.stroke, parameter)};
    drawn.values.front().of_form = true;
    drawn.unseen_by_forms = first_harmonics(angles, 1);
    drawn.evaluate = [angles](const Numbers& shown) -> Result<Numbers> {
      const auto found = instruments::turn_harmonics({angles, shown});
      if (!found) return found.error();
      const auto& h = found->value;
      return in_um({found->form, std::hypot(h[1], h[2]), std::hypot(h[3], h[4]), h[0]});
    };
    return drawn;
  }

  const MotionSetup& setup_;
};

}  // namespace

Result<DrawnTest> drawn_test(const TestWords& words, const MotionSetup& setup) {
  const auto& common =
      std::visit([](const auto& each) -> const MotionWords& { return each; }, words);
  if (common.nc.run) {
    return error("program-in-study"_id,
                 "a study commands the axes of a motion test itself and runs no program",
                 "leave 'program' out of the test file; frustum motion run runs it");
  }
  return std::visit(TestDrawer(setup), words);
}

}  // namespace frustum::app

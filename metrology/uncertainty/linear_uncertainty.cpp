#include "metrology/uncertainty/linear_uncertainty.hpp"

#include <Eigen/Core>
#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <optional>

#include "metrology/characteristic/measured_values.hpp"
#include "metrology/uncertainty/element_patterns.hpp"
#include "metrology/uncertainty/feature_groups.hpp"
#include "metrology/uncertainty/monte_carlo_uncertainty.hpp"

namespace frustum::metrology {
namespace {

// How the parts of a characteristic answer to what it rests on: a column an error, times the
// standard deviation of its coefficient.
class Response {
 public:
  void add(std::size_t error, bool to_toleranced, Eigen::VectorXd answer) {
    columns_.push_back({error, to_toleranced, std::move(answer)});
  }
  // By the numbers of the errors.
  void sort() {
    std::sort(columns_.begin(), columns_.end(),
              [](const Column& a, const Column& b) { return a.error < b.error; });
  }
  // To the features whose points or sections the parts are of, or to datums and machine.
  [[nodiscard]] PartAnswers of(bool toleranced) const {
    PartAnswers answers;
    for (const Column& column : columns_) {
      if (column.to_toleranced == toleranced) answers.push_back(column.answer);
    }
    return answers;
  }
  // Of the first part: the number of the error and the answer.
  [[nodiscard]] std::vector<std::pair<std::size_t, double>> of_first() const {
    std::vector<std::pair<std::size_t, double>> answers;
    for (const Column& column : columns_) {
      if (column.answer.size() > 0) answers.emplace_back(column.error, column.answer[0]);
    }
    return answers;
  }

 private:
  struct Column {
    std::size_t error;
    bool to_toleranced;
    Eigen::VectorXd answer;
  };
  std::vector<Column> columns_{};
};

// What a characteristic is made of: the parts of a zone, or its value.
Eigen::VectorXd parts_of(const CharacteristicResult& c) {
  if (!c.spread.is_known()) return Eigen::VectorXd::Constant(1, internal_value(c));
  return Eigen::Map<const Eigen::VectorXd>(c.spread.parts.data(),
                                           static_cast<Eigen::Index>(c.spread.parts.size()));
}

// A profile or straightness of several features tolerances all of them.
bool is_toleranced(const PlannedCharacteristic& planned, const std::string& feature) {
  if (planned.kind != CharacteristicKind::surface_profile &&
      planned.kind != CharacteristicKind::straightness &&
      planned.kind != CharacteristicKind::thickness) {
    return planned.features.front() == feature;
  }
  const auto& all = planned.features;
  return std::find(all.begin(), all.end(), feature) != all.end();
}

// Half the step of differences: the farthest point moves by a micrometre.
constexpr double kStep = 1e-3;

// Some of the characteristics of a measurement, which can be made again.
struct Measured {
  const InspectionPlan& plan;
  std::span<const FittedFeature> features{};
  InspectionPlan asked{};  // with those characteristics alone

  [[nodiscard]] Result<Measurement> with(const MeasuringErrors& errors) const {
    auto moved = remeasured_features(plan, features, errors);
    if (!moved) return std::move(moved).error();
    return evaluated_values(asked, *std::move(moved));
  }
  // With errors in some features alone: places in `features`.
  [[nodiscard]] Result<Measurement> with(const MeasuringErrors& errors,
                                         std::span<const std::size_t> in_error,
                                         std::vector<FittedFeature> others) const {
    for (const std::size_t place : in_error) {
      auto moved = remeasured_features(plan, features.subspan(place, 1), errors);
      if (!moved) return std::move(moved).error();
      others[place] = std::move(moved->front());
    }
    return evaluated_values(asked, std::move(others));
  }
  [[nodiscard]] Result<std::vector<FittedFeature>> features_as_they_are() const {
    return remeasured_features(
        plan, features,
        [](const Vec3& centre, const Vec3&, std::size_t, std::size_t) -> Vec3 { return centre; });
  }
  [[nodiscard]] Result<Measurement> as_it_is() const {
    auto still = features_as_they_are();
    if (!still) return std::move(still).error();
    return evaluated_values(asked, *std::move(still));
  }
};

MeasuringErrors opposite(const MeasuringErrors& errors) {
  return [&errors](const Vec3& centre, const Vec3& approach, std::size_t feature,
                   std::size_t point) -> Vec3 {
    return 2.0 * centre - errors(centre, approach, feature, point);
  };
}

// Half the difference of what is measured with errors added and taken away, a column a
// characteristic.
Result<PartAnswers> half_difference(const Result<Measurement>& more,
                                    const Result<Measurement>& less) {
  if (!more) return more.error();
  if (!less) return less.error();
  PartAnswers all;
  for (std::size_t c = 0; c < more->characteristics.size(); ++c) {
    const Eigen::VectorXd high = parts_of(more->characteristics[c]);
    const Eigen::VectorXd low = parts_of(less->characteristics[c]);
    // A zone that another number of points makes, as after a change of sides, says nothing.
    all.push_back(high.size() == low.size() ? Eigen::VectorXd(0.5 * (high - low))
                                            : Eigen::VectorXd());
  }
  return all;
}

// How the uncertainty of a characteristic is found.
enum class Way {
  responses,    // by what patterns and field do to its parts
  own_points,   // a form: its element moves with the points; only the field bends it
  draws,        // what it depends on touches single points: root mean square of draws
  noise_alone,  // a form that is not the peak to valley of deviations, by draws of a perfect one
};

bool touches_single_points(Criterion by) {
  return by == Criterion::outside_material || by == Criterion::maximum_inscribed ||
         by == Criterion::minimum_circumscribed;
}

bool is_form(CharacteristicKind kind) {
  using enum CharacteristicKind;
  constexpr std::array kForms{roundness, cylindricity, cone_form,        equivalent_cone_form,
                              flatness,  straightness, axis_straightness};
  return std::find(kForms.begin(), kForms.end(), kind) != kForms.end();
}

// Sizes, and what names its own datum, are the same in every frame.
bool is_seen_in_frame(const PlannedCharacteristic& c) {
  using enum CharacteristicKind;
  constexpr std::array kSizes{radius, diameter, half_angle};
  constexpr std::array kInFrame{line_distance,   line_angle, line_profile,
                                surface_profile, position,   thickness};
  if (std::find(kSizes.begin(), kSizes.end(), c.kind) != kSizes.end()) return false;
  return c.features.size() < 2 ||
         std::find(kInFrame.begin(), kInFrame.end(), c.kind) != kInFrame.end();
}

Way way_of(const InspectionPlan& plan, const PlannedCharacteristic& c) {
  if (is_form(c.kind)) {
    const bool is_other_size = c.parameter.value_or(FormParameter::t) != FormParameter::t;
    return is_other_size || c.filter || touches_single_points(c.criterion) ? Way::noise_alone
                                                                           : Way::own_points;
  }
  const bool in_datum =
      c.frame.empty() && plan.alignment == Alignment::datum && plan.datum && is_seen_in_frame(c);
  const bool touches = touches_single_points(c.criterion) ||
                       touches_single_points(c.datum_criterion) ||
                       (in_datum && touches_single_points(plan.datum->criterion));
  return touches ? Way::draws : Way::responses;
}

// The values of many measurements, a row a characteristic. A draw in which an element cannot be
// found is left out; where most are, nothing can be said.
Result<std::vector<std::vector<double>>> drawn_values(const Measured& measured,
                                                      const ErrorDraws& draws) {
  constexpr std::uint32_t kDraws = 256;
  std::vector<std::vector<double>> values(measured.asked.characteristics.size());
  std::uint32_t failed = 0;
  for (std::uint32_t draw = 0; draw < kDraws; ++draw) {
    const auto again = measured.with(draws(draw));
    // More than half have failed: the errors of the measurement are too large for the element.
    if (!again && 2 * ++failed > kDraws) return again.error();
    if (!again) continue;
    for (std::size_t c = 0; c < values.size(); ++c) {
      values[c].push_back(internal_value(again->characteristics[c]));
    }
  }
  return values;
}

double root_mean_square_about(double value, const std::vector<double>& drawn) {
  double squares = 0.0;
  for (const double v : drawn) squares += (v - value) * (v - value);
  return std::sqrt(squares / static_cast<double>(std::max<std::size_t>(drawn.size(), 1)));
}

ErrorDraws errors_of(const PointUncertainty& u) {
  CmmModel cmm{.e0_mm = 2.0 * u.probing};
  if (u.scale > 0.0) cmm.length_per_error = 0.5e-3 / u.scale;
  return error_draws(cmm, 0);
}

struct Uncertain {
  double standard = 0.0;
  TruthBounds bounds{};
  bool either_sign = false;  // no size
};

constexpr double kCoverage = 2.0;  // 95 % of a normal distribution
Uncertain either_way(double standard) {
  return {standard, {kCoverage * standard, kCoverage * standard}, true};
}

Result<std::vector<Uncertain>> by_draws(const Measured& measured, const PointUncertainty& u) {
  const auto still = measured.as_it_is();
  if (!still) return still.error();
  const auto values = drawn_values(measured, errors_of(u));
  if (!values) return values.error();
  std::vector<Uncertain> found;
  for (std::size_t c = 0; c < values->size(); ++c) {
    found.push_back(either_way(
        root_mean_square_about(internal_value(still->characteristics[c]), (*values)[c])));
  }
  return found;
}

// The standard uncertainty is that of small errors of the part that was measured.
Result<std::vector<Uncertain>> by_noise_alone(const Measured& measured, const PointUncertainty& u) {
  static constexpr double kSmall = 1e-3;
  const auto still = measured.as_it_is();
  if (!still) return still.error();
  const ErrorDraws errors = errors_of(u);
  const auto small = drawn_values(measured, [&](std::uint32_t draw) -> MeasuringErrors {
    return [whole = errors(draw)](const Vec3& centre, const Vec3& approach, std::size_t feature,
                                  std::size_t point) -> Vec3 {
      return centre + kSmall * (whole(centre, approach, feature, point) - centre);
    };
  });
  if (!small) return small.error();
  std::vector<FittedFeature> perfect(measured.features.begin(), measured.features.end());
  for (FittedFeature& feature : perfect) {
    for (MeasuredPoint& p : feature.points) {
      p.point -= p.deviation * p.normal;
      p.deviation = 0.0;
    }
  }
  auto noise = drawn_values({measured.plan, perfect, measured.asked}, errors);
  if (!noise) return noise.error();
  std::vector<Uncertain> found;
  for (std::size_t c = 0; c < noise->size(); ++c) {
    const double value = internal_value(still->characteristics[c]);
    const double standard = root_mean_square_about(value, (*small)[c]) / kSmall;
    found.push_back({standard, truth_bounds(value, standard, (*noise)[c])});
  }
  return found;
}

using Responses = std::vector<Response>;

// Adds the answers of every characteristic to the patterns of every feature: those of a group of
// features at once. Returns how many errors there are.
Result<std::size_t> add_answers_to_patterns(Responses& responses, const Measured& measured,
                                            const PointUncertainty& u) {
  const std::vector<PlannedCharacteristic>& asked = measured.asked.characteristics;
  const FeatureGroups rest = feature_groups(measured.asked, measured.features);
  std::vector<Eigen::MatrixXd> patterns;
  std::vector<std::size_t> first_error;  // of each feature
  std::vector<std::size_t> place_of(measured.plan.features.size(), measured.features.size());
  std::size_t errors = 0;
  for (const FittedFeature& feature : measured.features) {
    place_of[static_cast<std::size_t>(feature.planned - measured.plan.features.data())] =
        patterns.size();
    patterns.push_back(element_patterns(feature));
    first_error.push_back(errors);
    errors += static_cast<std::size_t>(patterns.back().cols());
  }
  const auto still = measured.features_as_they_are();
  if (!still) return still.error();
  for (std::size_t group = 0; group < rest.groups.size(); ++group) {
    Eigen::Index most = 0;
    for (const std::size_t place : rest.groups[group]) {
      most = std::max(most, patterns[place].cols());
    }
    for (Eigen::Index k = 0; k < most; ++k) {
      const auto step = [&](std::size_t place) {
        return kStep / patterns[place].col(k).cwiseAbs().maxCoeff();
      };
      std::vector<std::size_t> moved;
      std::vector<double> steps(patterns.size(), 0.0);
      for (const std::size_t place : rest.groups[group]) {
        if (k >= patterns[place].cols()) continue;
        moved.push_back(place);
        steps[place] = step(place);
      }
      const MeasuringErrors pattern = [&](const Vec3& centre, const Vec3& approach,
                                          std::size_t feature, std::size_t point) -> Vec3 {
        const std::size_t place = place_of[feature];
        return centre +
               steps[place] * patterns[place](static_cast<Eigen::Index>(point), k) * approach;
      };
      const auto answers = half_difference(measured.with(pattern, moved, *still),
                                           measured.with(opposite(pattern), moved, *still));
      if (!answers) return answers.error();
      for (std::size_t c = 0; c < responses.size(); ++c) {
        const auto place = rest.of(c, group);
        if (!place || k >= patterns[*place].cols()) continue;
        const bool to_toleranced = is_toleranced(asked[c], measured.features[*place].planned->name);
        responses[c].add(first_error[*place] + static_cast<std::size_t>(k), to_toleranced,
                         u.probing / steps[*place] * (*answers)[c]);
      }
    }
  }
  return errors;
}

// Adds those to the machine's linear field, whose errors are numbered from `errors` on; returns how
// many there are with them.
Result<std::size_t> add_answers_to_field(Responses& responses, const Measured& measured,
                                         const PointUncertainty& u, std::size_t errors) {
  if (!(u.scale > 0.0)) return errors;
  double reach = 1.0;
  for (const FittedFeature& feature : measured.features) {
    for (const MeasuredPoint& p : feature.points) reach = std::max(reach, p.point.norm());
  }
  constexpr std::array<std::pair<int, int>, 6> kTerms{
      {{0, 0}, {1, 1}, {2, 2}, {0, 1}, {0, 2}, {1, 2}}};
  for (const auto& [row, column] : kTerms) {
    const double step = kStep / reach;
    Mat3 field = Mat3::Zero();
    field(row, column) = step;
    const MeasuringErrors bend = [&](const Vec3& centre, const Vec3&, std::size_t,
                                     std::size_t) -> Vec3 { return centre + field * centre; };
    const auto answers = half_difference(measured.with(bend), measured.with(opposite(bend)));
    if (!answers) return answers.error();
    for (std::size_t c = 0; c < responses.size(); ++c) {
      responses[c].add(errors, false, u.scale / step * (*answers)[c]);
    }
    ++errors;
  }
  return errors;
}

// What the characteristics of one way are uncertain by, and how they answer.
struct Answered {
  std::vector<Uncertain> uncertain{};
  Responses responses{};
  std::size_t errors = 0;
};

Result<Answered> by_responses(const Measured& measured, const PointUncertainty& u,
                              bool to_patterns) {
  Answered found;
  const std::size_t count = measured.asked.characteristics.size();
  if (count == 0) return found;
  const auto still = measured.as_it_is();
  if (!still) return still.error();
  found.responses.resize(count);
  auto errors = to_patterns ? add_answers_to_patterns(found.responses, measured, u)
                            : Result<std::size_t>(std::size_t{0});
  if (errors) errors = add_answers_to_field(found.responses, measured, u, *errors);
  if (!errors) return std::move(errors).error();
  found.errors = *errors;
  NormalDraws normals;
  for (std::size_t c = 0; c < count; ++c) {
    Response& response = found.responses[c];
    response.sort();
    const NonNegative& spread = still->characteristics[c].spread;
    if (spread.is_known()) {
      const PartAnswers toleranced = response.of(true);
      const PartAnswers others = response.of(false);
      const PartNoise noise(spread, toleranced, others, u.probing);
      found.uncertain.push_back({noise.standard(), noise.bounds(normals)});
      continue;
    }
    double squares = 0.0;
    for (const auto& [error, answer] : response.of_first()) squares += answer * answer;
    found.uncertain.push_back(either_way(std::sqrt(squares)));
  }
  return found;
}

// The plan with the characteristics of one way alone.
Measured asked_in(Way way, const InspectionPlan& plan, std::span<const FittedFeature> features) {
  Measured some{plan, features, plan};
  std::erase_if(some.asked.characteristics, [&](const auto& c) { return way_of(plan, c) != way; });
  return some;
}

// Of the noise of single points of ruled features what their patterns do not hold: (1 - P) of the
// points, where P projects on the patterns. Deviations of points answer to it, means and places do
// not.
class OwnNoise {
 public:
  explicit OwnNoise(std::span<const FittedFeature> features) : features_(features) {}

  struct Rest {
    std::size_t first = 0;  // number of the first error, counted from those of patterns and field
    Eigen::VectorXd vector{};
  };
  [[nodiscard]] Rest beside_patterns(const PlannedCharacteristic& planned) {
    std::size_t first = 0;
    for (const FittedFeature& feature : features_) {
      if (feature.planned->kind != FeatureKind::ruled) continue;
      if (feature.planned->name != planned.features.front()) {
        first += feature.points.size();
        continue;
      }
      auto [known, is_new] = patterns_.try_emplace(&feature);
      if (is_new) known->second = element_patterns(feature);
      const Eigen::MatrixXd& patterns = known->second;
      const auto point = static_cast<Eigen::Index>(planned.point.value_or(0));
      Eigen::VectorXd vector = -patterns * patterns.row(point).transpose();
      vector[point] += 1.0;
      return {first, std::move(vector)};
    }
    return {};
  }
  [[nodiscard]] std::size_t count() const {
    std::size_t points = 0;
    for (const FittedFeature& feature : features_) {
      if (feature.planned->kind == FeatureKind::ruled) points += feature.points.size();
    }
    return points;
  }

 private:
  std::span<const FittedFeature> features_;
  std::map<const FittedFeature*, Eigen::MatrixXd> patterns_{};
};

}  // namespace

bool is_coverage_proven(const InspectionPlan& plan, const PlannedCharacteristic& characteristic) {
  return way_of(plan, characteristic) != Way::draws;
}

Result<LinearUncertainty> linear_uncertainty(const InspectionPlan& plan,
                                             std::span<const FittedFeature> features,
                                             const PointUncertainty& u) {
  std::map<Way, std::vector<Uncertain>> found;
  auto answered = by_responses(asked_in(Way::responses, plan, features), u, true);
  if (!answered) return std::move(answered).error();
  found[Way::responses] = std::move(answered->uncertain);
  const auto forms = by_responses(asked_in(Way::own_points, plan, features), u, false);
  if (!forms) return forms.error();
  found[Way::own_points] = forms->uncertain;
  using ByDraws = Result<std::vector<Uncertain>> (*)(const Measured&, const PointUncertainty&);
  constexpr std::array<std::pair<Way, ByDraws>, 2> kByDraws{
      {{Way::draws, by_draws}, {Way::noise_alone, by_noise_alone}}};
  for (const auto& [way, uncertain] : kByDraws) {
    const Measured some = asked_in(way, plan, features);
    if (some.asked.characteristics.empty()) continue;
    auto drawn = uncertain(some, u);
    if (!drawn) return std::move(drawn).error();
    found[way] = std::move(*drawn);
  }
  LinearUncertainty out;
  OwnNoise own(features);
  const Responses& responses = answered->responses;
  std::vector<Eigen::Triplet<double>> answers;
  std::map<Way, std::size_t> next;
  for (std::size_t c = 0; c < plan.characteristics.size(); ++c) {
    const Way way = way_of(plan, plan.characteristics[c]);
    const std::size_t place = next[way]++;
    const PlannedCharacteristic& planned = plan.characteristics[c];
    Uncertain uncertain = found[way][place];
    if (planned.kind == CharacteristicKind::deviation) {
      const auto rest = own.beside_patterns(planned);
      uncertain = either_way(std::hypot(uncertain.standard, u.probing * rest.vector.norm()));
      for (Eigen::Index j = 0; j < rest.vector.size(); ++j) {
        answers.emplace_back(static_cast<int>(c),
                             static_cast<int>(answered->errors + rest.first) + static_cast<int>(j),
                             u.probing * rest.vector[j]);
      }
    }
    out.standard.push_back(uncertain.standard);
    out.bounds.push_back(uncertain.bounds);
    out.is_proven.push_back(is_coverage_proven(plan, plan.characteristics[c]));
    if (way != Way::responses || !uncertain.either_sign) continue;
    for (const auto& [error, answer] : responses[place].of_first()) {
      answers.emplace_back(static_cast<int>(c), static_cast<int>(error), answer);
    }
  }
  out.answers.resize(static_cast<Eigen::Index>(plan.characteristics.size()),
                     static_cast<Eigen::Index>(answered->errors + own.count()));
  out.answers.setFromTriplets(answers.begin(), answers.end());
  return out;
}

}  // namespace frustum::metrology

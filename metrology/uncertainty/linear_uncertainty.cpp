#include "metrology/uncertainty/linear_uncertainty.hpp"

#include <Eigen/Core>
#include <algorithm>
#include <array>
#include <cmath>

#include "core/linear_algebra.hpp"
#include "metrology/characteristic/measured_values.hpp"
#include "metrology/uncertainty/element_patterns.hpp"
#include "metrology/uncertainty/monte_carlo_uncertainty.hpp"

namespace frustum::metrology {
namespace {

using Columns = std::vector<Eigen::VectorXd>;

// What a characteristic is made of: the parts of a zone, or its value.
Eigen::VectorXd parts_of(const CharacteristicResult& c) {
  if (!c.spread.is_known()) return Eigen::VectorXd::Constant(1, internal_value(c));
  return Eigen::Map<const Eigen::VectorXd>(c.spread.parts.data(),
                                           static_cast<Eigen::Index>(c.spread.parts.size()));
}

// How its parts answer: a column a pattern, times the standard deviation of its coefficient.
struct Response {
  Columns others{};                // to datums and to the field of the machine
  Columns toleranced{};            // to the features whose points or sections the parts are of
  std::vector<double> in_order{};  // of the first part to all patterns

  void add(bool to_toleranced, Eigen::VectorXd answer) {
    in_order.push_back(answer.size() > 0 ? answer[0] : 0.0);
    (to_toleranced ? toleranced : others).push_back(std::move(answer));
  }
};

// A profile of several surfaces tolerances all of them.
bool is_toleranced(const PlannedCharacteristic& planned, const std::string& feature) {
  if (planned.kind != CharacteristicKind::surface_profile)
    return planned.features.front() == feature;
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
  [[nodiscard]] Result<Measurement> as_it_is() const {
    return with(
        [](const Vec3& centre, const Vec3&, std::size_t, std::size_t) -> Vec3 { return centre; });
  }
};

// Half the difference of what is measured with errors added and taken away, a column a
// characteristic.
Result<Columns> difference(const Measured& measured, const MeasuringErrors& errors) {
  const auto more = measured.with(errors);
  if (!more) return more.error();
  const auto less = measured.with([&](const Vec3& centre, const Vec3& approach, std::size_t feature,
                                      std::size_t point) -> Vec3 {
    return 2.0 * centre - errors(centre, approach, feature, point);
  });
  if (!less) return less.error();
  Columns all;
  for (std::size_t c = 0; c < more->characteristics.size(); ++c) {
    const Eigen::VectorXd high = parts_of(more->characteristics[c]);
    const Eigen::VectorXd low = parts_of(less->characteristics[c]);
    // A zone that another number of points makes, as after a change of sides, says nothing.
    all.push_back(high.size() == low.size() ? Eigen::VectorXd(0.5 * (high - low))
                                            : Eigen::VectorXd());
  }
  return all;
}

// Largest variance of a few parts over all directions.
double worst_variance(const Eigen::MatrixXd& covariance) {
  return covariance.rows() == 1 ? covariance(0, 0) : symmetric_eigenvalues(covariance).maxCoeff();
}

class Spread {
 public:
  Spread(const CharacteristicResult& measured, const Response& response, double probing)
      : spread_(measured.spread), response_(response), probing_(probing) {}

  [[nodiscard]] double of_value() const {
    if (!spread_.is_known()) return std::sqrt(covariance(0, 1)(0, 0));
    switch (spread_.rule.kind) {
      case NonNegativeKind::peak_to_valley:
        return of_ends();
      case NonNegativeKind::twice_largest:
        return 2.0 * of_places(3);
      case NonNegativeKind::twice_largest_height:
        return 2.0 * of_places(1);
      case NonNegativeKind::length:
        return of_places(3);
      case NonNegativeKind::none:
        break;
    }
    return 0.0;
  }

 private:
  static Eigen::MatrixXd products(const Columns& columns, Eigen::Index first, Eigen::Index count) {
    Eigen::MatrixXd sum = Eigen::MatrixXd::Zero(count, count);
    for (const Eigen::VectorXd& column : columns) {
      if (column.size() < first + count) continue;
      sum += column.segment(first, count) * column.segment(first, count).transpose();
    }
    return sum;
  }

  // Of `count` parts that stand together.
  [[nodiscard]] Eigen::MatrixXd covariance(Eigen::Index first, Eigen::Index count) const {
    Eigen::MatrixXd sum = products(response_.toleranced, first, count);
    if (!spread_.own.empty()) {
      // What its element gives a place is a share of what its own points do.
      const double own =
          probing_ * probing_ * spread_.own.at(static_cast<std::size_t>(first / count));
      if (worst_variance(sum) < own) sum = own * Eigen::MatrixXd::Identity(count, count);
    }
    return sum + products(response_.others, first, count);
  }

  // Of the place that is farthest, or may be.
  [[nodiscard]] double of_places(Eigen::Index count) const {
    constexpr double kSure = 3.0;  // standard deviations above which a direction is known
    const Eigen::Map<const Eigen::VectorXd> parts(spread_.parts.data(),
                                                  static_cast<Eigen::Index>(spread_.parts.size()));
    struct Place {
      double distance = 0.0;
      double standard = 0.0;
    };
    std::vector<Place> places;
    double farthest = 0.0;
    for (Eigen::Index first = 0; first + count <= parts.size(); first += count) {
      const Eigen::MatrixXd spread = covariance(first, count);
      const Eigen::VectorXd away = parts.segment(first, count);
      Place place{away.norm(), std::sqrt(worst_variance(spread))};
      if (place.distance > kSure * place.standard) {
        const Eigen::VectorXd toward = away / place.distance;
        place.standard = std::sqrt(toward.dot(spread * toward));
      }
      farthest = std::max(farthest, place.distance);
      places.push_back(place);
    }
    double standard = 0.0;
    for (const Place& place : places) {
      if (place.distance + 2.0 * place.standard >= farthest) {
        standard = std::max(standard, place.standard);
      }
    }
    return standard;
  }

  // Of the difference of the two ends of the worst row.
  [[nodiscard]] double of_ends() const {
    std::vector<std::size_t> rows = spread_.rule.rows;
    if (rows.empty()) rows.push_back(spread_.parts.size());
    std::size_t lowest = 0;
    std::size_t highest = 0;
    double worst = -1.0;
    auto begin = spread_.parts.begin();
    for (const std::size_t places : rows) {
      if (places == 0) continue;
      const auto end = begin + static_cast<std::ptrdiff_t>(places);
      const auto [low, high] = std::minmax_element(begin, end);
      if (*high - *low > worst) {
        worst = *high - *low;
        lowest = static_cast<std::size_t>(low - spread_.parts.begin());
        highest = static_cast<std::size_t>(high - spread_.parts.begin());
      }
      begin = end;
    }
    const auto squares = [&](const Columns& columns) {
      double sum = 0.0;
      for (const Eigen::VectorXd& column : columns) {
        if (column.size() != static_cast<Eigen::Index>(spread_.parts.size())) continue;
        const double apart =
            column[static_cast<Eigen::Index>(highest)] - column[static_cast<Eigen::Index>(lowest)];
        sum += apart * apart;
      }
      return sum;
    };
    double own = squares(response_.toleranced);
    if (!spread_.own.empty()) {
      own = std::max(own, probing_ * probing_ * (spread_.own[lowest] + spread_.own[highest]));
    }
    return std::sqrt(own + squares(response_.others));
  }

  const NonNegative& spread_;
  const Response& response_;
  double probing_;
};

// Root mean squares of what simulated errors do to the values. A draw in which an element cannot be
// found is left out; where most are, nothing can be said.
Result<std::vector<double>> drawn_uncertainties(const Measured& measured,
                                                const PointUncertainty& u) {
  constexpr std::uint32_t kDraws = 256;
  const auto still = measured.as_it_is();
  if (!still) return still.error();
  CmmModel cmm{.e0_mm = 2.0 * u.probing};
  if (u.scale > 0.0) cmm.length_per_error = 0.5e-3 / u.scale;
  const ErrorDraws draws = error_draws(cmm, 0);
  std::vector<double> squares(still->characteristics.size(), 0.0);
  std::uint32_t found = 0;
  for (std::uint32_t draw = 0; draw < kDraws; ++draw) {
    const auto again = measured.with(draws(draw));
    // More than half have failed: the errors of the measurement are too large for the element.
    if (!again && 2 * (draw + 1 - found) > kDraws) return again.error();
    if (!again) continue;
    ++found;
    for (std::size_t c = 0; c < squares.size(); ++c) {
      const double off =
          internal_value(again->characteristics[c]) - internal_value(still->characteristics[c]);
      squares[c] += off * off;
    }
  }
  for (double& square : squares) square = std::sqrt(square / std::max(found, 1U));
  return squares;
}

bool touches_single_points(const InspectionPlan& plan, const PlannedCharacteristic& c) {
  const auto touches = [](Criterion by) {
    return by == Criterion::outside_material || by == Criterion::maximum_inscribed ||
           by == Criterion::minimum_circumscribed;
  };
  const bool in_datum = c.frame.empty() && plan.alignment == Alignment::datum && plan.datum;
  return touches(c.criterion) || touches(c.datum_criterion) ||
         (in_datum && touches(plan.datum->criterion));
}

// The answers of every characteristic to the patterns of every feature and to the field.
Result<std::vector<Response>> responses_of(const Measured& measured, const PointUncertainty& u) {
  const std::vector<PlannedCharacteristic>& asked = measured.asked.characteristics;
  std::vector<Response> responses(asked.size());
  double reach = 1.0;
  for (const FittedFeature& feature : measured.features) {
    const auto index = static_cast<std::size_t>(feature.planned - measured.plan.features.data());
    const Eigen::MatrixXd patterns = element_patterns(feature);
    for (Eigen::Index k = 0; k < patterns.cols(); ++k) {
      const double step = kStep / patterns.col(k).cwiseAbs().maxCoeff();
      const auto answers = difference(
          measured,
          [&](const Vec3& centre, const Vec3& approach, std::size_t f, std::size_t point) -> Vec3 {
            if (f != index) return centre;
            return centre + step * patterns(static_cast<Eigen::Index>(point), k) * approach;
          });
      if (!answers) return answers.error();
      for (std::size_t c = 0; c < responses.size(); ++c) {
        responses[c].add(is_toleranced(asked[c], feature.planned->name),
                         u.probing / step * (*answers)[c]);
      }
    }
    for (const MeasuredPoint& p : feature.points) reach = std::max(reach, p.point.norm());
  }
  constexpr std::array<std::pair<int, int>, 6> kTerms{
      {{0, 0}, {1, 1}, {2, 2}, {0, 1}, {0, 2}, {1, 2}}};
  for (const auto& [row, column] : kTerms) {
    if (!(u.scale > 0.0)) break;
    const double step = kStep / reach;
    Mat3 field = Mat3::Zero();
    field(row, column) = step;
    const auto answers = difference(
        measured, [&](const Vec3& centre, const Vec3&, std::size_t, std::size_t) -> Vec3 {
          return centre + field * centre;
        });
    if (!answers) return answers.error();
    for (std::size_t c = 0; c < responses.size(); ++c) {
      responses[c].add(false, u.scale / step * (*answers)[c]);
    }
  }
  return responses;
}

}  // namespace

Result<LinearUncertainty> linear_uncertainty(const InspectionPlan& plan,
                                             std::span<const FittedFeature> features,
                                             const PointUncertainty& u) {
  Measured smooth{plan, features, plan};
  Measured touching{plan, features, plan};
  std::erase_if(smooth.asked.characteristics,
                [&](const auto& c) { return touches_single_points(plan, c); });
  std::erase_if(touching.asked.characteristics,
                [&](const auto& c) { return !touches_single_points(plan, c); });
  const auto measured = smooth.as_it_is();
  if (!measured) return measured.error();
  const auto responses = responses_of(smooth, u);
  if (!responses) return responses.error();
  std::vector<double> drawn;
  if (!touching.asked.characteristics.empty()) {
    auto found = drawn_uncertainties(touching, u);
    if (!found) return std::move(found).error();
    drawn = std::move(*found);
  }
  LinearUncertainty out;
  const std::size_t errors = responses->empty() ? 0 : responses->front().in_order.size();
  out.answers = Eigen::MatrixXd::Zero(static_cast<Eigen::Index>(plan.characteristics.size()),
                                      static_cast<Eigen::Index>(errors));
  std::size_t next_smooth = 0;
  std::size_t next_drawn = 0;
  for (std::size_t c = 0; c < plan.characteristics.size(); ++c) {
    if (touches_single_points(plan, plan.characteristics[c])) {
      out.standard.push_back(drawn[next_drawn++]);
      continue;
    }
    const Response& response = (*responses)[next_smooth];
    const CharacteristicResult& value = measured->characteristics[next_smooth++];
    out.standard.push_back(Spread(value, response, u.probing).of_value());
    if (value.spread.is_known()) continue;
    out.answers.row(static_cast<Eigen::Index>(c)) = Eigen::Map<const Eigen::RowVectorXd>(
        response.in_order.data(), static_cast<Eigen::Index>(errors));
  }
  return out;
}

}  // namespace frustum::metrology

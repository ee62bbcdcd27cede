#include "metrology/uncertainty/part_noise.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/linear_algebra.hpp"
#include "core/quantile.hpp"
#include "metrology/uncertainty/non_negative_interval.hpp"

namespace frustum::metrology {
namespace {

constexpr double kSure = 3.0;        // standard deviations above which a direction is known
constexpr double kMayCount = 6.0;    // standard deviations within which a place may make the size
constexpr double kTwoSided = 1.960;  // standard deviations on either side of 95 %

// Largest variance of a few parts over all directions.
double worst_variance(const Eigen::MatrixXd& covariance) {
  return covariance.rows() == 1 ? covariance(0, 0) : symmetric_eigenvalues(covariance).maxCoeff();
}

Eigen::MatrixXd products(const PartAnswers& answers, Eigen::Index first, Eigen::Index count) {
  Eigen::MatrixXd sum = Eigen::MatrixXd::Zero(count, count);
  for (const Eigen::VectorXd& column : answers) {
    if (column.size() < first + count) continue;
    sum += column.segment(first, count) * column.segment(first, count).transpose();
  }
  return sum;
}

Eigen::Index parts_of_a_place(NonNegativeKind kind) {
  const bool are_vectors =
      kind == NonNegativeKind::twice_largest || kind == NonNegativeKind::length;
  return are_vectors ? 3 : 1;
}

constexpr std::uint64_t kSeed = 0x3c6ef372fe94f82bU;

double normal_of(RandomPurpose purpose, std::uint32_t draw, std::size_t number) {
  return normal({.seed = kSeed, .draw = draw, .purpose = purpose}, number);
}

}  // namespace

double NormalDraws::of_element(std::uint32_t draw, std::size_t error) {
  return kept(elements_, RandomPurpose::cmm_scale, draw, error);
}

double NormalDraws::of_place(std::uint32_t draw, std::size_t number) {
  return kept(places_, RandomPurpose::cmm_point, draw, number);
}

double NormalDraws::kept(std::vector<std::vector<double>>& known, RandomPurpose purpose,
                         std::uint32_t draw, std::size_t number) {
  constexpr std::size_t kMostKept = 256;  // of a draw: 2 MB of a thousand draws
  if (number >= kMostKept) return normal_of(purpose, draw, number);
  if (known.size() <= draw) known.resize(draw + 1);
  std::vector<double>& of_draw = known[draw];
  while (of_draw.size() <= number) of_draw.push_back(normal_of(purpose, draw, of_draw.size()));
  return of_draw[number];
}

TruthBounds truth_bounds(double size, double standard, std::span<double> noise) {
  constexpr double kCoverage = 0.95;
  if (!(standard > 0.0)) return {};
  const double above_noise = std::max(0.0, (size - quantile(noise, 0.5)) / standard);
  const Tails tails = tails_near_zero(above_noise, kCoverage);
  return {std::max(0.0, quantile(noise, 1.0 - tails.high)), kTwoSided * standard};
}

PartNoise::PartNoise(const NonNegative& parts, const PartAnswers& elements,
                     const PartAnswers& others, double probing)
    : parts_(parts),
      elements_(elements),
      others_(others),
      probing_(probing),
      per_place_(parts_of_a_place(parts.rule.kind)),
      factor_(parts.rule.kind == NonNegativeKind::twice_largest ||
                      parts.rule.kind == NonNegativeKind::twice_largest_height
                  ? 2.0
                  : 1.0) {}

std::size_t PartNoise::place_count() const {
  return parts_.parts.size() / static_cast<std::size_t>(per_place_);
}

Eigen::VectorXd PartNoise::part(std::size_t place) const {
  return Eigen::Map<const Eigen::VectorXd>(
      parts_.parts.data() + static_cast<Eigen::Index>(place) * per_place_, per_place_);
}

// What its element gives a place is a share of what its own points do.
bool PartNoise::stands_alone(std::size_t place) const {
  if (parts_.own.empty()) return false;
  const auto first = static_cast<Eigen::Index>(place) * per_place_;
  return worst_variance(products(elements_, first, per_place_)) <
         probing_ * probing_ * parts_.own.at(place);
}

Eigen::MatrixXd PartNoise::covariance(std::size_t place) const {
  const auto first = static_cast<Eigen::Index>(place) * per_place_;
  const Eigen::MatrixXd own =
      stands_alone(place) ? Eigen::MatrixXd(probing_ * probing_ * parts_.own.at(place) *
                                            Eigen::MatrixXd::Identity(per_place_, per_place_))
                          : products(elements_, first, per_place_);
  return own + products(others_, first, per_place_);
}

double PartNoise::standard_of(std::size_t place) const {
  const Eigen::MatrixXd spread = covariance(place);
  const Eigen::VectorXd away = part(place);
  const double worst = std::sqrt(worst_variance(spread));
  if (away.norm() <= kSure * worst) return worst;
  const Eigen::VectorXd toward = away.normalized();
  return std::sqrt(toward.dot(spread * toward));
}

// Of the place that is farthest, or may be.
double PartNoise::standard_of_farthest() const {
  std::vector<double> standards;
  double farthest = 0.0;
  for (std::size_t i = 0; i < place_count(); ++i) {
    standards.push_back(standard_of(i));
    farthest = std::max(farthest, part(i).norm());
  }
  double standard = 0.0;
  for (std::size_t i = 0; i < standards.size(); ++i) {
    if (part(i).norm() + 2.0 * standards[i] >= farthest) {
      standard = std::max(standard, standards[i]);
    }
  }
  return factor_ * standard;
}

// Of the difference of the two ends of the worst row.
double PartNoise::standard_of_ends() const {
  const std::vector<Ends> rows = rows_within(0.0);
  if (rows.empty()) return 0.0;
  const std::size_t high = rows.front().peaks.front();
  const std::size_t low = rows.front().valleys.front();
  const auto squares = [&](const PartAnswers& answers) {
    double sum = 0.0;
    for (const Eigen::VectorXd& column : answers) {
      if (column.size() != static_cast<Eigen::Index>(parts_.parts.size())) continue;
      const double apart =
          column[static_cast<Eigen::Index>(high)] - column[static_cast<Eigen::Index>(low)];
      sum += apart * apart;
    }
    return sum;
  };
  double own = squares(elements_);
  if (!parts_.own.empty()) {
    own = std::max(own, probing_ * probing_ * (parts_.own[low] + parts_.own[high]));
  }
  return std::sqrt(own + squares(others_));
}

double PartNoise::standard() const {
  switch (parts_.rule.kind) {
    case NonNegativeKind::peak_to_valley:
      return standard_of_ends();
    case NonNegativeKind::twice_largest:
    case NonNegativeKind::twice_largest_height:
    case NonNegativeKind::length:
      return standard_of_farthest();
    case NonNegativeKind::none:
      break;
  }
  return 0.0;
}

// Ends of rows that are no more than this apart from the size; within 0 those that make it.
std::vector<PartNoise::Ends> PartNoise::rows_within(double reach) const {
  std::vector<std::size_t> rows = parts_.rule.rows;
  if (rows.empty()) rows.push_back(parts_.parts.size());
  const double size = size_of(parts_);
  std::vector<Ends> found;
  std::size_t begin = 0;
  for (const std::size_t places : rows) {
    const std::size_t end = begin + places;
    if (places == 0) continue;
    const auto [low, high] =
        std::minmax_element(parts_.parts.begin() + static_cast<std::ptrdiff_t>(begin),
                            parts_.parts.begin() + static_cast<std::ptrdiff_t>(end));
    const double left = reach - (size - (*high - *low));
    if (left >= 0.0) {
      Ends ends;
      for (std::size_t i = begin; i < end; ++i) {
        if (parts_.parts[i] >= *high - left) ends.peaks.push_back(i);
        if (parts_.parts[i] <= *low + left) ends.valleys.push_back(i);
      }
      found.push_back(std::move(ends));
    }
    begin = end;
  }
  return found;
}

std::vector<PartNoise::Ends> PartNoise::places_within(double reach) const {
  const double size = size_of(parts_);
  Ends ends;
  for (std::size_t i = 0; i < place_count(); ++i) {
    if (factor_ * part(i).norm() >= size - reach) ends.peaks.push_back(i);
  }
  return {std::move(ends)};
}

// The direction in which noise makes a place farther; nothing where any may.
std::optional<Eigen::VectorXd> PartNoise::toward(std::size_t place) const {
  if (parts_.rule.kind == NonNegativeKind::peak_to_valley) return Eigen::VectorXd::Ones(1);
  const Eigen::VectorXd away = part(place);
  const double worst = std::sqrt(worst_variance(covariance(place)));
  if (away.norm() <= kMayCount * worst) return std::nullopt;
  return away.normalized();
}

TruthBounds PartNoise::bounds(NormalDraws& normals) const {
  constexpr std::size_t kNormals = 20'000;
  const double u = standard();
  if (!(u > 0.0)) return {};
  const bool has_valleys = parts_.rule.kind == NonNegativeKind::peak_to_valley;
  const std::vector<Ends> rows =
      has_valleys ? rows_within(kMayCount * u) : places_within(kMayCount * u);
  std::size_t ends = 0;
  for (const Ends& row : rows) ends += row.peaks.size() + row.valleys.size();
  const std::size_t draws =
      std::clamp<std::size_t>(kNormals / std::max<std::size_t>(ends, 1), 40, 1000);
  struct Place {
    bool alone = false;
    std::optional<Eigen::VectorXd> toward{};
  };
  std::vector<Place> places;
  for (std::size_t i = 0; i < place_count(); ++i) places.push_back({stands_alone(i), toward(i)});
  std::vector<double> largest;
  Eigen::VectorXd noise(per_place_);
  for (std::size_t d = 0; d < draws; ++d) {
    const auto draw = static_cast<std::uint32_t>(d);
    const auto add = [&](const PartAnswers& answers, Eigen::Index first, std::size_t error) {
      for (const Eigen::VectorXd& answer : answers) {
        const double coefficient = normals.of_element(draw, error++);
        if (answer.size() < first + per_place_) continue;
        noise += coefficient * answer.segment(first, per_place_);
      }
    };
    const auto adds = [&](std::size_t place) {
      const auto first = static_cast<Eigen::Index>(place) * per_place_;
      noise.setZero();
      add(others_, first, elements_.size());
      if (places[place].alone) {
        const double standard = probing_ * std::sqrt(parts_.own[place]);
        for (Eigen::Index i = 0; i < per_place_; ++i) {
          noise[i] += standard * normals.of_place(draw, static_cast<std::size_t>(first + i));
        }
      } else {
        add(elements_, first, 0);
      }
      const auto& direction = places[place].toward;
      return factor_ * (direction ? direction->dot(noise) : noise.norm());
    };
    double most = -std::numeric_limits<double>::infinity();
    for (const Ends& row : rows) {
      double peak = -std::numeric_limits<double>::infinity();
      double valley = std::numeric_limits<double>::infinity();
      for (const std::size_t place : row.peaks) peak = std::max(peak, adds(place));
      for (const std::size_t place : row.valleys) valley = std::min(valley, adds(place));
      most = std::max(most, has_valleys ? peak - valley : peak);
    }
    largest.push_back(most);
  }
  return truth_bounds(size_of(parts_), u, largest);
}

}  // namespace frustum::metrology

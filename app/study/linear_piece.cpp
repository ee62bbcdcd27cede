#include "app/study/linear_piece.hpp"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>

#include "core/units.hpp"
#include "metrology/cmm.hpp"
#include "metrology/plan/strategy.hpp"
#include "trials/surface_gain.hpp"

namespace frustum::app {
namespace {

using metrology::NonNegativeKind;
using studies::LinearCharacteristic;

constexpr std::uint32_t kCheckedDraws = 3;
// Points of a feature that show how far a draw is from the middle.
constexpr Eigen::Index kReachPoints = 64;

std::string words_of(const Diagnostics& problems) {
  std::string text;
  for (const Diagnostic& d : problems) {
    if (d.severity == Severity::error) text += (text.empty() ? "" : "; ") + d.message;
  }
  return text;
}

// What a value is made of, um or urad: of one of either sign itself, of a size its parts.
Eigen::VectorXd parts_of(const metrology::CharacteristicResult& c, bool both_sides) {
  if (both_sides) return Eigen::VectorXd::Constant(1, shown_value(c));
  const std::vector<double>& parts = c.spread.is_known() ? c.spread.parts : c.plot_deviation;
  return kUmPerMm *
         Eigen::Map<const Eigen::VectorXd>(parts.data(), static_cast<Eigen::Index>(parts.size()));
}

LinearCharacteristic made_of(const StudyCharacteristic& of, const metrology::SizeRule& rule,
                             const Eigen::VectorXd& nominal, const Eigen::MatrixXd& gains) {
  LinearCharacteristic linear{of.name, of.unit(), {}};
  const auto length = [&](double factor, std::size_t dimensions) {
    return studies::LinearLength{factor, dimensions, nominal, gains};
  };
  if (of.both_sides) {
    linear.of = studies::LinearSum{nominal[0], gains.row(0).transpose()};
    return linear;
  }
  switch (rule.kind) {
    case NonNegativeKind::twice_largest:
      linear.of = length(2.0, 3);
      break;
    case NonNegativeKind::twice_largest_height:
      linear.of = studies::LinearReach{2.0, nominal, gains};
      break;
    case NonNegativeKind::length:
      linear.of = length(1.0, static_cast<std::size_t>(nominal.size()));
      break;
    case NonNegativeKind::none:
    case NonNegativeKind::peak_to_valley: {
      studies::LinearRange range{nominal, gains, rule.rows};
      std::erase(range.rows, std::size_t{0});
      linear.of = std::move(range);
      break;
    }
  }
  return linear;
}

}  // namespace

double shown_value(const metrology::CharacteristicResult& c, double value) {
  const double nominal = c.nominal ? metrology::internal_value(*c.nominal, c.unit) : 0.0;
  const double scale = metrology::is_angle(c) ? kUradPerRad : kUmPerMm;
  return (value - nominal) * scale;
}

double shown_value(const metrology::CharacteristicResult& c) {
  return shown_value(c, metrology::internal_value(c));
}

std::vector<double> shown_values(const metrology::Measurement& measurement) {
  std::vector<double> values;
  for (const auto& c : measurement.characteristics) values.push_back(shown_value(c));
  return values;
}

std::vector<double> deviations_of(const metrology::InspectionPlan& plan,
                                  const metrology::Measurement& measurement) {
  std::vector<double> deviations;
  for (const auto& feature : measurement.features) {
    const auto* planned = metrology::find_feature(plan, feature.name);
    if (planned == nullptr) continue;
    const auto places = metrology::planned_points(*planned);
    for (std::size_t i = 0; i < std::min(places.size(), feature.points.size()); ++i) {
      const Vec3 at = measurement.workpiece_from_datum.point(feature.points[i].point);
      deviations.push_back(places[i].normal.dot(at - places[i].point) * kUmPerMm);
    }
  }
  return deviations;
}

LinearPiece::LinearPiece(const StudyFile& study, const studies::FactorSet& factors,
                         const trials::Trial& middle)
    : study_(study),
      factors_(factors),
      middle_(middle),
      characteristics_(study.characteristics.size()) {
  find_gains();
  if (gains_.cols() == 0) return;
  find_characteristics();
  find_engine();
}

void LinearPiece::find_gains() {
  std::vector<trials::Parameter> columns;
  for (const studies::Column& column : factors_.columns()) {
    columns.push_back({column.name, false, column.unit});
  }
  const auto gains = trials::surface_gains(study_.machine(), study_.job->piece, middle_, columns);
  if (!gains) {
    against_ = "the gains of the surface are not known: " + words_of(gains.error());
    return;
  }
  gains_ = gains->odd * kUmPerMm;
  // What a face cut by a leaning end of a cutter adds, for the largest errors of the laws.
  const std::vector<double> largest = factors_.largest_weights();
  const Eigen::Map<const Eigen::VectorXd> most(largest.data(),
                                               static_cast<Eigen::Index>(largest.size()));
  constexpr double kNothing = 1e-6;  // mm: below a nanometre nothing is seen of it
  if ((gains->even.cwiseAbs() * most).maxCoeff() > kNothing) {
    against_ = "a face is cut by the leaning end of a cutter, which is not linear";
  }
  std::vector<Eigen::Index> rows;
  Eigen::Index first = 0;
  for (const auto& feature : middle_.measurement.features) {
    const auto count = static_cast<Eigen::Index>(feature.points.size());
    const Eigen::Index taken = std::min(count, kReachPoints);
    for (Eigen::Index i = 0; i < taken; ++i) rows.push_back(first + i * count / taken);
    first += count;
  }
  reach_gains_ = gains_(rows, Eigen::all);
}

// The points of the machine in the middle, moved along their normals by so many um.
Result<metrology::Measurement> LinearPiece::evaluated(const Eigen::VectorXd& moves,
                                                      const metrology::CmmModel& cmm) const {
  const metrology::Measurement& middle = middle_.measurement;
  std::vector<metrology::FeaturePoints> features;
  Eigen::Index row = 0;
  for (const auto& feature : middle.features) {
    metrology::FeaturePoints points{feature.name, {}, {}};
    for (const metrology::MeasuredPoint& p : feature.points) {
      const double move = moves.size() == 0 ? 0.0 : moves[row++] / kUmPerMm;
      points.points.push_back(middle.workpiece_from_datum.point(p.point + move * p.normal));
      points.sections.push_back(p.section);
    }
    features.push_back(std::move(points));
  }
  return metrology::evaluate(study_.job->piece.plan, features, metrology::PointMeaning::surface,
                             cmm);
}

void LinearPiece::find_characteristics() {
  const auto base = evaluated({}, {});
  if (!base) return;
  const std::size_t count = characteristics_.size();
  std::vector<Eigen::VectorXd> nominal;
  std::vector<Eigen::MatrixXd> gains;
  for (std::size_t c = 0; c < count; ++c) {
    nominal.push_back(parts_of(base->characteristics.at(c), study_.characteristics[c].both_sides));
    gains.emplace_back(Eigen::MatrixXd::Zero(nominal[c].size(), gains_.cols()));
  }
  // By column, whether each characteristic has as many parts as before.
  const auto columns = static_cast<std::size_t>(gains_.cols());
  std::vector<char> sound(columns * count, 1);
  tbb::parallel_for(std::size_t{0}, columns, [&](std::size_t column) {
    const auto j = static_cast<Eigen::Index>(column);
    const double most = gains_.col(j).cwiseAbs().maxCoeff();
    if (!(most > 0.0)) return;
    // One um: small against the part, large against the fits' rounding.
    const auto moved = evaluated(gains_.col(j) / most, {});
    for (std::size_t c = 0; c < count; ++c) {
      const Eigen::VectorXd there =
          moved ? parts_of(moved->characteristics.at(c), study_.characteristics[c].both_sides)
                : Eigen::VectorXd();
      const bool alike = there.size() == nominal[c].size();
      sound[column * count + c] = alike ? 1 : 0;
      if (alike) gains[c].col(j) = (there - nominal[c]) * most;
    }
  });
  std::vector<double> values(factors_.variables().size());
  for (std::uint32_t draw = 0; draw < kCheckedDraws; ++draw) {
    Checked& checked = checked_.emplace_back();
    factors_.draw(study_.seed, draw, values);
    checked.weights.resize(gains_.cols());
    factors_.weights(values, {checked.weights.data(), columns});
    if (const auto whole = evaluated(gains_ * checked.weights, {})) {
      checked.values = shown_values(*whole);
    }
  }
  for (std::size_t c = 0; c < count; ++c) {
    bool all = nominal[c].size() > 0;
    for (std::size_t j = 0; j < columns; ++j) all = all && sound[j * count + c] == 1;
    if (!all) continue;
    characteristics_[c] = made_of(study_.characteristics[c],
                                  base->characteristics.at(c).spread.rule, nominal[c], gains[c]);
    // For shares: second order, and a tenth of what a share has to say.
    if (!agrees(c, 0.01, 0.02)) characteristics_[c].reset();
  }
}

bool LinearPiece::agrees(std::size_t characteristic, double relative, double absolute) const {
  return std::ranges::all_of(checked_, [&](const Checked& checked) {
    if (checked.values.empty()) return false;
    const double value = checked.values[characteristic];
    const double linear = studies::value_of(*characteristics_[characteristic], checked.weights);
    return std::abs(linear - value) <= relative * std::abs(value) + absolute;
  });
}

void LinearPiece::find_engine() {
  studies::LinearModel model;
  for (std::size_t c = 0; c < characteristics_.size(); ++c) {
    // A fit of second order: below what the controls let pass. What differs more is evaluated.
    if (!characteristics_[c] || !agrees(c, 0.002, 0.005)) return;
    model.characteristics.push_back(*characteristics_[c]);
  }
  model.characteristics.push_back(
      {"largest move", "um",
       studies::LinearReach{1.0, Eigen::VectorXd::Zero(reach_gains_.rows()), reach_gains_}});
  engine_ = std::make_unique<studies::LinearEngine>(factors_, model);
}

DrawOutcome LinearPiece::moved(const Eigen::VectorXd& weights) const {
  DrawOutcome outcome;
  const auto measurement = evaluated(gains_ * weights, {});
  if (!measurement) {
    outcome.failure = words_of(measurement.error());
    return outcome;
  }
  outcome.values = shown_values(*measurement);
  outcome.largest_move = (reach_gains_ * weights).cwiseAbs().maxCoeff();
  return outcome;
}

std::vector<double> LinearPiece::points(const Eigen::VectorXd& weights) const {
  std::vector<double> deviations = deviations_of(study_.job->piece.plan, middle_.measurement);
  const Eigen::VectorXd moves = gains_ * weights;
  for (std::size_t i = 0; i < deviations.size(); ++i) {
    deviations[i] += moves[static_cast<Eigen::Index>(i)];
  }
  return deviations;
}

}  // namespace frustum::app

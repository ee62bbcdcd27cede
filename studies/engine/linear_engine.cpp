#include "studies/engine/linear_engine.hpp"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>

#include "core/linear_algebra.hpp"
#include "core/random.hpp"
#include "kinematics/errors/error_draw.hpp"
#include "studies/engine/lane_kernels.hpp"

namespace frustum::studies {
namespace {

constexpr std::uint32_t kEngineBlock = 1024;  // draws of one task
// Columns that move no point by this share of the largest motion are left out: together below
// 1e-9 of it for 1,000 columns.
constexpr double kDead = 1e-12;
// What the rank may leave out, over the largest motion of a point: a screen that misses more sends
// more points to the exact evaluation, one that misses less costs more itself.
constexpr double kLeftOut = 1e-4;

constexpr std::size_t padded(std::size_t n, std::size_t to) { return (n + to - 1) / to * to; }

// Points that are looked at together, as the engine evaluates them: gains of their live columns.
struct LanePoints {
  std::vector<std::size_t> columns{};  // live
  std::size_t width = 0;               // of a row of gains: columns padded to 8
  std::vector<double> gains{};         // points x width
  std::vector<double> nominal{};
  std::vector<float> per_weight{};  // 1 / largest weight, by live column
  ScreenFactors screen{};           // where extremes are asked for
};

enum class Size : std::uint8_t { sum, range, reach, length };
struct LaneCharacteristic {
  Size size = Size::sum;
  double factor = 1.0;
  std::size_t dimensions = 1;      // of vectors
  std::vector<LanePoints> rows{};  // a range of each, of which the worst counts; else one
};

// max over the points of sum |g_ij|.
double largest_row_sum(const Eigen::MatrixXd& m) {
  return m.size() == 0 ? 0.0 : m.cwiseAbs().rowwise().sum().maxCoeff();
}

// The nominal is one more column, whose weight is 1.
void make_screen(LanePoints& points, const Eigen::MatrixXd& scaled) {
  const SingularValues svd = singular_values(scaled, SingularVectors::thin);
  const double largest = scaled.rowwise().norm().maxCoeff();
  Eigen::Index rank = 0;
  Eigen::MatrixXd rest = scaled;
  while (rank < svd.values.size() && largest_row_sum(rest) > kLeftOut * largest) {
    rest -= svd.values[rank] * svd.left.col(rank) * svd.right.col(rank).transpose();
    ++rank;
  }
  ScreenFactors& s = points.screen;
  s.points = padded(static_cast<std::size_t>(scaled.rows()), 4);
  s.columns = static_cast<std::size_t>(scaled.cols());
  s.rank = padded(static_cast<std::size_t>(std::max<Eigen::Index>(rank, 1)), 4);
  s.left_out = largest_row_sum(rest);
  s.left.assign(s.points * s.rank, 0.0F);
  s.right.assign(s.columns * s.rank, 0.0F);
  for (std::size_t i = 0; i < s.points; ++i) {
    // Points beyond the last are the last again.
    const auto row = std::min(static_cast<Eigen::Index>(i), scaled.rows() - 1);
    for (Eigen::Index k = 0; k < rank; ++k) {
      s.left[(i / 4 * s.rank + static_cast<std::size_t>(k)) * 4 + i % 4] =
          static_cast<float>(svd.left(row, k));
    }
  }
  for (std::size_t j = 0; j < s.columns; ++j) {
    for (Eigen::Index k = 0; k < rank; ++k) {
      s.right[j * s.rank + static_cast<std::size_t>(k)] =
          static_cast<float>(svd.values[k] * svd.right(static_cast<Eigen::Index>(j), k));
    }
  }
  // A sum of n products of numbers that are rounded themselves is off by (n + 3) 2^-24 of the sum
  // of the absolute products; that of the combinations is at most their length times that of the
  // weights, and the points' that of the scaled gains times sqrt(rank).
  const double roundings = static_cast<double>(s.columns + s.rank) + 8.0;
  s.rounding = 1.01 * roundings * 0x1p-24 * largest * std::sqrt(static_cast<double>(s.rank));
}

LanePoints points_of(const Eigen::VectorXd& nominal, const Eigen::MatrixXd& gains,
                     const std::vector<double>& largest_weights, bool screened) {
  assert(static_cast<std::size_t>(gains.cols()) == largest_weights.size());
  LanePoints lanes;
  Eigen::VectorXd reach(gains.cols());
  for (Eigen::Index j = 0; j < gains.cols(); ++j) {
    reach[j] = gains.col(j).cwiseAbs().maxCoeff() * largest_weights[static_cast<std::size_t>(j)];
  }
  const double largest = reach.maxCoeff();
  for (Eigen::Index j = 0; j < gains.cols(); ++j) {
    if (reach[j] > kDead * largest) lanes.columns.push_back(static_cast<std::size_t>(j));
  }
  lanes.width = padded(lanes.columns.size(), 8);
  const auto live = static_cast<Eigen::Index>(lanes.columns.size());
  lanes.gains.assign(static_cast<std::size_t>(gains.rows()) * lanes.width, 0.0);
  Eigen::MatrixXd scaled(gains.rows(), live + 1);
  for (Eigen::Index k = 0; k < live; ++k) {
    const auto j = static_cast<Eigen::Index>(lanes.columns[static_cast<std::size_t>(k)]);
    const double weight = largest_weights[static_cast<std::size_t>(j)];
    scaled.col(k) = gains.col(j) * weight;
    lanes.per_weight.push_back(static_cast<float>(1.0 / weight));
    for (Eigen::Index i = 0; i < gains.rows(); ++i) {
      lanes.gains[static_cast<std::size_t>(i) * lanes.width + static_cast<std::size_t>(k)] =
          gains(i, j);
    }
  }
  scaled.col(live) = nominal;
  lanes.nominal.assign(nominal.data(), nominal.data() + nominal.size());
  if (screened) make_screen(lanes, scaled);
  return lanes;
}

// One overload a kind.
struct LanesOf {
  const std::vector<double>& largest_weights;

  LaneCharacteristic operator()(const LinearSum& sum) const {
    return {.rows = {points_of(Eigen::VectorXd::Constant(1, sum.constant), sum.gains.transpose(),
                               largest_weights, false)}};
  }
  LaneCharacteristic operator()(const LinearRange& range) const {
    LaneCharacteristic lanes{.size = Size::range};
    Eigen::Index first = 0;
    const auto add = [&](std::size_t points) {
      const auto count = static_cast<Eigen::Index>(points);
      lanes.rows.push_back(points_of(range.nominal.segment(first, count),
                                     range.gains.middleRows(first, count), largest_weights, true));
      first += count;
    };
    for (const std::size_t count : range.rows) add(count);
    if (range.rows.empty()) add(static_cast<std::size_t>(range.nominal.size()));
    return lanes;
  }
  LaneCharacteristic operator()(const LinearReach& reach) const {
    return {.size = Size::reach,
            .factor = reach.factor,
            .rows = {points_of(reach.nominal, reach.gains, largest_weights, true)}};
  }
  LaneCharacteristic operator()(const LinearLength& length) const {
    return {.size = Size::length,
            .factor = length.factor,
            .dimensions = length.dimensions,
            .rows = {points_of(length.nominal, length.gains, largest_weights, false)}};
  }
};

// What one task works in.
struct Workspace {
  std::vector<LaneRow<double>> variables{}, weights{};
  std::vector<LaneRow<float>> scaled{}, combinations{}, screens{};
  std::vector<std::uint32_t> places{};
  std::vector<double> rows{};    // kLanes x width: weights of live columns, a draw after the other
  std::vector<double> values{};  // of all variables of one draw
  std::vector<double> uniform{};
};

}  // namespace

struct LinearEngine::State {
  FactorSet set;
  const LaneKernels* kernels = nullptr;
  std::vector<LaneCharacteristic> characteristics{};
  std::vector<bool> live_column{};
  std::vector<bool> live_variable{};

  // Columns that move any point, and what they are made of, are drawn.
  void use(const std::vector<std::size_t>& columns) {
    for (const std::size_t j : columns) {
      live_column[j] = true;
      const Column& column = set.columns()[j];
      use_amount(column.amount);
      if (column.phase) use_amount(*column.phase);
    }
  }
  void use_amount(std::size_t amount) {
    for (const DrawnAmount::Part& part : set.amounts()[amount].parts) {
      live_variable[part.variable] = true;
    }
  }

  [[nodiscard]] Workspace workspace() const {
    Workspace w;
    w.variables.resize(set.variables().size());
    w.weights.resize(set.columns().size());
    w.values.resize(set.variables().size());
    w.uniform.resize(set.variables().size());
    std::size_t columns = 1, rank = 0, points = 0, width = 0;
    for (const LaneCharacteristic& c : characteristics) {
      for (const LanePoints& row : c.rows) {
        columns = std::max(columns, row.columns.size() + 1);
        rank = std::max(rank, row.screen.rank);
        points = std::max(points, row.screen.points);
        width = std::max(width, row.width);
      }
    }
    w.scaled.resize(columns);
    w.combinations.resize(rank);
    w.screens.resize(points);
    w.places.resize(points * kLanes);
    w.rows.resize(kLanes * width);
    return w;
  }

  // Values of the variables of draws first .. first + 15.
  void draw(const Scheme& scheme, std::uint64_t seed, std::uint32_t first, Workspace& w) const {
    if (scheme.kind() != SchemeKind::random || set.has_correlated()) {
      for (std::size_t l = 0; l < kLanes; ++l) {
        const std::uint32_t d = first + static_cast<std::uint32_t>(l);
        if (scheme.kind() == SchemeKind::random) {
          set.draw(seed, d, w.values);
        } else {
          scheme.point(d, w.uniform);
          set.from_uniform(w.uniform, w.values);
        }
        for (std::size_t v = 0; v < w.values.size(); ++v) w.variables[v].at[l] = w.values[v];
      }
      return;
    }
    for (std::size_t v = 0; v < w.variables.size(); ++v) {
      if (!live_variable[v]) continue;
      const Variable& variable = set.variables()[v];
      const Law& law = variable.law;
      if (law.kind == Law::Kind::uniform) {
        kernels->uniforms(seed, first, variable.stream, law.lo, law.hi - law.lo, w.variables[v]);
        continue;
      }
      for (std::size_t l = 0; l < kLanes; ++l) {
        const RandomKey key{seed, first + static_cast<std::uint32_t>(l),
                            RandomPurpose::error_amount};
        w.variables[v].at[l] = kinematics::drawn_from(law, key, variable.stream);
      }
    }
  }

  void amount(std::size_t index, Workspace& w, LaneRow<double>& out) const {
    const DrawnAmount& amount = set.amounts()[index];
    const bool is_simple =
        amount.parts.size() == 1 &&
        amount.parts.front().function == kinematics::DrawnFactor::Function::itself;
    if (is_simple) {
      const DrawnAmount::Part& part = amount.parts.front();
      const LaneRow<double>& x = w.variables[part.variable];
      for (std::size_t l = 0; l < kLanes; ++l) {
        out.at[l] = amount.value * (x.at[l] + part.shift);
      }
      return;
    }
    for (std::size_t l = 0; l < kLanes; ++l) {
      for (const DrawnAmount::Part& part : amount.parts) {
        w.values[part.variable] = w.variables[part.variable].at[l];
      }
      out.at[l] = amount(w.values);
    }
  }

  void weigh(Workspace& w) const {
    LaneRow<double> size, angle, cosine, sine;
    std::size_t amount_at = std::numeric_limits<std::size_t>::max();
    std::size_t phase_at = amount_at;
    for (std::size_t j = 0; j < w.weights.size(); ++j) {
      if (!live_column[j]) continue;
      const Column& column = set.columns()[j];
      if (column.amount != amount_at) {
        amount_at = column.amount;
        amount(amount_at, w, size);
      }
      LaneRow<double>& out = w.weights[j];
      if (column.wave == Wave::none) {
        out = size;
        continue;
      }
      if (*column.phase != phase_at) {
        phase_at = *column.phase;
        amount(phase_at, w, angle);
        kernels->turns(angle, cosine, sine);
      }
      for (std::size_t l = 0; l < kLanes; ++l) {
        out.at[l] = size.at[l] * (column.wave == Wave::cosine ? cosine.at[l] : -sine.at[l]);
      }
    }
  }

  // Weights of the live columns, a draw after the other.
  static void lay_out(const LanePoints& points, Workspace& w) {
    for (std::size_t k = 0; k < points.columns.size(); ++k) {
      const LaneRow<double>& of = w.weights[points.columns[k]];
      for (std::size_t l = 0; l < kLanes; ++l) w.rows[l * points.width + k] = of.at[l];
    }
    for (std::size_t l = 0; l < kLanes; ++l) {
      for (std::size_t k = points.columns.size(); k < points.width; ++k) {
        w.rows[l * points.width + k] = 0.0;
      }
    }
  }

  [[nodiscard]] double point(const LanePoints& points, const Workspace& w, std::size_t i,
                             std::size_t l) const {
    return points.nominal[i] + kernels->dot(points.gains.data() + i * points.width,
                                            w.rows.data() + l * points.width, points.width);
  }

  // Places of all points that can be an extreme of a lane, in w.places; returns how many.
  std::size_t screen(const LanePoints& c, Workspace& w) const {
    LaneRow<float> square, most, upper, lower;
    for (std::size_t l = 0; l < kLanes; ++l) square.at[l] = most.at[l] = 1.0F;  // of the nominal
    for (std::size_t k = 0; k < c.columns.size(); ++k) {
      const LaneRow<double>& of = w.weights[c.columns[k]];
      const float scale = c.per_weight[k];
      LaneRow<float>& scaled = w.scaled[k];
      for (std::size_t l = 0; l < kLanes; ++l) {
        const float x = static_cast<float>(of.at[l]) * scale;
        scaled.at[l] = x;
        square.at[l] += x * x;
        const float size = x < 0.0F ? -x : x;
        most.at[l] = size > most.at[l] ? size : most.at[l];
      }
    }
    for (std::size_t l = 0; l < kLanes; ++l) w.scaled[c.columns.size()].at[l] = 1.0F;
    kernels->screens(c.screen, w.scaled.data(), w.combinations.data(), w.screens.data(), upper,
                     lower);
    for (std::size_t l = 0; l < kLanes; ++l) {
      // A few units of single precision for the bound's own arithmetic.
      const double bound = 1.00001 * (c.screen.left_out * most.at[l] +
                                      c.screen.rounding * std::sqrt(1.00001 * square.at[l]));
      const double slack = 2.0 * bound + 0x1p-22 * (std::abs(upper.at[l]) + std::abs(lower.at[l]));
      upper.at[l] = static_cast<float>(upper.at[l] - slack);
      lower.at[l] = static_cast<float>(lower.at[l] + slack);
    }
    return kernels->outside(w.screens.data(), c.nominal.size(), upper, lower, w.places.data());
  }

  struct Extremes {
    LaneRow<double> highest, lowest;
  };
  Extremes extremes(const LanePoints& points, Workspace& w) const {
    lay_out(points, w);
    const std::size_t count = screen(points, w);
    Extremes found;
    found.highest.at.fill(-std::numeric_limits<double>::infinity());
    found.lowest.at.fill(std::numeric_limits<double>::infinity());
    for (std::size_t n = 0; n < count; ++n) {
      const std::size_t i = w.places[n] / kLanes, l = w.places[n] % kLanes;
      const double x = point(points, w, i, l);
      found.highest.at[l] = std::max(found.highest.at[l], x);
      found.lowest.at[l] = std::min(found.lowest.at[l], x);
    }
    return found;
  }

  // Of one lane: the square of the longest vector.
  [[nodiscard]] double longest_square(const LaneCharacteristic& c, const Workspace& w,
                                      std::size_t l) const {
    const LanePoints& parts = c.rows.front();
    double longest = 0.0;
    for (std::size_t first = 0; first < parts.nominal.size(); first += c.dimensions) {
      double square = 0.0;
      for (std::size_t i = first; i < first + c.dimensions; ++i) {
        const double x = point(parts, w, i, l);
        square += x * x;
      }
      longest = std::max(longest, square);
    }
    return longest;
  }

  // Values of one characteristic for the weights of the lanes.
  void evaluate(const LaneCharacteristic& c, Workspace& w, LaneRow<double>& out) const {
    if (c.size == Size::range) {
      out.at.fill(0.0);
      for (const LanePoints& row : c.rows) {
        const Extremes found = extremes(row, w);
        for (std::size_t l = 0; l < kLanes; ++l) {
          out.at[l] = std::max(out.at[l], found.highest.at[l] - found.lowest.at[l]);
        }
      }
      return;
    }
    if (c.size == Size::reach) {
      const Extremes found = extremes(c.rows.front(), w);
      for (std::size_t l = 0; l < kLanes; ++l) {
        out.at[l] = c.factor * std::max(found.highest.at[l], -found.lowest.at[l]);
      }
      return;
    }
    lay_out(c.rows.front(), w);
    for (std::size_t l = 0; l < kLanes; ++l) {
      out.at[l] = c.size == Size::sum ? point(c.rows.front(), w, 0, l)
                                      : c.factor * std::sqrt(longest_square(c, w, l));
    }
  }

  // `fill` puts the weights of draws first .. first + 15 into the workspace.
  template <typename Fill>
  [[nodiscard]] std::vector<double> over_draws(std::size_t count, const Fill& fill) const {
    std::vector<double> values(count * characteristics.size());
    const std::size_t blocks = (count + kEngineBlock - 1) / kEngineBlock;
    tbb::parallel_for(std::size_t{0}, blocks, [&](std::size_t block) {
      Workspace w = workspace();
      LaneRow<double> out;
      const std::size_t end = std::min(count, (block + 1) * kEngineBlock);
      for (std::size_t d = block * kEngineBlock; d < end; d += kLanes) {
        fill(d, w);
        for (std::size_t c = 0; c < characteristics.size(); ++c) {
          evaluate(characteristics[c], w, out);
          const std::size_t lanes = std::min(kLanes, end - d);
          std::copy_n(out.at.begin(), lanes,
                      values.begin() + static_cast<std::ptrdiff_t>(c * count + d));
        }
      }
    });
    return values;
  }
};

LinearEngine::LinearEngine(const FactorSet& set, const LinearModel& model, Lanes lanes) {
  auto state = std::make_shared<State>(State{.set = set});
  state->kernels = lanes == Lanes::best ? &best_kernels() : &plain_kernels();
  const std::vector<double> largest = set.largest_weights();
  state->live_column.assign(set.columns().size(), false);
  state->live_variable.assign(set.variables().size(), false);
  for (const LinearCharacteristic& c : model.characteristics) {
    state->characteristics.push_back(std::visit(LanesOf{largest}, c.of));
    for (const LanePoints& row : state->characteristics.back().rows) state->use(row.columns);
  }
  state_ = std::move(state);
}

std::size_t LinearEngine::characteristic_count() const { return state_->characteristics.size(); }

std::vector<double> LinearEngine::evaluate(const Scheme& scheme, std::uint64_t seed,
                                           std::uint32_t first, std::uint32_t count) const {
  return state_->over_draws(count, [&](std::size_t d, Workspace& w) {
    state_->draw(scheme, seed, first + static_cast<std::uint32_t>(d), w);
    state_->weigh(w);
  });
}

std::vector<double> LinearEngine::evaluate_values(std::span<const double> values) const {
  const std::size_t variables = state_->set.variables().size();
  const std::size_t count = values.size() / variables;
  return state_->over_draws(count, [&](std::size_t d, Workspace& w) {
    for (std::size_t l = 0; l < kLanes; ++l) {
      const std::size_t row = std::min(d + l, count - 1);
      for (std::size_t v = 0; v < variables; ++v) {
        w.variables[v].at[l] = values[row * variables + v];
      }
    }
    state_->weigh(w);
  });
}

std::vector<double> LinearEngine::evaluate_weights(std::span<const double> weights) const {
  const std::size_t columns = state_->set.columns().size();
  const std::size_t count = weights.size() / columns;
  return state_->over_draws(count, [&](std::size_t d, Workspace& w) {
    for (std::size_t l = 0; l < kLanes; ++l) {
      const std::size_t row = std::min(d + l, count - 1);
      for (std::size_t j = 0; j < columns; ++j) w.weights[j].at[l] = weights[row * columns + j];
    }
  });
}

LinearEngine::Screen LinearEngine::screen(std::size_t characteristic) const {
  const LanePoints& points = state_->characteristics[characteristic].rows.front();
  return {points.columns.size(), points.screen.rank, points.screen.left_out};
}

}  // namespace frustum::studies

#include "app/benchmark/benchmark_baseline.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>

#include "app/benchmark/benchmark_laws.hpp"
#include "app/benchmark/benchmark_motion.hpp"
#include "app/benchmark/benchmark_points.hpp"
#include "app/job/job.hpp"
#include "core/csv.hpp"
#include "core/linear_algebra.hpp"
#include "metrology/cmm.hpp"
#include "metrology/plan/strategy.hpp"
#include "trials/surface_gain.hpp"
#include "trials/trial.hpp"

namespace frustum::app {
namespace {

namespace fs = std::filesystem;
using kinematics::GeometricErrors;
using kinematics::Machine;

constexpr double kPointNoise = 1.0;   // um
constexpr double kMotionNoise = 0.2;  // um

// A datum or a question, linear in the unknowns: rows of the matrix.
struct Linear {
  Eigen::MatrixXd gain{};    // um per unit of each unknown
  Eigen::VectorXd offset{};  // um, of a machine without errors
};

// The plan without what moves the points: as they are on the table.
metrology::InspectionPlan bare(metrology::InspectionPlan plan) {
  plan.alignment = metrology::Alignment::plan;
  plan.characteristics.clear();
  plan.datum.reset();
  plan.frames.clear();
  return plan;
}

class Baseline {
 public:
  Baseline(fs::path folder, Machine machine, std::vector<BenchmarkUnknown> unknowns)
      : folder_(std::move(folder)), machine_(std::move(machine)), unknowns_(std::move(unknowns)) {
    const auto n = static_cast<Eigen::Index>(unknowns_.size());
    information_ = Eigen::MatrixXd::Zero(n, n);
    right_ = Eigen::VectorXd::Zero(n);
  }

  // Everything in units of the laws' standard deviations, about their means.
  std::optional<Diagnostics> learn(std::string_view method) {
    for (const std::string& piece : benchmark_pieces()) {
      const bool wanted =
          method == "all" || method == piece || (method == "steps" && piece.starts_with("steps"));
      std::error_code failure;
      if (!wanted || !fs::exists(folder_ / piece / "points.csv", failure)) continue;
      if (auto problem = learn_piece(piece)) return problem;
    }
    if (method != "all" && method != "motion") return std::nullopt;
    for (const char* test : {"rtest", "ballbar"}) {
      if (auto problem = learn_motion(test)) return problem;
    }
    return std::nullopt;
  }

  Result<BaselineFiles> predict() {
    solve();
    BaselineFiles files{"id,mean_um,sd_um\n", "name,mean,sd,unit\n"};
    if (auto problem = predict_points(files.predictions)) return *problem;
    if (auto problem = predict_poses(files.predictions)) return *problem;
    for (std::size_t k = 0; k < unknowns_.size(); ++k) {
      const auto at = static_cast<Eigen::Index>(k);
      const BenchmarkUnknown& u = unknowns_[k];
      files.errors += fmt::format("{},{:.6g},{:.6g},{}\n", u.name, u.mean + u.sd * mean_[at],
                                  u.sd * std::sqrt(covariance_(at, at)), u.unit);
    }
    return files;
  }

 private:
  [[nodiscard]] std::string id() const { return folder_.filename().string(); }

  Result<Job> job_of(const std::string& piece) const {
    return load_job(folder_ / piece / "job.toml", {}, true);
  }

  // Of an error-free cut, by what each law does to it.
  Result<Linear> linear_of(const Job& job, const std::string& piece, bool is_given) const {
    trials::TrialOptions options;
    options.find_collisions = false;
    options.time_law = job.controller.time_law;
    options.path_bound = job.path_bound;
    options.servo_lag = job.controller.servo_lag;
    programs::TestPiece bare_piece = job.piece;
    bare_piece.plan = bare(bare_piece.plan);
    const auto trial = trials::run_trial(machine_, GeometricErrors{}, bare_piece, {}, options);
    if (!trial) return trial.error();
    std::vector<trials::Parameter> parameters;
    for (const BenchmarkUnknown& u : unknowns_) {
      // The last one is the tool's radius.
      parameters.push_back({u.name, u.unit == "urad", u.one.value_or(GeometricErrors{})});
    }
    parameters.push_back({std::string(trials::kToolRadius), false, std::nullopt});
    const auto gains = trials::surface_gains(machine_, bare_piece, *trial, parameters);
    if (!gains) return gains.error();
    // Deflection leaves material where something is cut.
    Eigen::VectorXd cut = Eigen::VectorXd::Zero(gains->odd.rows());
    Eigen::Index at = 0;
    for (const auto& feature : trial->measurement.features) {
      for (const auto& touch : feature.touches) {
        cut[at++] = touch.provenance && touch.provenance->segment ? 1.0 : 0.0;
      }
    }
    Linear linear{
        Eigen::MatrixXd::Zero(gains->odd.rows(), static_cast<Eigen::Index>(unknowns_.size())),
        Eigen::VectorXd::Zero(gains->odd.rows())};
    for (std::size_t k = 0; k < unknowns_.size(); ++k) {
      const BenchmarkUnknown& u = unknowns_[k];
      const auto column = static_cast<Eigen::Index>(k);
      const bool acts = u.piece.empty() || (is_given && u.piece == piece);
      if (!acts) continue;
      if (u.one) {
        linear.gain.col(column) = gains->odd.col(column) * (u.unit == "urad" ? 1e-3 : 1.0);
      } else if (u.name.starts_with("radius.")) {
        linear.gain.col(column) = gains->odd.col(gains->odd.cols() - 1);
      } else if (u.name == "deflection") {
        linear.gain.col(column) = cut;
      }
    }
    Eigen::Index row = 0;
    for (std::size_t f = 0; f < bare_piece.plan.features.size(); ++f) {
      const auto planned = metrology::planned_points(bare_piece.plan.features[f]);
      const auto& points = trial->measurement.features[f].points;
      for (std::size_t i = 0; i < points.size(); ++i) {
        linear.offset[row++] =
            kUmPerMm * (points[i].point - planned[i].point).dot(planned[i].normal);
      }
    }
    return linear;
  }

  // One row: what it should be, what it is, um.
  void add_row(const Eigen::RowVectorXd& gain, double offset, double value, double noise) {
    Eigen::RowVectorXd scaled = gain;
    double expected = offset;
    for (std::size_t k = 0; k < unknowns_.size(); ++k) {
      const auto at = static_cast<Eigen::Index>(k);
      expected += gain[at] * unknowns_[k].mean;
      scaled[at] *= unknowns_[k].sd;
    }
    information_ += scaled.transpose() * scaled / (noise * noise);
    right_ += scaled.transpose() * (value - expected) / (noise * noise);
  }

  std::optional<Diagnostics> learn_piece(const std::string& piece) {
    const auto job = job_of(piece);
    if (!job) return job.error();
    const auto linear = linear_of(*job, piece, true);
    if (!linear) return linear.error();
    const auto measured = planned_deviations(job->piece.plan, folder_ / piece / "points.csv");
    if (!measured) return measured.error();
    // A CMM's own lines of points share its errors: a few of them tell as much as all.
    constexpr Eigen::Index kMost = 600;
    const Eigen::Index every = std::max<Eigen::Index>(1, linear->offset.size() / kMost);
    for (Eigen::Index row = 0; row < linear->offset.size(); row += every) {
      const auto& value = (*measured)[static_cast<std::size_t>(row)];
      if (value) add_row(linear->gain.row(row), linear->offset[row], *value, kPointNoise);
    }
    return std::nullopt;
  }

  // Rows of three: the tip's deviation by each unknown.
  Eigen::MatrixXd tip_gain(const kinematics::AxisState& at) const {
    Eigen::MatrixXd gain = Eigen::MatrixXd::Zero(3, static_cast<Eigen::Index>(unknowns_.size()));
    for (std::size_t k = 0; k < unknowns_.size(); ++k) {
      const BenchmarkUnknown& u = unknowns_[k];
      if (!u.one || !u.piece.empty()) continue;
      constexpr double kStep = 1e-3;
      const GeometricErrors one = GeometricErrors{}.plus(*u.one, kStep);
      gain.col(static_cast<Eigen::Index>(k)) =
          tip_deviation(machine_, one, at) / kStep * (u.unit == "urad" ? 1e-3 : 1.0);
    }
    return gain;
  }

  Result<kinematics::AxisPositions> axes_of(const CsvTable& table, const CsvRow& row) const {
    kinematics::AxisPositions q;
    for (std::size_t c = 0; c < table.columns().size(); ++c) {
      const auto letter = kinematics::axis_named(table.columns()[c]);
      if (!letter) continue;
      const auto value = table.number(row, c);
      if (!value) return value.error();
      q[*letter] = *value * (is_rotary(*letter) ? kRadPerDeg : 1.0);
    }
    return q;
  }

  std::optional<Diagnostics> learn_motion(const std::string& test) {
    const auto table = CsvTable::load(folder_ / "motion" / (test + ".csv"), {});
    if (!table) return table.error();
    std::array<std::size_t, 3> column{};
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const auto found = table->column(fmt::format("d{}_um", "xyz"[axis]));
      if (!found) return found.error();
      column[axis] = *found;
    }
    std::vector<kinematics::AxisPositions> places;
    for (const CsvRow& row : table->rows()) {
      const auto q = axes_of(*table, row);
      if (!q) return q.error();
      places.push_back(*q);
    }
    for (std::size_t i = 0; i < places.size(); ++i) {
      kinematics::AxisState at(places[i]);
      // On a circle the neighbours say which way each axis goes.
      if (test == "ballbar") {
        const std::size_t before = i == 0 ? 0 : i - 1, after = std::min(i + 1, places.size() - 1);
        for (const auto letter : kinematics::kLinearAxes) {
          const double step = places[after][letter] - places[before][letter];
          at.heading[letter] = std::abs(step) < 1e-6 ? 0.0 : std::copysign(1.0, step);
        }
      }
      const Eigen::MatrixXd gain = tip_gain(at);
      for (int axis = 0; axis < 3; ++axis) {
        const auto value = table->number(table->rows()[i], column[static_cast<std::size_t>(axis)]);
        if (!value) return value.error();
        add_row(gain.row(axis), 0.0, *value, kMotionNoise);
      }
    }
    return std::nullopt;
  }

  void solve() {
    const Eigen::Index n = right_.size();
    const SymmetricFactors factors(information_ + Eigen::MatrixXd::Identity(n, n));
    mean_ = factors.solve(right_);
    covariance_ = factors.solve(Eigen::MatrixXd(Eigen::MatrixXd::Identity(n, n)));
  }

  // With what is not in the model: servo gains.
  std::string row_of(const std::string& name, const Eigen::RowVectorXd& gain, double offset,
                     double more = 0.0) const {
    Eigen::RowVectorXd scaled = gain;
    double mean = offset;
    for (std::size_t k = 0; k < unknowns_.size(); ++k) {
      const auto at = static_cast<Eigen::Index>(k);
      scaled[at] *= unknowns_[k].sd;
      mean += gain[at] * unknowns_[k].mean;
    }
    mean += scaled.dot(mean_.transpose());
    constexpr double kLeast = 0.05;  // um: first order is no more exact
    const double variance = (scaled * covariance_ * scaled.transpose())(0, 0) + more;
    return fmt::format("{},{:.5f},{:.5f}\n", name, mean, std::sqrt(variance + kLeast * kLeast));
  }

  std::optional<Diagnostics> predict_points(std::string& csv) const {
    const auto questions =
        CsvTable::load(folder_ / "questions.csv", {"id", "piece", "x", "y", "z", "i", "j", "k"});
    if (!questions) return questions.error();
    const auto prior = CsvTable::load(
        folder_.parent_path().parent_path() / "prior" / (id() + ".csv"), {"id", "sd"});
    if (!prior) return prior.error();
    std::map<std::string, double> laws;
    for (const CsvRow& row : prior->rows()) {
      const auto sd = prior->number(row, 1);
      if (!sd) return sd.error();
      laws[row.fields[0].text] = *sd;
    }
    std::map<std::string, std::pair<Job, Linear>> pieces;
    for (const CsvRow& row : questions->rows()) {
      const std::string& piece = row.fields[1].text;
      if (!pieces.contains(piece)) {
        auto job = job_of("questions/" + piece);
        if (!job) return job.error();
        auto linear = linear_of(*job, piece, false);
        if (!linear) return linear.error();
        pieces.emplace(piece, std::pair{*std::move(job), *std::move(linear)});
      }
      const auto& [job, linear] = pieces.at(piece);
      Vec3 point = Vec3::Zero();
      for (std::size_t k = 0; k < 3; ++k) {
        const auto value = questions->number(row, 2 + k);
        if (!value) return value.error();
        point[static_cast<Eigen::Index>(k)] = *value;
      }
      Eigen::Index at = 0, best = 0;
      double nearest = HUGE_VAL;
      for (const auto& feature : job.piece.plan.features) {
        for (const auto& p : metrology::planned_points(feature)) {
          const double away = (p.point - point).squaredNorm();
          if (away < nearest) {
            nearest = away;
            best = at;
          }
          ++at;
        }
      }
      const std::string& name = row.fields[0].text;
      // What the prior says beyond the linear model is the servo gains'.
      double known = 0.0;
      for (std::size_t k = 0; k < unknowns_.size(); ++k) {
        known += std::pow(linear.gain(best, static_cast<Eigen::Index>(k)) * unknowns_[k].sd, 2);
      }
      const double more = std::max(0.0, std::pow(laws[name], 2) - known);
      csv += row_of(name, linear.gain.row(best), linear.offset[best], more);
    }
    return std::nullopt;
  }

  std::optional<Diagnostics> predict_poses(std::string& csv) const {
    const auto table = CsvTable::load(folder_ / "poses.csv", {});
    if (!table) return table.error();
    for (const CsvRow& row : table->rows()) {
      const auto q = axes_of(*table, row);
      if (!q) return q.error();
      const Eigen::MatrixXd gain = tip_gain(*q);
      for (int axis = 0; axis < 3; ++axis) {
        csv += row_of(fmt::format("{}.{}", row.fields[0].text, "xyz"[axis]), gain.row(axis), 0.0);
      }
    }
    return std::nullopt;
  }

  fs::path folder_;
  Machine machine_;
  std::vector<BenchmarkUnknown> unknowns_;
  Eigen::MatrixXd information_{};
  Eigen::VectorXd right_{};
  Eigen::VectorXd mean_{};
  Eigen::MatrixXd covariance_{};
};

}  // namespace

std::string baseline_method(std::string_view method) {
  const std::string_view data = method == "prior" ? "none: the laws alone"
                                : method == "all" ? "all pieces and both motion tests"
                                                  : method;
  return fmt::format(
      "# Our own baseline\n\n"
      "Data used: {}.\n\n"
      "Made by `frustum benchmark baseline BENCHMARK --data {}`: linear Bayes with the laws as\n"
      "prior. Gains are those of an error-free cut, to first order; a measured point has noise of\n"
      "{:g} um, a motion test of {:g} um. Tool radius, drift and deflection of each piece are\n"
      "unknowns; servo gains are not fitted. Of reversal the model knows what changes its sign\n"
      "with it.\n",
      data, method, kPointNoise, kMotionNoise);
}

Result<BaselineFiles> baseline_of(const fs::path& benchmark, const std::string& id,
                                  std::string_view method) {
  const auto entry = std::ranges::find(benchmark_entries(), id, &BenchmarkEntry::id);
  if (entry == benchmark_entries().end()) {
    return error("benchmark-machine"_id, fmt::format("there is no machine '{}'", id), "m01 to m24");
  }
  const fs::path folder = benchmark / "machines" / id;
  auto machine = Machine::load(folder / "machine.toml");
  if (!machine) return std::move(machine).error();
  // The laws alone count: any key names the same unknowns.
  auto unknowns = drawn_unknowns(*machine, entry->level, KeyedNumbers("laws"));
  if (!unknowns) return std::move(unknowns).error();
  Baseline baseline(folder, *std::move(machine), *std::move(unknowns));
  if (auto problem = baseline.learn(method)) return *problem;
  return baseline.predict();
}

}  // namespace frustum::app

#include "dynamics/identification.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>

#include "core/constants.hpp"
#include "core/counted.hpp"
#include "core/general_algebra.hpp"
#include "core/linear_algebra.hpp"
#include "core/spelling.hpp"
#include "dynamics/structure.hpp"

namespace frustum::dynamics {
namespace {

using Complex = std::complex<double>;
using Eigen::Index;
using Eigen::MatrixXcd;
using Eigen::MatrixXd;
using Eigen::VectorXd;

// A parameter takes each number of a model that it stands for.
template <typename Model, typename Visit>
void for_each_number(Model& model, const Visit& visit) {
  constexpr const char* kAxes[] = {"x", "y", "z"};
  for (auto& mount : model.mounts) {
    for (Index i = 0; i < 3; ++i) {
      visit("mount", kAxes[i], mount.stiffness[i], mount.damping[i]);
      if (i < 2) visit("mount", "horizontal", mount.stiffness[i], mount.damping[i]);
    }
  }
  for (auto& axis : model.axes) {
    const std::string letter(1, to_char(axis.joint.letter));
    const auto spring = [&](const char* kind, const char* part, auto& s) {
      visit(letter + "." + kind, part, s.stiffness, s.damping);
    };
    for (auto& carriage : axis.carriages) {
      spring("carriage", "normal", carriage.along_normal);
      spring("carriage", "lateral", carriage.lateral);
    }
    for (auto& bearing : axis.bearings) {
      spring("bearing", "axial", bearing.axial);
      spring("bearing", "radial", bearing.radial);
      spring("bearing", "tilt", bearing.tilt);
    }
    spring("drive", "", axis.drive.spring);
  }
}

struct NamedNumber {
  std::string whole{};  // "mount.stiffness"
  std::string part{};   // "mount.stiffness.z"
};
NamedNumber named(const std::string& connection, const char* part, const char* quantity) {
  const std::string whole = connection + "." + quantity;
  return {whole, *part == '\0' ? whole : whole + "." + part};
}

// One line of one response, and what a factor changes there.
struct Model {
  MatrixXd mass, tip;
  MatrixXd stiffness, damping;  // with all factors 1
  std::vector<MatrixXd> more_stiffness, more_damping;
};

Model model_of(const DynamicModel& model, const kinematics::AxisPositions& q, double tool_length,
               const std::vector<std::string>& names) {
  const Structure s = structure_at(model, q, tool_length);
  Model found{s.mass, s.tip_displacement(), s.stiffness, s.damping, {}, {}};
  for (const std::string& name : names) {
    const Structure twice = structure_at(with_factor(model, name, 2.0), q, tool_length);
    found.more_stiffness.push_back(twice.stiffness - s.stiffness);
    found.more_damping.push_back(twice.damping - s.damping);
  }
  return found;
}

// Residuals ln (measured / computed), magnitude then phase, and their derivatives by ln p.
struct Residuals {
  VectorXd values{};
  MatrixXd jacobian{};
};

// What was measured at one frequency, and the rows that it has.
struct MeasuredAt {
  struct Value {
    Index motion = 0, force = 0;
    Complex compliance{};
    Index row = 0;
  };
  std::vector<Value> values{};
};

class Fit {
 public:
  Fit(Model model, std::span<const FrequencyResponse> measured) : model_(std::move(model)) {
    for (const FrequencyResponse& r : measured) {
      for (std::size_t i = 0; i < r.frequencies.size(); ++i, rows_ += 2) {
        if (r.compliance[i] == 0.0) nothing_at_ = r.frequencies[i];
        lines_[r.frequencies[i]].values.push_back({r.motion, r.force, r.compliance[i], rows_});
      }
    }
  }

  [[nodiscard]] Index residual_count() const { return rows_; }
  // Hz, where a response is 0.
  [[nodiscard]] const std::optional<double>& nothing_at() const { return nothing_at_; }

  [[nodiscard]] Residuals at(const VectorXd& log_factors) const {
    const Index count = log_factors.size();
    const VectorXd factors = log_factors.array().exp();
    MatrixXd k = model_.stiffness, d = model_.damping;
    for (Index p = 0; p < count; ++p) {
      const auto i = static_cast<std::size_t>(p);
      k += (factors[p] - 1.0) * model_.more_stiffness[i];
      d += (factors[p] - 1.0) * model_.more_damping[i];
    }
    Residuals found{VectorXd(rows_), MatrixXd(rows_, count)};
    for (const auto& [frequency, measured] : lines_) {
      line(found, frequency, measured, k, d, factors);
    }
    return found;
  }

 private:
  void line(Residuals& found, double frequency, const MeasuredAt& measured, const MatrixXd& k,
            const MatrixXd& d, const VectorXd& factors) const {
    const double w = kTurn * frequency;
    MatrixXcd z(k.rows(), k.cols());
    z.real() = k - w * w * model_.mass;
    z.imag() = w * d;
    // Z is symmetric: one solution serves both sides of dZ.
    const MatrixXcd x = complex_solution(z, model_.tip.transpose().cast<Complex>());
    const MatrixXcd compliance = model_.tip.cast<Complex>() * x;
    for (const MeasuredAt::Value& v : measured.values) {
      const Complex off = std::log(v.compliance / compliance(v.motion, v.force));
      found.values[v.row] = off.real();
      found.values[v.row + 1] = off.imag();
    }
    const MatrixXd real = x.real(), imaginary = x.imag();
    // x^T A x of a real symmetric A.
    const auto between = [&](const MatrixXd& a) {
      const MatrixXd ar = a * real, ai = a * imaginary;
      MatrixXcd product(3, 3);
      product.real() = real.transpose() * ar - imaginary.transpose() * ai;
      product.imag() = real.transpose() * ai + imaginary.transpose() * ar;
      return product;
    };
    for (Index p = 0; p < factors.size(); ++p) {
      const auto n = static_cast<std::size_t>(p);
      const MatrixXcd change = factors[p] * (between(model_.more_stiffness[n]) +
                                             Complex(0.0, w) * between(model_.more_damping[n]));
      // d ln(measured / computed) = -dG / G = x^T dZ x / G.
      for (const MeasuredAt::Value& v : measured.values) {
        const Complex rate = change(v.motion, v.force) / compliance(v.motion, v.force);
        found.jacobian(v.row, p) = rate.real();
        found.jacobian(v.row + 1, p) = rate.imag();
      }
    }
  }

  Model model_;
  std::map<double, MeasuredAt> lines_{};  // by frequency
  Index rows_ = 0;
  std::optional<double> nothing_at_{};
};

struct Solution {
  VectorXd log_factors{};
  Residuals residuals{};
  bool converged = false;
};

Solution solve(const Fit& fit, Index count) {
  Solution now{VectorXd::Zero(count), fit.at(VectorXd::Zero(count)), false};
  double damping = 1e-3;
  constexpr int kMostSteps = 200;
  for (int step = 0; step < kMostSteps && !now.converged; ++step) {
    const MatrixXd normal = now.residuals.jacobian.transpose() * now.residuals.jacobian;
    const VectorXd gradient = now.residuals.jacobian.transpose() * now.residuals.values;
    MatrixXd damped = normal;
    damped.diagonal() *= 1.0 + damping;
    damped.diagonal().array() += 1e-12 * normal.diagonal().maxCoeff();
    // Not more than by a factor of e at once.
    VectorXd move = -SymmetricFactors(damped).solve(gradient);
    const double most = move.cwiseAbs().maxCoeff();
    if (most > 1.0) move /= most;
    const VectorXd next = now.log_factors + move;
    Residuals there = fit.at(next);
    const double before = now.residuals.values.squaredNorm();
    const double after = there.values.squaredNorm();
    if (!(after <= before)) {
      damping *= 10.0;
      // Nothing better is near: rounding, where the step is small.
      now.converged = damping > 1e12;
      continue;
    }
    damping = std::max(damping / 10.0, 1e-12);
    constexpr double kSettled = 1e-9;  // of ln p: far below any uncertainty
    now.converged = most < kSettled;
    now.log_factors = next;
    now.residuals = std::move(there);
  }
  return now;
}

// Combinations whose standard uncertainty is a factor of e and more.
std::vector<std::vector<std::string>> unseen_combinations(const MatrixXd& jacobian, double noise,
                                                          const std::vector<std::string>& names) {
  const SymmetricEigen normal = symmetric_eigen(jacobian.transpose() * jacobian);
  std::vector<std::vector<std::string>> combinations;
  for (Index k = 0; k < normal.values.size(); ++k) {
    const double rounding = 1e-14 * normal.values[normal.values.size() - 1];
    if (normal.values[k] > std::max(noise * noise, rounding)) continue;
    std::vector<std::pair<double, std::string>> shares;
    for (Index p = 0; p < normal.vectors.rows(); ++p) {
      const double share = std::abs(normal.vectors(p, k));
      if (share > 0.1) shares.emplace_back(share, names[static_cast<std::size_t>(p)]);
    }
    std::ranges::sort(shares, std::greater{}, [](const auto& s) { return s.first; });
    std::vector<std::string> combination;
    for (auto& [share, name] : shares) combination.push_back(std::move(name));
    combinations.push_back(std::move(combination));
  }
  return combinations;
}

bool overlap(const DynamicModel& model, const std::string& a, const std::string& b) {
  bool found = false;
  for_each_number(model, [&](const std::string& connection, const char* part, double, double) {
    for (const char* quantity : {"stiffness", "damping"}) {
      const NamedNumber number = named(connection, part, quantity);
      const auto stands = [&](const std::string& name) {
        return name == number.whole || name == number.part ||
               (std::string_view(part) != "z" && std::string_view(part).size() == 1 &&
                name == connection + "." + quantity + ".horizontal");
      };
      found = found || (stands(a) && stands(b));
    }
  });
  return found;
}

std::optional<Diagnostic> refused(const DynamicModel& model, const Fit& fit,
                                  const std::vector<std::string>& names) {
  const auto known = parameter_names(model);
  for (std::size_t i = 0; i < names.size(); ++i) {
    if (std::ranges::find(known, names[i]) == known.end()) {
      return error("unknown-parameter"_id,
                   fmt::format("machine {} has no parameter '{}'", model.name, names[i]),
                   suggestion(names[i], known));
    }
    if (std::find(names.begin(), names.begin() + static_cast<std::ptrdiff_t>(i), names[i]) !=
        names.begin() + static_cast<std::ptrdiff_t>(i)) {
      return error("given-twice"_id, fmt::format("parameter {} is given twice", names[i]));
    }
  }
  for (std::size_t i = 0; i < names.size(); ++i) {
    for (std::size_t k = 0; k < i; ++k) {
      if (!overlap(model, names[k], names[i])) continue;
      return error(
          "given-twice"_id,
          fmt::format("parameters {} and {} stand for the same numbers", names[k], names[i]),
          "name the parts of a connection, or the whole of it");
    }
  }
  if (model.is_controlled()) {
    return error(
        "wrong-connection"_id,
        fmt::format("the drives of machine {} are controlled: what is identified are the "
                    "springs of drives",
                    model.name),
        "take the control tables out of the machine file, and measure with the drives off");
  }
  if (fit.nothing_at()) {
    return error("out-of-range"_id,
                 fmt::format("a response of 0 at {:g} Hz has no phase", *fit.nothing_at()),
                 "leave that line out of the file");
  }
  if (names.empty() || fit.residual_count() <= static_cast<Index>(names.size())) {
    return error(
        "too-few-values"_id,
        fmt::format("{} for {}",
                    counted(static_cast<std::size_t>(fit.residual_count()) / 2, "measured line"),
                    counted(names.size(), "parameter")),
        "give more lines, or fewer parameters");
  }
  return std::nullopt;
}

}  // namespace

std::vector<std::string> parameter_names(const DynamicModel& model) {
  std::vector<std::string> names;
  const auto add = [&](const std::string& name) {
    if (std::ranges::find(names, name) == names.end()) names.push_back(name);
  };
  for_each_number(model, [&](const std::string& connection, const char* part, double stiffness,
                             double damping) {
    for (const auto& [quantity, value] :
         {std::pair{"stiffness", stiffness}, std::pair{"damping", damping}}) {
      if (value == 0.0) continue;
      const NamedNumber number = named(connection, part, quantity);
      add(number.whole);
      add(number.part);
    }
  });
  return names;
}

DynamicModel with_factor(const DynamicModel& model, const std::string& name, double factor) {
  DynamicModel changed = model;
  for_each_number(changed, [&](const std::string& connection, const char* part, double& stiffness,
                               double& damping) {
    // Horizontal is x and y once more.
    const bool again = std::string_view(part) == "horizontal";
    const NamedNumber k = named(connection, part, "stiffness");
    const NamedNumber d = named(connection, part, "damping");
    if (name == k.part || (name == k.whole && !again)) stiffness *= factor;
    if (name == d.part || (name == d.whole && !again)) damping *= factor;
  });
  return changed;
}

Result<Identification> identify_parameters(const DynamicModel& model,
                                           const kinematics::AxisPositions& q, double tool_length,
                                           std::span<const FrequencyResponse> measured,
                                           const std::vector<std::string>& names) {
  const Fit fit(model_of(model, q, tool_length, names), measured);
  if (auto problem = refused(model, fit, names)) return *std::move(problem);
  const auto count = static_cast<Index>(names.size());
  const Solution solution = solve(fit, count);
  if (!solution.converged || !solution.log_factors.allFinite()) {
    // What the responses do not show drifts away.
    const double left = solution.residuals.values.norm() /
                        std::sqrt(static_cast<double>(fit.residual_count() - count));
    const auto unseen = unseen_combinations(fit.at(VectorXd::Zero(count)).jacobian, left, names);
    if (!unseen.empty()) {
      return error(
          "not-separated"_id,
          unseen.front().size() == 1
              ? fmt::format("the responses show nothing of {}", unseen.front().front())
              : fmt::format("the responses do not separate {}", fmt::join(unseen.front(), " and ")),
          "leave it out, or measure nearer to the modes in which it yields");
    }
    return error("not-converged"_id, "no parameters explain the measured responses",
                 "check units and directions of the file, or name other parameters");
  }
  Identification found{.model = model};
  const auto freedom = static_cast<double>(fit.residual_count() - count);
  found.noise = std::sqrt(solution.residuals.values.squaredNorm() / freedom);
  const MatrixXd& jacobian = solution.residuals.jacobian;
  found.not_separated = unseen_combinations(jacobian, found.noise, names);
  const MatrixXd inverse = SymmetricFactors(jacobian.transpose() * jacobian)
                               .solve(MatrixXd(MatrixXd::Identity(count, count)));
  constexpr double kTwoSided95 = 1.959964;  // of the normal law: there are hundreds of lines
  for (Index p = 0; p < count; ++p) {
    const double sd = found.noise * std::sqrt(std::abs(inverse(p, p)));
    const double at = solution.log_factors[p];
    found.parameters.push_back({names[static_cast<std::size_t>(p)], std::exp(at), sd,
                                std::exp(at - kTwoSided95 * sd), std::exp(at + kTwoSided95 * sd)});
    found.model = with_factor(found.model, names[static_cast<std::size_t>(p)], std::exp(at));
  }
  return found;
}

}  // namespace frustum::dynamics

// Random machines cut and measured for real, their errors found again from what a CMM with noise
// says.
#include <gtest/gtest.h>

#include <fmt/format.h>

#include <cmath>
#include <map>

#include "calibration/identify/piece_observations.hpp"
#include "core/random.hpp"
#include "metrology/characteristic/characteristic.hpp"
#include "programs/step/step_pattern.hpp"
#include "tests/law_count.hpp"
#include "trials/trial.hpp"

namespace frustum::calibration {
namespace {

using kinematics::GeometricErrors;
using kinematics::Machine;

constexpr int kBlindMachines = 10;
constexpr int kFewBlindMachines = 2;       // of `make test`
constexpr int kMeasurements = 100;         // on each machine
constexpr double kSquarenessPrior = 5e-6;  // rad

constexpr const char* kAngles[] = {"alpha_AY", "beta_AY", "gamma_AY", "beta_CA"};
constexpr const char* kOffsets[] = {"dx_AY", "dy_AY", "dz_AY", "dy_CA"};
constexpr const char* kSquarenessNames[] = {"gamma_YX", "alpha_ZY", "beta_ZX"};

Machine tilting_table() {
  auto machine = Machine::load(std::string(FRUSTUM_SOURCE_DIR) + "/machines/zx-yac.toml");
  EXPECT_TRUE(machine);
  return *machine;
}

metrology::CmmModel cmm_of_draw(std::uint32_t draw) {
  metrology::CmmModel cmm;
  cmm.e0_mm = 0.5e-3;
  cmm.length_per_error = 600.0;
  cmm.seed = 2010;
  cmm.draw = draw;
  return cmm;
}

// All eleven patterns take three workpieces.
std::vector<programs::TestPiece> workpieces(const Machine& machine) {
  std::vector<programs::TestPiece> pieces;
  for (const auto& [number, patterns] :
       {std::pair<int, std::vector<std::string>>{1, {}}, {2, {}}, {2, {"4"}}}) {
    programs::StepTest test;
    test.workpiece = *programs::step_workpiece(number);
    test.patterns = patterns;
    auto made = programs::step_pattern(test, machine);
    EXPECT_TRUE(made);
    pieces.push_back(made->piece);
  }
  return pieces;
}

double draw(int machine, std::uint64_t index, double deviation) {
  return deviation * normal({.seed = 61, .draw = static_cast<std::uint32_t>(machine)}, index);
}

// What is to be found, in the order of the unknowns, and its true value on a random machine.
struct Truth {
  std::vector<std::string> names{};
  Eigen::VectorXd values{};
};

Truth random_machine(int number) {
  Truth truth;
  std::vector<double> values;
  const auto add = [&](const char* name, double deviation) {
    values.push_back(draw(number, values.size(), deviation));
    truth.names.emplace_back(name);
  };
  for (const char* name : kAngles) add(name, 30e-6);
  for (const char* name : kOffsets) add(name, 15e-3);
  for (const char* name : kSquarenessNames) add(name, 50e-6);
  add("tool_radius_error", 10e-3);
  truth.values =
      Eigen::Map<Eigen::VectorXd>(values.data(), static_cast<Eigen::Index>(values.size()));
  return truth;
}

// The noise-free answers of a workpiece, so that repeated measurements ask each contact once.
class RememberedProbe {
 public:
  explicit RememberedProbe(const stock::Workpiece& workpiece) : probe_(workpiece) {}

  [[nodiscard]] std::optional<metrology::Touch> touch(const Vec3& start, const UnitVec3& direction,
                                                      double length) const {
    const std::array<double, 7> key{
        start.x(),           start.y(),           start.z(),          length,
        direction.vec().x(), direction.vec().y(), direction.vec().z()};
    const auto known = answers_.find(key);
    if (known != answers_.end()) return known->second;
    return answers_.emplace(key, probe_.touch(start, direction, length)).first->second;
  }

 private:
  trials::WorkpieceProbe probe_;
  mutable std::map<std::array<double, 7>, std::optional<metrology::Touch>> answers_{};
};

// One machine: its parts cut once, ready to be measured again and again.
class BlindMachine {
 public:
  BlindMachine(const Machine& machine, const std::vector<programs::TestPiece>& pieces, int number)
      : truth_(random_machine(number)), pieces_(pieces), number_(number) {
    GeometricErrors errors;
    for (std::size_t k = 0; k + 1 < truth_.names.size(); ++k) {
      const auto parameter = trials::Parameter::named(machine, truth_.names[k]);
      errors = errors.plus(*parameter->unit, truth_.values[static_cast<Eigen::Index>(k)]);
    }
    for (programs::TestPiece piece : pieces) {
      for (auto& [tool, spec] : piece.tools) {
        spec.radius_error.value = truth_.values[truth_.values.size() - 1];
      }
      trials::TrialOptions options;
      options.find_collisions = false;
      options.measure = false;
      auto trial = trials::run_trial(machine, errors, piece, {}, options);
      EXPECT_TRUE(trial);
      workpieces_.push_back(trial->workpiece);
      probes_.emplace_back(*workpieces_.back());
    }
  }

  [[nodiscard]] const Truth& truth() const { return truth_; }

  // What a laboratory reports of part `piece` the `repetition`-th time.
  [[nodiscard]] MeasuredPart measured(std::size_t piece, int repetition) const {
    const auto index = static_cast<std::uint32_t>((number_ * kMeasurements + repetition) *
                                                  static_cast<int>(pieces_.size())) +
                       piece;
    const auto measurement = metrology::measure(pieces_[piece].plan, probes_[piece],
                                                cmm_of_draw(static_cast<std::uint32_t>(index)));
    EXPECT_TRUE(measurement);
    MeasuredPart part;
    for (const auto& c : measurement->characteristics) {
      part.emplace(c.name, MeasuredValue{metrology::internal_value(c), {}});
    }
    return part;
  }
  // Squareness as somebody measured it beforehand.
  [[nodiscard]] double known_before(std::size_t unknown, int repetition) const {
    const auto index = static_cast<std::uint64_t>(1000 + 16 * repetition) + unknown;
    return truth_.values[static_cast<Eigen::Index>(unknown)] +
           draw(number_, index, kSquarenessPrior);
  }

 private:
  Truth truth_;
  const std::vector<programs::TestPiece>& pieces_;
  int number_;
  std::vector<std::shared_ptr<const stock::Workpiece>> workpieces_{};
  std::vector<RememberedProbe> probes_{};
};

std::vector<Unknown> unknowns_of(const BlindMachine& machine, int repetition) {
  std::vector<Unknown> unknowns;
  for (std::size_t k = 0; k < machine.truth().names.size(); ++k) {
    const std::string& name = machine.truth().names[k];
    Unknown unknown{.name = name, .angular = k < 4 || (k >= 8 && k < 11)};
    if (k >= 8 && k < 11) {
      unknown.prior = Prior{machine.known_before(k, repetition), kSquarenessPrior};
    }
    unknowns.push_back(unknown);
  }
  return unknowns;
}

std::vector<Cause> causes_of(const Machine& machine, const Truth& truth) {
  std::vector<Cause> causes;
  for (const std::string& name : truth.names) {
    causes.push_back({*trials::Parameter::named(machine, name), std::nullopt});
  }
  return causes;
}

// Linear about the point where the whole trials settled.
Model linear_about(const Eigen::VectorXd& x0, const Prediction& at) {
  return [x0, at](const Eigen::VectorXd& x) -> Result<Prediction> {
    return Prediction{at.values + at.gain * (x - x0), at.gain};
  };
}

struct Score {
  int covered = 0, repetitions = 0;
  double deviation_sum = 0.0;  // of estimates from the truth, in standard uncertainties
};

TEST(BlindRoundTripLaws, IntervalsHoldAndEstimatesAreNotBiased) {
  const Machine machine = tilting_table();
  const std::vector<programs::TestPiece> pieces = workpieces(machine);
  std::vector<Score> scores;
  const int machines = proof::law_count(kBlindMachines, kFewBlindMachines);
  for (int number = 0; number < machines; ++number) {
    const BlindMachine blind(machine, pieces, number);
    scores.resize(blind.truth().names.size());
    const std::vector<Cause> causes = causes_of(machine, blind.truth());
    const auto input = [&](int repetition) {
      std::vector<MeasuredPiece> measured;
      for (std::size_t i = 0; i < pieces.size(); ++i) {
        MeasuredPiece piece;
        piece.name = fmt::format("workpiece {}", i + 1);
        piece.piece = pieces[i];
        piece.parts = {blind.measured(i, repetition)};
        piece.cmm = cmm_of_draw(0);
        measured.push_back(std::move(piece));
      }
      return measured;
    };
    // The first measurement by reruns of whole trials; the others about where those settled, which
    // is within a few standard uncertainties of where theirs would.
    const auto first = observations_of(machine, input(0), unknowns_of(blind, 0), causes);
    ASSERT_TRUE(first) << to_string(first.error().front());
    const auto settled = refine(first->observations, first->model);
    ASSERT_TRUE(settled) << to_string(settled.error().front());
    EXPECT_LE(settled->changes.size(), 5U);
    const Eigen::VectorXd x0 = settled->identification.working_point;
    const auto at = first->model(x0);
    ASSERT_TRUE(at);
    Observations observations = first->observations;
    for (int repetition = 0; repetition < kMeasurements; ++repetition) {
      observations.unknowns = unknowns_of(blind, repetition);
      Eigen::Index row = 0;
      for (std::size_t i = 0; i < pieces.size(); ++i) {
        const MeasuredPart part = blind.measured(i, repetition);
        for (const auto& c : pieces[i].plan.characteristics) {
          observations.values[row++] = part.at(c.name).value;
        }
      }
      const auto found = refine(observations, linear_about(x0, *at));
      ASSERT_TRUE(found);
      for (std::size_t k = 0; k < scores.size(); ++k) {
        const Estimate& e = found->identification.estimates[k];
        const double truth = blind.truth().values[static_cast<Eigen::Index>(k)];
        ++scores[k].repetitions;
        if (truth >= *e.lower && truth <= *e.upper) ++scores[k].covered;
        scores[k].deviation_sum += (*e.value - truth) / *e.standard_uncertainty;
      }
    }
    if (number == 0) {
      // Whole trials for the last measurement too: the shortcut costs nothing.
      const auto last = observations_of(machine, input(kMeasurements - 1),
                                        unknowns_of(blind, kMeasurements - 1), causes);
      const auto whole = refine(last->observations, last->model);
      const auto shortcut = refine(observations, linear_about(x0, *at));
      ASSERT_TRUE(whole && shortcut);
      for (std::size_t k = 0; k < scores.size(); ++k) {
        const Estimate& a = whole->identification.estimates[k];
        const Estimate& b = shortcut->identification.estimates[k];
        EXPECT_NEAR(*a.value, *b.value, 0.01 * *a.standard_uncertainty) << a.name;
      }
    }
  }
  const Truth names = random_machine(0);
  // Fewer machines scatter by the root of their share.
  const double scatter = std::sqrt(static_cast<double>(kBlindMachines) / machines);
  for (std::size_t k = 0; k < scores.size(); ++k) {
    const double rate = static_cast<double>(scores[k].covered) / scores[k].repetitions;
    const double bias = scores[k].deviation_sum / scores[k].repetitions;
    EXPECT_GE(rate, 0.95 - 0.05 * scatter) << names.names[k];
    EXPECT_LE(rate, 0.95 + 0.035 * scatter) << names.names[k];
    // 1000 repetitions leave 0.032 of a standard uncertainty to chance.
    EXPECT_LT(std::abs(bias), 0.1 * scatter) << names.names[k];
    RecordProperty(names.names[k], fmt::format("{:.1f} %, bias {:+.3f}", 100.0 * rate, bias));
  }
}

}  // namespace
}  // namespace frustum::calibration

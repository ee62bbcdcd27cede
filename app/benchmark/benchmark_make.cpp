#include "app/benchmark/benchmark_make.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <nlohmann/json.hpp>
#include <numbers>

#include "app/benchmark/benchmark_motion.hpp"
#include "app/benchmark/benchmark_pieces.hpp"
#include "app/job/machine_files.hpp"
#include "core/sha256.hpp"
#include "core/toml_edit.hpp"
#include "core/whole_file.hpp"
#include "metrology/plan/strategy.hpp"
#include "programs/test_piece_files.hpp"
#include "trials/surface_gain.hpp"
#include "trials/trial.hpp"

namespace frustum::app {
namespace {

using kinematics::AxisLetter;
using kinematics::AxisPositions;
using kinematics::GeometricErrors;
using kinematics::Machine;
using programs::TestPiece;

// A point that is asked, or probed.
struct AskedPoint {
  std::string id{}, piece{};
  Vec3 point = Vec3::Zero(), normal = Vec3::UnitZ();
  std::size_t feature = 0, index = 0;  // in the plan of its piece
};

// um, urad or 1/s; finer than any question can be answered.
double to_a_millionth(double value) {
  constexpr double kSteps = 1e6;
  return std::round(value * kSteps) / kSteps + 0.0;  // no negative zero
}

class Maker {
 public:
  Maker(const BenchmarkEntry& entry, std::string machine_text, Machine machine,
        KeyedNumbers numbers, std::vector<BenchmarkUnknown> unknowns)
      : entry_(entry),
        machine_text_(std::move(machine_text)),
        nominal_(std::move(machine)),
        actual_(nominal_),
        numbers_(std::move(numbers)),
        unknowns_(std::move(unknowns)) {}

  Result<BenchmarkFiles> files() {
    if (auto problem = set_gains()) return *problem;
    add(entry_.id + "/machine.toml", machine_text_);
    add(entry_.id + "/laws.csv", laws_csv());
    for (const std::string& piece : benchmark_pieces()) {
      if (auto problem = given(piece)) return *problem;
    }
    motion();
    if (auto problem = questions()) return *problem;
    std::string prior = "id,sd\n";
    for (const auto& [id, sd] : prior_) prior += fmt::format("{},{:.9g}\n", id, sd);
    for (const BenchmarkUnknown& u : unknowns_) {
      prior += fmt::format("{},{:.9g}\n", u.name, u.sd);
      answers_["errors"][u.name] = u.value;
    }
    files_["prior/" + entry_.id + ".csv"] = std::move(prior);
    // What is committed must not hang on the last digits that another compiler makes.
    for (const char* kind : {"points", "poses", "errors"}) {
      for (auto& [id, value] : answers_[kind].items()) value = to_a_millionth(value.get<double>());
    }
    answers_["key"] = numbers_.key();
    files_["answers/" + entry_.id + ".json"] = answers_.dump() + "\n";
    return std::move(files_);
  }

 private:
  [[nodiscard]] bool lags() const { return entry_.level == BenchmarkLevel::motion; }
  void add(const std::string& name, std::string bytes) {
    files_["machines/" + name] = std::move(bytes);
  }

  [[nodiscard]] const BenchmarkUnknown* find(const std::string& name) const {
    for (const BenchmarkUnknown& u : unknowns_) {
      if (u.name == name) return &u;
    }
    return nullptr;
  }
  [[nodiscard]] double deflection() const {
    const BenchmarkUnknown* found = find("deflection");
    return found == nullptr ? 0.0 : found->internal();
  }

  std::string laws_csv() const {
    std::string csv = "name,unit,mean,sd\n";
    for (const BenchmarkUnknown& u : unknowns_) {
      csv += fmt::format("{},{},{:.9g},{:.9g}\n", u.name, u.unit, u.mean, u.sd);
    }
    return csv;
  }

  Result<Machine> with_gain_changes(const std::map<char, double>& changes) const {
    TomlChanges edits;
    for (const auto& [letter, change] : changes) {
      const double gain =
          nominal_.joint(*kinematics::axis_named(std::string(1, letter)))->dynamics.servo_gain;
      edits.replaced.emplace_back(fmt::format("axis.{}.servo_gain", letter),
                                  fmt::format("{}", gain + change));
    }
    const auto text = changed_toml(machine_text_, edits);
    if (!text) return text.error();
    return Machine::read(*text, entry_.machine + ".toml");
  }
  std::optional<Diagnostics> set_gains() {
    if (!lags()) return std::nullopt;
    std::map<char, double> changes;
    for (const BenchmarkUnknown& u : unknowns_) {
      if (u.name.starts_with("gain.")) changes[u.name.back()] = u.value;
    }
    auto machine = with_gain_changes(changes);
    if (!machine) return machine.error();
    actual_ = *std::move(machine);
    return std::nullopt;
  }

  // Those of the machine, and of one piece where it is named.
  [[nodiscard]] GeometricErrors errors_of(const std::string& piece) const {
    GeometricErrors errors;
    for (const BenchmarkUnknown& u : unknowns_) {
      if (u.one && (u.piece.empty() || u.piece == piece)) {
        errors = errors.plus(*u.one, u.internal());
      }
    }
    return errors;
  }

  [[nodiscard]] trials::TrialOptions options() const {
    trials::TrialOptions options;
    options.find_collisions = false;
    options.servo_lag = lags();
    // As the jobs say, where axes that lag make paths dense.
    if (lags()) options.path_bound = 1e-4;  // mm
    return options;
  }

  // With the job as participants run it. The same keys make the same bytes with every version.
  void add_piece(const std::string& folder, const TestPiece& piece, const std::string& machine) {
    for (auto& [name, bytes] :
         programs::test_piece_files(piece, machine, programs::Maker::left_out)) {
      if (name == "job.toml" && lags()) {
        bytes +=
            "\n[controller]\ntime_law = false\nservo_lag = true\n\n[accuracy]\npath_bound = \"0.1 "
            "um\"\n";
      }
      add(folder + "/" + name, std::move(bytes));
    }
  }

  // Not on the blank's own surface.
  static bool is_cut(const metrology::MeasuredFeature& feature, std::size_t point) {
    const auto& provenance = feature.touches[point].provenance;
    return provenance && provenance->segment;
  }

  // A piece as it was cut and measured.
  std::optional<Diagnostics> given(const std::string& name) {
    const auto made = benchmark_piece(name, entry_.machine, nominal_, false);
    if (!made) return made.error();
    if (!*made) return std::nullopt;
    TestPiece piece = **made;
    add_piece(entry_.id + "/" + name, piece, "../machine.toml");
    const BenchmarkUnknown* radius = find("radius." + name);
    for (auto& [number, tool] : piece.tools) tool.radius_error.value += radius->internal();
    metrology::CmmModel cmm;
    cmm.kind = metrology::CmmKind::field;
    cmm.e0_mm = (0.5 + numbers_.uniform("cmm e0")) / kUmPerMm;
    cmm.length_per_error = 600.0;
    cmm.seed = numbers_.seed("cmm");
    cmm.draw = static_cast<std::uint32_t>(numbers_.seed("cmm " + name));
    const auto trial = trials::run_trial(actual_, errors_of(name), piece, cmm, options());
    if (!trial) return trial.error();
    // As it comes off the CMM: in the workpiece frame.
    std::string csv = "feature,section,x,y,z\n";
    const Pose& workpiece_from_datum = trial->measurement.workpiece_from_datum;
    for (const auto& feature : trial->measurement.features) {
      for (std::size_t i = 0; i < feature.points.size(); ++i) {
        const auto& p = feature.points[i];
        const double left = is_cut(feature, i) ? deflection() : 0.0;
        const Vec3 at = workpiece_from_datum.point(p.point + left * p.normal);
        csv += fmt::format("{},{},{:.7f},{:.7f},{:.7f}\n", feature.name, p.section, at.x(), at.y(),
                           at.z());
      }
    }
    add(entry_.id + "/" + name + "/points.csv", std::move(csv));
    return std::nullopt;
  }

  void motion() {
    const GeometricErrors errors = errors_of("");
    add(entry_.id + "/motion/rtest.csv", rtest_csv(nominal_, errors, numbers_));
    add(entry_.id + "/motion/ballbar.csv", ballbar_csv(nominal_, errors, numbers_));
  }

  // Pieces that nobody has measured, and poses.
  std::optional<Diagnostics> questions() {
    std::string csv = "id,piece,x,y,z,i,j,k\n";
    const std::array<std::pair<const char*, std::size_t>, 3> pieces{
        {{"cone", 80}, {"s-piece", 70}, {"contour", 50}}};
    std::size_t number = 0;
    for (const auto& [name, count] : pieces) {
      const auto made = benchmark_piece(name, entry_.machine, nominal_, true);
      if (!made) return made.error();
      TestPiece piece = **made;
      add_piece(fmt::format("{}/questions/{}", entry_.id, name), piece, "../../machine.toml");
      // Where the plan means the points to be, whatever the part.
      piece.plan.alignment = metrology::Alignment::plan;
      piece.plan.characteristics.clear();
      piece.plan.datum.reset();
      piece.plan.frames.clear();
      const auto nominal = trials::run_trial(nominal_, GeometricErrors{}, piece, {}, options());
      if (!nominal) return nominal.error();
      const std::vector<AskedPoint> asked = chosen(piece, *nominal, name, count, number);
      for (const AskedPoint& a : asked) {
        csv += fmt::format("{},{},{:.6f},{:.6f},{:.6f},{:.9f},{:.9f},{:.9f}\n", a.id, name,
                           a.point.x(), a.point.y(), a.point.z(), a.normal.x(), a.normal.y(),
                           a.normal.z());
      }
      if (auto problem = answer(piece, *nominal, asked)) return problem;
    }
    add(entry_.id + "/questions.csv", std::move(csv));
    poses();
    return std::nullopt;
  }

  static std::vector<AskedPoint> chosen(const TestPiece& piece, const trials::Trial& nominal,
                                        const std::string& name, std::size_t count,
                                        std::size_t& number) {
    std::vector<AskedPoint> all;
    for (std::size_t f = 0; f < piece.plan.features.size(); ++f) {
      const auto points = metrology::planned_points(piece.plan.features[f]);
      for (std::size_t i = 0; i < points.size(); ++i) {
        if (!is_cut(nominal.measurement.features[f], i)) continue;
        all.push_back({"", name, points[i].point, points[i].normal, f, i});
      }
    }
    std::vector<AskedPoint> asked;
    for (std::size_t i = 0; i < count; ++i) {
      asked.push_back(all[(2 * i + 1) * all.size() / (2 * count)]);
      asked.back().id = fmt::format("q{:03}", ++number);
    }
    return asked;
  }

  // Deviation of the asked points, um, along their normals.
  static std::vector<double> deviations(const trials::Trial& trial,
                                        const std::vector<AskedPoint>& asked) {
    std::vector<double> found;
    for (const AskedPoint& a : asked) {
      const auto& p = trial.measurement.features[a.feature].points[a.index];
      found.push_back(kUmPerMm * (p.point - a.point).dot(a.normal));
    }
    return found;
  }

  // True values, and what the laws let expect.
  std::optional<Diagnostics> answer(const TestPiece& piece, const trials::Trial& nominal,
                                    const std::vector<AskedPoint>& asked) {
    const auto truth = trials::run_trial(actual_, errors_of(""), piece, {}, options());
    if (!truth) return truth.error();
    const std::vector<double> values = deviations(*truth, asked);
    for (std::size_t i = 0; i < asked.size(); ++i) {
      answers_["points"][asked[i].id] = values[i] + kUmPerMm * deflection();
    }
    std::vector<trials::Parameter> parameters;
    std::vector<const BenchmarkUnknown*> laws;
    for (const BenchmarkUnknown& u : unknowns_) {
      if (!u.one || !u.piece.empty()) continue;
      parameters.push_back({u.name, u.unit == "urad", u.one});
      laws.push_back(&u);
    }
    const auto gains = trials::surface_gains(nominal_, piece, nominal, parameters);
    if (!gains) return gains.error();
    std::vector<std::size_t> first;  // row of each feature
    std::size_t rows = 0;
    for (const auto& feature : nominal.measurement.features) {
      first.push_back(rows);
      rows += feature.points.size();
    }
    std::vector<double> variance(asked.size(), 0.0);
    for (std::size_t i = 0; i < asked.size(); ++i) {
      const auto row = static_cast<Eigen::Index>(first[asked[i].feature] + asked[i].index);
      for (std::size_t k = 0; k < laws.size(); ++k) {
        // um per um, or per urad.
        const double per_unit =
            gains->odd(row, static_cast<Eigen::Index>(k)) * (laws[k]->unit == "urad" ? 1e-3 : 1.0);
        variance[i] += std::pow(per_unit * laws[k]->sd, 2);
      }
      if (const auto* law = find("deflection")) variance[i] += law->sd * law->sd;
    }
    if (auto problem = add_gain_variance(piece, asked, variance)) return problem;
    // What no law moves is still not known better than the cut is made.
    constexpr double kLeast = 0.01;  // um
    for (std::size_t i = 0; i < asked.size(); ++i) {
      prior_.emplace_back(asked[i].id, std::max(kLeast, std::sqrt(variance[i])));
    }
    return std::nullopt;
  }

  // By differences, on paths coarse enough to be quick.
  std::optional<Diagnostics> add_gain_variance(const TestPiece& piece,
                                               const std::vector<AskedPoint>& asked,
                                               std::vector<double>& variance) const {
    if (!lags()) return std::nullopt;
    trials::TrialOptions coarse = options();
    coarse.path_bound = 1e-3;  // mm
    const auto nominal = trials::run_trial(nominal_, GeometricErrors{}, piece, {}, coarse);
    if (!nominal) return nominal.error();
    const std::vector<double> before = deviations(*nominal, asked);
    for (const BenchmarkUnknown& u : unknowns_) {
      if (!u.name.starts_with("gain.")) continue;
      const auto machine = with_gain_changes({{u.name.back(), u.sd}});
      if (!machine) return machine.error();
      const auto trial = trials::run_trial(*machine, GeometricErrors{}, piece, {}, coarse);
      if (!trial) return trial.error();
      const std::vector<double> after = deviations(*trial, asked);
      for (std::size_t i = 0; i < asked.size(); ++i) {
        variance[i] += std::pow(after[i] - before[i], 2);
      }
    }
    return std::nullopt;
  }

  // In the working volume, the same for all machines of a kind.
  void poses() {
    const KeyedNumbers places("poses of " + entry_.machine);
    const GeometricErrors errors = errors_of("");
    std::string csv = "id,pose" + axes_header(nominal_) + "\n";
    constexpr int kPoses = 100;
    for (int k = 1; k <= kPoses; ++k) {
      AxisPositions q;
      for (const kinematics::Joint& joint : nominal_.joints()) {
        const double share =
            places.uniform(std::string(1, kinematics::to_char(joint.letter)), k) - 0.5;
        const bool turns = joint.rotary() && (joint.endless || joint.travel.width() > 6.0);
        q[joint.letter] = turns ? 2.0 * std::numbers::pi * share
                                : joint.travel.middle() + 0.6 * joint.travel.width() * share;
        // As the file states it.
        const double unit = joint.rotary() ? kDegPerRad : 1.0;
        q[joint.letter] = std::round(q[joint.letter] * unit * 1e6) / 1e6 / unit;
      }
      const std::string id = fmt::format("p{:03}", k);
      csv += fmt::format("{},{}{}\n", id, k, axes_text(nominal_, q));
      const Vec3 d = kUmPerMm * tip_deviation(nominal_, errors, q);
      Vec3 variance = Vec3::Zero();
      for (const BenchmarkUnknown& u : unknowns_) {
        if (!u.one || !u.piece.empty()) continue;
        constexpr double kStep = 1e-3;
        const double internal = u.unit == "urad" ? u.sd / kUradPerRad : u.sd / kUmPerMm;
        const GeometricErrors one = GeometricErrors{}.plus(*u.one, kStep);
        const Vec3 moved = kUmPerMm * tip_deviation(nominal_, one, q) / kStep * internal;
        variance += moved.cwiseAbs2();
      }
      constexpr double kLeast = 0.01;
      for (int axis = 0; axis < 3; ++axis) {
        const std::string asked = fmt::format("{}.{}", id, "xyz"[axis]);
        answers_["poses"][asked] = d[axis];
        prior_.emplace_back(asked, std::max(kLeast, std::sqrt(variance[axis])));
      }
    }
    add(entry_.id + "/poses.csv", std::move(csv));
  }

  const BenchmarkEntry& entry_;
  std::string machine_text_;
  Machine nominal_, actual_;
  KeyedNumbers numbers_;
  std::vector<BenchmarkUnknown> unknowns_;
  BenchmarkFiles files_{};
  std::vector<std::pair<std::string, double>> prior_{};
  nlohmann::json answers_{{"points", nlohmann::json::object()},
                          {"poses", nlohmann::json::object()},
                          {"errors", nlohmann::json::object()}};
};

}  // namespace

Result<BenchmarkFiles> benchmark_files(const BenchmarkEntry& entry, const std::string& key) {
  const auto file = find_machine(entry.machine, ".");
  if (!file) return file.error();
  auto text = read_whole_file(*file);
  if (!text) return std::move(text).error();
  auto machine = Machine::read(*text, *file);
  if (!machine) return std::move(machine).error();
  KeyedNumbers numbers(key);
  auto unknowns = drawn_unknowns(*machine, entry.level, numbers);
  if (!unknowns) return std::move(unknowns).error();
  return Maker(entry, *std::move(text), *std::move(machine), std::move(numbers),
               *std::move(unknowns))
      .files();
}

std::string salt_of(const std::string& key) { return sha256("frustum benchmark salt/" + key); }

std::string commitment_of(const std::string& answers, const std::string& key) {
  std::string bytes;
  const std::string salt = salt_of(key);
  for (std::size_t i = 0; i < salt.size(); i += 2) {
    bytes += static_cast<char>(std::stoi(salt.substr(i, 2), nullptr, 16));
  }
  return sha256(bytes + answers);
}

}  // namespace frustum::app

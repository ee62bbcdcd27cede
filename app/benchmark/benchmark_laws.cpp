#include "app/benchmark/benchmark_laws.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "core/printable_text.hpp"
#include "core/sha256.hpp"
#include "core/text_words.hpp"
#include "core/whole_file.hpp"
#include "kinematics/errors/error_assignment.hpp"

namespace frustum::app {
namespace {

using kinematics::ErrorName;
using kinematics::GeometricErrors;
using kinematics::Machine;

// Of a standard normal that is cut at 3: its standard deviation, and those of its size.
constexpr double kCutSd = 0.98658;
constexpr double kSizeMean = 0.79116, kSizeSd = 0.58941;

// "EXX=linear 1mm over ..": what one mm or rad of a shape does.
Result<GeometricErrors> one_of(const Machine& machine, const std::string& text) {
  auto entry = kinematics::parse_error(text);
  if (!entry) return std::move(entry).error();
  return kinematics::resolve(machine, std::span(&*entry, 1));
}

class Laws {
 public:
  Laws(const Machine& machine, BenchmarkLevel level, const KeyedNumbers& numbers)
      : machine_(machine), level_(level), numbers_(numbers) {}

  Result<std::vector<BenchmarkUnknown>> draw() {
    locations();
    for (const std::string& piece : benchmark_pieces()) {
      add_normal("radius." + piece, "um", 5.0);
      all_.back().piece = piece;
    }
    if (level_ == BenchmarkLevel::components || level_ == BenchmarkLevel::motion) components();
    if (level_ >= BenchmarkLevel::motion) {
      reversals();
      if (level_ == BenchmarkLevel::motion) gains();
      drift();
      add("deflection", "um", 1.5, 3.0 / std::sqrt(12.0), 3.0 * numbers_.uniform("deflection"));
    }
    if (!problems_.empty()) return problems_;
    return std::move(all_);
  }

 private:
  void add(const std::string& name, const std::string& unit, double mean, double sd, double value,
           const std::string& shape = {}) {
    BenchmarkUnknown unknown{name, unit, mean, sd, value, std::nullopt, {}};
    if (!shape.empty()) {
      auto one = one_of(machine_, shape);
      if (one) {
        unknown.one = *std::move(one);
      } else {
        problems_.insert(problems_.end(), one.error().begin(), one.error().end());
      }
    }
    all_.push_back(std::move(unknown));
  }
  void add_normal(const std::string& name, const std::string& unit, double scale,
                  const std::string& shape = {}) {
    add(name, unit, 0.0, kCutSd * scale, scale * numbers_.normal(name), shape);
  }

  static const char* unit_of(const ErrorName& error) {
    return is_rotation(error.direction) ? "urad" : "um";
  }
  static const char* one(const ErrorName& error) {
    return is_rotation(error.direction) ? "1rad" : "1mm";
  }

  void locations() {
    for (const ErrorName& error : machine_.error_names()) {
      if (!error.location || machine_.refused(error)) continue;
      const bool angle = is_rotation(error.direction);
      const bool squareness = !is_rotary(error.axis);
      // Where a linear axis is, and how it turns about itself, is no error.
      if (squareness && !angle) continue;
      const double scale = squareness ? 20.0 : angle ? 30.0 : 15.0;
      add_normal(error.text(), unit_of(error), scale, error.text() + "=" + one(error));
    }
  }

  void components() {
    for (const ErrorName& error : machine_.error_names()) {
      if (error.location) continue;
      if (is_rotary(error.axis)) {
        for (const int order : {1, 2}) {
          harmonic(error, order, is_rotation(error.direction) ? 10.0 : 3.0, "0deg..360deg");
        }
        continue;
      }
      const auto travel = machine_.joint(error.axis)->travel;
      const std::string span = fmt::format("{}mm..{}mm", travel.lo, travel.hi);
      const bool along = static_cast<int>(error.direction) == static_cast<int>(error.axis);
      const double scale = is_rotation(error.direction) ? 8.0 : along ? 3.0 : 1.5;
      for (int power = 1; power <= 3; ++power) {
        std::string shape = error.text() + "=polynomial";
        const std::string zero = is_rotation(error.direction) ? " 0rad" : " 0mm";
        for (int k = 0; k < power; ++k) shape += zero;
        shape += std::string(" ") + one(error) + " over " + span;
        add_normal(fmt::format("{}.t{}", error.text(), power), unit_of(error), scale, shape);
      }
      if (!is_rotation(error.direction)) harmonic(error, 1, 1.0, span);
    }
  }

  // Amplitude uniform, phase anywhere: cosine and sine.
  void harmonic(const ErrorName& error, int order, double largest, const std::string& span) {
    const std::string name = fmt::format("{}.harmonic{}", error.text(), order);
    const double amplitude = largest * numbers_.uniform(name, 0);
    const double phase = 2.0 * std::numbers::pi * numbers_.uniform(name, 1);
    const double sd = largest / std::sqrt(6.0);
    const auto shape = [&](const char* degrees) {
      return fmt::format("{}=harmonic {} {} over {} phase {}", error.text(), order, one(error),
                         span, degrees);
    };
    add(fmt::format("{}.cos{}", error.text(), order), unit_of(error), 0.0, sd,
        amplitude * std::cos(phase), shape("0deg"));
    add(fmt::format("{}.sin{}", error.text(), order), unit_of(error), 0.0, sd,
        amplitude * std::sin(phase), shape("-90deg"));
  }

  void reversals() {
    for (const kinematics::Joint& joint : machine_.joints()) {
      const char letter = kinematics::to_char(joint.letter);
      const double scale = joint.rotary() ? 15.0 : 3.0;
      const std::string error = fmt::format("E{}{}", letter, letter);
      const std::string name = error + ".reversal";
      add(name, joint.rotary() ? "urad" : "um", kSizeMean * scale, kSizeSd * scale,
          scale * std::abs(numbers_.normal(name)),
          error + "=reversal " + (joint.rotary() ? "1rad" : "1mm"));
    }
  }

  void gains() {
    for (const kinematics::Joint& joint : machine_.joints()) {
      const std::string name = fmt::format("gain.{}", kinematics::to_char(joint.letter));
      add_normal(name, "1/s", 0.02 * joint.dynamics.servo_gain);
    }
  }

  // From piece to piece the tool wanders in the directions of the bed.
  void drift() {
    const char axis = kinematics::to_char(machine_.joint(kinematics::AxisLetter::X)->letter);
    for (const char direction : {'X', 'Y', 'Z'}) {
      const std::string error = fmt::format("E{}{}", direction, axis);
      double walked = 0.0, variance = 0.0;
      for (const std::string& piece : benchmark_pieces()) {
        const std::string name = fmt::format("drift.{}.{}", piece, direction);
        walked += numbers_.normal(name);
        variance += kCutSd * kCutSd;
        add(name, "um", 0.0, std::sqrt(variance), walked, error + "=1mm");
        all_.back().piece = piece;
      }
    }
  }

  const Machine& machine_;
  BenchmarkLevel level_;
  const KeyedNumbers& numbers_;
  std::vector<BenchmarkUnknown> all_{};
  Diagnostics problems_{};
};

}  // namespace

const std::vector<BenchmarkEntry>& benchmark_entries() {
  static const std::vector<BenchmarkEntry> kAll = [] {
    constexpr std::array<const char*, 3> kMachines{"zx-yac", "iwf-bc", "dvf5000"};
    std::vector<BenchmarkEntry> all{{"m01", "zx-yac", BenchmarkLevel::location, true},
                                    {"m02", "iwf-bc", BenchmarkLevel::components, true},
                                    {"m03", "dvf5000", BenchmarkLevel::motion, true},
                                    {"m04", "zx-yac", BenchmarkLevel::mixed, true}};
    std::array<int, 3> left{6, 7, 7};
    std::size_t next = 0;
    for (int number = 5; number <= 24; ++number) {
      while (left[next % 3] == 0) ++next;
      --left[next % 3];
      // Each machine has each level twice or more.
      const int level = 1 + (number - 5) / 3 % 3;
      all.push_back({fmt::format("m{:02}", number), kMachines[next % 3],
                     static_cast<BenchmarkLevel>(level), false});
      ++next;
    }
    return all;
  }();
  return kAll;
}

const std::vector<std::string>& benchmark_pieces() {
  static const std::vector<std::string> kPieces{"cone", "steps-1", "steps-2", "s-piece", "contour"};
  return kPieces;
}

double KeyedNumbers::uniform(std::string_view purpose, std::uint64_t index) const {
  constexpr std::size_t kDigits = 13;  // 52 bits
  const std::string hash = sha256(fmt::format("{}/{}/{}", key_, purpose, index));
  const std::uint64_t bits = std::stoull(hash.substr(0, kDigits), nullptr, 16);
  return (static_cast<double>(bits) + 0.5) / static_cast<double>(std::uint64_t{1} << 52U);
}

double KeyedNumbers::normal(std::string_view purpose, std::uint64_t index) const {
  constexpr double kCut = 3.0;
  constexpr std::uint64_t kTries = 1000;
  for (std::uint64_t i = 0; i < kTries; ++i) {
    const std::uint64_t at = 2 * (kTries * index + i);
    const double radius = std::sqrt(-2.0 * std::log(uniform(purpose, at)));
    const double z = radius * std::cos(2.0 * std::numbers::pi * uniform(purpose, at + 1));
    if (std::abs(z) <= kCut) return z;
  }
  return 0.0;
}

std::uint64_t KeyedNumbers::seed(std::string_view purpose) const {
  return std::stoull(sha256(fmt::format("{}/{}", key_, purpose)).substr(0, 16), nullptr, 16);
}

double BenchmarkUnknown::internal() const {
  if (unit == "um") return value / kUmPerMm;
  if (unit == "urad") return value / kUradPerRad;
  return value;
}

Result<std::vector<BenchmarkUnknown>> drawn_unknowns(const Machine& machine, BenchmarkLevel level,
                                                     const KeyedNumbers& numbers) {
  return Laws(machine, level, numbers).draw();
}

Result<std::vector<BenchmarkKey>> read_keys(const std::string& file) {
  const auto text = read_whole_file(file);
  if (!text) return text.error();
  std::vector<BenchmarkKey> keys;
  TextWords words(*text);
  const auto wrong = [&](int line, std::string what, std::string hint) {
    Diagnostic failure = error("benchmark-keys"_id, std::move(what), std::move(hint));
    failure.file = file;
    failure.line = line;
    return failure;
  };
  while (true) {
    const std::string id(words.next());
    if (id.empty()) break;
    const int line = words.line();
    const std::string key(words.next_in_line());
    const auto entry = std::ranges::find(benchmark_entries(), id, &BenchmarkEntry::id);
    if (entry == benchmark_entries().end()) {
      return wrong(line, fmt::format("there is no machine '{}'", printable(id)), "m01 to m24");
    }
    const auto is_digit = [](char c) { return (c >= '0' && c <= '9') || (c >= 'a' && c <= 'f'); };
    if (key.size() != 32 || !std::ranges::all_of(key, is_digit)) {
      return wrong(line, fmt::format("the key of {} is no 32 hexadecimal digits", id),
                   "16 bytes of the system's entropy: openssl rand -hex 16");
    }
    if (std::ranges::find(keys, id, &BenchmarkKey::id) != keys.end()) {
      return wrong(line, fmt::format("{} has two keys", id), "");
    }
    keys.push_back({id, key});
  }
  if (keys.empty()) return wrong(1, "there are no keys", "m01 <32 hexadecimal digits> a line");
  return keys;
}

}  // namespace frustum::app

// The machines of the open blind benchmark, what is unknown of each, and how a key draws it.
//
// Every random number is a function of the machine's key (128 bits) alone: the first 52 bits of
// the SHA-256 of key, purpose and index. Who has the key makes the same machine again.
// Units : named errors in um, urad and 1/s; inside mm and rad
// Errors: a machine file that cannot be read; keys that are no 32 hexadecimal digits
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "core/result.hpp"
#include "kinematics/model/machine.hpp"

namespace frustum::app {

enum class BenchmarkLevel {
  location = 1,    // location errors, tool radius
  components = 2,  // and component errors
  motion = 3,      // and reversal, servo gains, drift, deflection
  mixed = 4        // location, reversal, drift and deflection, without component errors
};

struct BenchmarkEntry {
  std::string id{};       // "m01"
  std::string machine{};  // of a shipped file
  BenchmarkLevel level{};
  bool open = false;  // an example with answers
};
// 24: eight of each machine, four of them open.
[[nodiscard]] const std::vector<BenchmarkEntry>& benchmark_entries();
// The pieces in the order in which they are cut.
[[nodiscard]] const std::vector<std::string>& benchmark_pieces();

class KeyedNumbers {
 public:
  explicit KeyedNumbers(std::string key) : key_(std::move(key)) {}
  // Between 0 and 1, without the ends.
  [[nodiscard]] double uniform(std::string_view purpose, std::uint64_t index = 0) const;
  // Standard normal, cut at 3.
  [[nodiscard]] double normal(std::string_view purpose, std::uint64_t index = 0) const;
  [[nodiscard]] std::uint64_t seed(std::string_view purpose) const;
  [[nodiscard]] const std::string& key() const { return key_; }

 private:
  std::string key_;
};

// One named error: its law, and what a mm or rad of it does.
struct BenchmarkUnknown {
  std::string name{};
  std::string unit{};  // um, urad, 1/s
  double mean = 0.0;   // of the law, in `unit`
  double sd = 1.0;
  double value = 0.0;  // drawn, in `unit`
  // Of a mm or rad; nothing: tool radius, gain, deflection.
  std::optional<kinematics::GeometricErrors> one{};
  std::string piece{};  // that alone has it; empty: all

  [[nodiscard]] double internal() const;  // mm, rad, 1/s
};

// Everything unknown of a machine, drawn by its key.
[[nodiscard]] Result<std::vector<BenchmarkUnknown>> drawn_unknowns(
    const kinematics::Machine& machine, BenchmarkLevel level, const KeyedNumbers& numbers);

// "m01 <32 hexadecimal digits>" a line.
struct BenchmarkKey {
  std::string id{}, key{};
};
[[nodiscard]] Result<std::vector<BenchmarkKey>> read_keys(const std::string& file);

}  // namespace frustum::app

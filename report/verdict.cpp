#include "report/verdict.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

namespace frustum::report {

Outcome outcome_of(const metrology::CharacteristicResult& characteristic) {
  if (!std::isfinite(characteristic.value)) return Outcome::not_measured;
  if (characteristic.verdict() == metrology::Verdict::uncertain) return Outcome::uncertain;
  return characteristic.pass ? Outcome::pass : Outcome::fail;
}

std::string_view name_of(Outcome outcome) {
  constexpr std::array<std::string_view, 4> kNames{"pass", "fail", "uncertain", "not measured"};
  return kNames.at(static_cast<std::size_t>(outcome));
}

std::string_view doubt_of(const metrology::CharacteristicResult& characteristic) {
  const auto coverage = characteristic.coverage();
  const bool is_doubtful =
      coverage == metrology::Coverage::not_proven || coverage == metrology::Coverage::not_stated;
  return is_doubtful ? metrology::name_of(*coverage) : std::string_view();
}

std::string counts_text(const metrology::Measurement& measurement, const Wording& words) {
  std::array<std::size_t, 4> counts{};
  for (const auto& c : measurement.characteristics) {
    ++counts.at(static_cast<std::size_t>(outcome_of(c)));
  }
  constexpr std::array<Phrase, 4> kOne{"passes", "fails", "uncertain", "not measured"};
  std::string text;
  for (std::size_t k = 0; k < counts.size(); ++k) {
    if (counts[k] == 0) continue;
    text +=
        fmt::format("{}{} {}", text.empty() ? "" : ", ", counts[k],
                    counts[k] == 1 ? words(kOne[k]) : words.word(name_of(static_cast<Outcome>(k))));
  }
  return text;
}

bool has_no_uncertainty(const metrology::Measurement& measurement) {
  const auto& all = measurement.characteristics;
  return !all.empty() && std::all_of(all.begin(), all.end(),
                                     [](const auto& c) { return c.expanded_uncertainty == 0.0; });
}

bool is_accuracy_unknown(const metrology::Measurement& measurement) {
  const auto& all = measurement.characteristics;
  return std::any_of(all.begin(), all.end(), [](const auto& c) { return c.is_accuracy_unknown; });
}

}  // namespace frustum::report

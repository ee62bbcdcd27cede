#include "report/verdict.hpp"

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

}  // namespace frustum::report

// How often a law is repeated: in full by `make laws`, less often by `make test`, whose preset says
// so in the environment (FRUSTUM_LAWS=reduced). A test program that is started by hand repeats in
// full.
//
// Both counts are written where the law is; docs/verification.md lists them. Only repetitions are
// fewer: limits are the same, or widen as the scatter of the smaller sample does, where the law is
// about a rate.
//
// Units  : none
// Errors : none
#pragma once

#include <cstdlib>
#include <string_view>

namespace frustum::proof {

[[nodiscard]] inline bool laws_are_reduced() {
  const char* said = std::getenv("FRUSTUM_LAWS");  // NOLINT(concurrency-mt-unsafe)
  return said != nullptr && std::string_view(said) == "reduced";
}

template <typename Count>
[[nodiscard]] Count law_count(Count full, Count reduced) {
  return laws_are_reduced() ? reduced : full;
}

}  // namespace frustum::proof

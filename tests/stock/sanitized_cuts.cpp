// Random cuts in a program whose every line is compiled with the sanitizers: sanitized_cuts [FIRST
// COUNT].
#include <cstdio>
#include <cstdlib>

#include "tests/law_count.hpp"
#include "tests/stock/random_cuts.hpp"

int main(int count, char** words) {
  const int first = count > 1 ? std::atoi(words[1]) : 0;
  const int cuts = count > 2 ? std::atoi(words[2]) : frustum::proof::law_count(40, 6);
  for (int seed = first; seed < first + cuts; ++seed) {
    const auto cut = frustum::proof::random_cut(static_cast<std::uint64_t>(seed));
    const std::string fault = frustum::proof::broken_law(cut);
    if (fault.empty()) continue;
    std::printf("seed %d: %s\n", seed, fault.c_str());
    return 1;
  }
  std::printf("%d cuts\n", cuts);
  return 0;
}

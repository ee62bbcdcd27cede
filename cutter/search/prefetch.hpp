// Memory that may be asked next: trees of long programs do not fit into the caches.
//
// Units    : none
// Errors   : none; nothing is read that the program would see
#pragma once

#include <cstddef>

namespace frustum::cutter {

// `count` of these from `first` on.
template <class T>
void fetch(const T* first, std::size_t count) {
  constexpr std::size_t kLine = 64;
  const auto* bytes = reinterpret_cast<const char*>(first);
  for (std::size_t k = 0; k < count * sizeof(T); k += kLine) __builtin_prefetch(bytes + k);
}

}  // namespace frustum::cutter

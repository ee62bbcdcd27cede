// Places of things in a list by their names: found at once, however many there are.
//
// Units  : none
// Errors : none: of two of one name the first counts
#pragma once

#include <cstddef>
#include <functional>
#include <optional>
#include <string_view>
#include <unordered_map>

namespace frustum {

class NameIndex {
 public:
  // `name` is what gives the name of a thing, as a member does; the names outlive this.
  template <typename Things, typename Name>
  NameIndex(const Things& things, Name name) {
    places_.reserve(things.size());
    std::size_t place = 0;
    for (const auto& thing : things) {
      places_.emplace(std::string_view(std::invoke(name, thing)), place++);
    }
  }

  [[nodiscard]] std::optional<std::size_t> find(std::string_view name) const {
    const auto found = places_.find(name);
    if (found == places_.end()) return std::nullopt;
    return found->second;
  }

 private:
  std::unordered_map<std::string_view, std::size_t> places_{};
};

}  // namespace frustum

// A value, or the diagnostics that say why there is none. Spelled like std::expected so that the
// standard type can replace it.
//
// Errors: error() is never empty and holds at least one entry of Severity::error.
#pragma once

#include <cassert>
#include <type_traits>
#include <utility>
#include <variant>

#include "core/diagnostic.hpp"

namespace frustum {

template <typename T>
class [[nodiscard]] Result {
 public:
  using value_type = T;

  // Implicit, as those of std::expected.
  Result(T value) : state_(std::in_place_index<0>, std::move(value)) {}
  Result(Diagnostic failure) : state_(std::in_place_index<1>, Diagnostics{std::move(failure)}) {}
  Result(Diagnostics failure) : state_(std::in_place_index<1>, std::move(failure)) {
    assert(has_error(error()));
  }

  [[nodiscard]] bool has_value() const { return state_.index() == 0; }
  explicit operator bool() const { return has_value(); }

  [[nodiscard]] T& value() & { return std::get<0>(state_); }
  [[nodiscard]] const T& value() const& { return std::get<0>(state_); }
  [[nodiscard]] T&& value() && { return std::get<0>(std::move(state_)); }
  T& operator*() & { return value(); }
  const T& operator*() const& { return value(); }
  T&& operator*() && { return std::move(*this).value(); }
  T* operator->() { return &value(); }
  const T* operator->() const { return &value(); }

  [[nodiscard]] const Diagnostics& error() const& { return std::get<1>(state_); }
  [[nodiscard]] Diagnostics&& error() && { return std::get<1>(std::move(state_)); }

  template <typename F>
  auto and_then(F&& next) && -> std::invoke_result_t<F, T> {
    if (!has_value()) return std::move(*this).error();
    return std::forward<F>(next)(std::move(*this).value());
  }
  template <typename F>
  auto transform(F&& next) && -> Result<std::invoke_result_t<F, T>> {
    if (!has_value()) return std::move(*this).error();
    return std::forward<F>(next)(std::move(*this).value());
  }

 private:
  std::variant<T, Diagnostics> state_;
};

}  // namespace frustum

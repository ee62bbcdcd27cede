// What is wrong with the input, as a Python exception: frustum.InputError with the diagnostics.
//
// Units : none
// Errors: none
#pragma once

#include <pybind11/pybind11.h>

#include <stdexcept>
#include <string>

#include "core/diagnostic.hpp"
#include "core/result.hpp"

namespace frustum::python {

class Refused : public std::runtime_error {
 public:
  explicit Refused(Diagnostics problems);
  [[nodiscard]] const Diagnostics& problems() const { return problems_; }

 private:
  Diagnostics problems_;
};

// The value, or Refused.
template <typename T>
T required(Result<T>&& result) {
  if (!result) throw Refused(result.error());
  return *std::move(result);
}

// A wrong argument of a call.
[[noreturn]] void refuse_argument(const std::string& name, const std::string& message,
                                  const std::string& hint = {});

void bind_refusal(pybind11::module_& module);

}  // namespace frustum::python

// The parameters of a program: numbered (#1 .. #99999) and named (#<feed>), each set or not.
//
// Units: as the program wrote them; a parameter has no unit until a word uses it.
// Errors: reading a parameter that was never set, or a number that no parameter has.
#pragma once

#include <map>
#include <string>
#include <string_view>
#include <unordered_map>

#include "core/result.hpp"

namespace frustum::parser {

constexpr int kMaxParameterNumber = 99999;

class Parameters {
 public:
  [[nodiscard]] Result<double> read(double number) const;
  [[nodiscard]] Result<double> read(std::string_view name) const;
  // The number as an index, when a parameter of that number can exist.
  [[nodiscard]] static Result<int> index_of(double number);

  void set(int index, double value) { numbered_[index] = value; }
  void set(std::string_view name, double value) {
    named_.insert_or_assign(std::string(name), value);
  }

 private:
  std::unordered_map<int, double> numbered_;
  std::map<std::string, double, std::less<>> named_;
};

}  // namespace frustum::parser

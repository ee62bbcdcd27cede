// Arrays of numpy as lists of rows, and back.
//
// Units : those of the caller
// Shape : (n, columns), or (columns,) for one row
// Errors: another shape, a type that is no real number, a number that is not finite: Refused, with
//         the name of the argument, the row and the column
#pragma once

#include <pybind11/numpy.h>

#include <span>
#include <string>
#include <vector>

#include "core/pose.hpp"
#include "python/refusal.hpp"

namespace frustum::python {

using Numbers = pybind11::array_t<double, pybind11::array::c_style>;

// Refers to the caller's memory where it is of doubles, row by row.
class RowArray {
 public:
  RowArray(const pybind11::object& given, const std::string& name, std::size_t columns);

  [[nodiscard]] std::size_t rows() const { return rows_; }
  [[nodiscard]] std::span<const double> row(std::size_t i) const {
    return {data_ + i * columns_, columns_};
  }
  [[nodiscard]] Vec3 vector(std::size_t i) const { return Vec3(data_ + 3 * i); }
  [[nodiscard]] std::vector<Vec3> vectors() const;
  // The only row; refused where there is another number of rows.
  [[nodiscard]] std::span<const double> only_row() const;
  // (n, columns), or (columns,) where one row was given so.
  [[nodiscard]] Numbers like(std::size_t columns) const;

 private:
  std::string name_{};
  Numbers array_{};
  const double* data_ = nullptr;
  std::size_t rows_ = 0, columns_ = 0;
  bool is_one_ = false;
};

[[nodiscard]] Numbers array_of(const std::vector<double>& numbers);
[[nodiscard]] Numbers array_of(const std::vector<Vec3>& vectors);

}  // namespace frustum::python

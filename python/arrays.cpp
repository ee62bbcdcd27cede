#include "python/arrays.hpp"

#include <fmt/format.h>

#include <cmath>

namespace frustum::python {

namespace py = pybind11;

namespace {

std::string shape_of(const py::array& array) {
  std::string text;
  for (py::ssize_t i = 0; i < array.ndim(); ++i) {
    text += fmt::format("{}{}", i > 0 ? ", " : "", array.shape(i));
  }
  return "(" + text + (array.ndim() == 1 ? ",)" : ")");
}

Numbers doubles_of(const py::object& given, const std::string& name) {
  const py::array any = py::array::ensure(given);
  if (!any) {
    PyErr_Clear();
    refuse_argument(name, "no array can be made of this", "rows of numbers");
  }
  const char kind = any.dtype().kind();
  if (kind != 'f' && kind != 'i' && kind != 'u') {
    refuse_argument(
        name, fmt::format("an array of {} has no real numbers", std::string(py::str(any.dtype()))),
        "dtype float64");
  }
  return py::array_t<double, py::array::c_style | py::array::forcecast>::ensure(any);
}

}  // namespace

RowArray::RowArray(const py::object& given, const std::string& name, std::size_t columns)
    : name_(name), array_(doubles_of(given, name)), columns_(columns) {
  is_one_ = array_.ndim() == 1;
  const bool fits = (is_one_ || array_.ndim() == 2) &&
                    array_.shape(array_.ndim() - 1) == static_cast<py::ssize_t>(columns);
  if (!fits) {
    refuse_argument(name, fmt::format("an array of the shape {}", shape_of(array_)),
                    fmt::format("(n, {0}), or ({0},) for one", columns));
  }
  rows_ = is_one_ ? 1 : static_cast<std::size_t>(array_.shape(0));
  data_ = array_.data();
  for (std::size_t i = 0; i < rows_ * columns_; ++i) {
    if (std::isfinite(data_[i])) continue;
    refuse_argument(name,
                    fmt::format("row {}, column {} is {}", i / columns_, i % columns_, data_[i]),
                    "finite numbers");
  }
}

std::span<const double> RowArray::only_row() const {
  if (rows_ != 1) {
    refuse_argument(name_, fmt::format("{} rows", rows_), fmt::format("one, ({},)", columns_));
  }
  return row(0);
}

std::vector<Vec3> RowArray::vectors() const {
  std::vector<Vec3> all;
  all.reserve(rows_);
  for (std::size_t i = 0; i < rows_; ++i) all.push_back(vector(i));
  return all;
}

Numbers RowArray::like(std::size_t columns) const {
  const auto width = static_cast<py::ssize_t>(columns);
  if (is_one_) return Numbers(width);
  return Numbers({static_cast<py::ssize_t>(rows_), width});
}

Numbers array_of(const std::vector<double>& numbers) {
  return Numbers(static_cast<py::ssize_t>(numbers.size()), numbers.data());
}

Numbers array_of(const std::vector<Vec3>& vectors) {
  Numbers array({static_cast<py::ssize_t>(vectors.size()), py::ssize_t{3}});
  double* to = array.mutable_data();
  for (const Vec3& v : vectors) to = std::copy(v.begin(), v.end(), to);
  return array;
}

}  // namespace frustum::python

// HDF5 files in memory: what a study writes to them and reads of them.
//
// The only place that knows the HDF5 library. Data are chunked, shuffled and deflated; chunks are
// packed and unpacked on all cores, the library itself is used by one thread at a time.
// Units: none. Errors: the library's refusal, with the name of the dataset
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "core/result.hpp"

namespace frustum::studies {

enum class NumberKind : std::uint8_t { real, whole, flag };  // double, int64, uint8

class Hdf5Writer {
 public:
  Hdf5Writer();
  ~Hdf5Writer();
  Hdf5Writer(const Hdf5Writer&) = delete;
  Hdf5Writer& operator=(const Hdf5Writer&) = delete;

  // Groups on the way are made. `columns` above 0: a table of so many columns. An empty array is
  // left out. False, and failure() says which, where the library refuses.
  bool write(const std::string& name, std::span<const double> values, const std::string& unit = {},
             std::size_t columns = 0);
  bool write(const std::string& name, std::span<const std::int64_t> values);
  bool write(const std::string& name, std::span<const std::uint8_t> values);
  bool write(const std::string& name, const std::vector<std::string>& texts);
  bool attribute(const std::string& name, const std::string& text);
  bool attribute(const std::string& name, std::uint64_t number);

  [[nodiscard]] Result<std::string> bytes();

 private:
  struct Image;
  bool write_numbers(const std::string& name, const void* data, NumberKind kind, std::size_t rows,
                     std::size_t columns, const std::string& unit);
  std::unique_ptr<Image> image_;
};

// One dataset, or attributes of the root.
class Hdf5Reader {
 public:
  [[nodiscard]] static std::optional<Hdf5Reader> open(std::string_view bytes);
  Hdf5Reader(Hdf5Reader&&) noexcept;
  Hdf5Reader& operator=(Hdf5Reader&&) noexcept;
  ~Hdf5Reader();

  [[nodiscard]] std::vector<std::string> datasets() const;  // by their full names, as written
  [[nodiscard]] std::optional<std::vector<double>> reals(const std::string& name) const;
  [[nodiscard]] std::optional<std::vector<std::int64_t>> whole_numbers(
      const std::string& name) const;
  [[nodiscard]] std::optional<std::vector<std::uint8_t>> flags(const std::string& name) const;
  [[nodiscard]] std::optional<std::vector<std::string>> texts(const std::string& name) const;
  [[nodiscard]] std::string unit(const std::string& name) const;
  [[nodiscard]] std::size_t columns(const std::string& name) const;  // of a table; else 0
  [[nodiscard]] std::optional<std::string> text_attribute(const std::string& name) const;
  [[nodiscard]] std::optional<std::uint64_t> number_attribute(const std::string& name) const;

 private:
  struct Image;
  explicit Hdf5Reader(std::unique_ptr<Image> image);
  template <class T>
  std::optional<std::vector<T>> numbers(const std::string& name, NumberKind kind) const;
  std::unique_ptr<Image> image_;
};

}  // namespace frustum::studies

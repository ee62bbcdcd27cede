// A place of APT CLDATA: x,y,z and perhaps the tool vector i,j,k; and the quick reader of records
// that name nothing else, GOTO/1.5,-2,.5.
//
// Units : as written
// Errors: none; what is no such record is read in full
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string_view>

#include "core/pose.hpp"

namespace frustum::parser {

struct CldataPlace {
  std::uint32_t column = 0;  // of the record
  std::size_t count = 0;     // 3 or 6
  std::array<double, 6> numbers{};
  std::array<std::uint32_t, 6> columns{};

  // Without a vector, for a record at `column`.
  [[nodiscard]] static CldataPlace at(const Vec3& point, std::uint32_t column) {
    return {column, 3, {point.x(), point.y(), point.z()}, {column, column, column}};
  }
  [[nodiscard]] Vec3 point() const { return {numbers[0], numbers[1], numbers[2]}; }
  [[nodiscard]] Vec3 vector() const { return {numbers[3], numbers[4], numbers[5]}; }
};

// Nothing for records with labels, comments, exponents, continuation marks or a mistake.
[[nodiscard]] std::optional<CldataPlace> read_cldata_place(std::string_view text);

}  // namespace frustum::parser

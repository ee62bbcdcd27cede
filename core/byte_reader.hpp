// The numbers of a binary file one after another, in the byte order of the file.
//
// Units: bytes. Errors: none; past the end there is no number.
#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cstddef>
#include <cstring>
#include <optional>
#include <string_view>

namespace frustum {

class ByteReader {
 public:
  explicit ByteReader(std::string_view bytes, std::size_t at = 0,
                      std::endian order = std::endian::little)
      : bytes_(bytes), at_(at), swap_(order != std::endian::native) {}

  template <typename Number>
  std::optional<Number> next() {
    if (at_ > bytes_.size() || bytes_.size() - at_ < sizeof(Number)) return std::nullopt;
    std::array<char, sizeof(Number)> raw;
    std::memcpy(raw.data(), bytes_.data() + at_, sizeof(Number));
    if (swap_) std::reverse(raw.begin(), raw.end());
    at_ += sizeof(Number);
    return std::bit_cast<Number>(raw);
  }
  [[nodiscard]] std::size_t at() const { return at_; }

 private:
  std::string_view bytes_;
  std::size_t at_;
  bool swap_;
};

}  // namespace frustum

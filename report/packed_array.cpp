#include "report/packed_array.hpp"

#include <zlib.h>

#include <new>
#include <vector>

namespace frustum::report {

std::string base64(std::span<const unsigned char> bytes) {
  constexpr char kAlphabet[] = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string text;
  text.reserve((bytes.size() + 2) / 3 * 4);
  for (std::size_t k = 0; k < bytes.size(); k += 3) {
    const std::size_t count = std::min<std::size_t>(3, bytes.size() - k);
    std::uint32_t group = 0;
    for (std::size_t i = 0; i < 3; ++i) group = group << 8U | (i < count ? bytes[k + i] : 0U);
    for (std::size_t i = 0; i < 4; ++i) {
      text += i <= count ? kAlphabet[group >> (18U - 6U * i) & 63U] : '=';
    }
  }
  return text;
}

std::string packed_array(std::span<const std::uint32_t> values, std::size_t stride) {
  std::vector<unsigned char> planes(values.size() * 4);
  for (std::size_t k = 0; k < values.size(); ++k) {
    const std::uint32_t difference = values[k] - (k >= stride ? values[k - stride] : 0U);
    for (std::size_t plane = 0; plane < 4; ++plane) {
      planes[plane * values.size() + k] =
          static_cast<unsigned char>(difference >> (8U * plane) & 255U);
    }
  }
  uLongf size = compressBound(static_cast<uLong>(planes.size()));
  std::vector<unsigned char> packed(size);
  if (compress2(packed.data(), &size, planes.data(), static_cast<uLong>(planes.size()),
                Z_DEFAULT_COMPRESSION) != Z_OK) {
    throw std::bad_alloc();  // the only way zlib can fail with a buffer of compressBound bytes
  }
  packed.resize(size);
  return base64(packed);
}

}  // namespace frustum::report

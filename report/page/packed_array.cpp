#include "report/page/packed_array.hpp"

#include <zlib.h>

#include <new>
#include <vector>

#include "core/base64.hpp"

namespace frustum::report {
namespace {

std::string deflated(std::span<const unsigned char> bytes) {
  uLongf size = compressBound(static_cast<uLong>(bytes.size()));
  std::vector<unsigned char> packed(size);
  if (compress2(packed.data(), &size, bytes.data(), static_cast<uLong>(bytes.size()),
                Z_DEFAULT_COMPRESSION) != Z_OK) {
    throw std::bad_alloc();  // the only way zlib can fail with a buffer of compressBound bytes
  }
  packed.resize(size);
  return base64(packed);
}

}  // namespace

std::string packed_array(std::span<const std::uint32_t> values, std::size_t stride) {
  std::vector<unsigned char> planes(values.size() * 4);
  for (std::size_t k = 0; k < values.size(); ++k) {
    const std::uint32_t difference = values[k] - (k >= stride ? values[k - stride] : 0U);
    for (std::size_t plane = 0; plane < 4; ++plane) {
      planes[plane * values.size() + k] =
          static_cast<unsigned char>(difference >> (8U * plane) & 255U);
    }
  }
  return deflated(planes);
}

std::string packed_text(std::string_view text) {
  return deflated({reinterpret_cast<const unsigned char*>(text.data()), text.size()});
}

}  // namespace frustum::report

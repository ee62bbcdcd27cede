#include "report/page/packed_array.hpp"

#include <gtest/gtest.h>
#include <zlib.h>

#include <vector>

namespace frustum::report {
namespace {

std::vector<unsigned char> bytes_of(const std::string& text) {
  const std::string alphabet = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::vector<unsigned char> bytes;
  std::uint32_t group = 0;
  int bits = 0;
  for (const char c : text) {
    if (c == '=') break;
    group = group << 6U | static_cast<std::uint32_t>(alphabet.find(c));
    bits += 6;
    if (bits >= 8) {
      bits -= 8;
      bytes.push_back(static_cast<unsigned char>(group >> static_cast<unsigned>(bits) & 255U));
    }
  }
  return bytes;
}

// What report/page/packed_array.js does.
std::vector<std::uint32_t> unpack(const std::string& text, std::size_t count, std::size_t stride) {
  const std::vector<unsigned char> packed = bytes_of(text);
  std::vector<unsigned char> planes(4 * count);
  uLongf size = static_cast<uLongf>(planes.size());
  EXPECT_EQ(uncompress(planes.data(), &size, packed.data(), static_cast<uLong>(packed.size())),
            Z_OK);
  EXPECT_EQ(size, 4 * count);
  std::vector<std::uint32_t> values(count);
  for (std::size_t k = 0; k < count; ++k) {
    std::uint32_t difference = 0;
    for (std::size_t plane = 4; plane-- > 0;) {
      difference = difference << 8U | planes[plane * count + k];
    }
    values[k] = difference + (k >= stride ? values[k - stride] : 0U);
  }
  return values;
}

TEST(PackedArray, ComesBackAsItWent) {
  std::vector<std::uint32_t> values;
  for (std::uint32_t k = 0; k < 999; ++k) values.push_back(k * k * 2654435761U);
  EXPECT_EQ(unpack(packed_array(values, 3), values.size(), 3), values);
  EXPECT_EQ(unpack(packed_array(values, 1), values.size(), 1), values);
}

TEST(PackedText, ComesBackAsItWent) {
  const std::string text = "G1 X10 (Umlaut: \xC3\xA4)\r\n</script>\0\n" + std::string(5000, 'G');
  const std::vector<unsigned char> packed = bytes_of(packed_text(text));
  EXPECT_LT(packed.size(), 200U);
  std::string back(text.size(), '\0');
  uLongf size = static_cast<uLongf>(back.size());
  EXPECT_EQ(uncompress(reinterpret_cast<unsigned char*>(back.data()), &size, packed.data(),
                       static_cast<uLong>(packed.size())),
            Z_OK);
  EXPECT_EQ(back, text);
}

}  // namespace
}  // namespace frustum::report

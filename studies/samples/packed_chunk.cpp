#include "studies/samples/packed_chunk.hpp"

#include <zlib.h>

#include <array>
#include <cstdint>

namespace frustum::studies {
namespace {

// The least of zlib: more effort gains nothing.
constexpr int kPacked = 1;
constexpr int kStored = 0;

std::vector<unsigned char> shuffled(std::span<const unsigned char> numbers, std::size_t size) {
  const std::size_t count = numbers.size() / size;
  std::vector<unsigned char> bytes(numbers.size());
  for (std::size_t b = 0; b < size; ++b) {
    for (std::size_t i = 0; i < count; ++i) bytes[b * count + i] = numbers[i * size + b];
  }
  return bytes;
}

// Whether all bytes are about equally frequent, so that nothing is gained by packing them: their
// squared counts add up to n^2 / 256, and for n random ones to n more.
bool is_noise(std::span<const unsigned char> bytes) {
  std::array<std::uint64_t, 256> counts{};
  for (const unsigned char byte : bytes) ++counts[byte];
  double squares = 0.0;
  for (const std::uint64_t c : counts) squares += static_cast<double>(c * c);
  const auto n = static_cast<double>(bytes.size());
  constexpr double kGain = 1.05;  // packing would save some two parts in a hundred
  return squares <= kGain * n * n / 256.0 + n;
}

}  // namespace

std::vector<unsigned char> packed_chunk(std::span<const unsigned char> numbers, std::size_t size,
                                        bool are_real) {
  const std::vector<unsigned char> bytes = shuffled(numbers, size);
  constexpr std::size_t kOfPlanes = 1024;  // their beginnings and ends in the stream
  std::vector<unsigned char> packed(compressBound(static_cast<uLong>(bytes.size())) + kOfPlanes);
  z_stream stream{};
  if (deflateInit(&stream, kPacked) != Z_OK) return {};
  stream.next_out = packed.data();
  stream.avail_out = static_cast<uInt>(packed.size());
  const std::size_t count = bytes.size() / size;
  bool is_done = true;
  for (std::size_t b = 0; b < size; ++b) {
    const auto plane = std::span(bytes).subspan(b * count, count);
    const int level = are_real && is_noise(plane) ? kStored : kPacked;
    is_done = is_done && deflateParams(&stream, level, Z_DEFAULT_STRATEGY) == Z_OK;
    stream.next_in = const_cast<unsigned char*>(plane.data());  // which zlib only reads
    stream.avail_in = static_cast<uInt>(plane.size());
    const bool is_last = b + 1 == size;
    const int end = deflate(&stream, is_last ? Z_FINISH : Z_NO_FLUSH);
    is_done = is_done && end == (is_last ? Z_STREAM_END : Z_OK);
  }
  packed.resize(is_done ? stream.total_out : 0);
  deflateEnd(&stream);
  return packed;
}

bool unpack_chunk(std::span<const unsigned char> packed, std::size_t size, std::size_t whole,
                  std::span<unsigned char> numbers) {
  std::vector<unsigned char> bytes(whole);
  uLongf length = static_cast<uLongf>(whole);
  const int end =
      uncompress(bytes.data(), &length, packed.data(), static_cast<uLong>(packed.size()));
  if (end != Z_OK || length != whole) return false;
  const std::size_t count = whole / size, wanted = numbers.size() / size;
  for (std::size_t b = 0; b < size; ++b) {
    for (std::size_t i = 0; i < wanted; ++i) numbers[i * size + b] = bytes[b * count + i];
  }
  return true;
}

}  // namespace frustum::studies

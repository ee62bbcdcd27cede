// A chunk of numbers, packed as HDF5's filters "shuffle" and "deflate" do.
//
// Model    : first the first bytes of all numbers, then all second ones, and so on; each of these
//            planes goes into one stream of zlib. Of real numbers the planes of the last digits are
//            noise: they are stored in the stream as they are
// Units    : bytes
// Shape    : a chunk has a whole number of numbers
// Errors   : an empty chunk, or false, where zlib has failed or the bytes are not what they were
// Accuracy : the same bytes for the same numbers
// Source   : RFC 1950, RFC 1951; HDF5 filters 1 and 2
#pragma once

#include <cstddef>
#include <span>
#include <vector>

namespace frustum::studies {

// `size`: bytes of a number.
[[nodiscard]] std::vector<unsigned char> packed_chunk(std::span<const unsigned char> numbers,
                                                      std::size_t size, bool are_real);
// The first numbers of a chunk of `whole` bytes, as many as there is room for.
[[nodiscard]] bool unpack_chunk(std::span<const unsigned char> packed, std::size_t size,
                                std::size_t whole, std::span<unsigned char> numbers);

}  // namespace frustum::studies

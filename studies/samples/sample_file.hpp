// A file of samples: HDF5, one dataset a column, as h5py, MATLAB, Julia and pandas read it.
//
// Datasets : draw (int64), the columns by their names (double, attribute `unit`), pass/NAME
//            (uint8), points (draw x point, um), failed/draw (int64) and failed/message (text)
//            where draws failed; of whatever is empty there is none
// Root     : attributes frustum.study (SHA-256 of the study and of every file that it reads), seed,
//            first_draw, count
// Seal     : a line with the SHA-256 of all bytes before it ends the file, after what readers of
//            HDF5 look at
// Bytes    : equal samples give equal bytes: no times, one thread writes, columns in their order
// Units    : those of the columns
// Errors   : bytes whose seal does not agree, that are no HDF5, or lack what a file of samples has
#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include "core/result.hpp"
#include "studies/samples/sample_block.hpp"

namespace frustum::studies {

// Of which study a file of samples is.
struct SampleMark {
  std::string study{};  // SHA-256, 64 hexadecimal digits
  std::uint64_t seed = 0;

  friend bool operator==(const SampleMark&, const SampleMark&) = default;
};

struct SampleFile {
  SampleMark mark{};
  SampleBlock block{};
};

[[nodiscard]] Result<std::string> encoded(const SampleFile& file);

// The columns in the order in which they were written, those of `wanted` names alone. `name` is
// that of the file, for messages.
[[nodiscard]] Result<SampleFile> decoded(
    std::string_view bytes, const std::string& name,
    const std::function<bool(const std::string&)>& wanted = [](const auto&) { return true; });

// What the root says, without the datasets.
struct SampleRange {
  SampleMark mark{};
  std::uint64_t first_draw = 0;
  std::uint64_t count = 0;
};
[[nodiscard]] Result<SampleRange> range_of(std::string_view bytes, const std::string& name);

}  // namespace frustum::studies

// Several files as the bytes of one ZIP archive.
//
// Deflated, dated 1980-01-01, so that equal files make equal archives.
// Units: none. Errors: none; precondition: each file, and all of them, below 4 GiB.
#pragma once

#include <span>
#include <string>
#include <string_view>

namespace frustum::stock {

struct ZipEntry {
  std::string_view name;
  std::string_view bytes;
};

[[nodiscard]] std::string zip_archive(std::span<const ZipEntry> entries);

}  // namespace frustum::stock

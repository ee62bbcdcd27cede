#include "report/text_file.hpp"

#include <fmt/format.h>

#include <cerrno>
#include <fstream>
#include <system_error>

namespace frustum::report {

Diagnostic cannot_write(const std::filesystem::path& path, std::string_view reason) {
  Diagnostic diagnostic = error(fmt::format("cannot write '{}': {}", path.string(), reason),
                                "name a file in an existing folder that you may write to");
  diagnostic.file = path.string();
  return diagnostic;
}

Result<std::filesystem::path> write_text_file(const std::filesystem::path& path,
                                              std::string_view text) {
  errno = 0;
  std::ofstream out(path, std::ios::binary | std::ios::trunc);
  out.write(text.data(), static_cast<std::streamsize>(text.size()));
  out.close();
  if (!out) {
    const std::error_code reason(errno != 0 ? errno : EIO, std::generic_category());
    return cannot_write(path, reason.message());
  }
  return path;
}

}  // namespace frustum::report

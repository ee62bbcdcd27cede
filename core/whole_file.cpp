#include "core/whole_file.hpp"

#include <fmt/format.h>

#include <array>
#include <cerrno>
#include <cstdio>
#include <cstring>
#include <memory>
#include <optional>
#include <string>
#include <system_error>
#include <utility>

namespace frustum {
namespace {

namespace fs = std::filesystem;

struct CloseFile {
  void operator()(std::FILE* file) const { std::fclose(file); }
};
using File = std::unique_ptr<std::FILE, CloseFile>;

struct PartFile {
  fs::path path;
  File file;
};

// A new file beside the target, on the same volume so that renaming is one step. errno on failure.
std::optional<PartFile> open_part(const fs::path& target) {
  constexpr int kTries = 100;  // others may be writing the same file, or have died doing so
  for (int number = 0; number < kTries; ++number) {
    fs::path path = target;
    path += number == 0 ? std::string(".part") : fmt::format(".part{}", number);
    if (File file{std::fopen(path.c_str(), "wbx")}) return PartFile{path, std::move(file)};
    if (errno != EEXIST) return std::nullopt;
  }
  return std::nullopt;
}

}  // namespace

Result<std::string> read_whole_file(const fs::path& path) {
  std::error_code unknown;
  std::string bytes;
  bool read = false;
  if (!fs::is_directory(path, unknown)) {
    if (const File file{std::fopen(path.c_str(), "rb")}) {
      std::array<char, 1 << 16> some{};
      while (const std::size_t count = std::fread(some.data(), 1, some.size(), file.get())) {
        bytes.append(some.data(), count);
      }
      read = std::ferror(file.get()) == 0;
    }
  }
  if (read) return bytes;
  Diagnostic diagnostic =
      error("file-unreadable"_id, "the file cannot be read", "check the path and permissions");
  diagnostic.file = path.string();
  return diagnostic;
}

Diagnostic cannot_write(const fs::path& path, std::string_view reason) {
  Diagnostic diagnostic =
      error("file-unwritable"_id, fmt::format("cannot write '{}': {}", path.string(), reason),
            "name a file in an existing folder that you may write to");
  diagnostic.file = path.string();
  return diagnostic;
}

Result<fs::path> write_whole_file(const fs::path& path, std::string_view bytes) {
  std::error_code failure;
  if (fs::is_directory(path, failure)) return cannot_write(path, "it is a folder");
  auto part = open_part(path);
  if (!part) return cannot_write(path, std::strerror(errno));
  const bool written = std::fwrite(bytes.data(), 1, bytes.size(), part->file.get()) == bytes.size();
  // Closing writes what is buffered, so its result counts too.
  const bool closed = std::fclose(part->file.release()) == 0;
  const int reason = errno;
  if (written && closed) {
    fs::rename(part->path, path, failure);
    if (!failure) return path;
  }
  const std::string why = written && closed ? failure.message() : std::strerror(reason);
  fs::remove(part->path, failure);
  return cannot_write(path, why);
}

}  // namespace frustum

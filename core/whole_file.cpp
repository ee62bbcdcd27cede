#include "core/whole_file.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <cstdio>
#include <cstring>
#include <memory>
#include <optional>
#include <string>
#include <system_error>
#include <utility>

#include "core/files_read.hpp"

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

bool write_bytes(File file, std::string_view bytes, bool synced = false) {
  bool written = std::fwrite(bytes.data(), 1, bytes.size(), file.get()) == bytes.size();
  if (written && synced) {
    written = std::fflush(file.get()) == 0 && ::fsync(::fileno(file.get())) == 0;
  }
  const int reason = errno;
  // Closing writes what is buffered, so its result counts too.
  const bool closed = std::fclose(file.release()) == 0;
  if (!written) errno = reason;
  return written && closed;
}

// Nothing can be renamed over a device or a pipe; /dev/stdout may be a link to a file.
bool is_device(const fs::path& path) {
  const std::string name = path.lexically_normal().string();
  std::error_code failure;
  return (name.starts_with("/dev/") && !name.starts_with("/dev/shm/")) ||
         name.starts_with("/proc/") ||
         (fs::exists(path, failure) && !fs::is_regular_file(path, failure));
}
Result<fs::path> write_through(const fs::path& path, std::string_view bytes) {
  File file{std::fopen(path.c_str(), "wb")};
  if (file && write_bytes(std::move(file), bytes)) return path;
  return cannot_write(path, std::strerror(errno));
}

Diagnostic endless(const fs::path& path) {
  Diagnostic diagnostic =
      error("file-unreadable"_id, "more than 256 MiB come through this pipe or device",
            "write them to a file before, and name that");
  diagnostic.file = path.string();
  return diagnostic;
}

}  // namespace

Result<std::string> read_to_replace(const fs::path& path) {
  constexpr std::size_t kLongestStream = std::size_t{1} << 28U;
  std::error_code unknown;
  const std::size_t longest =
      fs::is_regular_file(path, unknown) ? std::string().max_size() : kLongestStream;
  std::string bytes;
  bool read = false;
  if (!fs::is_directory(path, unknown)) {
    if (const File file{std::fopen(path.c_str(), "rb")}) {
      std::array<char, 1 << 16> some{};
      while (const std::size_t count = std::fread(some.data(), 1, some.size(), file.get())) {
        if (bytes.size() + count > longest) return endless(path);
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

Result<std::string> read_whole_file(const fs::path& path) {
  auto bytes = read_to_replace(path);
  if (bytes) note_read(path);
  return bytes;
}

Diagnostic cannot_write(const fs::path& path, std::string_view reason) {
  Diagnostic diagnostic =
      error("file-unwritable"_id, fmt::format("cannot write '{}': {}", path.string(), reason),
            "name a file in an existing folder that you may write to");
  diagnostic.file = path.string();
  return diagnostic;
}

std::optional<Diagnostic> unwritable(const fs::path& path) {
  std::error_code failure;
  if (fs::is_directory(path, failure)) return cannot_write(path, "it is a folder");
  if (is_device(path)) return std::nullopt;
  if (auto lost = would_be_lost(path)) return lost;
  const fs::path folder = path.has_parent_path() ? path.parent_path() : fs::path(".");
  if (!fs::exists(folder, failure)) return cannot_write(path, "there is no such folder");
  if (::access(folder.c_str(), W_OK | X_OK) == 0) return std::nullopt;
  return cannot_write(path, std::strerror(errno));
}

namespace {

// The entry of a file in its folder; file systems that cannot are passed over.
void sync_folder_of(const fs::path& path) {
  const fs::path folder = path.has_parent_path() ? path.parent_path() : fs::path(".");
  const int descriptor = ::open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
  if (descriptor < 0) return;
  ::fsync(descriptor);
  ::close(descriptor);
}

Result<fs::path> write_beside(const fs::path& path, std::string_view bytes, bool synced) {
  std::error_code failure;
  if (fs::is_directory(path, failure)) return cannot_write(path, "it is a folder");
  if (is_device(path)) return write_through(path, bytes);
  if (auto lost = would_be_lost(path)) return *std::move(lost);
  auto part = open_part(path);
  if (!part) return cannot_write(path, std::strerror(errno));
  const bool written = write_bytes(std::move(part->file), bytes, synced);
  const int reason = errno;
  if (written) {
    fs::rename(part->path, path, failure);
    if (!failure) {
      if (synced) sync_folder_of(path);
      return path;
    }
  }
  const std::string why = written ? failure.message() : std::strerror(reason);
  fs::remove(part->path, failure);
  return cannot_write(path, why);
}

}  // namespace

Result<fs::path> write_whole_file(const fs::path& path, std::string_view bytes) {
  return write_beside(path, bytes, false);
}

Result<fs::path> write_synced_file(const fs::path& path, std::string_view bytes) {
  return write_beside(path, bytes, true);
}

}  // namespace frustum

#include "core/files_read.hpp"

#include <fmt/format.h>
#include <sys/stat.h>

#include <atomic>
#include <mutex>
#include <set>
#include <utility>

namespace frustum {
namespace {

namespace fs = std::filesystem;

using FileIdentity = std::pair<dev_t, ino_t>;

struct FilesRead {
  std::atomic<bool> is_kept = false;
  std::mutex mutex{};
  std::set<FileIdentity> files{};
};
FilesRead& files_read() {
  static FilesRead of_process;
  return of_process;
}

// Nothing: there is no such file, or it is a device or a pipe, which nothing is lost of.
std::optional<FileIdentity> identity_of(const fs::path& file) {
  struct stat found {};
  if (::stat(file.c_str(), &found) != 0 || !S_ISREG(found.st_mode)) return std::nullopt;
  return FileIdentity{found.st_dev, found.st_ino};
}

}  // namespace

void keep_what_is_read(bool kept) {
  FilesRead& read = files_read();
  const std::lock_guard lock(read.mutex);
  read.is_kept = kept;
  read.files.clear();
}

void note_read(const fs::path& file) {
  FilesRead& read = files_read();
  if (!read.is_kept) return;
  const auto identity = identity_of(file);
  if (!identity) return;
  const std::lock_guard lock(read.mutex);
  read.files.insert(*identity);
}

std::optional<Diagnostic> would_be_lost(const fs::path& file) {
  FilesRead& read = files_read();
  if (!read.is_kept) return std::nullopt;
  const auto identity = identity_of(file);
  if (!identity) return std::nullopt;
  const std::lock_guard lock(read.mutex);
  if (!read.files.contains(*identity)) return std::nullopt;
  return error("output-overwrites-input"_id,
               fmt::format("'{}' would be overwritten, which was read", file.string()),
               "choose another file or folder for what is written");
}

}  // namespace frustum

#include "core/file_set.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstdio>
#include <cstring>
#include <system_error>
#include <utility>

#include "core/files_read.hpp"
#include "core/whole_file.hpp"

namespace frustum {
namespace {

namespace fs = std::filesystem;

// More than this is somebody's home, not a folder of results: it stays where it is.
constexpr std::ptrdiff_t kMostOthers = 2000;

// A folder that is open, and locked where the file system can do so.
class LockedFolder {
 public:
  LockedFolder() = default;
  explicit LockedFolder(const fs::path& folder)
      : descriptor_(::open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC)) {}
  LockedFolder(LockedFolder&& other) noexcept : descriptor_(std::exchange(other.descriptor_, -1)) {}
  LockedFolder& operator=(LockedFolder&& other) noexcept {
    std::swap(descriptor_, other.descriptor_);
    return *this;
  }
  ~LockedFolder() {
    if (descriptor_ >= 0) ::close(descriptor_);
  }

  [[nodiscard]] bool is_open() const { return descriptor_ >= 0; }
  // False where somebody else has it. A file system without locks is used without.
  [[nodiscard]] bool lock() const {
    return ::flock(descriptor_, LOCK_EX | LOCK_NB) == 0 || errno != EWOULDBLOCK;
  }
  // Whether the path still is this folder: another run may have exchanged or removed it.
  [[nodiscard]] bool is_at(const fs::path& path) const {
    struct stat own {
    }, there{};
    return ::fstat(descriptor_, &own) == 0 && ::stat(path.c_str(), &there) == 0 &&
           own.st_dev == there.st_dev && own.st_ino == there.st_ino;
  }

 private:
  int descriptor_ = -1;
};

Diagnostic no_folder(const fs::path& folder, const std::string& reason) {
  Diagnostic failure =
      error("file-unwritable"_id, "the output folder cannot be written to: " + reason,
            "name a folder that you may make or write to");
  failure.file = folder.string();
  return failure;
}

// Those on the way to the folder that are not there yet, the deepest first.
std::vector<fs::path> missing_folders(const fs::path& folder) {
  std::vector<fs::path> missing;
  std::error_code unknown;
  for (fs::path at = fs::absolute(folder).lexically_normal(); !fs::exists(at, unknown);) {
    if (at.has_filename()) missing.push_back(at);
    if (at == at.parent_path()) break;
    at = at.parent_path();
  }
  return missing;
}

bool exchange(const fs::path& a, const fs::path& b) {
#ifdef RENAME_EXCHANGE
  return ::renameat2(AT_FDCWD, a.c_str(), AT_FDCWD, b.c_str(), RENAME_EXCHANGE) == 0;
#else
  return false;
#endif
}

// Owner and permissions as the folder has them.
bool make_alike(const fs::path& made, const fs::path& folder) {
  struct stat wanted {
  }, own{};
  if (::stat(folder.c_str(), &wanted) != 0 || ::stat(made.c_str(), &own) != 0) return false;
  const bool same_owner = own.st_uid == wanted.st_uid && own.st_gid == wanted.st_gid;
  if (!same_owner && ::chown(made.c_str(), wanted.st_uid, wanted.st_gid) != 0) return false;
  return ::chmod(made.c_str(), wanted.st_mode & 07777U) == 0;
}

}  // namespace

struct FileSet::Place {
  fs::path named{};   // as the user writes it
  fs::path folder{};  // without links
  std::vector<std::string> names{};
  std::vector<fs::path> made{};  // folders that were not there before, the deepest first
  LockedFolder lock{}, next_lock{};
  bool is_written = false;

  [[nodiscard]] bool is_own(const std::string& name) const {
    return std::ranges::find(names, name) != names.end();
  }
  // The new folder: while it is filled, and when it is complete.
  [[nodiscard]] fs::path beside(const char* state) const {
    return folder.parent_path() / ("." + folder.filename().string() + ".frustum-" + state);
  }
  [[nodiscard]] fs::path within() const { return folder / ".frustum-next"; }

  // Moves what is not of the set back to the folder, unless it is there; removes the rest.
  void clear(const fs::path& next) const {
    std::error_code unknown;
    if (!fs::is_directory(next, unknown)) return;
    for (const auto& entry : fs::directory_iterator(next, unknown)) {
      const std::string name = entry.path().filename().string();
      if (is_own(name) || fs::exists(fs::symlink_status(folder / name, unknown))) continue;
      fs::rename(entry.path(), folder / name, unknown);
      if (unknown) return;  // nobody's files are removed
    }
    fs::remove_all(next, unknown);
  }

  [[nodiscard]] bool may_move() const {
    std::error_code failure;
    const fs::path here = fs::current_path(failure);
    const auto down = here.lexically_relative(folder);
    const bool is_inside = !failure && !down.empty() && *down.begin() != "..";
    if (failure || is_inside || !folder.has_filename()) return false;
    std::ptrdiff_t others = 0;
    for (auto at = fs::recursive_directory_iterator(folder, failure);
         !failure && at != fs::recursive_directory_iterator(); at.increment(failure)) {
      if (++others > kMostOthers) return false;
    }
    return !failure;
  }

  // Links to everything that is not of the set.
  [[nodiscard]] bool link_others(const fs::path& next) const {
    constexpr auto kAsLinks = fs::copy_options::recursive | fs::copy_options::create_hard_links |
                              fs::copy_options::copy_symlinks;
    std::error_code failure;
    for (const auto& entry : fs::directory_iterator(folder, failure)) {
      const std::string name = entry.path().filename().string();
      if (is_own(name)) continue;
      fs::copy(entry.path(), next / name, kAsLinks, failure);
      if (failure) return false;
    }
    return !failure;
  }

  [[nodiscard]] static Result<fs::path> fill(const fs::path& next,
                                             const std::map<std::string, std::string>& files) {
    for (const auto& [name, bytes] : files) {
      std::error_code failure;
      fs::create_directories((next / name).parent_path(), failure);
      auto written = write_whole_file(next / name, bytes);
      if (!written) return written;
    }
    return next;
  }

  // False where the folder must stay where it is.
  [[nodiscard]] Result<bool> write_exchanged(const std::map<std::string, std::string>& files) {
    std::error_code failure;
    const fs::path next = beside("next"), complete = beside("last");
    if (!may_move() || !fs::create_directory(next, failure)) return false;
    next_lock = LockedFolder(next);
    const bool alike = make_alike(next, folder) && next_lock.is_open() && next_lock.lock();
    if (!alike || !link_others(next)) {
      fs::remove_all(next, failure);
      return false;
    }
    const auto filled = fill(next, files);
    if (filled) fs::rename(next, complete, failure);
    const bool done = filled && !failure && exchange(complete, folder);
    if (done) {
      clear(complete);
    } else {
      fs::remove_all(next, failure);
      fs::remove_all(complete, failure);
    }
    if (!filled) return filled.error();
    return done;
  }

  [[nodiscard]] Result<fs::path> write_within(const std::map<std::string, std::string>& files) {
    std::error_code failure;
    const fs::path next = within();
    fs::create_directory(next, failure);
    if (failure) return no_folder(named, failure.message());
    auto filled = fill(next, files);
    if (filled) {
      for (auto name = names.begin(); name != names.end() && !failure; ++name) {
        fs::remove(folder / *name, failure);
      }
      std::vector<std::string> order;
      for (const auto& [name, bytes] : files) order.push_back(name);
      std::ranges::stable_sort(order, {}, [&](const auto& name) { return name == names.front(); });
      for (const std::string& name : order) {
        if (failure) break;
        fs::create_directories((folder / name).parent_path(), failure);
        if (!failure) fs::rename(next / name, folder / name, failure);
      }
      if (failure) filled = no_folder(named, failure.message());
    }
    fs::remove_all(next, failure);
    return filled;
  }
};

FileSet::FileSet(std::unique_ptr<Place> place) : place_(std::move(place)) {}
FileSet::FileSet(FileSet&&) noexcept = default;
FileSet& FileSet::operator=(FileSet&&) noexcept = default;

FileSet::~FileSet() {
  if (!place_ || place_->is_written) return;
  std::error_code not_empty;
  for (const fs::path& folder : place_->made) fs::remove(folder, not_empty);
}

Result<FileSet> FileSet::open(const fs::path& folder, std::vector<std::string> names) {
  if (folder.empty()) {
    return error("file-unwritable"_id, "the output folder has no name",
                 "name one, or . for this one");
  }
  constexpr int kTries = 10;  // another run may remove or exchange the folder between two steps
  auto place = std::make_unique<Place>();
  place->named = folder;
  place->names = std::move(names);
  place->made = missing_folders(folder);
  FileSet set(std::move(place));
  Place& at = *set.place_;
  for (int attempt = 0; attempt < kTries; ++attempt) {
    std::error_code failure;
    fs::create_directories(folder, failure);
    if (!failure) at.folder = fs::canonical(folder, failure);
    if (!failure && !fs::is_directory(at.folder))
      failure = std::make_error_code(std::errc::not_a_directory);
    if (!failure && ::access(at.folder.c_str(), W_OK | X_OK) != 0) {
      failure = std::error_code(errno, std::generic_category());
    }
    if (failure) return no_folder(folder, failure.message());
    at.lock = LockedFolder(at.folder);
    if (!at.lock.is_open()) return no_folder(folder, std::strerror(errno));
    if (!at.lock.lock()) {
      at.made.clear();
      Diagnostic in_use = error("output-in-use"_id, "another run is writing to this folder",
                                "wait for its end, or give another --out");
      in_use.file = folder.string();
      return in_use;
    }
    if (!at.lock.is_at(at.folder)) continue;
    for (const std::string& name : at.names) {
      if (auto lost = would_be_lost(at.folder / name)) return *std::move(lost);
    }
    // What a run that was killed has left.
    fs::remove_all(at.beside("next"), failure);
    fs::remove_all(at.within(), failure);
    at.clear(at.beside("last"));
    return set;
  }
  return no_folder(folder, "other runs exchange it again and again");
}

fs::path FileSet::add(const std::string& name, std::string bytes) {
  files_[name] = std::move(bytes);
  return place_->named / name;
}

std::optional<std::string> FileSet::name_of(const fs::path& path) const {
  std::error_code unknown;
  const fs::path name =
      fs::weakly_canonical(fs::absolute(path), unknown).lexically_relative(place_->folder);
  if (unknown || name.empty() || name == "." || *name.begin() == "..") return std::nullopt;
  return name.string();
}

Result<fs::path> FileSet::write() {
  for (const auto& [name, bytes] : files_) {
    if (auto lost = would_be_lost(place_->folder / name)) return *std::move(lost);
    if (!place_->is_own(name) && name.find('/') == std::string::npos) place_->names.push_back(name);
  }
  const auto exchanged = place_->write_exchanged(files_);
  if (!exchanged) return exchanged.error();
  if (!*exchanged) {
    auto written = place_->write_within(files_);
    if (!written) return written.error();
  }
  place_->is_written = true;
  return place_->named;
}

}  // namespace frustum

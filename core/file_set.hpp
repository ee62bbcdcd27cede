// The files of one result: in its folder all of them are of the same run, or all of an older one.
//
// They are written to a new folder beside, with links to what else the folder holds, and both
// folders are exchanged in one step. Until the set ends no other run may write to the folder. Where
// folders cannot be exchanged (the working directory, a mounted folder, a file system without links
// or without exchange) the old set is removed before the new one is moved in, the first of `names`
// last: while it is missing, the set is not complete.
// Units: none
// Errors: a place where no folder can be made or written to; another run that writes there
#pragma once

#include <filesystem>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "core/result.hpp"

namespace frustum {

class FileSet {
 public:
  // The folder is made if need be, and is removed again where nothing was written to it. `names`:
  // all files that such a set may have; everything else in the folder is kept.
  [[nodiscard]] static Result<FileSet> open(const std::filesystem::path& folder,
                                            std::vector<std::string> names);
  FileSet(FileSet&&) noexcept;
  FileSet& operator=(FileSet&&) noexcept;
  ~FileSet();

  // A file in the folder or below it, by its name from there; returns its path.
  std::filesystem::path add(const std::string& name, std::string bytes);
  [[nodiscard]] bool has(const std::string& name) const { return files_.contains(name); }
  // The name of a path that is in the folder or below it.
  [[nodiscard]] std::optional<std::string> name_of(const std::filesystem::path& path) const;
  // Once, after all files were added.
  [[nodiscard]] Result<std::filesystem::path> write();

 private:
  struct Place;  // the folder on disk, and what keeps others from it
  explicit FileSet(std::unique_ptr<Place> place);

  std::unique_ptr<Place> place_;
  std::map<std::string, std::string> files_{};
};

}  // namespace frustum

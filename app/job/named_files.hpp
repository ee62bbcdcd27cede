// The files that a job, an error file, a tool library or a machine file names.
//
// One table says which keys name files. Whoever writes such a document elsewhere, or has to say
// what a result was made of, asks here.
// Units : none
// Errors: a text that is not TOML; what its keys hold is judged where they are read
#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "core/result.hpp"

namespace frustum::app {

struct NamedFile {
  std::string key{};   // as of TomlChanges: "fixtures[0].file"
  std::string role{};  // in evidence: "fixture"
  std::string written{};
  std::filesystem::path file{};  // from the folder of the document, where it is a relative one
};

// In the order of the table. `document` anchors relative paths. Machine, program and plan of a job
// are those of Job.
[[nodiscard]] Result<std::vector<NamedFile>> files_named_in(std::string_view text,
                                                            const std::filesystem::path& document);

}  // namespace frustum::app

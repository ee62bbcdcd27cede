// The [errors] table of a job and of an error file.
//
// Units    : as people write them; inside mm and rad
// Errors   : mistakes in the table are noted in its document; those of other files (an error file,
//            CSV, a calibration file) are handed out with file, line and column
#pragma once

#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "core/result.hpp"
#include "core/toml_document.hpp"
#include "kinematics/errors/error_shape.hpp"

namespace frustum::kinematics {

class Machine;

// What an error file says about itself.
struct ErrorFileHead {
  std::filesystem::path file{};
  std::string title{};
  std::string source{};
  std::string machine{};    // it was written for
  std::string structure{};  // of that machine; empty: not said
};

struct ErrorList {
  std::vector<ErrorEntry> entries{};  // later ones replace earlier ones of the same name
  std::vector<ErrorFileHead> files{};
  Diagnostics problems{};
};

// Keys are error names, with a text as in parse_error, a table { value | linear | polynomial |
// harmonic | cyclic | reversal | tent | table | surface | csv = .. } or an array of such tables;
// and `drawn`, `file`, `csv`, `etalon`, `grid`, `datum`.
// `find` turns the text of `file` and the folder of the document into a path; without it: relative
// to that.
using FileFinder =
    std::function<std::filesystem::path(const std::string&, const std::filesystem::path&)>;
[[nodiscard]] ErrorList read_errors(const TomlTable& table, const FileFinder& find = {});

// A file of its own: title, source, machine, structure, [errors].
[[nodiscard]] Result<ErrorList> load_error_file(const std::filesystem::path& file);

// Why a file written for other axes does not fit this machine.
[[nodiscard]] std::optional<Diagnostic> mismatch(const ErrorFileHead& file, const Machine& machine);

}  // namespace frustum::kinematics

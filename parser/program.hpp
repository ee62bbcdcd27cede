// An NC program: its text and the language it is written in. The text is read into blocks once: of
// a text in memory when its syntax is checked, of a file as it runs, so that a program may be
// larger than memory.
//
//   %                      tape mark: nothing before the program, end of it after
//   O1000 (main)           the first program of the file is the main one, its O word may be missing
//   ...
//   M30
//   O2000 (subprogram)     called by M98 P2000, ends with M99
//
// Units: as written.
// Errors: parse_program and syntax_errors: all syntax errors of the text, one a block, up to
// kMaxSyntaxErrors; a program number that occurs twice. open_program: a file that cannot be read.
#pragma once

#include <cstddef>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "core/result.hpp"
#include "parser/dialect.hpp"
#include "parser/language/block.hpp"
#include "parser/reading/program_text.hpp"

namespace frustum::parser {

constexpr std::size_t kMaxSyntaxErrors = 100;

// A block with the places where it begins and where the next one is looked for.
struct ReadBlock {
  TextPlace place{};
  TextPlace after{};
  Block block{};
};

struct Program {
  std::string file{};  // names the program in diagnostics
  Dialect dialect = Dialect::fanuc;
  ProgramText text{};
  // All of the text, in order and without blank lines, when it has been read; else null.
  std::shared_ptr<const std::vector<ReadBlock>> blocks{};
};

// A text that is in memory, read into blocks.
[[nodiscard]] Result<Program> parse_program(std::string_view text, std::string file,
                                            Dialect dialect = Dialect::fanuc);
// A file of any size, whose syntax is checked as it runs.
[[nodiscard]] Result<Program> open_program(const std::filesystem::path& file, Dialect dialect);

// From `start` on. The whole text is read once.
[[nodiscard]] Diagnostics syntax_errors(const Program& program, TextPlace start = {});
// All blocks in file order; blank lines and those with a syntax error left out.
[[nodiscard]] std::vector<Block> blocks_of(const Program& program);

}  // namespace frustum::parser

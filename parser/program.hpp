// An NC program: its blocks in file order, and where its subprograms begin.
//
//   %                      tape mark: nothing before the program, end of it after
//   O1000 (main)           the first program of the file is the main one, its O word may be missing
//   ...
//   M30
//   O2000 (subprogram)     called by M98 P2000, ends with M99
//
// Lines end with LF, CRLF, or (when the file has no LF at all) CR. A byte order mark is skipped.
// Units: as written.
// Errors: all syntax errors of the file, one a block, up to kMaxSyntaxErrors; a program number that
// occurs twice.
#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "core/result.hpp"
#include "parser/block.hpp"
#include "parser/dialect.hpp"

namespace frustum::parser {

constexpr std::size_t kMaxSyntaxErrors = 100;

struct Program {
  std::string file{};  // names the program in diagnostics
  Dialect dialect = Dialect::fanuc;
  std::vector<Block> blocks{};                     // blank lines left out
  std::map<std::uint32_t, std::size_t> entries{};  // O number -> index of its first block
};

[[nodiscard]] Result<Program> parse_program(std::string_view text, std::string file,
                                            Dialect dialect = Dialect::fanuc);

// The block and the program as NC text: reading it again gives the same blocks (places aside).
[[nodiscard]] std::string to_text(const Block& block);
[[nodiscard]] std::string to_text(const Program& program);

}  // namespace frustum::parser

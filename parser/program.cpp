#include "parser/program.hpp"

#include <fmt/format.h>

#include <map>
#include <utility>

#include "parser/reading/block_cursor.hpp"

namespace frustum::parser {
namespace {

Diagnostic second_program(const Program& program, const Block& block, std::uint32_t first_line) {
  Diagnostic twice =
      error("program-twice"_id,
            fmt::format("program O{} is already on line {}", *block.program, first_line),
            "give each program of the file its own number");
  twice.file = program.file;
  twice.line = static_cast<int>(block.line);
  twice.column = static_cast<int>(block.program_column);
  return twice;
}

Diagnostic too_many_errors(const Program& program) {
  Diagnostic more =
      error("syntax-errors"_id,
            fmt::format("more than {} syntax errors; the rest of the file was not read",
                        kMaxSyntaxErrors - 1),
            "is this an NC program?");
  more.file = program.file;
  return more;
}

// All that follows is not for milling either.
bool is_of_another_machine(const Diagnostic& failure) { return failure.id == "not-milling"_id; }

// Reads from where the cursor is to the end of the text; `take` gets each block. What is wrong, but
// no more of it than kMaxSyntaxErrors.
template <typename Take>
Diagnostics read_to_end(const Program& program, BlockCursor& cursor, const Take& take) {
  Diagnostics failures;
  std::map<std::uint32_t, std::uint32_t> line_of_program;
  while (failures.size() < kMaxSyntaxErrors) {
    auto block = cursor.next();
    if (!block) {
      failures.push_back(std::move(block).error().front());
      if (is_of_another_machine(failures.back())) return {failures.back()};
      continue;
    }
    if (*block == nullptr) return failures;
    if ((*block)->program) {
      const auto [entry, fresh] = line_of_program.emplace(*(*block)->program, (*block)->line);
      if (!fresh) failures.push_back(second_program(program, **block, entry->second));
    }
    take(cursor);
  }
  if (cursor.at_end()) return failures;
  failures.push_back(too_many_errors(program));
  return failures;
}

}  // namespace

Result<Program> parse_program(std::string_view text, std::string file, Dialect dialect) {
  Program program{std::move(file), dialect, ProgramText(std::string(text))};
  BlockCursor cursor(program);
  std::vector<ReadBlock> blocks;
  Diagnostics failures = read_to_end(program, cursor, [&blocks](BlockCursor& at) {
    blocks.push_back({at.block_place(), at.place(), at.take()});
  });
  if (!failures.empty()) return failures;
  program.blocks = std::make_shared<const std::vector<ReadBlock>>(std::move(blocks));
  return program;
}

Result<Program> open_program(const std::filesystem::path& file, Dialect dialect) {
  return ProgramText::open(file).transform([&](ProgramText text) {
    return Program{file.string(), dialect, std::move(text)};
  });
}

Diagnostics syntax_errors(const Program& program, TextPlace start) {
  BlockCursor cursor(program);
  if (start.offset != 0) cursor.go_to(start);
  return read_to_end(program, cursor, [](const BlockCursor&) {});
}

std::vector<Block> blocks_of(const Program& program) {
  std::vector<Block> blocks;
  BlockCursor cursor(program);
  while (true) {
    const auto block = cursor.next();
    if (!block) continue;
    if (*block == nullptr) return blocks;
    blocks.push_back(**block);
  }
}

}  // namespace frustum::parser

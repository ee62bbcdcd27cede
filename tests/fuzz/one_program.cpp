#include "tests/fuzz/one_program.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstdlib>
#include <nlohmann/json.hpp>
#include <stdexcept>
#include <string>

#include "parser/interpreter.hpp"
#include "parser/program.hpp"
#include "parser/writing/block_text.hpp"
#include "parser/writing/canonical_json.hpp"
#include "tests/parser/same_block.hpp"

namespace frustum::parser {
namespace {

constexpr std::uint64_t kMaxBlocks = 10'000;
constexpr int kMostToCheck = 2000;  // motions; the sanitizers make it slow
constexpr std::size_t kMaxCalls = 32;
constexpr std::size_t kMostToPrint = 4096;  // bytes

// JSON has no infinities: they are written as null, which no motion has.
bool has_null(const nlohmann::json& json) {
  if (json.is_null()) return true;
  return std::any_of(json.begin(), json.end(), [](const nlohmann::json& part) {
    return part.is_structured() ? has_null(part) : part.is_null();
  });
}

void check(const Motion& motion) {
  const std::string line = to_json_line(motion);
  // Comments may hold the word; they are parsed to tell.
  if (line.find("null") == std::string::npos || !has_null(nlohmann::json::parse(line))) return;
  throw std::runtime_error("a motion without a number: " + line);
}

void check(const Diagnostics& failures, bool of_syntax) {
  if (!has_error(failures)) throw std::runtime_error("a failure without an error");
  for (const Diagnostic& failure : failures) {
    const bool whole = !failure.message.empty() && !failure.hint.empty();
    const bool placed = of_syntax || (failure.line > 0 && failure.column > 0);
    if (whole && placed) continue;
    throw std::runtime_error("a failure without place or hint: " + to_string(failure));
  }
}

// What is printed reads back as the same blocks.
void check_printing(const Program& program) {
  const std::vector<Block> blocks = blocks_of(program);
  const std::string text = to_text(blocks, program.dialect);
  const auto again = parse_program(text, "printed", program.dialect);
  if (!again) throw std::runtime_error("what was printed is not read: " + text);
  const std::vector<Block> read = blocks_of(*again);
  if (!std::equal(blocks.begin(), blocks.end(), read.begin(), read.end(), same_block)) {
    throw std::runtime_error("what was printed reads as other blocks: " + text);
  }
}

}  // namespace

void run_one_program(std::string_view text, Dialect dialect) {
  const auto program = parse_program(text, "fuzz", dialect);
  if (!program) return check(program.error(), true);
  static const bool prints = std::getenv("FUZZ_PRINTING") != nullptr;
  if (prints && text.size() <= kMostToPrint) check_printing(*program);
  InterpreterOptions options;
  options.max_blocks = kMaxBlocks;
  options.max_call_depth = kMaxCalls;
  int motions = 0;
  const auto check_first = [&motions](Motion&& motion) {
    if (++motions <= kMostToCheck) check(motion);
  };
  const auto summary = interpret(*program, check_first, options);
  if (!summary) check(summary.error(), false);
}

}  // namespace frustum::parser

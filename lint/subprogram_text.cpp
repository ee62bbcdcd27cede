#include "lint/subprogram_text.hpp"

#include <string_view>

#include "parser/language/letter_case.hpp"
#include "parser/reading/block_cursor.hpp"

namespace frustum::lint {
namespace {

using parser::Block;
using parser::Dialect;
using parser::FlowKind;

bool commands(const Block& block, double number) {
  for (const parser::Word& word : block.words) {
    if (word.letter == 'M' && word.expression.empty() && word.number == number) return true;
  }
  return false;
}

bool gives_back(const Block& block, Dialect dialect) {
  if (dialect == Dialect::heidenhain || dialect == Dialect::cldata) return false;
  if (dialect != Dialect::sinumerik) return commands(block, 99);
  return commands(block, 17) || (block.flow && block.flow->kind == FlowKind::give_back);
}

// PROC SLOT, or %_N_SLOT_SPF.
bool is_head_of_subprogram(const Block& block) {
  if (!block.flow || block.flow->kind != FlowKind::program) return false;
  if (!block.tape_mark) return true;
  return !block.comments.empty() &&
         parser::lower_case(block.comments.front().text).find("_spf") != std::string::npos;
}

}  // namespace

bool is_subprogram(const parser::Program& program) {
  if (program.dialect == Dialect::sinumerik && parser::lower_case(program.file).ends_with(".spf")) {
    return true;
  }
  parser::BlockCursor cursor(program);
  bool begun = false, last_gives_back = false;
  // LinuxCNC: within sub and endsub, and outside.
  bool defines = false, outside = false;
  int depth = 0;
  while (true) {
    const auto next = cursor.next();
    if (!next) continue;
    if (*next == nullptr) break;
    const Block& block = **next;
    const bool acts = !block.words.empty() || !block.assignments.empty() || block.flow;
    if (!acts) continue;
    if (!begun && program.dialect == Dialect::sinumerik && is_head_of_subprogram(block)) {
      return true;
    }
    begun = true;
    last_gives_back = gives_back(block, program.dialect);
    const bool ends = commands(block, 30) || commands(block, 2);
    const bool opens = block.flow && block.flow->kind == FlowKind::subprogram;
    if (opens) ++depth;
    defines = defines || opens;
    outside = outside || (depth == 0 && !ends);
    // A main program; behind the subprograms of LinuxCNC it ends the text alone.
    if (ends && depth == 0 && (outside || !defines)) return false;
    if (block.flow && block.flow->kind == FlowKind::end_sub) --depth;
  }
  return last_gives_back || (defines && !outside);
}

}  // namespace frustum::lint

#include "parser/writing/block_text.hpp"

#include "parser/writing/block_writer.hpp"

namespace frustum::parser {
namespace {

BlockWriter writer_of(Dialect dialect) {
  switch (dialect) {
    case Dialect::linuxcnc:
      return linuxcnc_writer();
    case Dialect::sinumerik:
      return sinumerik_writer();
    case Dialect::heidenhain:
      return heidenhain_writer();
    case Dialect::cldata:
      return cldata_writer();
    case Dialect::fanuc:
      break;
  }
  return fanuc_writer();
}

}  // namespace

std::string to_text(std::span<const Block> blocks, Dialect dialect) {
  const BlockWriter write = writer_of(dialect);
  std::string text;
  for (const Block& block : blocks) text += write(block) + '\n';
  return text;
}

}  // namespace frustum::parser

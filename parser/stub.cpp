#include "parser/block_reader.hpp"
#include "parser/grammar.hpp"
namespace frustum::parser {
Result<Block> read_sinumerik_block(std::string_view t, std::uint32_t l) {
  return parse_block(t, l);
}
Result<Block> read_heidenhain_block(std::string_view t, std::uint32_t l) {
  return parse_block(t, l);
}
BlockReader cldata_reader() { return parse_block; }
}  // namespace frustum::parser

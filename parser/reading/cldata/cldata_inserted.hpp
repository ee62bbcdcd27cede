// What INSERT of APT CLDATA hands to the control as it is: a remark, or a block.
//
// Units : none
// Errors: none
#pragma once

#include <cstdint>
#include <string_view>

namespace frustum::parser {

enum class Inserted : std::uint8_t { remark, builder_code, block };

// A block is words of a letter and a number; or it begins with G and a number, with # or with a
// statement of Klartext or Sinumerik that moves. M words alone that no control knows are the
// builder's.
[[nodiscard]] Inserted what_is_inserted(std::string_view text);

}  // namespace frustum::parser

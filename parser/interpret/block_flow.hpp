// Where a program goes after a block, as its words ask.
//
// Units : none
// Errors: none
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <variant>
#include <vector>

namespace frustum::parser {

// The largest program number of a call, and how often one call repeats.
constexpr int kMaxProgramNumber = 99'999'999;
constexpr int kMaxRepeats = 99'999;

// Where the program goes after a block.
struct NextBlock {
  bool moved = false;
};
struct EndProgram {};
struct LeaveSubprogram {
  std::uint32_t column = 0;
  std::optional<std::uint32_t> block_number{};  // where the caller goes on
  bool of_file = false;                         // the end of a whole program (END PGM)
};
// A whole program, in a file of its own.
struct CallFile {
  std::string name{};
  std::uint32_t column = 0;
};
struct CallSubprogram {
  std::uint32_t program = 0;
  bool counted = false;  // L was given
  std::uint32_t count = 1;
  std::uint32_t column = 0;
  std::optional<std::vector<double>>
      arguments{};      // of a macro: #1, #2, ...; vacant where not given
  bool modal = false;   // G66: not now, but after each block that moves
  bool blocks = false;  // M97: `program` is the number of a block
};
struct EndModalCall {};  // G67
using Flow =
    std::variant<NextBlock, EndProgram, LeaveSubprogram, CallSubprogram, CallFile, EndModalCall>;

}  // namespace frustum::parser

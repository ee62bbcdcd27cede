// A program or subprogram at work: where it is read, how often it runs, and the repeats within it.
//
// Units : none
// Errors: none
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "parser/interpret/block_executor.hpp"
#include "parser/interpret/block_numbers.hpp"
#include "parser/interpret/program_map.hpp"
#include "parser/reading/block_cursor.hpp"

namespace frustum::parser {

// A program with its map and its block numbers, once something has asked for them.
class LoadedProgram {
 public:
  enum class Role : std::uint8_t { main, file_of_subprogram };
  LoadedProgram(Program program, Role role)
      : program_(std::move(program)),
        place_file_(role == Role::main ? nullptr
                                       : std::make_shared<const std::string>(program_.file)) {}
  [[nodiscard]] const Program& program() const { return program_; }
  // What SourcePlace::file is in its blocks.
  [[nodiscard]] const std::shared_ptr<const std::string>& place_file() const { return place_file_; }
  // How many lines farther this one is than all that have run.
  std::uint64_t advance_to(std::uint32_t line) {
    const std::uint64_t by = line > farthest_ ? line - farthest_ : 0;
    farthest_ += static_cast<std::uint32_t>(by);
    return by;
  }
  [[nodiscard]] const ProgramMap& map() {
    if (!map_) map_.emplace(program_);
    return *map_;
  }
  [[nodiscard]] const BlockNumbers& numbers() {
    if (!numbers_) numbers_.emplace(program_);
    return *numbers_;
  }

 private:
  Program program_;
  std::shared_ptr<const std::string> place_file_;
  std::optional<ProgramMap> map_{};
  std::optional<BlockNumbers> numbers_{};
  std::uint32_t farthest_ = 0;
};

// A loop that counts.
struct CountedLoop {
  std::uint64_t begin = 0;  // offset of its first block
  double turns_left = 0.0;
  std::string variable{};  // that goes up by 1 to `limit`, instead
  double limit = 0.0;
};
// A segment of blocks that runs again when its end is reached.
struct RepeatedPart {
  TextPlace begin{};
  std::uint64_t end = 0;
  TextPlace behind{};
  std::uint64_t turns_left = 0;
};

// G66: the macro that runs after each block that moves.
struct ModalMacro {
  CallSubprogram call{};  // its arguments are what the macro has left of them
};

// What a call gives: values, vacant where one is left out, and the names of those that are
// variables.
struct GivenArguments {
  std::vector<double> values{};
  std::vector<std::string> variables{};
};

struct CallFrame {
  std::shared_ptr<LoadedProgram> program;
  BlockCursor cursor;
  std::string name{};  // "O2000", "pocket"; empty for the main program
  std::string end{};   // of the subprogram, as it is spelled: "M99", "endsub"
  TextPlace entry{};
  SourcePlace named{};  // where its name stands
  std::uint64_t runs_left = 1;
  bool has_locals = false;
  bool opened = false;         // a block that does something has been reached
  GivenArguments arguments{};  // for the head of the program
  // What gives its value back to which variable of the caller (VAR).
  std::vector<std::pair<std::string, std::string>> given_back{};
  std::vector<std::pair<std::string, std::string>> given_back_arrays{};
  std::vector<CountedLoop> loops{};
  std::vector<RepeatedPart> parts{};
  // Those at work in this program, innermost last. Moves of a macro called by one of them call
  // those before it.
  std::vector<ModalMacro> modal_macros{};
  bool is_modal = false;  // called by the last one of its caller
};

}  // namespace frustum::parser

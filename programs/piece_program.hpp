// The NC program of a test piece while it is made: blocks of motions, and the text that they
// become.
//
// Units  : as motions
// Errors : what a dialect has no words for (tool vectors on LinuxCNC), with the remedy
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "core/result.hpp"
#include "parser/motion.hpp"
#include "parser/writing/motion_writer.hpp"
#include "programs/test_piece.hpp"

namespace frustum::programs {

class PieceProgram {
 public:
  // The number is that of controllers that number programs; the title is the first comment.
  PieceProgram(std::string number, std::string title);

  // Motions that are one block where a dialect can say them in one.
  void block(std::vector<parser::Command> commands);
  void comment(std::string text);
  // Without compensation, as the modes say that dialects begin with; after the comments about the
  // whole.
  void without_compensation();
  // The number of the block that comes next, as operations of the piece name it until it is
  // written.
  [[nodiscard]] std::uint32_t next_block() const { return blocks_ + 1; }

  // F in every block that begins to cut, not only where it changes.
  void restate_feed() { restate_feed_ = true; }

  // Writes the text of `piece` in a dialect and names its operations' lines in it.
  [[nodiscard]] Result<parser::NcProgram> write(TestPiece& piece, parser::Dialect dialect) const;

 private:
  std::string number_;
  std::vector<parser::Motion> motions_{};
  std::uint32_t blocks_ = 0;
  bool restate_feed_ = false;
};

// The place of a tool tip, and a rapid to axis positions.
[[nodiscard]] parser::AxisTarget tip_target(const Vec3& tip);
[[nodiscard]] parser::Command machine_traverse(const parser::AxisTarget& end);

}  // namespace frustum::programs

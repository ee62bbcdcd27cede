// The feed of a block, or of a part of it, that keeps the time the program gave the block.
//
// Units  : mm, rad, minutes
// Errors : feed per revolution with the spindle at rest
#pragma once

#include "core/result.hpp"
#include "parser/motion.hpp"

namespace frustum::post {

// `counted`: what the feed counts over the block, BlockMotion::feed_length.
[[nodiscard]] Result<double> minutes_of(const parser::Feed& feed, double counted,
                                        double spindle_speed);

// What a part of a block does in the words of the output.
struct PartOfBlock {
  double minutes = 0.0;
  double length = 0.0;     // mm, straight, of what X Y Z words name
  double turn = 0.0;       // rad, of the rotary axes together
  bool tip_words = false;  // X Y Z words name the tip
  bool arc = false;
};
[[nodiscard]] parser::Feed feed_for(const parser::Feed& written, const PartOfBlock& part);

}  // namespace frustum::post

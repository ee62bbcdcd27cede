#include "post/planning/block_feed.hpp"

#include <cmath>

#include "core/units.hpp"

namespace frustum::post {

using parser::Feed;
using parser::FeedMode;

Result<double> minutes_of(const Feed& feed, double counted, double spindle_speed) {
  switch (feed.mode) {
    case FeedMode::per_minute:
      return counted / feed.value;
    case FeedMode::inverse_time:
      return 1.0 / feed.value;
    case FeedMode::per_revolution:
      break;
  }
  if (spindle_speed > 0.0) return counted / (feed.value * spindle_speed);
  return error("spindle-off"_id, "feed per revolution with the spindle at rest",
               "start the spindle before");
}

Feed feed_for(const Feed& written, const PartOfBlock& part) {
  // rad and mm: below any written word; an axis and a tip that move by less are at rest.
  constexpr double kAxesStand = 1e-12;
  constexpr double kTipStands = 1e-9;
  if (!(part.minutes > 0.0) || written.synchronised) return written;
  const bool axes_turn = !part.tip_words && part.turn > kAxesStand;
  if (axes_turn || written.mode == FeedMode::inverse_time) {
    return {1.0 / part.minutes, FeedMode::inverse_time};
  }
  if (part.arc || written.mode == FeedMode::per_revolution) return written;
  // Where X Y Z are at rest the feed is that of the rotary axes, in deg/min.
  const double counted = part.length > kTipStands ? part.length : part.turn * kDegPerRad;
  const double feed = counted / part.minutes;
  // A chord is shorter than its arc; a feed that changes by less than a millionth is the same feed.
  constexpr double kSameFeed = 1e-6;
  if (std::abs(feed - written.value) <= kSameFeed * written.value) return written;
  return {feed, FeedMode::per_minute};
}

}  // namespace frustum::post

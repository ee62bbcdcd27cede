// One canonical motion -> one line of JSON, as `frustum parse --canon` prints it.
//
//   {"line":7,"type":"feed","end":{"X":1.0,"C":90.0},"feed":200.0}
// Types: traverse, home, feed, arc, dwell, tool_change, compensation, work_offset,
// orientation_path, rotary_path, tilted_plane, align_to_plane, spindle, coolant, stop, event. Keys
// that would say nothing are left out: "coordinates" only when "machine", "tool_axis" only with a
// tool vector, "feed_mode" only when not per minute. A stream that ends early ends with the error:
// {"line":12,"column":7,"type":"error","message":"..","hint":".."}.
// Units: mm, degrees, mm/min (deg/min, 1/min), seconds, 1/min. Numbers read back as the same value;
// angles as the same radians.
// Errors: none.
#pragma once

#include <string>
#include <string_view>

#include "core/diagnostic.hpp"
#include "parser/motion.hpp"

namespace frustum::parser {

// As in the list above.
[[nodiscard]] std::string_view type_of(const Command& command);

// Without a line feed.
[[nodiscard]] std::string to_json_line(const Motion& motion);
[[nodiscard]] std::string to_json_line(const Diagnostic& error);

}  // namespace frustum::parser

// The records of APT CLDATA that set a mode: feed, spindle, tool, unit, tool axis, the frame of an
// operation, coolant; and dwells.
//
// Units : as written
// Errors: by LineScanner::fail: words without a meaning in the record, a number that is missing
#pragma once

#include <string_view>
#include <vector>

#include "parser/reading/cldata/cldata_record.hpp"

namespace frustum::parser {

// What later records are read by.
struct CldataModes {
  bool multax = false;
  bool feed_per_revolution = false;
  bool inches = false;
  const char* spindle = "SPINDL/CLW";  // the last direction, for SPINDL/ON
  std::vector<CldataArgument> axis{};  // of TLAXIS and CSYS: i, j, k
  bool world = false;                  // places count in the part's frame (TRNTYP/WORLD)
  bool feed_given = false;
  double feed = 0.0;   // in the file's unit
  double speed = 0.0;  // of the spindle, 1/min
};

// False when the record is none of these.
[[nodiscard]] bool read_cldata_setting(LineScanner& in, const CldataRecord& record,
                                       CldataModes& modes, Block& block);
[[nodiscard]] std::vector<std::string_view> cldata_setting_words();

}  // namespace frustum::parser

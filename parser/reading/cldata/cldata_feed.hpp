// The units of feeds in APT CLDATA: MMPM, MMPR, IPM, IPR, FPM, FPR, PERMIN, PERREV.
//
// Units : `scale` brings a feed to the file's own unit
// Errors: nothing for other words
#pragma once

#include <optional>
#include <string_view>

#include "core/units.hpp"

namespace frustum::parser {

struct CldataFeedUnit {
  bool per_revolution = false;
  double scale = 1.0;
};

[[nodiscard]] inline std::optional<CldataFeedUnit> cldata_feed_unit(std::string_view word,
                                                                    bool inches) {
  const double from_mm = inches ? 1.0 / kMmPerInch : 1.0;
  const double from_inches = inches ? 1.0 : kMmPerInch;
  if (word == "PERMIN") return CldataFeedUnit{false, 1.0};
  if (word == "PERREV") return CldataFeedUnit{true, 1.0};
  if (word == "MMPM") return CldataFeedUnit{false, from_mm};
  if (word == "MMPR") return CldataFeedUnit{true, from_mm};
  if (word == "IPM") return CldataFeedUnit{false, from_inches};
  if (word == "IPR") return CldataFeedUnit{true, from_inches};
  constexpr double kInchesPerFoot = 12.0;
  if (word == "FPM") return CldataFeedUnit{false, kInchesPerFoot * from_inches};
  if (word == "FPR") return CldataFeedUnit{true, kInchesPerFoot * from_inches};
  return std::nullopt;
}

}  // namespace frustum::parser

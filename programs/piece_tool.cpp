#include "programs/piece_tool.hpp"

#include <algorithm>

namespace frustum::programs {

cutter::CutterSpec piece_tool(Mm diameter, Mm length, Mm flutes) {
  constexpr double kChuckWider = 30.0, kChuck = 60.0, kShortestChuck = 20.0, kFreeShank = 10.0;
  cutter::CutterSpec tool{.type = cutter::CutterType::flat,
                          .diameter = diameter,
                          .length = length,
                          .flute_length = {std::min(flutes.value, length.value)},
                          .shank_diameter = diameter};
  const double chuck = std::min(kChuck, length.value - tool.flute_length.value - kFreeShank);
  if (chuck < kShortestChuck) return tool;
  const double wide = diameter.value + kChuckWider;
  tool.holder = {{chuck, wide, wide}};
  return tool;
}

}  // namespace frustum::programs

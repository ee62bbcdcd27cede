#include "programs/step/near_net_blank.hpp"

#include <cmath>

namespace frustum::programs {

stock::LoftShape near_net_blank(const stock::LoftShape& body, double allowance) {
  stock::LoftShape blank;
  const auto slabs = stock::slabs_of(body);
  for (std::size_t i = 0; i < slabs.size(); ++i) {
    const stock::LoftSection& bottom = slabs[i].bottom;
    const stock::LoftSection& top = slabs[i].top;
    const auto offset = [&](const stock::LoftSection& at, bool shifted) {
      const double rise = shifted ? allowance : 0.0;
      // Perpendicular to a face that leans inwards by m per mm of height, and on at that slope.
      const auto wider = [&](double from, double to, double size) {
        const double m = 0.5 * (to - from) / (top.z - bottom.z);
        return size + 2.0 * (allowance * std::sqrt(1.0 + m * m) + m * rise);
      };
      // A nanometre is enough for stock, and reads better than all digits.
      const auto neat = [](double mm) { return std::round(mm * 1e6) / 1e6; };
      blank.sections.push_back({neat(at.z + rise),
                                neat(wider(bottom.size_x, top.size_x, at.size_x)),
                                neat(wider(bottom.size_y, top.size_y, at.size_y))});
    };
    offset(bottom, i > 0);
    offset(top, i + 1 < slabs.size());
  }
  return blank;
}

}  // namespace frustum::programs

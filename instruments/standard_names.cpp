#include "instruments/standard_names.hpp"

#include <array>

namespace frustum::instruments {

std::span<const StandardTest> standard_tests() {
  static constexpr std::array kTests{
      StandardTest{"BK1", "tilting rotary table",
                   "rotary --axis A (or B) --direction axial, radial, tangential",
                   "location errors of the tilting axis, with two linear axes following", true},
      StandardTest{"BK2", "tilting rotary table",
                   "rotary --axis C --direction axial, radial, tangential",
                   "location errors of the table's own axis, with two linear axes following", true},
      StandardTest{"BK3", "tilting rotary table", "chase --at \"A=..,C=..;..\"",
                   "both rotary axes while the tip stays at one ball", false},
      StandardTest{"BK4", "tilting rotary table", "cone --sense normal, radial",
                   "five axes at once on the path of the cone test", true}};
  return kTests;
}

}  // namespace frustum::instruments

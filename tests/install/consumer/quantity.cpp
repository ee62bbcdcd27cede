// Prints a quantity in internal units: `quantity "10 um"` prints "0.01 mm".
#include <iostream>

#include "core/units.hpp"

int main(int argc, char** argv) {
  const auto length = frustum::parse_length(argc > 1 ? argv[1] : "");
  if (!length) {
    frustum::print(std::cerr, length.error());
    return 2;
  }
  std::cout << length->value << " mm\n";
}

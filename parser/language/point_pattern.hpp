// The elements of PATTERN DEF of Klartext, and the letters that their words have in
// Block::pattern.
//
//   POS        X Y           a place
//   ROW        X Y D NUM     NUM places D apart on a line by ROT from the first one
//   PAT        X Y DX DY NUMX NUMY   lines of places, turned by ROT about the first one; ROTX and
//                            ROTY turn the lines and what is across them alone, beyond ROT
//   FRAME      the same      the outer ones of them
//   CIRC       X Y D NUM     evenly on the circle of diameter D about X Y, from START on
//   PITCHCIRC  X Y D NUM     from START on each STEP further, or the last one at END
//
// Z raises the surface of the cycle, which Q203 gives, by so much.
// Units : none; values are as written
// Errors: none
#pragma once

#include <array>
#include <string_view>

namespace frustum::parser {

struct PatternElement {
  std::string_view name;
  std::string_view needed;
  std::string_view optional;
};
inline constexpr std::array kPatternElements{
    PatternElement{"POS", "XY", "Z"},        PatternElement{"ROW", "XYDN", "RZ"},
    PatternElement{"PAT", "XYuvxy", "RabZ"}, PatternElement{"FRAME", "XYuvxy", "RabZ"},
    PatternElement{"CIRC", "XYDN", "SZ"},    PatternElement{"PITCHCIRC", "XYDN", "STEZ"}};

struct PatternLetter {
  std::string_view name;
  char letter;
};
// Those that begin with another one are before it.
inline constexpr std::array kPatternLetters{
    PatternLetter{"NUMX", 'x'},  PatternLetter{"NUMY", 'y'}, PatternLetter{"NUM", 'N'},
    PatternLetter{"ROTX", 'a'},  PatternLetter{"ROTY", 'b'}, PatternLetter{"ROT", 'R'},
    PatternLetter{"START", 'S'}, PatternLetter{"STEP", 'T'}, PatternLetter{"END", 'E'},
    PatternLetter{"DX", 'u'},    PatternLetter{"DY", 'v'},   PatternLetter{"D", 'D'},
    PatternLetter{"X", 'X'},     PatternLetter{"Y", 'Y'},    PatternLetter{"Z", 'Z'}};

constexpr std::string_view pattern_word(char letter) {
  for (const PatternLetter& known : kPatternLetters) {
    if (known.letter == letter) return known.name;
  }
  return {};
}

}  // namespace frustum::parser

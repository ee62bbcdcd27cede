// Sets of word letters.
//
// Units : none
// Errors: none
#pragma once

#include <bit>
#include <cstdint>
#include <string_view>

namespace frustum::parser {

// A set of the letters A to Z and a to z. Characters before A and behind z are in no set, and
// adding them changes nothing.
class LetterSet {
 public:
  constexpr LetterSet() = default;
  constexpr explicit LetterSet(std::string_view letters) {
    for (const char letter : letters) bits_ |= bit(letter);
  }
  [[nodiscard]] constexpr bool has(char letter) const { return (bits_ & bit(letter)) != 0; }
  [[nodiscard]] constexpr bool empty() const { return bits_ == 0; }
  [[nodiscard]] constexpr LetterSet operator|(LetterSet other) const {
    return of(bits_ | other.bits_);
  }
  [[nodiscard]] constexpr LetterSet operator&(LetterSet other) const {
    return of(bits_ & other.bits_);
  }
  [[nodiscard]] constexpr LetterSet without(LetterSet other) const {
    return of(bits_ & ~other.bits_);
  }
  // The first of the alphabet, capitals before small letters; of an empty set none.
  [[nodiscard]] constexpr char first() const {
    return static_cast<char>('A' + std::countr_zero(bits_));
  }
  [[nodiscard]] constexpr LetterSet without_first() const { return of(bits_ & (bits_ - 1)); }
  constexpr void add(char letter) { bits_ |= bit(letter); }

 private:
  static constexpr std::uint32_t kPlaces = 'z' - 'A' + 1;
  static constexpr std::uint64_t bit(char letter) {
    const auto place = static_cast<std::uint32_t>(letter - 'A');
    return place < kPlaces ? std::uint64_t{1} << place : 0;
  }
  static constexpr LetterSet of(std::uint64_t bits) {
    LetterSet set;
    set.bits_ = bits;
    return set;
  }
  std::uint64_t bits_ = 0;
};

constexpr LetterSet kAxisWords{"XYZABC"};
constexpr LetterSet kLinearWords{"XYZ"};
constexpr LetterSet kRotaryWords{"ABC"};

}  // namespace frustum::parser

// The G and M words a program may use: a table, so that a dialect is data.
//
// A code belongs to a modal group, of which a block may hold one word. Codes that are known but
// change nothing that is simulated are events; codes that would change the part and are not
// simulated are refused with a remedy. Everything else is unknown.
// Units: none.
// Errors: none; find_code returns null for what is not in the table.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <string_view>

namespace frustum::parser {

// A set of the letters A to Z.
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
  constexpr void add(char letter) { bits_ |= bit(letter); }

 private:
  static constexpr std::uint32_t bit(char letter) {
    return 1U << static_cast<std::uint32_t>(letter - 'A');
  }
  static constexpr LetterSet of(std::uint32_t bits) {
    LetterSet set;
    set.bits_ = bits;
    return set;
  }
  std::uint32_t bits_ = 0;
};

constexpr LetterSet kAxisWords{"XYZABC"};
constexpr LetterSet kLinearWords{"XYZ"};
constexpr LetterSet kRotaryWords{"ABC"};
constexpr LetterSet kVectorWords{"IJK"};

enum class CodeGroup : std::uint8_t {
  motion,
  cycle,  // G80, which may stand beside G0 in a safe line; alone it cancels the motion
  non_modal,
  plane,
  distance,
  arc_distance,
  feed_mode,
  unit,
  radius_compensation,
  length_compensation,
  work_offset,
  path_control,
  tool_change,
  spindle,
  coolant,
  stop,
  subprogram,
  event,  // no group: several may stand in a block
};
constexpr std::size_t kCodeGroups = static_cast<std::size_t>(CodeGroup::event);

// The values of the groups that have no enum of their own.
enum class NonModal : std::uint8_t { none, dwell, home, machine_coordinates };
enum class SubprogramWord : std::uint8_t { none, call, leave };
enum class LengthWord : std::uint8_t { off, length, tool_centre_point, tool_vectors };
enum class CoolantWord : std::uint8_t { off, flood };

struct Code {
  char letter;
  int tenths;  // ten times the number: G43.4 has 434
  CodeGroup group;
  std::uint8_t value;   // enumerator of what the group sets
  LetterSet arguments;  // words that belong to this code
  bool event;           // known, not simulated

  [[nodiscard]] std::string name() const;
};

// A code that would change the part and that is not simulated.
struct RefusedCode {
  char letter;
  int first_tenths;  // of the range of codes
  int last_tenths;
  std::string_view remedy;
};

[[nodiscard]] const Code* find_code(char letter, double number);
[[nodiscard]] const RefusedCode* find_refused(char letter, double number);
// "G0 G1 G2 ...": all known codes of the letter.
[[nodiscard]] std::string known_codes(char letter);
// What a letter belongs to, for the hint when nothing in the block uses it; empty for unknown
// letters.
[[nodiscard]] std::string_view letter_use(char letter);

}  // namespace frustum::parser

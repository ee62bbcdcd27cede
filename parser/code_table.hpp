// The words a program may use, of every dialect: one table, so that a dialect is data.
//
// A code is a G or M number, or a word without one (TRAORI, TOOL CALL). It belongs to a modal group,
// of which a block may hold one word. Codes that are known but change nothing that is simulated are
// events; codes that would change the part and are not simulated are refused with a remedy.
// Everything else is unknown.
// Units: none.
// Errors: none; find_code returns null for what the dialect does not have.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <string_view>

#include "parser/dialect.hpp"

namespace frustum::parser {

// A set of the letters A to Z and a to z.
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
  static constexpr std::uint64_t bit(char letter) {
    return std::uint64_t{1} << static_cast<std::uint32_t>(letter - 'A');
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

enum class CodeGroup : std::uint8_t {
  motion,
  cycle,  // G80, which may stand beside G0 in a safe line; alone it cancels the motion
  non_modal,
  plane,
  distance,
  arc_distance,
  feed_mode,
  feed_source,
  unit,
  radius_compensation,
  length_compensation,
  tool_tip,
  work_offset,
  tilted_plane,
  orientation_path,
  rotary_path,
  path_control,
  retract,
  speed_mode,
  saved_modes,
  tool_change,
  spindle,
  coolant,
  stop,
  subprogram,
  event,  // no group: several may stand in a block
};
constexpr std::size_t kCodeGroups = static_cast<std::size_t>(CodeGroup::event);

// The values of the groups that have no enum of their own.
enum class NonModal : std::uint8_t {
  none,
  dwell,
  home,
  machine_coordinates,
  align,           // the rotary axes to the normal of the tilted plane
  pole,            // the centre of the arcs that follow
  start,           // where the tool is before the program moves it
  shift_to_place,  // G92: so that the tool is where the words say
  shift,           // G52
  shift_off,
  shift_suspend,
  shift_resume
};
enum class SubprogramWord : std::uint8_t { none, call, leave, macro };
// The last two leave the tool-tip switch as it is.
enum class LengthWord : std::uint8_t {
  off,
  length,
  tool_centre_point,
  tool_vectors,
  length_only,
  length_only_off
};
enum class TipWord : std::uint8_t { off, on };
enum class CoolantWord : std::uint8_t { off, flood };
enum class SpeedWord : std::uint8_t { revolutions, surface };
enum class SavedModesWord : std::uint8_t { save, drop, restore, save_for_call };
enum class RetractWord : std::uint8_t { initial, level };
// Where the frame of a tilted plane comes from.
enum class TiltWord : std::uint8_t {
  off,
  euler,    // shift X Y Z; turns I J K about Z, the new X, the new Z
  swivel,   // shift X Y Z; turns A B C in the order that Q names; shift u v w
  turn,     // G68: about the centre X Y by R, in the plane
  spatial,  // turns A B C about the axes of the untilted X, Y, Z in this order
};

struct Code {
  std::uint8_t dialects;  // bits by Dialect
  char letter;            // G or M; '@' for a word without number
  int tenths;             // ten times the number: G43.4 has 434
  CodeGroup group;
  std::uint8_t value;     // enumerator of what the group sets
  LetterSet arguments;    // words that belong to this code
  bool event;             // known, not simulated
  std::string_view word;  // for '@'

  [[nodiscard]] std::string name() const;
};

[[nodiscard]] const Code* find_code(Dialect dialect, char letter, double number);
[[nodiscard]] const Code* find_code(Dialect dialect, std::string_view word);
// The row of a code in the table and back, by which a kNamedWord refers to it.
[[nodiscard]] double row_of(const Code& code);
[[nodiscard]] const Code& code_at(double row);
// What to do instead of a code that would change the part and that is not simulated; empty when
// there is no such code.
[[nodiscard]] std::string_view remedy_for(Dialect dialect, char letter, double number);
[[nodiscard]] std::string_view remedy_for(Dialect dialect, std::string_view word);
// "TRAORI CYCLE800 ...": all known words.
[[nodiscard]] std::string known_words(Dialect dialect);
// "G73 G74 G80": the known codes of the letter that are nearest to a number.
[[nodiscard]] std::string codes_near(Dialect dialect, char letter, double number);

}  // namespace frustum::parser

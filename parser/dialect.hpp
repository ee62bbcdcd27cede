// The languages that NC programs are written in.
//
// Units  : none
// Errors : none; a text whose language cannot be identified is taken as Fanuc's, and the reason
//          says so
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

namespace frustum::parser {

enum class Dialect : std::uint8_t { fanuc, linuxcnc, sinumerik, heidenhain, cldata };
inline constexpr std::array kDialects{Dialect::fanuc, Dialect::linuxcnc, Dialect::sinumerik,
                                      Dialect::heidenhain, Dialect::cldata};

// "fanuc", as --dialect and job files write it.
[[nodiscard]] std::string_view name_of(Dialect dialect);
// "iso" is read as fanuc.
[[nodiscard]] std::optional<Dialect> dialect_named(std::string_view name);

struct RecognisedDialect {
  Dialect dialect = Dialect::fanuc;
  std::string reason{};  // "line 3: TRAORI", "the name ends in .mpf", "nothing says otherwise"
};
[[nodiscard]] RecognisedDialect recognise_dialect(std::string_view text, std::string_view file);

}  // namespace frustum::parser

#include "parser/reading/cldata/cldata_place.hpp"

#include "parser/language/letter_case.hpp"
#include "parser/reading/plain_number.hpp"

namespace frustum::parser {
namespace {

class PlaceScanner {
 public:
  explicit PlaceScanner(std::string_view text) : text_(text) {}

  void skip_blanks() {
    while (place_ < text_.size() &&
           (text_[place_] == ' ' || text_[place_] == '\t' || text_[place_] == '\r')) {
      ++place_;
    }
  }
  bool take(char expected) {
    if (place_ >= text_.size() || upper(text_[place_]) != expected) return false;
    ++place_;
    return true;
  }
  [[nodiscard]] bool at_end() const { return place_ == text_.size(); }
  [[nodiscard]] std::uint32_t column() const { return static_cast<std::uint32_t>(place_) + 1; }

  // Digits and a point, without an exponent.
  bool take_number(double& value) {
    const bool negative = take('-');
    if (!negative) take('+');
    skip_blanks();
    const auto number = read_plain_number(text_.data() + place_, text_.data() + text_.size());
    if (!number) return false;
    place_ = static_cast<std::size_t>(number->end - text_.data());
    value = (negative ? -number->value : number->value) + 0.0;
    return true;
  }

 private:
  std::string_view text_;
  std::size_t place_ = 0;
};

}  // namespace

std::optional<CldataPlace> read_cldata_place(std::string_view text) {
  PlaceScanner in(text);
  in.skip_blanks();
  CldataPlace place;
  place.column = in.column();
  if (!in.take('G') || !in.take('O') || !in.take('T') || !in.take('O')) return std::nullopt;
  in.skip_blanks();
  if (!in.take('/')) return std::nullopt;
  do {
    if (place.count == place.numbers.size()) return std::nullopt;
    in.skip_blanks();
    place.columns[place.count] = in.column();
    if (!in.take_number(place.numbers[place.count])) return std::nullopt;
    ++place.count;
    in.skip_blanks();
  } while (in.take(','));
  if (!in.at_end() || (place.count != 3 && place.count != 6)) return std::nullopt;
  return place;
}

}  // namespace frustum::parser

// Path statements of Klartext: L, LN, C, CR, CT, LP, CP, CTP, CC and the elements of a line.
#include <fmt/format.h>

#include <array>
#include "core/decimal.hpp"
#include "parser/dialects/code_table.hpp"
#include "parser/reading/heidenhain/heidenhain_statements.hpp"

namespace frustum::parser {
namespace {

struct Element {
  std::string_view name;
  char letter;
  const char* spelled;
};
constexpr std::array kIncremental{Element{"IX", 'X', "IX"}, Element{"IY", 'Y', "IY"},
                                  Element{"IZ", 'Z', "IZ"}, Element{"IA", 'A', "IA"},
                                  Element{"IB", 'B', "IB"}, Element{"IC", 'C', "IC"}};
struct PolarElement {
  std::string_view name;
  char letter;
  Measure measure;
};
constexpr std::array kPolar{PolarElement{"PR", kPolarRadius, Measure::modal},
                            PolarElement{"PA", kPolarAngle, Measure::modal},
                            PolarElement{"IPR", kPolarRadius, Measure::incremental},
                            PolarElement{"IPA", kPolarAngle, Measure::incremental}};
constexpr std::array kToolVector{Element{"TX", 'a', "TX"}, Element{"TY", 'b', "TY"},
                                 Element{"TZ", 'c', "TZ"}};

template <typename Known, std::size_t N>
const Known* find(const std::array<Known, N>& elements, std::string_view name) {
  for (const Known& element : elements) {
    if (element.name == name) return &element;
  }
  return nullptr;
}

// What a statement has room for.
struct Path {
  bool axes = false;
  bool polar = false;
  bool vector = false;
  bool radius = false;
  bool sense = false;
  bool feed = false;
};

class PathReader {
 public:
  explicit PathReader(BlockDraft& draft) : draft_(draft), in_(draft.in), block_(draft.block) {}

  void read_path(const std::string& statement, std::uint32_t column) {
    const bool tangential = statement.starts_with("CT");
    const bool polar = statement.ends_with('P');
    const bool arc = statement.front() == 'C' && !tangential;
    // The place of the statement's word; which word it is follows from the elements.
    block_.words.push_back({kNamedWord, false, column, 0.0, {}});
    Path path;
    path.axes = true;
    path.polar = polar;
    path.vector = statement == "LN";
    path.radius = statement == "CR";
    path.sense = arc;
    path.feed = true;
    read_elements(statement, path);
    if (in_.failed()) return;
    std::string word = polar ? statement.substr(0, statement.size() - 1) : statement;
    if (tangential) {
      if (rapid_)
        return in_.fail("word-misplaced"_id, column, statement + " with FMAX",
                        "give an arc a feed");
      add_number(block_, kTangential, 1.0, column);
    } else if (arc) {
      if (sense_ == 0) {
        return in_.fail("keyword-missing"_id, column, statement + " has no direction",
                        "end it with DR+ or DR-");
      }
      if (rapid_)
        return in_.fail("word-misplaced"_id, column, statement + " with FMAX",
                        "give an arc a feed");
      word += sense_ == '+' ? " DR+" : " DR-";
    } else if (rapid_) {
      word += " FMAX";
    }
    block_.words.front().number = row_of(*find_code(Dialect::heidenhain, word));
    if (statement == "CP" && !has_angle_) {
      return in_.fail("value-missing"_id, column, "CP has no angle",
                      "give PA or IPA; a full turn is IPA+360 DR+");
    }
    if (statement == "CR" && !has_radius_) {
      in_.fail("value-missing"_id, column, "CR has no radius",
               "give R and the radius, for example R+10");
    }
  }

  void read_elements(const std::string& statement, const Path& path) {
    while (!in_.at_end()) {
      if (in_.peek() == ';') {
        draft_.read_comment();
        continue;
      }
      read_element(statement, path);
    }
  }

  void read_pole(std::uint32_t column) {
    add_code(block_, *find_code(Dialect::heidenhain, "CC"), column);
    while (!in_.at_end() && in_.peek() != ';') {
      const std::uint32_t place = in_.column();
      const std::string name = in_.letters();
      const Element* element = find(kIncremental, name);
      const std::string axis = element == nullptr ? name : std::string(1, element->letter);
      if (axis != "X" && axis != "Y") {
        if (name.empty()) return in_.fail_unexpected("write CC X+0 Y+0");
        return in_.fail("unknown-word"_id, place, fmt::format("{} has no meaning in CC", name),
                        "the pole has X and Y: CC X+0 Y+0");
      }
      add_measured(axis.front(), element == nullptr ? Measure::modal : Measure::incremental,
                   element == nullptr ? nullptr : element->spelled, place);
    }
    if (in_.peek() == ';') draft_.read_comment();
  }

 private:
  void read_element(const std::string& statement, const Path& path) {
    const std::uint32_t column = in_.column();
    const std::string name = in_.letters();
    const auto is_axis = [&](std::string_view letters) {
      return path.axes && name.size() == 1 && letters.find(name.front()) != std::string_view::npos;
    };
    if (name == "M") return read_m(column);
    if (is_axis("XYZABC")) return add_measured(name.front(), Measure::modal, nullptr, column);
    if (const Element* element = find(kIncremental, name); path.axes && element != nullptr) {
      return add_measured(element->letter, Measure::incremental, element->spelled, column);
    }
    if (const PolarElement* element = find(kPolar, name); path.polar && element != nullptr) {
      has_angle_ = has_angle_ || element->letter == kPolarAngle;
      return add_measured(element->letter, element->measure, element->name.data(), column);
    }
    if (const Element* element = find(kToolVector, name); path.vector && element != nullptr) {
      return add_value(draft_, element->letter, name, column, element->spelled);
    }
    if (path.vector && (name == "NX" || name == "NY" || name == "NZ")) {
      // The surface normal matters to oversized tools only, which TOOL CALL refuses.
      (void)in_.signed_number(name, column);
      return;
    }
    if (path.sense && name == "DR" && (in_.peek() == '+' || in_.peek() == '-')) {
      if (sense_ != 0)
        return in_.fail("word-twice"_id, column, "DR is given twice", "leave one of them out");
      sense_ = in_.peek();
      in_.take(sense_);
      return;
    }
    if (name == "R") return read_radius(statement, path, column);
    if (name == "RL" || name == "RR") {
      if (!path.axes || path.vector) {
        return in_.fail("not-supported"_id, column,
                        fmt::format("{} in {} is not simulated", name, statement),
                        "radius compensation belongs to L, C, CR, CT, LP, CP and CTP");
      }
      return add_code(block_, *find_code(Dialect::heidenhain, name), column);
    }
    if (path.feed && name.starts_with('F')) return read_feed(name, column);
    if (name.empty()) {
      return in_.fail_unexpected("elements of a statement are such as X+10, R0, F500, FMAX, M3");
    }
    in_.fail("unknown-word"_id, column, fmt::format("{} has no meaning in {}", name, statement),
             "known are X Y Z A B C, I before them, R0, F, FMAX, F AUTO, FT, M; TX TY TZ in LN; "
             "DR+ and DR- in C, CR and CP; PR and PA in LP, CP and CTP");
  }

  void read_radius(const std::string& statement, const Path& path, std::uint32_t column) {
    const bool is_signed = in_.peek_byte() == '+' || in_.peek_byte() == '-';
    const double value = in_.signed_number("R", column);
    if (!is_signed && value == 0.0) {
      add_code(block_, *find_code(Dialect::heidenhain, "R0"), column);
      return;
    }
    if (!path.radius) {
      return in_.fail("word-misplaced"_id, column, fmt::format("a radius in {}", statement),
                      "R0 is no radius compensation; a radius belongs to CR");
    }
    has_radius_ = true;
    add_number(block_, 'R', value, column);
  }

  void read_feed(const std::string& name, std::uint32_t column) {
    const bool spaced = name == "F";
    if (name == "FMAX" || (spaced && in_.take_name("MAX"))) {
      rapid_ = true;
      return;
    }
    if (name == "FAUTO" || (spaced && in_.take_name("AUTO"))) {
      add_code(block_, *find_code(Dialect::heidenhain, "F AUTO"), column);
      return;
    }
    if (name == "FT") return add_number(block_, 't', in_.signed_number(name, column), column, "FT");
    if (name.starts_with("FQ")) {  // FQ1
      in_.go_to(column + 1);
      return add_value(draft_, 'F', "F", column, nullptr);
    }
    if (!spaced) {
      return in_.fail("not-supported"_id, column, name + " is not simulated",
                      "give F, FMAX, F AUTO or FT; feed per revolution is M136");
    }
    add_value(draft_, 'F', name, column, nullptr);
  }

  void read_m(std::uint32_t column) {
    const double code = in_.signed_number("M", column);
    if (code == 140.0) {
      return in_.fail("not-supported"_id, column, "M140 is not simulated",
                      "retract by L Z... R0 FMAX M91");
    }
    const auto add = [&](double m) { add_number(block_, 'M', m, column); };
    if (code == 13.0 || code == 14.0) {  // spindle and coolant
      add(code - 10.0);
      return add(8.0);
    }
    add(code);
    if (code != 128.0 || in_.peek() != 'F') return;
    const std::uint32_t feed_column = in_.column();
    if (in_.letters() != "F" || in_.next_name() == "MAX") return in_.go_to(feed_column);
    // The feed of the balancing moves.
    block_.comments.push_back(
        {feed_column, false, "F" + shortest_decimal(in_.signed_number("F", feed_column)), "M128"});
  }

  void add_measured(char letter, Measure measure, const char* spelled, std::uint32_t column) {
    add_value(draft_, letter, spelled != nullptr ? spelled : std::string(1, letter), column,
              spelled);
    if (!block_.words.empty()) block_.words.back().measure = measure;
  }

  BlockDraft& draft_;
  LineScanner& in_;
  Block& block_;
  char sense_ = 0;
  bool rapid_ = false;
  bool has_radius_ = false;
  bool has_angle_ = false;
};

}  // namespace

void read_heidenhain_corner(BlockDraft& draft, const std::string& statement, std::uint32_t column) {
  LineScanner& in = draft.in;
  add_code(draft.block, *find_code(Dialect::heidenhain, statement), column);
  const bool rounds = statement == "RND";
  const std::uint32_t place = in.column();
  if (rounds && in.letters() != "R") {
    return in.fail("value-missing"_id, place, "RND has no radius", "write RND R5");
  }
  add_value(draft, 'R', rounds ? "R" : statement, place, rounds ? "R" : "");
  const std::uint32_t feed_place = in.column();
  if (in.peek() == 'F') {
    if (in.letters() != "F") {
      return in.fail("value-missing"_id, feed_place, "the feed of " + statement + " is no number",
                     "give F and a number, or leave it out");
    }
    add_value(draft, 'f', "F", feed_place, "F");
  }
  end_statement(draft);
}
void read_heidenhain_path(BlockDraft& draft, const std::string& statement, std::uint32_t column) {
  PathReader(draft).read_path(statement, column);
}
void read_heidenhain_elements(BlockDraft& draft, const std::string& statement) {
  PathReader(draft).read_elements(statement, {});
}
void read_heidenhain_axes(BlockDraft& draft, const std::string& statement) {
  PathReader(draft).read_elements(statement, {.axes = true});
}
void read_heidenhain_pole(BlockDraft& draft, std::uint32_t column) {
  PathReader(draft).read_pole(column);
}

}  // namespace frustum::parser

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
constexpr std::array kSurfaceNormal{Element{"NX", 'n', "NX"}, Element{"NY", 'o', "NY"},
                                    Element{"NZ", 's', "NZ"}};

// What may follow an M word, as letters with or without a number, or as a word of its own.
struct Operand {
  double m;
  std::string_view letters;
  std::string_view word;
  const char* event;
};
constexpr std::array kOperandsOfM{
    Operand{128.0, "F", "", "M128"},   Operand{94.0, "ABCUVW", "", "M94"},
    Operand{103.0, "F", "", "M103"},   Operand{112.0, "TAE", "", "M112"},
    Operand{116.0, "ABC", "", "M116"}, Operand{118.0, "XYZABC", "", "M118"},
    Operand{120.0, "", "LA", "M120"},  Operand{124.0, "T", "", "M124"},
    Operand{138.0, "ABC", "", "M138"}, Operand{197.0, "", "DL", "M197"}};

// Whether a number or a parameter follows.
bool begins_value(char next) {
  return (next >= '0' && next <= '9') || next == '.' || next == '+' || next == '-' || next == 'Q';
}

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
  bool link = false;  // of a way on to a contour: LEN, CCA
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
    if (statement == "L") turn_to_plane();
    if (statement == "CP" && !has_angle_) {
      return in_.fail("value-missing"_id, column, "CP has no angle",
                      "give PA or IPA; a full turn is IPA+360 DR+");
    }
    if (statement == "CR" && !has_radius_) {
      in_.fail("value-missing"_id, column, "CR has no radius",
               "give R and the radius, for example R+10");
    }
  }

  // APPR LT, DEP PLCT
  void read_link(const std::string& statement, std::uint32_t column) {
    const std::uint32_t place = in_.column();
    std::string shape = in_.letters();
    const bool polar = shape.starts_with('P');
    if (polar) shape.erase(0, 1);
    const Code* code = find_code(Dialect::heidenhain, statement + " " + shape);
    if (code == nullptr || (polar && statement == "DEP" && shape != "LCT")) {
      return in_.fail("unknown-word"_id, place, statement + " does not say how",
                      statement == "APPR" ? "write APPR LT, LN, CT or LCT; PLT, PLN, PCT or PLCT"
                                          : "write DEP LT, LN, CT, LCT or PLCT");
    }
    add_code(block_, *code, column);
    Path path;
    path.axes = path.radius = path.feed = path.link = true;
    path.polar = polar;
    read_elements(statement, path);
    if (rapid_ && !in_.failed()) add_number(block_, 'd', 1.0, column, "FMAX");
  }

  // L A+Q120 C+Q122: to the positions of the axes that the control has computed of the plane.
  void turn_to_plane() {
    const auto turns = [](const Word& word) {
      return std::string_view("ABC").find(word.letter) != std::string_view::npos;
    };
    const auto computed = [this](const Word& word) {
      if (word.expression.count != 1 || word.measure != Measure::modal) return false;
      const ExpressionStep& step = block_.steps[word.expression.first];
      return step.operation == Operation::named_parameter &&
             block_.names[static_cast<std::size_t>(step.number)] ==
                 fmt::format("Q{}", 120 + (word.letter - 'A'));
    };
    bool any = false;
    for (const Word& word : block_.words) {
      if (turns(word) ? !computed(word) : word.letter >= 'X' && word.letter <= 'Z') return;
      any = any || turns(word);
    }
    if (!any) return;
    std::erase_if(block_.words, turns);
    block_.words.front().number = row_of(*find_code(Dialect::heidenhain, "L A+Q120 B+Q121 C+Q122"));
  }

  // CYCL CALL POS X+50 Y+50 Z+0 FMAX M3, CYCL CALL PAT FMAX: the way to a hole is by rapid.
  void read_call_at(const std::string& statement, std::uint32_t column) {
    const bool at_place = statement == "CYCL CALL POS";
    read_elements(statement, {.axes = at_place, .feed = true});
    const auto is_feed = [](const Word& word) { return word.letter == 'F' || word.letter == 't'; };
    if (in_.failed() || std::erase_if(block_.words, is_feed) == 0) return;
    draft_.add_event(
        at_place ? "CYCL CALL POS" : "CYCL CALL PAT", column,
        "the way to the hole is by rapid, not by the feed of the call, which is for it alone");
    block_.comments.back().assumed = true;
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
      if (axis != "X" && axis != "Y" && axis != "Z") {
        if (name.empty()) return in_.fail_unexpected("write CC X+0 Y+0");
        return in_.fail("unknown-word"_id, place, fmt::format("{} has no meaning in CC", name),
                        "the pole has X and Y: CC X+0 Y+0; or Z and one of them");
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
    if (const Element* element = find(kSurfaceNormal, name); path.vector && element != nullptr) {
      return add_value(draft_, element->letter, name, column, element->spelled);
    }
    if (path.sense && name == "DR" && (in_.peek() == '+' || in_.peek() == '-')) {
      if (sense_ != 0)
        return in_.fail("word-twice"_id, column, "DR is given twice", "leave one of them out");
      sense_ = in_.peek();
      in_.take(sense_);
      return;
    }
    if (path.link && (name == "LEN" || name == "CCA")) {
      return add_value(draft_, name == "LEN" ? 'l' : 'i', name, column,
                       name == "LEN" ? "LEN" : "CCA");
    }
    if (name == "S" || name == "SQ" || name == "SQL" || name == "SQR") {
      in_.go_to(column + 1);
      return add_value(draft_, 'S', "S", column, nullptr);
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
    // R, F and M without numbers are left from a dialog: nothing changes.
    if (!is_signed && !begins_value(in_.peek())) return;
    if (in_.peek() == 'Q') {
      if (path.radius) {
        has_radius_ = true;
        return add_value(draft_, 'R', "R", column, nullptr);
      }
    }
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
    if (!begins_value(in_.peek())) return;
    add_value(draft_, 'F', name, column, nullptr);
  }

  void read_m(std::uint32_t column) {
    if (!begins_value(in_.peek())) return;
    const double code = in_.signed_number("M", column);
    if (code == 140.0) return read_retraction(column);
    const auto add = [&](double m) { add_number(block_, 'M', m, column); };
    if (code == 13.0 || code == 14.0) {  // spindle and coolant
      add(code - 10.0);
      return add(8.0);
    }
    add(code);
    for (const Operand& operand : kOperandsOfM) {
      if (operand.m == code) return read_operands_of_m(operand);
    }
  }

  // What belongs to an M word: M128 F2000, M103 F20, M120 LA5, M118 X1 Y1, M94 C, M138 A C.
  void read_operands_of_m(const Operand& operand) {
    std::string taken;
    while (!in_.at_end()) {
      const std::uint32_t column = in_.column();
      const std::string name = in_.letters();
      const bool by_parameter = name.size() > 1 && name[1] == 'Q';
      const bool known = by_parameter ? operand.letters.find(name.front()) != std::string_view::npos
                         : name.size() == 1
                             ? operand.letters.find(name.front()) != std::string_view::npos
                             : operand.word == name;
      const bool again = known && taken.find(name.front()) != std::string::npos;
      if (!known || again || (name == "F" && in_.next_name() == "MAX")) return in_.go_to(column);
      taken += name.front();
      std::string text = by_parameter ? name.substr(0, 1) : name;
      if (by_parameter) in_.go_to(column + 1);
      const bool is_signed = in_.peek() == '+' || in_.peek() == '-';
      if (in_.peek() == 'Q' || by_parameter) {
        in_.take('+');
        text += in_.name();
      } else if (is_signed || begins_value(in_.peek())) {
        text += shortest_decimal(in_.signed_number(text, column));
      }
      block_.comments.push_back({column, false, std::move(text), operand.event});
    }
  }

  // M140 MB MAX, M140 MB+50: away from the workpiece along the tool.
  void read_retraction(std::uint32_t column) {
    const std::uint32_t place = in_.column();
    if (in_.letters() != "MB") {
      return in_.fail("value-missing"_id, place, "M140 has no MB",
                      "write M140 MB MAX, or M140 MB+50");
    }
    const bool all = in_.take_name("MAX");
    add_code(block_, *find_code(Dialect::heidenhain, all ? "M140 MB MAX" : "M140"), column);
    if (!all) add_value(draft_, 'z', "MB", place, "MB");
    const std::uint32_t feed_place = in_.column();
    if (in_.peek() != 'F') return;
    if (in_.letters() != "F" || !begins_value(in_.peek())) return in_.go_to(feed_place);
    add_value(draft_, 'f', "F", feed_place, "F");
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
void read_heidenhain_link(BlockDraft& draft, const std::string& statement, std::uint32_t column) {
  PathReader(draft).read_link(statement, column);
}
void read_heidenhain_path(BlockDraft& draft, const std::string& statement, std::uint32_t column) {
  PathReader(draft).read_path(statement, column);
}
void read_heidenhain_elements(BlockDraft& draft, const std::string& statement) {
  PathReader(draft).read_elements(statement, {.feed = true});
}
void read_heidenhain_axes(BlockDraft& draft, const std::string& statement) {
  PathReader(draft).read_elements(statement, {.axes = true});
}
void read_heidenhain_call_at(BlockDraft& draft, const std::string& statement,
                             std::uint32_t column) {
  PathReader(draft).read_call_at(statement, column);
}
void read_heidenhain_pole(BlockDraft& draft, std::uint32_t column) {
  PathReader(draft).read_pole(column);
}

}  // namespace frustum::parser

#include "parser/reading/sinumerik/sinumerik_settings.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <string_view>

#include "parser/dialects/code_table.hpp"
#include "parser/language/letter_case.hpp"
#include "parser/reading/sinumerik/sinumerik_passed.hpp"
#include "parser/reading/sinumerik/sinumerik_values.hpp"

namespace frustum::parser {
namespace {

// Axes beside X, Y and Z, of a quill or a second slide: at zero they are where they were when the
// work offset was taken.
constexpr std::array<const char*, 3> kParallelAxes{"U", "V", "W"};

constexpr std::string_view kBlanks = " \t\r";

template <typename Names>
const char* found_in(const Names& names, std::string_view name) {
  const auto found =
      std::ranges::find_if(names, [name](const char* known) { return name == known; });
  return found == names.end() ? nullptr : *found;
}

// Up to the ) that closes what is open; quotes hold anything.
std::string text_in_brackets(LineScanner& in) {
  const std::uint32_t start = in.column();
  const std::string_view text = in.text();
  int depth = 1;
  bool quoted = false;
  std::size_t end = start - 1;
  for (; end < text.size(); ++end) {
    if (text[end] == '"') quoted = !quoted;
    if (quoted) continue;
    if (text[end] == '(') ++depth;
    if (text[end] == ')' && --depth == 0) break;
  }
  in.go_to(start);
  // An odd quote: as far as the first bracket.
  if (quoted) return in.text_to(")");
  in.go_to(static_cast<std::uint32_t>(end) + 1);
  std::string_view found = text.substr(start - 1, end - (start - 1));
  return std::string(found.substr(0, found.find_last_not_of(kBlanks) + 1));
}

// ADIS=0.1, read and kept as text.
void read_setting(BlockDraft& draft, const char* name, std::uint32_t column) {
  LineScanner& in = draft.in;
  std::string index;
  if (in.take('[')) {
    index = "[" + in.text_to("]") + "]";
    in.take(']');
  }
  if (!in.take('=')) {
    return in.fail("keyword-missing"_id, column, fmt::format("{} has no =", name),
                   fmt::format("write {}=0", name));
  }
  const std::uint32_t from = in.column();
  // SPOS=DC(30) says how it turns.
  for (const std::string_view measure : {"AC", "IC", "DC", "ACP", "ACN"}) {
    if (in.take_name(measure)) break;
  }
  (void)draft.read_expression(ExpressionLevel::sum);
  const auto text = in.text().substr(from - 1, in.column() - from);
  draft.add_event(name, column, std::string(text.substr(0, text.find_last_not_of(kBlanks) + 1)));
}

// G0, M6, SUPA: what comes next is no name of a macro.
bool is_word(LineScanner& in) {
  const std::string name = in.next_name();
  const bool numbered =
      name.size() > 1 && name.find_first_not_of("0123456789", 1) == std::string::npos;
  return numbered || find_code(Dialect::sinumerik, name) != nullptr;
}

// Takes a plain number that is zero.
bool is_zero(LineScanner& in) {
  const std::uint32_t start = in.column();
  if (!in.take('-')) in.take('+');
  const auto number = in.number();
  // No word or operator goes on from it.
  const char next = in.peek();
  const bool more = next == '+' || next == '-' || next == '*' || next == '/' || next == '(';
  if (number && number->value == 0.0 && !more) return true;
  in.go_to(start);
  return false;
}

// OFFN=0, TOFFL[1]=0: an event; otherwise what refuses the word reports it.
bool read_idle_setting(BlockDraft& draft, const std::string& name, std::uint32_t column) {
  LineScanner& in = draft.in;
  const char* idle = found_in(kIdleAtZero, name);
  if (idle == nullptr) return false;
  const std::uint32_t start = in.column();
  if (in.take('[')) {
    (void)in.text_to("]");
    in.take(']');
  }
  if (in.take('=') && is_zero(in)) {
    draft.add_event(idle, column, "0");
    return true;
  }
  in.go_to(start);
  return false;
}

// NAME(...), kept as text.
void read_event(BlockDraft& draft, const char* name, std::uint32_t column, bool message) {
  LineScanner& in = draft.in;
  if (!in.take('(')) {
    if (std::ranges::find(kBareProcedures, name) != kBareProcedures.end()) {
      return draft.add_event(name, column, {});
    }
    in.fail("bracket-missing"_id, in.column(), "the opening bracket is missing",
            "write the text in ( )");
    return;
  }
  std::string text;
  const std::uint32_t start = in.column();
  if (in.take('"')) {
    text = in.text_to("\"");
    if (!in.take('"'))
      in.fail("text-not-closed"_id, column, "the text is not closed", "close it with \"");
  }
  const bool whole = !text.empty() && in.peek() == ')';
  if (!whole && !in.failed()) {
    in.go_to(start);
    text = text_in_brackets(in);
    if (message && text == "\"\"") text.clear();
  }
  close_bracket(in, name);
  draft.add_event(name, column, std::move(text));
}

constexpr std::array<std::string_view, 6> kFrameParts{"CTRANS", "CFINE",   "CROT",
                                                      "CSCALE", "CMIRROR", "CROTS"};

// CTRANS(X,10,Y,20):CROT(Z,30); false when there is none.
bool read_frame(BlockDraft& draft) {
  LineScanner& in = draft.in;
  const auto is_part = [&] {
    return std::ranges::find(kFrameParts, in.next_name()) != kFrameParts.end();
  };
  if (!is_part()) return false;
  std::vector<FramePart> parts;
  do {
    if (!is_part()) {
      in.fail_unexpected("join CTRANS( ), CROT( ) and CMIRROR( ) by :");
      return true;
    }
    FramePart part{in.name(), {}, {}};
    if (!in.take('(')) {
      in.fail("bracket-missing"_id, in.column(), "the opening bracket is missing",
              "write CTRANS(X,10)");
      return true;
    }
    while (!in.failed() && in.peek() != ')' && !in.at_end()) {
      const std::uint32_t column = in.column();
      const std::string axis = in.name();
      if (axis.size() != 1) {
        in.fail("name-missing"_id, column, part.name + " without an axis", "write CTRANS(X,10)");
      }
      part.axes += axis;
      if (part.name == "CMIRROR") {
        if (in.peek() == ',') in.take(',');
        continue;
      }
      if (!in.take(',')) {
        in.fail("value-missing"_id, in.column(), part.name + " without a value",
                "write CTRANS(X,10)");
        return true;
      }
      part.values.push_back(draft.read_expression(ExpressionLevel::sum));
      in.take(',');
    }
    close_bracket(in, part.name);
    parts.push_back(std::move(part));
  } while (in.take(':'));
  if (!in.failed()) draft.block.assignments.back().frame = std::move(parts);
  return true;
}

}  // namespace

bool read_parallel_axis(BlockDraft& draft, char letter, std::uint32_t column) {
  const char* axis = found_in(kParallelAxes, std::string_view(&letter, 1));
  if (axis == nullptr) return false;
  const std::uint32_t start = draft.in.column();
  draft.in.take('=');
  if (is_zero(draft.in)) {
    draft.add_event(axis, column, "the axis at zero is where the work offset was taken");
    draft.block.comments.back().assumed = true;
    return true;
  }
  draft.in.go_to(start);
  draft.in.fail("not-simulated"_id, column, fmt::format("{} moves an axis beside X Y Z", letter),
                fmt::format("move the tool by X Y Z, and leave {} at zero", letter));
  return true;
}

bool read_sinumerik_setting(BlockDraft& draft, const std::string& name, std::uint32_t column) {
  if (read_idle_setting(draft, name, column)) return true;
  if (name == "MSG") {
    read_event(draft, "message", column, true);
    return true;
  }
  const char* passed = found_in(kPassedSettings, name);
  const bool takes_value = passed != nullptr;
  if (!takes_value) passed = found_in(kPassedProcedures, name);
  if (passed != nullptr) {
    // FGREF(X), COARSEA[X]: each is written in the other way, too.
    const char next = draft.in.peek();
    if (takes_value ? next != '(' : next == '=' || next == '[') {
      read_setting(draft, passed, column);
    } else {
      read_event(draft, passed, column, false);
    }
    return true;
  }
  if (const char* lift = found_in(kLiftWords, name); lift != nullptr) {
    if (draft.in.peek() == '(') {
      read_event(draft, lift, column, false);
    } else {
      read_setting(draft, lift, column);
    }
    if (draft.in.failed()) return true;
    draft.block.comments.back().text += ": nothing interrupts the program and lifts the tool";
    draft.block.comments.back().assumed = true;
    return true;
  }
  // Actions beside the program: overrides, signals, stops.
  constexpr std::array kOpenEvents{"EXTERN", "DEFINE", "WHENEVER", "WHEN",
                                   "EVERY",  "IDS",    "ID",       "DO"};
  const char* open = found_in(kOpenEvents, name);
  if (open == nullptr) return false;
  const std::uint32_t start = draft.in.column();
  if (name == "DEFINE" && is_word(draft.in)) {
    draft.in.fail("not-supported"_id, start, "DEFINE gives a word of the control another meaning",
                  "give the macro a name of its own");
  }
  std::string text = draft.in.text_to(";");
  for (const char* moving : {"POS[", "MOV[", "POSA[", "SYNFCT", "PRESETON", "AFREE"}) {
    if (upper_case(text).find(moving) == std::string::npos) continue;
    draft.in.fail("not-simulated"_id, start, name + " moves an axis beside the program",
                  "move it in the program by G0 or G1");
  }
  draft.add_event(open, column, std::move(text));
  if (name != "EXTERN") draft.block.comments.back().of_builder = true;
  return true;
}

void read_setting_values(BlockDraft& draft) {
  LineScanner& in = draft.in;
  if (read_frame(draft)) return;
  Assignment& setting = draft.block.assignments.back();
  const std::uint32_t start = in.column();
  const bool set = in.take_name("SET");
  const bool repeated = !set && in.take_name("REP");
  const bool list = set || repeated || (setting.defines && !setting.indices.empty());
  if (!list || !in.take('(')) {
    in.go_to(start);
    const ExpressionRange value = draft.read_expression(ExpressionLevel::disjunction);
    draft.block.assignments.back().value = value;
    return;
  }
  std::vector<ExpressionRange> values;
  do {
    values.push_back(draft.read_expression(ExpressionLevel::disjunction));
  } while (in.take(','));
  close_bracket(in, repeated ? "REP" : "SET");
  if (in.failed()) return;
  Assignment& read = draft.block.assignments.back();
  read.value = values.front();
  read.fills = repeated;
  if (!repeated) read.more.assign(values.begin() + 1, values.end());
}

void read_variable_setting(BlockDraft& draft, const std::string& name, std::uint32_t column) {
  LineScanner& in = draft.in;
  draft.begin_setting(name, column);
  if (in.take('[')) {
    std::vector<ExpressionRange> indices;
    do {
      indices.push_back(draft.read_expression(ExpressionLevel::sum));
    } while (indices.size() < kMaxIndices && in.take(','));
    if (!in.take(']'))
      in.fail("bracket-not-closed"_id, in.column(), "the index is not closed", "close it with ]");
    if (in.failed()) return;
    draft.block.assignments.back().indices = std::move(indices);
  }
  if (!in.take('=')) {
    in.fail("keyword-missing"_id, in.column(), fmt::format("{} has no =", name),
            fmt::format("write {}[1]=5", name));
    return;
  }
  read_setting_values(draft);
}

void read_system_setting(BlockDraft& draft, std::uint32_t column) {
  LineScanner& in = draft.in;
  in.take('$');
  const std::string name = "$" + in.name();
  if (name.size() == 1) {
    in.fail("name-missing"_id, column, "$ without a name", "write for example $TC_DP6[1,1]=5");
    return;
  }
  const std::string indices = read_index_names(in);
  read_variable_setting(draft, name + indices, column);
}

void read_auxiliary(BlockDraft& draft, const char* name, std::uint32_t column) {
  LineScanner& in = draft.in;
  in.go_to(column);
  (void)in.letters();
  const std::uint32_t from = in.column();
  (void)in.digits();
  if (in.take('=')) {
    (void)draft.read_expression(ExpressionLevel::sum);
  } else {
    in.go_to(from);
    (void)in.signed_number(name, column);
  }
  const auto text = in.text().substr(from - 1, in.column() - from);
  draft.add_event(name, column, std::string(text.substr(0, text.find_last_not_of(kBlanks) + 1)));
  draft.block.comments.back().of_builder = true;
}

void read_builder_call(BlockDraft& draft, const std::string& name, std::uint32_t column) {
  LineScanner& in = draft.in;
  in.take('(');
  const std::string text = text_in_brackets(in);
  close_bracket(in, name);
  draft.add_event("M", column, fmt::format("{}({})", name.substr(1), text));
  draft.block.comments.back().of_builder = true;
}

void read_brackets_of_word(BlockDraft& draft, const std::string& name, std::uint32_t column) {
  LineScanner& in = draft.in;
  if (!in.take('(')) return;
  const auto number = in.digits();
  const bool first = number.empty() || number == "1";
  if (name == "TRAORI" && !first) {
    in.fail("not-supported"_id, column, "TRAORI(" + std::string(number) + ") is not simulated",
            "there is one transformation: TRAORI or TRAORI(1)");
  }
  if (name == "TRAORI") (void)in.text_to(")");
  close_bracket(in, name);
}

}  // namespace frustum::parser

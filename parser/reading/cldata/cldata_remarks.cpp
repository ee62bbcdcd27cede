#include "parser/reading/cldata/cldata_remarks.hpp"

#include <algorithm>
#include <string_view>
#include <utility>

#include "parser/reading/cldata/cldata_inserted.hpp"
#include "parser/reading/cldata/cldata_words.hpp"

namespace frustum::parser {

void CldataRemarks::add(const char* event, std::string text) {
  block_.comments.push_back({record_.column, false, std::move(text), event});
}

void CldataRemarks::assumed(const char* name, const char* text) {
  add(name, text);
  block_.comments.back().assumed = true;
}

bool CldataRemarks::take_comment() {
  const std::uint32_t column = in_.column();
  if (!in_.take('$')) return in_.failed();
  if (!in_.take('$')) {
    in_.fail("value-missing"_id, column, "nothing follows the continuation mark",
             "$ continues a record on the next line, $$ begins a comment");
    return true;
  }
  block_.comments.push_back({column, true, in_.text_to(), nullptr});
  return true;
}

std::string CldataRemarks::numbers_of_remark() {
  std::string text(in_.bytes_to());
  std::replace_if(
      text.begin(), text.end(), [](char c) { return c == '\n' || c == '\r'; }, ' ');
  return text;
}

bool CldataRemarks::take_text() {
  const char* text = cldata_text_word(record_.word);
  if (text == nullptr) return false;
  in_.go_to(record_.column + static_cast<std::uint32_t>(std::string_view(text).size()));
  in_.take('/');
  const bool message = std::string_view(text) == "PPRINT";
  add(message ? "message" : text, in_.text_to());
  if (std::string_view(text) == "INSERT") check_inserted();
  return true;
}

void CldataRemarks::check_inserted() {
  const std::string& text = block_.comments.back().text;
  const Inserted what = what_is_inserted(text);
  block_.comments.back().of_builder = what == Inserted::builder_code;
  if (what != Inserted::block) return;
  in_.fail("not-supported"_id, record_.column,
           "INSERT hands a block to the control, which is not simulated",
           "say what the block does by records of CLDATA");
}

bool CldataRemarks::take_note(std::string& frame) {
  const std::string& word = record_.word;
  if (word == "TOOL" && in_.take_name("PATH")) return note("TOOL PATH");
  if (word == "END" && in_.peek() == '-') return note("END-OF-PATH");
  if (word == "MSYS" || word == "SYS") return note_frame(frame);
  const std::uint32_t behind_word = in_.column();
  if (word == "SET" && in_.take('/') && in_.take_name("AXIS")) {
    in_.fail("not-supported"_id, record_.column, "SET/AXIS is not simulated",
             "give tool vectors in GOTO after MULTAX/ON");
    return true;
  }
  in_.go_to(behind_word);
  for (const char* event : cldata_note_words()) {
    if (word == event) return note(event);
  }
  return false;
}

std::string CldataRemarks::rest_of_record() {
  in_.take('/');
  std::string text = in_.text_to("$");
  while (!in_.at_end() && in_.peek() != '$') text += in_.text_to("$");
  return text;
}

bool CldataRemarks::note(const char* event) {
  add(event, rest_of_record());
  if (!take_comment() && !in_.at_end()) in_.fail_unexpected("separate arguments by ,");
  return true;
}

// The frame that places of NX count in.
bool CldataRemarks::note_frame(std::string& before) {
  std::string frame = rest_of_record();
  add("MSYS", frame);
  if (!before.empty() && before != frame) {
    assumed("MSYS", "places count in this frame from here on; the job says where it is");
  }
  before = std::move(frame);
  if (!take_comment() && !in_.at_end()) in_.fail_unexpected("separate arguments by ,");
  return true;
}

bool CldataRemarks::take_turn_of_nothing() {
  for (const char* turn : {"ROTABL", "ROTATE", "ROTHED"}) {
    if (record_.word != turn) continue;
    const std::uint32_t behind_word = in_.column();
    in_.take('/');
    const std::uint32_t column = in_.column();
    in_.take('-');
    const auto angle = in_.number();
    if (angle && angle->value == 0.0) {
      in_.go_to(column);
      return note(turn);
    }
    in_.go_to(behind_word);
  }
  return false;
}

bool CldataRemarks::take_harmless() {
  if (record_.word == "CUTCOM") {
    add("CUTCOM", record_.text_from(0));
    if (record_.only_word() == "OFF") return true;
    assumed("CUTCOM",
            "places are those of the tool's centre, and the offset that the control adds is zero");
    return true;
  }
  if (record_.word == "ORIGIN" && record_.only_word().empty()) {
    add("ORIGIN", record_.text_from(0));
    assumed("ORIGIN", "it says where the part is on the machine; places stay the part's");
    return true;
  }
  const char* word = harmless_cldata(record_.word, record_.only_word());
  if (word == nullptr) return false;
  add(word, record_.only_word());
  return true;
}

}  // namespace frustum::parser

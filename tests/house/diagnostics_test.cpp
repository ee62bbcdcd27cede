// The id of a diagnostic is what code refers to; its message is for people.
#include <gtest/gtest.h>

#include <algorithm>
#include <regex>
#include <set>
#include <string>
#include <vector>

#include "tests/house/rooms.hpp"
#include "tests/house/source_tree.hpp"

namespace frustum::house {
namespace {

// Where a message is compared, and why that is not reading it.
struct MessageSite {
  std::string file;
  std::string why;
};

const std::vector<MessageSite>& message_sites() {
  static const std::vector<MessageSite> kSites{
      {"lint/finding_list.cpp", "the same diagnostic is reported once"},
  };
  return kSites;
}

// Ways to look into a message or to decide by it. Printing it, putting words before it and passing
// it on are none.
const std::vector<std::regex>& questions() {
  static const std::vector<std::regex> kQuestions = [] {
    const std::string message = R"((\.|->)message\b)";
    const std::string operand = R"([\w.\->()\[\]]*)";
    std::vector<std::regex> all;
    for (
        const std::string& pattern :
        {message +
             R"(\s*\)?\s*(\.|->)\s*(r?find\w*|compare|starts_with|ends_with|contains|substr|front|back|at|size|length)\b)",
         message + R"(\s*(==|!=|<=?|>=?|\[)\s*)", R"((==|!=)\s*)" + operand + message,
         R"((regex_match|regex_search|strstr|strcmp|key_of|hash)\w*(<[^>]*>)?[({]+\s*)" + operand +
             message,
         message + R"(\s*\+\s*)" + operand + R"(hint\s*\)\s*\.)"}) {
      all.emplace_back(pattern);
    }
    return all;
  }();
  return kQuestions;
}

TEST(Diagnostics, NoCodeReadsAMessage) {
  std::set<std::string> asking;
  for (const std::string& file : sources_of_all_rooms()) {
    if (file.starts_with("core/diagnostic.")) continue;
    const std::string text = text_of(file);
    if (text.find("message") == std::string::npos) continue;
    for (const std::regex& question : questions()) {
      std::smatch hit;
      if (!std::regex_search(text, hit, question)) continue;
      asking.insert(file);
      const auto listed = std::any_of(message_sites().begin(), message_sites().end(),
                                      [&](const MessageSite& site) { return site.file == file; });
      const auto line = std::count(text.begin(), text.begin() + hit.position(0), '\n') + 1;
      EXPECT_TRUE(listed) << file << ":" << line
                          << ": ask for the id of a diagnostic, not its message: " << hit[0];
    }
  }
  for (const MessageSite& site : message_sites()) {
    EXPECT_TRUE(asking.contains(site.file))
        << site.file << " asks for no message: remove it from tests/house/diagnostics_test.cpp";
  }
}

TEST(Diagnostics, QuestionsAreRecognised) {
  const auto asks = [](const std::string& code) {
    return std::any_of(questions().begin(), questions().end(), [&](const std::regex& question) {
      return std::regex_search(code, question);
    });
  };
  for (const char* code :
       {R"(if (error.message.find("radius") != npos))", R"(error->message.starts_with("H"))",
        "d.message == other.message", R"("too long" == found.front().message)",
        "(error.message + error.hint).find(part)", "FindingList::key_of(error.message)",
        "error.message\n    .contains(part)", "d.message[0]"}) {
    EXPECT_TRUE(asks(code)) << code;
  }
  for (const char* code :
       {"return Words{error.message, error.hint};", "text += diagnostic.message;",
        R"(d.message = fmt::format("frame {}: {}", name, d.message);)",
        "error(row.message, row.hint)", R"({"message", finding.message},)",
        "fail(key, found.id, found.message, found.hint)"}) {
    EXPECT_FALSE(asks(code)) << code;
  }
}

}  // namespace
}  // namespace frustum::house

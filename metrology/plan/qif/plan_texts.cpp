#include "metrology/plan/qif/plan_texts.hpp"

#include <sstream>

namespace frustum::metrology {
namespace {

// Without the comment that a line may end with; a # in a text is none.
std::string without_comment(const std::string& value) {
  bool quoted = false;
  for (std::size_t i = 0; i < value.size(); ++i) {
    if (quoted && value[i] == '\\') {
      ++i;
    } else if (value[i] == '"') {
      quoted = !quoted;
    } else if (value[i] == '#' && !quoted) {
      return value.substr(0, value.find_last_not_of(' ', i - 1) + 1);
    }
  }
  return value;
}

std::string inline_table(const PlanKeys& keys) {
  std::string text = "{ ";
  for (const PlanKey& k : keys) {
    text += (text.size() > 2 ? ", " : "") + k.key + " = " + k.value;
  }
  return text + " }";
}

}  // namespace

PlanTexts plan_texts(const InspectionPlan& plan) {
  PlanTexts texts;
  std::vector<std::string> frames;
  PlanKeys part;
  std::string name;
  const auto close = [&] {
    if (name == "feature") {
      texts.features.push_back(part);
    } else if (name == "characteristic") {
      texts.characteristics.push_back(part);
    } else if (name == "frame") {
      frames.push_back(inline_table(part));
    } else if (!name.empty()) {
      texts.root.push_back({name, inline_table(part)});
    }
    part.clear();
  };
  std::istringstream lines(to_toml(plan));
  for (std::string line; std::getline(lines, line);) {
    if (line.empty() || line.front() == '#') continue;
    if (line.front() == '[') {
      close();
      const std::size_t begin = line.find_first_not_of('[');
      name = line.substr(begin, line.find(']') - begin);
      continue;
    }
    const std::size_t equals = line.find(" = ");
    if (equals == std::string::npos) continue;
    PlanKey key{line.substr(0, equals), without_comment(line.substr(equals + 3))};
    (name.empty() ? texts.root : part).push_back(std::move(key));
  }
  close();
  if (!frames.empty()) {
    std::string list = "[";
    for (const std::string& frame : frames) list += (list.size() > 1 ? ", " : "") + frame;
    texts.root.push_back({"frame", list + "]"});
  }
  return texts;
}

}  // namespace frustum::metrology

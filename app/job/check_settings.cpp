#include "app/job/check_settings.hpp"

#include <fmt/format.h>

#include <array>
#include <utility>

#include "app/job/machine_files.hpp"
#include "core/toml_document.hpp"
#include "parser/dialect.hpp"

namespace frustum::app {
namespace {

namespace fs = std::filesystem;

constexpr const char* kFileName = ".frustum.toml";

void add_to(std::vector<std::string>& list, const std::vector<std::string>& more) {
  list.insert(list.end(), more.begin(), more.end());
}
void take_if_empty(std::string& value, const std::string& other) {
  if (value.empty()) value = other;
}

// A path of the file; empty where the key is not there.
std::string path_of(const TomlTable& root, const char* key) {
  return root.text_or(key, "").empty() ? std::string() : root.file_path(key).string();
}

struct WordsOfKey {
  const char* key;
  std::vector<std::string> SetupWords::*list;
};
constexpr std::array kWordsOfKeys{
    WordsOfKey{"tool_length", &SetupWords::tool_lengths},
    WordsOfKey{"tool_diameter", &SetupWords::tool_diameters},
    WordsOfKey{"offset", &SetupWords::offsets},
};

// Words are judged one by one, where the file has them.
void judge(const TomlTable& table, const std::string& key, const SetupWords& alone) {
  const auto known = known_setup_of(alone);
  if (known) return;
  for (const Diagnostic& wrong : known.error()) table.fail(key, wrong);
}

SetupWords setup_words_of(const TomlTable& root) {
  SetupWords words;
  if (const std::string name = root.text_or("machine", ""); !name.empty()) {
    const auto machine = find_machine(name, root.folder());
    if (machine) {
      words.machine = machine->string();
    } else {
      root.fail("machine", machine.error().front());
    }
  }
  words.job = path_of(root, "job");
  words.tool_lengths = root.texts_or("tool_length", {});
  words.tool_diameters = root.texts_or("tool_diameter", {});
  words.offsets = root.texts_or("offset", {});
  words.start = root.text_or("start", "");
  for (const WordsOfKey& key : kWordsOfKeys) {
    for (const std::string& text : words.*key.list) {
      SetupWords alone;
      (alone.*key.list).push_back(text);
      judge(root, key.key, alone);
    }
  }
  if (SetupWords alone; !words.start.empty()) {
    alone.start = words.start;
    judge(root, "start", alone);
  }
  if (const auto controller = root.table_if("controller")) {
    words.words = controller->texts_or("words", {});
    for (const std::string& text : words.words) {
      SetupWords alone;
      alone.words.push_back(text);
      judge(*controller, "words", alone);
    }
    if (controller->has("max_blocks")) {
      words.max_blocks =
          static_cast<std::uint64_t>(controller->integer("max_blocks", Bound::positive));
    }
    words.units = controller->text_or("units", "");
    const std::vector<std::string> units{"mm", "inch"};
    if (controller->has("units")) (void)controller->choice("units", units);
    words.decimal_point = controller->text_or("decimal_point", "");
    const std::vector<std::string> points{"calculator", "increment"};
    if (controller->has("decimal_point")) (void)controller->choice("decimal_point", points);
  }
  return words;
}

std::string one_of(const TomlTable& root, const char* key, const std::vector<std::string>& words) {
  if (!root.has(key)) return {};
  return words.at(root.choice_or(key, words, 0));
}

}  // namespace

Result<std::set<lint::Check>> checks_named(const std::vector<std::string>& ids,
                                           const std::string& option) {
  std::set<lint::Check> checks;
  Diagnostics unknown;
  for (const std::string& id : ids) {
    if (const auto check = lint::check_named(id)) {
      checks.insert(*check);
      continue;
    }
    unknown.push_back(
        error("unknown-check"_id,
              fmt::format("{}{}{}: there is no such check", option, option.empty() ? "" : " ", id),
              lint::check_meant_by(id)));
  }
  if (!unknown.empty()) return unknown;
  return checks;
}

Result<CheckSettings> read_check_settings(const fs::path& file) {
  auto document = TomlDocument::load(file);
  if (!document) return document.error();
  const TomlTable& root = document->root();
  CheckSettings settings;
  settings.file = file;
  settings.setup_words = setup_words_of(root);
  settings.dialect =
      one_of(root, "dialect", {"fanuc", "iso", "linuxcnc", "sinumerik", "heidenhain", "cldata"});
  for (const std::string& folder : root.texts_or("search", {})) {
    const fs::path whole = root.folder() / folder;
    std::error_code unknown;
    if (!fs::is_directory(whole, unknown)) {
      root.fail("search", "missing-folder"_id, fmt::format("there is no folder {}", folder),
                "folders are named from that of the settings");
    }
    settings.search.push_back(whole.string());
  }
  settings.disabled = root.texts_or("disable", {});
  if (const auto checks = checks_named(settings.disabled); !checks) {
    for (const Diagnostic& unknown : checks.error()) root.fail("disable", unknown);
  }
  settings.fail_on = one_of(root, "fail_on", {"error", "warning", "note"});
  settings.tools = path_of(root, "tools");
  settings.baseline = path_of(root, "baseline");
  if (root.has("most_repeats")) {
    settings.most_repeats =
        static_cast<std::uint64_t>(root.integer("most_repeats", Bound::positive));
  }
  settings.inch_machine = root.boolean_or("inch_machine", false);
  settings.block_delete = root.boolean_or("block_delete", false);
  settings.endings = root.texts_or("endings", {});
  settings.exclude = root.texts_or("exclude", {});
  Diagnostics problems = document->finish();
  if (has_error(problems)) return problems;
  return settings;
}

std::optional<fs::path> find_check_settings(const fs::path& folder) {
  std::error_code ignored;
  for (fs::path at = fs::absolute(folder, ignored).lexically_normal(); !at.empty();
       at = at.parent_path()) {
    if (fs::is_regular_file(at / kFileName, ignored)) return at / kFileName;
    if (at == at.parent_path()) break;
  }
  return std::nullopt;
}

CheckSettings joined(CheckSettings own, const CheckSettings& file) {
  own.file = file.file;
  SetupWords& words = own.setup_words;
  const SetupWords& others = file.setup_words;
  // A job has its machine: that of the command line is not to be lost behind one of the file.
  if (words.job.empty()) take_if_empty(words.machine, others.machine);
  take_if_empty(words.job, others.job);
  take_if_empty(words.start, others.start);
  take_if_empty(words.decimal_point, others.decimal_point);
  take_if_empty(words.units, others.units);
  if (!words.max_blocks) words.max_blocks = others.max_blocks;
  // Later ones go before.
  words.tool_lengths.insert(words.tool_lengths.begin(), others.tool_lengths.begin(),
                            others.tool_lengths.end());
  words.tool_diameters.insert(words.tool_diameters.begin(), others.tool_diameters.begin(),
                              others.tool_diameters.end());
  words.offsets.insert(words.offsets.begin(), others.offsets.begin(), others.offsets.end());
  add_to(words.words, others.words);
  take_if_empty(own.dialect, file.dialect);
  take_if_empty(own.fail_on, file.fail_on);
  take_if_empty(own.tools, file.tools);
  take_if_empty(own.baseline, file.baseline);
  if (!own.most_repeats) own.most_repeats = file.most_repeats;
  add_to(own.search, file.search);
  add_to(own.disabled, file.disabled);
  own.inch_machine = own.inch_machine || file.inch_machine;
  own.block_delete = own.block_delete || file.block_delete;
  own.endings = file.endings;
  own.exclude = file.exclude;
  return own;
}

}  // namespace frustum::app

// Links between the documents and the paths that they name lead somewhere.
#include <gtest/gtest.h>

#include <filesystem>
#include <regex>
#include <set>
#include <string>
#include <vector>

#include "tests/house/rooms.hpp"
#include "tests/house/source_tree.hpp"

namespace frustum::house {
namespace {

std::vector<std::string> documents() {
  std::vector<std::string> files = files_of("docs", {".md"});
  for (const auto& entry : std::filesystem::directory_iterator(source_dir())) {
    if (entry.path().extension() == ".md") files.push_back(entry.path().filename().string());
  }
  return files;
}

TEST(Documents, RelativeLinksPointToFilesThatExist) {
  const std::regex link(R"(\]\(([^)#\s]+)(#[^)]*)?\))");
  for (const std::string& file : documents()) {
    const std::string text = text_of(file);
    for (auto hit = std::sregex_iterator(text.begin(), text.end(), link);
         hit != std::sregex_iterator(); ++hit) {
      const std::string target = (*hit)[1].str();
      if (target.find("://") != std::string::npos || target.starts_with("mailto:")) continue;
      const auto path = source_dir() / std::filesystem::path(file).parent_path() / target;
      EXPECT_TRUE(std::filesystem::exists(path)) << file << " links to " << target;
    }
  }
}

// `kinematics/model/chain.hpp`, `stock/polyhedral/`, `tests/install/consumer`. A path may end in
// .hpp and mean the source, too; `bad/*.nc` and other patterns are not held.
TEST(Documents, PathsOfTheTreeExist) {
  std::string folders = "tests|bench|examples|scripts|cmake|docs|machines";
  for (const auto& [room, plan] : rooms()) folders += "|" + room;
  const std::regex path("[`\"](?:\\.\\./)?((?:" + folders + ")/[A-Za-z0-9_./-]*)[`\"]");
  int held = 0;
  for (const std::string& file : documents()) {
    if (file == "CHANGELOG.md") continue;  // names what was at its time
    const std::string text = text_of(file);
    for (auto hit = std::sregex_iterator(text.begin(), text.end(), path);
         hit != std::sregex_iterator(); ++hit) {
      const std::string name = (*hit)[1].str();
      EXPECT_TRUE(std::filesystem::exists(source_dir() / name)) << file << " names " << name;
      ++held;
    }
  }
  EXPECT_GT(held, 20);
}

// `// kinematics/model/chain.hpp` of a comment is there; a name without a folder is somewhere.
TEST(Documents, FilesThatCommentsNameExist) {
  std::vector<std::string> files = sources_of_all_rooms();
  for (const char* folder : {"tests", "bench", "examples"}) {
    for (std::string& file : files_of(folder, {".cpp", ".hpp"})) files.push_back(std::move(file));
  }
  std::set<std::string> names;
  for (const std::string& file : files) names.insert(file.substr(file.rfind('/') + 1));
  const std::regex path(R"((^|[^\w<./-])([\w./]*\w\.(hpp|cpp))\b)");
  for (const std::string& file : files) {
    int number = 0;
    for (const std::string& line : lines_of(file)) {
      ++number;
      const auto comment = line.find("// ");
      if (comment == std::string::npos) continue;
      for (auto hit = std::sregex_iterator(line.begin() + static_cast<std::ptrdiff_t>(comment),
                                           line.end(), path);
           hit != std::sregex_iterator(); ++hit) {
        const std::string name = (*hit)[2].str();
        const bool there = rooms().contains(room_of(name))
                               ? std::filesystem::exists(source_dir() / name)
                               : names.contains(name.substr(name.rfind('/') + 1));
        EXPECT_TRUE(there) << file << ":" << number << " names " << name;
      }
    }
  }
}

TEST(Documents, TheApiPageShowsTheExampleThatIsCompiled) {
  EXPECT_NE(text_of("docs/cpp-api.md").find(text_of("examples/api/measure_pin.cpp")),
            std::string::npos);
}

}  // namespace
}  // namespace frustum::house

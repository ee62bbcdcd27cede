// Links between the documents lead somewhere.
#include <gtest/gtest.h>

#include <filesystem>
#include <regex>
#include <string>
#include <vector>

#include "tests/house/source_tree.hpp"

namespace frustum::house {
namespace {

TEST(Documents, RelativeLinksPointToFilesThatExist) {
  std::vector<std::string> files = files_of("docs", {".md"});
  for (const auto& entry : std::filesystem::directory_iterator(source_dir())) {
    if (entry.path().extension() == ".md") files.push_back(entry.path().filename().string());
  }
  const std::regex link(R"(\]\(([^)#\s]+)(#[^)]*)?\))");
  for (const std::string& file : files) {
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

TEST(Documents, TheApiPageShowsTheExampleThatIsCompiled) {
  EXPECT_NE(text_of("docs/cpp-api.md").find(text_of("examples/api/measure_pin.cpp")),
            std::string::npos);
}

}  // namespace
}  // namespace frustum::house

// Pages whose tables a test computes: each section is between two comment lines.
//
// The page must hold what the test computes; with FRUSTUM_UPDATE_DOCS set it is written anew
// instead.
#pragma once

#include <gtest/gtest.h>

#include <cstdlib>
#include <fstream>
#include <sstream>
#include <string>

namespace frustum {

inline void expect_section(const std::string& page, const std::string& name,
                           const std::string& text) {
  const std::string file = std::string(FRUSTUM_SOURCE_DIR) + "/docs/" + page;
  std::ostringstream content;
  content << std::ifstream(file).rdbuf();
  std::string whole = content.str();
  const std::string begin = "<!-- " + name + " -->\n", end = "<!-- end of " + name + " -->";
  const auto from = whole.find(begin), to = whole.find(end);
  ASSERT_TRUE(from != std::string::npos && to != std::string::npos) << page << ": " << name;
  const auto first = from + begin.size();
  const std::string wanted = "\n" + text + "\n";
  if (std::getenv("FRUSTUM_UPDATE_DOCS") == nullptr) {
    EXPECT_EQ(whole.substr(first, to - first), wanted)
        << "docs/" << page << " is stale: run this test with FRUSTUM_UPDATE_DOCS=1 and review";
    return;
  }
  whole.replace(first, to - first, wanted);
  std::ofstream(file) << whole;
}

}  // namespace frustum

// Pages whose tables a test writes: each section stands between two comment lines.
//
// With FRUSTUM_UPDATE_DOCS set the section is written; without it the page is left alone.
#pragma once

#include <gtest/gtest.h>

#include <cstdlib>
#include <fstream>
#include <sstream>
#include <string>

namespace frustum {

inline void write_section(const std::string& page, const std::string& name,
                          const std::string& text) {
  if (std::getenv("FRUSTUM_UPDATE_DOCS") == nullptr) return;
  const std::string file = std::string(FRUSTUM_SOURCE_DIR) + "/docs/" + page;
  std::ostringstream content;
  content << std::ifstream(file).rdbuf();
  std::string whole = content.str();
  const std::string begin = "<!-- " + name + " -->\n", end = "<!-- end of " + name + " -->";
  const auto from = whole.find(begin), to = whole.find(end);
  ASSERT_TRUE(from != std::string::npos && to != std::string::npos) << page << ": " << name;
  whole.replace(from + begin.size(), to - from - begin.size(), "\n" + text + "\n");
  std::ofstream(file) << whole;
}

}  // namespace frustum

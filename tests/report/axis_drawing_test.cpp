#include "tests/report/axis_drawing.hpp"

#include <gtest/gtest.h>

#include <cstdlib>
#include <fstream>
#include <sstream>

namespace frustum::report {
namespace {

TEST(AxisDrawing, DocsHoldTheDrawingsAsTheyAreMade) {
  for (const AxisType type : kAxisTypes) {
    const std::string file =
        std::string(FRUSTUM_SOURCE_DIR) + "/docs/" + std::string(name_of(type)) + ".svg";
    const std::string drawing = axis_drawing(type);
    if (std::getenv("FRUSTUM_UPDATE_DOCS") != nullptr) std::ofstream(file) << drawing;
    std::ostringstream content;
    content << std::ifstream(file).rdbuf();
    EXPECT_EQ(content.str(), drawing)
        << file << " is stale: run this test with FRUSTUM_UPDATE_DOCS=1 and look at the picture";
  }
}

TEST(AxisDrawing, NamesTheSixComponentErrorsOfItsAxis) {
  for (const AxisType type : kAxisTypes) {
    const std::string drawing = axis_drawing(type);
    const char axis = type == AxisType::nutating ? 'B' : type < AxisType::rotary_stator ? 'X' : 'C';
    for (const char direction : {'X', 'Y', 'Z', 'A', 'B', 'C'}) {
      EXPECT_NE(drawing.find(std::string("E") + direction + axis), std::string::npos)
          << name_of(type) << " " << direction;
    }
  }
}

}  // namespace
}  // namespace frustum::report

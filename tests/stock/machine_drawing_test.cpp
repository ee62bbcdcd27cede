#include "tests/stock/machine_drawing.hpp"

#include <gtest/gtest.h>

#include <cstdlib>
#include <fstream>
#include <sstream>

#include "tests/kinematics/machines.hpp"

namespace frustum::stock {
namespace {

struct DrawnMachine {
  const char* name;
  double azimuth;  // rad: from where nothing hides the table
};

TEST(MachineDrawing, DocsHoldTheShippedMachinesAsTheyAre_Fault2_25) {
  for (const DrawnMachine& machine :
       {DrawnMachine{"ac-probe", -1.0}, DrawnMachine{"double-pivot-head", -2.5},
        DrawnMachine{"dvf5000", -1.0}, DrawnMachine{"iwf-bc", -2.6},
        DrawnMachine{"swivel-head-table", -2.5}, DrawnMachine{"three-axis", -1.0},
        DrawnMachine{"zx-yac", -1.0}}) {
    const std::string file =
        std::string(FRUSTUM_SOURCE_DIR) + "/docs/machine-" + machine.name + ".svg";
    const std::string drawing = machine_drawing(kinematics::shipped(machine.name), machine.azimuth);
    if (std::getenv("FRUSTUM_UPDATE_DOCS") != nullptr) std::ofstream(file) << drawing;
    std::ostringstream content;
    content << std::ifstream(file).rdbuf();
    EXPECT_EQ(content.str(), drawing)
        << file << " is stale: run this test with FRUSTUM_UPDATE_DOCS=1 and look at the picture";
  }
}

}  // namespace
}  // namespace frustum::stock

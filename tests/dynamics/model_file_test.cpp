#include "dynamics/model_file.hpp"

#include <gmock/gmock.h>

#include "tests/dynamics/machines.hpp"

namespace frustum::dynamics {
namespace {

std::string good_text() { return machine_text(expected()["machines"]["iwf-bc"], true); }

TEST(ModelFile, ReadsBodiesConnectionsAndControls) {
  const DynamicModel model = model_named("iwf-bc", true);
  ASSERT_EQ(model.axes.size(), 5U);
  EXPECT_EQ(model.tool_axes, 2U);
  EXPECT_EQ(model.body_name(0), "bed");
  EXPECT_EQ(model.body_name(1), "Y");
  EXPECT_EQ(model.axes[1].previous, 0);
  EXPECT_EQ(model.axes[2].previous, -1);
  EXPECT_EQ(model.mounts.size(), 4U);
  EXPECT_DOUBLE_EQ(model.mounts[0].stiffness.z(), 450e6);
  EXPECT_DOUBLE_EQ(model.axes[0].carriages[0].lateral.damping, 20e3);
  EXPECT_DOUBLE_EQ(model.axes[4].bearings[0].tilt.stiffness, 8e6);
  ASSERT_TRUE(model.axes[0].control);
  EXPECT_DOUBLE_EQ(model.axes[0].control->velocity_gain, 500e3);
  EXPECT_DOUBLE_EQ(*model.axes[3].control->integral_time, 0.012);
}

TEST(ModelFile, IsNothingWithoutDynamics) {
  const std::string text = good_text();
  const auto model = model_from_text(text.substr(0, text.find("[dynamics]")));
  ASSERT_TRUE(model);
  EXPECT_FALSE(*model);
}

TEST(ModelFile, TakesABodyAsTheSumOfSolids) {
  std::string text = good_text();
  const std::string body =
      "[dynamics.body.Z]\n" + keys_of(expected()["machines"]["iwf-bc"]["bodies"]["Z"]);
  const auto at = text.find(body);
  ASSERT_NE(at, std::string::npos);
  text.replace(at, body.size(),
               "[[dynamics.body.Z.element]]\nshape = \"box\"\nsize = [1000, 400, 200]\n"
               "density = 7200\n[[dynamics.body.Z.element]]\nshape = \"cylinder\"\n"
               "diameter = 300\nlength = 500\nat = [200, 100, 350]\ndensity = 7850\n");
  const auto model = model_from_text(text);
  ASSERT_TRUE(model) << to_string(model.error().front());
  EXPECT_NEAR((*model)->axes[1].body.mass, 853.4419012, 1e-6);
}

// The body Z as these solids.
std::string with_solids(const std::string& solids) {
  std::string text = good_text();
  const std::string body =
      "[dynamics.body.Z]\n" + keys_of(expected()["machines"]["iwf-bc"]["bodies"]["Z"]);
  return text.replace(text.find(body), body.size(), solids);
}

TEST(ModelFile, RefusesSolidsInOtherUnitsAndOutlinesThatCross) {
  const std::string element = "[[dynamics.body.Z.element]]\n";
  const std::string prism = element + "shape = \"prism\"\nlength = 100\ndensity = 7850\n";
  const struct {
    std::string solids;
    const char* told;
  } kBad[] = {
      // Metres, a density in g/cm^3, and tonnes of a thimble.
      {element + "shape = \"box\"\nsize = [0.7, 0.6, 0.12]\ndensity = 7200\n", "weighs"},
      {element + "shape = \"box\"\nsize = [0.07, 0.06, 0.012]\nmass = 30\n", "wide"},
      {element + "shape = \"cylinder\"\ndiameter = 1e6\nlength = 1e6\ndensity = 7200\n", "weighs"},
      {prism + "outline = [[0, 0], [300, 0], [0, 100], [200, 100]]\n", "crosses itself"},
      {prism + "outline = [[0, 0], [300, 0]]\n", "encloses no area"},
      {prism + "outline = [[0, 0], [1e7, 0], [0, 1]]\n", "kilometre"},
      {element + "shape = \"box\"\nsize = [1e7, 1, 1]\nmass = 30\n", "kilometre"},
      {element + "shape = \"cylinder\"\ndiameter = 10\nlength = 1e7\nmass = 30\n", "kilometre"},
  };
  for (const auto& bad : kBad) {
    const auto model = model_from_text(with_solids(bad.solids));
    ASSERT_FALSE(model) << bad.solids;
    EXPECT_THAT(to_string(model.error().front()), testing::HasSubstr(bad.told));
    EXPECT_GT(model.error().front().line, 0);
  }
  EXPECT_TRUE(
      model_from_text(with_solids(prism + "outline = [[0, 0], [300, 0], [300, 100], [0, 100]]\n")));
}

struct BadFile {
  const char* good;
  const char* bad;
  const char* id;
  const char* key;
  const char* told;  // a part of message and hint
};

constexpr BadFile kBadFiles[] = {
    {"mass = 6200", "mass = -6200", "out-of-range", "dynamics.body.bed.mass", "greater than 0"},
    {"mass = 6200", "mass = 6.2e9", "out-of-range", "dynamics.body.bed.mass", "in kg"},
    {"mass = 6200", "mas = 6200", "missing-key", "dynamics.body.bed.mass", "missing"},
    {"mass = 6200", "mass = \"6200 kg\"", "wrong-type", "dynamics.body.bed.mass",
     "expected a finite number"},
    {"inertia = [4300,3800,5500,0,0,250]", "inertia = [4300,3800,9500,0,0,250]",
     "impossible-inertia", "dynamics.body.bed.inertia", "sum of the others"},
    {"inertia = [4300,3800,5500,0,0,250]", "inertia = [4300,3800,5500,0,0,25000]",
     "impossible-inertia", "dynamics.body.bed.inertia", "above 0"},
    {"inertia = [4300,3800,5500,0,0,250]", "inertia = [4.3e9,3.8e9,5.5e9,0,0,2.5e8]",
     "out-of-range", "dynamics.body.bed.inertia", "1e6 kg mm^2"},
    {"inertia = [4300,3800,5500,0,0,250]", "inertia = [4300,3800,5500]", "wrong-type",
     "dynamics.body.bed.inertia", "xx, yy, zz, xy, xz, yz"},
    {"stiffness = [600,600,450]", "stiffness = [6e8,6e8,4.5e8]", "out-of-range",
     "dynamics.mount[1].stiffness", "in N/um"},
    {"stiffness = [300,200]", "stiffness = [300,-200]", "out-of-range",
     "dynamics.axis.Y.carriage[1].stiffness", "must not be negative"},
    {"stiffness = [300,200]", "stiffness = [300]", "wrong-type",
     "dynamics.axis.Y.carriage[1].stiffness", "expected 2 numbers"},
    {"normal = [0,0,1]", "normal = [1,0,0]", "axis-directions",
     "dynamics.axis.X.carriage[1].normal", "along the axis X"},
    {"normal = [0,0,1]", "normal = [0,0,2]", "axis-directions",
     "dynamics.axis.X.carriage[1].normal", "unit vector"},
    {"on = \"moving\"", "on = \"movin\"", "unknown-choice", "", "did you mean moving"},
    {"kv = 50", "kw = 50", "missing-key", "dynamics.axis.B.control.kv", "missing"},
    {"kv = 50", "kv = 1e300", "out-of-range", "dynamics.axis.B.control.kv", "in 1/s"},
    {"feed_forward_velocity = 1.0", "feed_forward_velocity = 100", "out-of-range",
     "dynamics.axis.B.control.feed_forward_velocity", "shares of 1"},
    {"com = [0,120,-620]", "com = [0,1e9,-620]", "out-of-range", "dynamics.body.bed.com",
     "kilometre"},
    {"normal = [0,0,1]", "normal = [0,0,\"1\"]", "wrong-type", "dynamics.axis.X.carriage[1].normal",
     "found text"},
    {"axial = [400,40]", "axial = [400]", "wrong-type", "dynamics.axis.B.bearing[1].axial",
     "N/um and kN s/m"},
    {"[dynamics]\n", "[dynamics]\nworkpiece = \"ground\"\n", "wrong-connection",
     "dynamics.workpiece", "axes that move the workpiece"},
    {"[[dynamics.axis.B.bearing]]", "[[dynamics.axis.B.carriage]]", "wrong-connection",
     "dynamics.axis.B.carriage", "write bearing"},
};

TEST(ModelFile, NamesKeyLineAndRemedyOfWhatIsWrong) {
  for (const BadFile& file : kBadFiles) {
    std::string text = good_text();
    for (auto at = text.find(file.good); at != std::string::npos;
         at = text.find(file.good, at + std::string(file.bad).size())) {
      text.replace(at, std::string(file.good).size(), file.bad);
      if (std::string(file.good).find("bearing") == std::string::npos) break;
    }
    const auto model = model_from_text(text);
    ASSERT_FALSE(model) << file.bad;
    bool found = false;
    std::string all;
    for (const Diagnostic& d : model.error()) {
      all += to_string(d) + "\n";
      found = found ||
              (d.id.text() == file.id && d.line > 0 && (*file.key == '\0' || d.key == file.key) &&
               to_string(d).find(file.told) != std::string::npos);
    }
    EXPECT_TRUE(found) << file.bad << "\n" << all;
  }
}

TEST(ModelFile, NamesANormalAlongItsAxis) {
  std::string text = good_text();
  const auto from = text.find("[[dynamics.axis.Y.carriage]]");
  const auto at = text.find("normal = [0,0,1]", from);
  text.replace(at, 16, "normal = [0,1,0]");
  const auto model = model_from_text(text);
  ASSERT_FALSE(model);
  EXPECT_EQ(model.error().front().key, "dynamics.axis.Y.carriage[1].normal");
  EXPECT_THAT(model.error().front().message, testing::HasSubstr("along the axis Y"));
}

TEST(ModelFile, NamesABodyThatNothingHoldsAndTheDirection) {
  std::string text = good_text();
  const auto drive = text.find("[dynamics.axis.Z.drive]");
  const auto at = text.find("stiffness = 120", drive);
  text.replace(at, 15, "stiffness = 0");
  const auto model = model_from_text(text);
  ASSERT_FALSE(model);
  const Diagnostic& problem = model.error().front();
  EXPECT_EQ(problem.id.text(), "free-direction");
  EXPECT_GT(problem.line, 0);
  EXPECT_THAT(problem.message, testing::HasSubstr("body Z along [0.000, 0.000, 1.000]"));
  EXPECT_THAT(problem.hint, testing::HasSubstr("drive"));
}

}  // namespace
}  // namespace frustum::dynamics

// What a motion test answers: a document, a text for the terminal, and files.
//
// Units  : as named in the document; the text says them
// Errors : none
#pragma once

#include <map>
#include <span>
#include <string>
#include <vector>

#include "app/motion/document.hpp"
#include "app/motion/motion_words.hpp"
#include "instruments/motion_test.hpp"
#include "instruments/observability.hpp"
#include "instruments/probing_program.hpp"
#include "report/page/motion_page.hpp"

namespace frustum::app {

struct NcText {
  std::string name{};  // of its file, where none was given
  std::string text{};
};

struct MotionAnswer {
  Document document{};
  std::string text{};
  report::MotionPage page{};
  report::Wording words{};  // of text and page
  Diagnostics warnings{};
  std::map<std::string, std::string> files{};  // of --out, besides the document
  std::optional<NcText> program{};
};

// Begins the document with schema, test, machine, errors and set-up, text and page with the title
// and the same.
[[nodiscard]] MotionAnswer answer_of(const std::string& test, const std::string& title,
                                     const MotionSetup& setup);

// The probing program for each control, and Klartext's mask, among the files.
void add_probing_programs(MotionAnswer& answer, const instruments::ProbingProgram& program);

// The pre-travel of a probe in the document, and on the page where there is some.
void add_lobes(MotionAnswer& answer, const instruments::ProbeLobes& lobes);

// Puts the warnings into the document.
void add_warnings(MotionAnswer& answer);

// Lengths in um, or in uin where the wording says so: with so many decimals of um; as they are
// drawn.
[[nodiscard]] std::string shown_um(double mm, const report::Wording& words, int decimals = 3);
[[nodiscard]] std::vector<double> drawn_um(std::vector<double> mm, const report::Wording& words);
// Between numbers in a row: a comma, or a semicolon where decimals have a comma.
[[nodiscard]] const char* between(const report::Wording& words);
// "10, -5, 3 µm", of um.
[[nodiscard]] std::string um_amounts(const Vec3& um, const report::Wording& words);

// Millimetres and rad as they are documented.
[[nodiscard]] std::vector<double> in_um(std::vector<double> mm);
[[nodiscard]] std::vector<double> in_degrees(std::vector<double> rad);
[[nodiscard]] std::vector<double> coordinates(const Vec3& v, double factor = 1.0);
// {"X": [..], "C": [..]}, mm and degrees.
[[nodiscard]] Document axes_of(const kinematics::Machine& machine,
                               const std::vector<instruments::TestPose>& poses);
[[nodiscard]] std::vector<double> parameters_of(const instruments::MotionTest& test);

// What the bar of a test of one run shows of the actual machine, the tip of which is moved besides
// in each pose. Refused: a deviation beyond its
// stroke (mm), with where in the run it is, a value of `parameter`.
[[nodiscard]] Result<std::vector<double>> shown_by_bar(const MotionSetup& setup,
                                                       const instruments::MotionTest& test,
                                                       double stroke, const std::string& parameter,
                                                       std::span<const Vec3> moved = {});

// Puts `told` and `not_told` into the document and a line into the text.
void add_told(MotionAnswer& answer, const instruments::Told& told);

// At least as many poses as the unknowns of any test, evenly among its samples.
constexpr std::size_t kPosesThatTell = 72;

}  // namespace frustum::app

#include "tests/report/axis_drawing.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include "core/pose.hpp"

namespace frustum::report {
namespace {

using Point = Eigen::Vector2d;

constexpr double kWidth = 760.0, kHeight = 340.0;
constexpr double kPixels = 1.35;  // of a unit of the drawn scene

constexpr const char* kStyle =
    "text{font:13px sans-serif;fill:#222}.name{font-weight:bold}.error{fill:#b3261e}"
    ".motion{fill:#0b57a4}.quiet{fill:#666}line,path,polygon{stroke-linejoin:round}";

// X to the right and forward, Y to the right and back, Z up.
Point project(const Vec3& p) {
  return {200.0 + kPixels * (0.90 * p.x() + 0.42 * p.y()),
          205.0 - kPixels * (p.z() - 0.22 * p.x() + 0.34 * p.y())};
}

class Scene {
 public:
  void line(const Vec3& a, const Vec3& b, const char* colour, double width, bool dashed = false) {
    const Point p = project(a), q = project(b);
    svg_ += fmt::format(
        "<line x1=\"{:.1f}\" y1=\"{:.1f}\" x2=\"{:.1f}\" y2=\"{:.1f}\" stroke=\"{}\" "
        "stroke-width=\"{:g}\"{}/>\n",
        p.x(), p.y(), q.x(), q.y(), colour, width, dashed ? " stroke-dasharray=\"6 4\"" : "");
  }

  void polygon(const std::vector<Vec3>& corners, const char* fill) {
    std::string points;
    for (const Vec3& corner : corners) {
      const Point p = project(corner);
      points += fmt::format("{}{:.1f},{:.1f}", points.empty() ? "" : " ", p.x(), p.y());
    }
    svg_ += fmt::format("<polygon points=\"{}\" fill=\"{}\" stroke=\"#555\" stroke-width=\"1\"/>\n",
                        points, fill);
  }

  // The three faces of a box that are seen.
  void box(const Vec3& lo, const Vec3& hi, const std::array<const char*, 3>& fills) {
    polygon({{lo.x(), lo.y(), hi.z()}, {hi.x(), lo.y(), hi.z()}, hi, {lo.x(), hi.y(), hi.z()}},
            fills[0]);
    polygon({lo, {hi.x(), lo.y(), lo.z()}, {hi.x(), lo.y(), hi.z()}, {lo.x(), lo.y(), hi.z()}},
            fills[1]);
    polygon({{hi.x(), lo.y(), lo.z()}, {hi.x(), hi.y(), lo.z()}, hi, {hi.x(), lo.y(), hi.z()}},
            fills[2]);
  }

  void disc(const Pose& frame, double radius, double height, const char* top, const char* rim) {
    const auto ring = [&](double z) {
      std::vector<Vec3> points;
      for (int k = 0; k < 48; ++k) {
        const double t = 2.0 * std::numbers::pi * k / 48.0;
        points.push_back(frame.point({radius * std::cos(t), radius * std::sin(t), z}));
      }
      return points;
    };
    for (double z = 0.0; z < height; z += 0.5) polygon_without_edge(ring(z), rim);
    polygon(ring(0.0), "none");
    polygon(ring(height), top);
  }

  void arrow(const Vec3& a, const Vec3& b, const char* colour, double width) {
    line(a, b, colour, width);
    head(project(a), project(b), colour);
  }

  // From angle `from` to `to` about the frame's z.
  void arc(const Pose& frame, double radius, double from, double to, const char* colour,
           double width) {
    std::string path;
    Point before = Point::Zero(), last = Point::Zero();
    for (int k = 0; k <= 24; ++k) {
      const double t = from + (to - from) * k / 24.0;
      before = last;
      last = project(frame.point({radius * std::cos(t), radius * std::sin(t), 0.0}));
      path += fmt::format("{}{:.1f} {:.1f}", k == 0 ? "M" : " L", last.x(), last.y());
    }
    svg_ += fmt::format("<path d=\"{}\" fill=\"none\" stroke=\"{}\" stroke-width=\"{:g}\"/>\n",
                        path, colour, width);
    head(before, last, colour);
  }

  void dot(const Vec3& at) {
    const Point p = project(at);
    svg_ +=
        fmt::format("<circle cx=\"{:.1f}\" cy=\"{:.1f}\" r=\"4\" fill=\"#111\"/>\n", p.x(), p.y());
  }

  void text(const Vec3& at, const Point& shift, const char* kind, const std::string& what) {
    const Point p = project(at) + shift;
    caption(p, kind, what);
  }
  // Lines beside the picture.
  void note(const char* kind, const std::string& what) {
    caption({445.0, 70.0 + 19.0 * static_cast<double>(notes_++)}, kind, what);
  }

 private:
  void caption(const Point& p, const char* kind, const std::string& what) {
    svg_ += fmt::format("<text class=\"{}\" x=\"{:.1f}\" y=\"{:.1f}\">{}</text>\n", kind, p.x(),
                        p.y(), what);
  }

 public:
  // Six errors at the functional point, in the directions of `frame`.
  void errors(const Pose& frame, const std::string& axis) {
    constexpr const char* kRed = "#b3261e";
    const std::array names{"X", "Y", "Z"};
    const std::array turns{"A", "B", "C"};
    constexpr double kReach = 58.0;
    const std::array shifts{Point(6, 12), Point(6, -4), Point(6, 0)};
    for (int d = 0; d < 3; ++d) {
      const auto i = static_cast<std::size_t>(d);
      const Vec3 u = Vec3::Unit(d);
      const Vec3 tip = frame.point(kReach * u);
      arrow(frame.translation, tip, kRed, 2.0);
      // About u: the frame's z laid along u.
      const Pose about{
          frame.rotation * Eigen::Quaterniond::FromTwoVectors(Vec3::UnitZ(), u).toRotationMatrix(),
          frame.point(0.62 * kReach * u)};
      arc(about, 10.0, -2.6, 2.2, kRed, 1.4);
      text(tip, shifts[i], "error", fmt::format("E{0}{2}, E{1}{2}", names[i], turns[i], axis));
    }
    dot(frame.translation);
  }

  [[nodiscard]] std::string svg(const std::string& title) const {
    return fmt::format(
        "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 {0:g} {1:g}\" width=\"{0:g}\" "
        "height=\"{1:g}\" role=\"img\" aria-label=\"{2}\">\n<style>{3}</style>\n<rect "
        "width=\"{0:g}\" height=\"{1:g}\" fill=\"#fff\"/>\n<text class=\"name\" x=\"16\" "
        "y=\"26\">{2}</text>\n{4}</svg>\n",
        kWidth, kHeight, title, kStyle, svg_);
  }

 private:
  void polygon_without_edge(const std::vector<Vec3>& corners, const char* fill) {
    std::string points;
    for (const Vec3& corner : corners) {
      const Point p = project(corner);
      points += fmt::format("{}{:.1f},{:.1f}", points.empty() ? "" : " ", p.x(), p.y());
    }
    svg_ += fmt::format("<polygon points=\"{}\" fill=\"{}\"/>\n", points, fill);
  }

  void head(const Point& from, const Point& to, const char* colour) {
    const Point u = (to - from).normalized(), n(-u.y(), u.x());
    const Point tip = to + 4.0 * u, left = to - 5.0 * u + 4.0 * n, right = to - 5.0 * u - 4.0 * n;
    svg_ +=
        fmt::format("<polygon points=\"{:.1f},{:.1f} {:.1f},{:.1f} {:.1f},{:.1f}\" fill=\"{}\"/>\n",
                    tip.x(), tip.y(), left.x(), left.y(), right.x(), right.y(), colour);
  }

  std::string svg_;
  int notes_ = 0;
};

constexpr std::array kBed{"#dcdcdc", "#b9b9b9", "#c8c8c8"};
constexpr std::array kPart{"#cfe2f7", "#96b9de", "#aecbea"};
constexpr std::array kWork{"#f5e6c4", "#d9c08a", "#e6d2a5"};
constexpr const char* kBlue = "#0b57a4";
constexpr const char* kGrey = "#777";

void bed(Scene& scene) { scene.box({-130, -45, -50}, {130, 45, -30}, kBed); }

// The tilted line of motion, drawn far larger than it is.
void line_of_motion(Scene& scene, const Vec3& through) {
  scene.line(through - Vec3(140, 0, 0), through + Vec3(140, 0, 0), kGrey, 1.0);
  scene.line(through + Vec3(-120, 0, -14), through + Vec3(120, 0, 14), "#b3261e", 1.2, true);
  scene.text(through + Vec3(120, 0, 14), {-20, -8}, "error", "EB0X, EC0X");
}

std::string linear(bool tool_side) {
  Scene scene;
  bed(scene);
  scene.box({-50, -35, -28}, {50, 35, 0}, kPart);
  scene.box({-25, -18, 0}, {25, 18, 25}, tool_side ? kPart : kWork);
  line_of_motion(scene, {0, 0, 25});
  const double way = tool_side ? 1.0 : -1.0;
  const Vec3 from(60 * way, -45, -12);
  scene.arrow(from, from + Vec3(62 * way, 0, 0), kBlue, 3.0);
  scene.errors({Mat3::Identity(), {0, 0, 25}}, "X");
  scene.note("motion",
             tool_side ? "+q moves the part by +q e" : "+q moves the part by -q e: the tool, seen");
  if (!tool_side) scene.note("motion", "from the work, goes in +e (ISO 841)");
  scene.note("error", "EXX EYX EZX: displacements of the part");
  scene.note("error", "EAX EBX ECX: turns about the functional point (dot)");
  scene.note("error", "EB0X EC0X: tilt of the line, not of what it carries");
  scene.note("quiet", "all positive along the axes of the bed, or of the");
  scene.note("quiet", "axis before (grey), whatever the side");
  scene.note("motion", "reversal h: the part lags by h/2 behind its own");
  scene.note("motion",
             tool_side ? "motion: EXX = -h/2 while q grows" : "motion: EXX = +h/2 while q grows");
  return scene.svg(tool_side ? "Linear axis X that carries the tool (side +1)"
                             : "Linear axis X that carries the work (side -1)");
}

std::string rotary(bool rotor) {
  Scene scene;
  bed(scene);
  constexpr double kTurned = 0.6;
  scene.disc({Mat3::Identity(), {0, 0, -28}}, 62.0, 28.0, "#cfe2f7", "#96b9de");
  scene.line({0, 0, -28}, {0, 0, 120}, kGrey, 1.0, true);
  scene.line(Vec3::Zero(), {62 * std::cos(kTurned), 62 * std::sin(kTurned), 0}, kBlue, 1.4);
  scene.arc({Mat3::Identity(), Vec3::Zero()}, 74.0, -2.4, -1.2, kBlue, 3.0);
  scene.errors({rotation_z(rotor ? kTurned : 0.0), Vec3::Zero()}, "C");
  scene.text({0, 0, 120}, {8, 6}, "quiet", "e");
  scene.note("motion", "the part turns by side q about e (blue: a mark on it)");
  scene.note("error", "EXC EYC EZC: displacements of the part");
  scene.note("error", "EAC EBC ECC: turns about the functional point (dot)");
  scene.note("error", "EX0C EY0C EA0C EB0C: the mean axis line, with all");
  scene.note("error", "that it carries");
  scene.note("quiet", rotor ? "the component errors turn with the axis"
                            : "the component errors keep to the directions of the");
  scene.note("quiet",
             rotor ? "(rotary_error_frame = \"rotor\")" : "stator, whatever q (ISO 230-7)");
  return scene.svg(rotor ? "Rotary axis C, errors in the rotor frame"
                         : "Rotary axis C, errors in the stator frame");
}

std::string nutating() {
  Scene scene;
  bed(scene);
  const Mat3 lean = rotation_x(-0.25 * std::numbers::pi);
  scene.disc({lean, lean * Vec3(0, 0, -18)}, 55.0, 18.0, "#cfe2f7", "#96b9de");
  scene.line(Vec3::Zero(), lean * Vec3(0, 0, 120), kGrey, 1.0, true);
  scene.text(lean * Vec3(0, 0, 120), {6, 0}, "quiet", "e = (0, 1, 1) / sqrt 2");
  scene.arc({lean, Vec3::Zero()}, 66.0, -2.6, -1.4, kBlue, 3.0);
  scene.errors({Mat3::Identity(), Vec3::Zero()}, "B");
  scene.note("motion", "the part turns by side q about e");
  scene.note("error", "EXB EYB EZB: displacements of the part");
  scene.note("error", "EAB EBB ECB: turns about the functional point (dot)");
  scene.note("quiet", "the errors keep to X Y Z of the joint's frame, not");
  scene.note("quiet", "to the leaning direction: EBB is the turn about Y,");
  scene.note("quiet", "a positioning error is a turn about e: EBB and ECB");
  scene.note("quiet", "of the same size");
  return scene.svg("Nutating axis B, leaning by 45 deg");
}

}  // namespace

std::string_view name_of(AxisType type) {
  constexpr std::array<std::string_view, 5> kNames{
      "axis-linear-tool-side", "axis-linear-workpiece-side", "axis-rotary-stator",
      "axis-rotary-rotor", "axis-nutating"};
  return kNames.at(static_cast<std::size_t>(type));
}

std::string axis_drawing(AxisType type) {
  switch (type) {
    case AxisType::linear_tool_side:
      return linear(true);
    case AxisType::linear_workpiece_side:
      return linear(false);
    case AxisType::rotary_stator:
      return rotary(false);
    case AxisType::rotary_rotor:
      return rotary(true);
    case AxisType::nutating:
      break;
  }
  return nutating();
}

}  // namespace frustum::report

#include "report/exchange/tool_drawing.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "core/made_by.hpp"
#include "report/exchange/dxf_drawing.hpp"
#include "report/html/html_text.hpp"
#include "report/number_text.hpp"

namespace frustum::report {
namespace {

using cutter::Body;
using cutter::GeneratrixSegment;
using cutter::MeridianPoint;

struct DrawnBody {
  const char* name;  // class; the layer in capitals
  const char* layer;
  int colour;
  const Body* body;
};

std::vector<DrawnBody> bodies_of(const cutter::Cutter& tool) {
  std::vector<DrawnBody> bodies{{"cutter", "CUTTER", 7, &tool.body()}};
  if (tool.shank()) bodies.push_back({"shank", "SHANK", 8, &*tool.shank()});
  if (tool.holder()) bodies.push_back({"holder", "HOLDER", 5, &*tool.holder()});
  return bodies;
}

// With what closes the body at its top and, where it does not begin at the axis, at its bottom.
std::vector<GeneratrixSegment> outline_of(const Body& body) {
  const auto segments = body.generatrix().segments();
  std::vector<GeneratrixSegment> outline;
  const MeridianPoint first = segments.front().from, last = segments.back().to;
  if (first.r > 0.0) outline.push_back(cutter::line({0.0, first.z}, first));
  outline.insert(outline.end(), segments.begin(), segments.end());
  if (last.r > 0.0) outline.push_back(cutter::line(last, {0.0, last.z}));
  return outline;
}

// Whether the arc from `from` to `to`, below half a turn, runs counter-clockwise about its centre.
bool is_counter_clockwise(const GeneratrixSegment& s) {
  const double x = s.from.r - s.centre.r, y = s.from.z - s.centre.z;
  return x * (s.to.z - s.centre.z) - y * (s.to.r - s.centre.r) > 0.0;
}

void draw_half(DxfDrawing& drawing, const DrawnBody& drawn, double side) {
  for (const GeneratrixSegment& s : outline_of(*drawn.body)) {
    const Vec3 from(side * s.from.r, s.from.z, 0.0), to(side * s.to.r, s.to.z, 0.0);
    if (!cutter::is_arc(s)) {
      drawing.line(drawn.layer, drawn.colour, from, to);
      continue;
    }
    const Vec3 centre(side * s.centre.r, s.centre.z, 0.0);
    const auto angle = [&](const Vec3& p) {
      return std::atan2(p.y() - centre.y(), p.x() - centre.x());
    };
    const bool forward = is_counter_clockwise(s) == (side > 0.0);
    drawing.arc(drawn.layer, drawn.colour, centre, s.arc_radius, Rad{angle(forward ? from : to)},
                Rad{angle(forward ? to : from)});
  }
}

// Heights of a drawing run down.
std::string path_of(const Body& body, double side) {
  std::string path;
  for (const GeneratrixSegment& s : outline_of(body)) {
    if (path.empty()) {
      path = fmt::format("M{} {}", exact_decimal(side * s.from.r), exact_decimal(-s.from.z));
    }
    const std::string to =
        fmt::format("{} {}", exact_decimal(side * s.to.r), exact_decimal(-s.to.z));
    if (!cutter::is_arc(s)) {
      path += "L" + to;
      continue;
    }
    // The flag of the sweep is 1 for angles that grow clockwise on the page.
    const bool clockwise = is_counter_clockwise(s) != (side > 0.0);
    path += fmt::format("A{0} {0} 0 0 {1} {2}", exact_decimal(s.arc_radius), clockwise ? 1 : 0, to);
  }
  return path;
}

}  // namespace

std::string tool_dxf(const cutter::Cutter& tool) {
  DxfDrawing drawing;
  double top = 0.0;
  for (const DrawnBody& drawn : bodies_of(tool)) {
    for (const double side : {1.0, -1.0}) draw_half(drawing, drawn, side);
    top = std::max(top, drawn.body->height());
  }
  drawing.line("AXIS", 1, Vec3(0.0, -2.0, 0.0), Vec3(0.0, top + 2.0, 0.0));
  return drawing.file();
}

std::string tool_svg(const cutter::Cutter& tool, const std::string& title) {
  double top = 0.0, wide = 0.0;
  std::string paths;
  for (const DrawnBody& drawn : bodies_of(tool)) {
    top = std::max(top, drawn.body->height());
    wide = std::max(wide, drawn.body->max_radius());
    for (const double side : {1.0, -1.0}) {
      paths +=
          fmt::format("<path class=\"{}\" d=\"{}\"/>\n", drawn.name, path_of(*drawn.body, side));
    }
  }
  constexpr double kMargin = 2.0;  // mm
  const double width = 2.0 * (wide + kMargin), height = top + 2.0 * kMargin;
  const std::string left = exact_decimal(-wide - kMargin), upper = exact_decimal(-top - kMargin);
  return fmt::format(
      "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n"
      "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{0}mm\" height=\"{1}mm\" "
      "viewBox=\"{2} {3} {0} {1}\">\n<title>{4}</title>\n<desc>{7}</desc>\n"
      "<style>path{{fill:#eef0f2;stroke:#1b2129;stroke-width:0.2}} .shank{{fill:#ffffff}} "
      ".holder{{fill:#d9dee3}} .axis{{stroke:#b3261e;stroke-width:0.15;stroke-dasharray:4 1 1 1}}"
      "</style>\n{5}<path class=\"axis\" d=\"M0 {6}L0 {3}\"/>\n</svg>\n",
      exact_decimal(width), exact_decimal(height), left, upper, html_text(title), paths,
      exact_decimal(kMargin), made_by());
}

}  // namespace frustum::report

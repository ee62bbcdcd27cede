#include "report/chart/bar_drawing.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "core/units.hpp"
#include "report/chart/svg.hpp"
#include "report/html/html_text.hpp"
#include "report/number_text.hpp"

namespace frustum::report {
namespace {

constexpr double kSide = 440.0, kEdge = 46.0;  // pixels
constexpr double kBall = 6.0, kHead = 9.0;     // of balls and of the heads of arrows

// Coordinates of the table to the right and upward.
struct SheetAxes {
  int right = 0, up = 1;
  Phrase name;
  const char* right_name = "";
  const char* up_name = "";
};
constexpr std::array<SheetAxes, 2> kViews{
    {{0, 1, "from above", "X", "Y"}, {0, 2, "from the front", "X", "Z"}}};

using Flat = std::vector<SvgPoint>;

// Counterclockwise, of points in a plane.
Flat convex_hull(Flat points) {
  std::ranges::sort(points, [](const SvgPoint& a, const SvgPoint& b) {
    return a.x < b.x || (a.x == b.x && a.y < b.y);
  });
  Flat hull;
  for (const int half : {0, 1}) {
    const std::size_t start = hull.size();
    for (const SvgPoint& p : points) {
      const auto turns_left = [&] {
        const SvgPoint& a = hull[hull.size() - 2];
        const SvgPoint& b = hull.back();
        return (b.x - a.x) * (p.y - a.y) - (b.y - a.y) * (p.x - a.x) > 0.0;
      };
      while (hull.size() >= start + 2 && !turns_left()) hull.pop_back();
      hull.push_back(p);
    }
    hull.pop_back();
    if (half == 0) std::ranges::reverse(points);
  }
  return hull;
}

class View {
 public:
  View(const BarDrawing& drawing, const SheetAxes& axes, const Wording& words)
      : drawing_(drawing),
        axes_(axes),
        words_(words),
        svg_(kSide, kSide, drawing.title + ", " + words(axes.name)) {
    // Both views have one scale: that of the largest side of set-up and table.
    Vec3 low = drawing.table_ball, high = low;
    const auto include = [&](const Vec3& p) {
      low = low.cwiseMin(p);
      high = high.cwiseMax(p);
    };
    include(drawing.offset);
    for (const Vec3& p : drawing.path) include(p);
    const Vec3 at_tool = drawing.path.front() + drawing.tool_length * drawing.tool_axis;
    include(at_tool);
    constexpr double kMost = 4.0;  // times the set-up: larger tables reach beyond the picture
    const double set_up = (high - low).maxCoeff();
    Vec3 all_low = low, all_high = high;
    for (const BarDrawing::Outline& body : drawing.bodies) {
      for (const Vec3& p : body.corners) {
        all_low = all_low.cwiseMin(p);
        all_high = all_high.cwiseMax(p);
      }
    }
    if ((all_high - all_low).maxCoeff() <= kMost * set_up) {
      low = all_low;
      high = all_high;
    }
    middle_ = flat(Vec3(0.5 * (low + high)));
    scale_ = (kSide - 2.0 * kEdge) / std::max((high - low).maxCoeff(), 1.0);
  }

  std::string html() {
    draw_bodies();
    draw_turning();
    draw_path();
    draw_tool();
    draw_bar();
    draw_offset();
    draw_axes();
    draw_scale();
    return fmt::format(
        "<figure><figcaption><b>{}</b><span class=\"scale\">{}</span></figcaption>\n{}</figure>\n",
        html_text(words_(axes_.name)), html_text(said()), svg_.html());
  }

 private:
  [[nodiscard]] SvgPoint flat(const Vec3& p) const { return {p[axes_.right], p[axes_.up]}; }
  // What the drawing would have no room for.
  [[nodiscard]] std::string said() const {
    const auto place = [&](double mm) {
      return words_.fixed(words_.shown(mm, "mm"), words_.is_inch() ? 4 : 3);
    };
    const double bar = (drawing_.path.front() - drawing_.table_ball).norm();
    std::string text =
        words_("+ G54 at {0} {1}, {2} {3} {5}; bar {4} {5} where it is mounted", axes_.right_name,
               place(drawing_.offset[axes_.right]), axes_.up_name, place(drawing_.offset[axes_.up]),
               words_.number(fmt::format("{:.5g}", words_.shown(bar, "mm"))), words_.symbol("mm"));
    if (drawing_.tool_length > 0.0) text += "; T1 " + words_.amount(drawing_.tool_length, "mm");
    return text;
  }
  [[nodiscard]] SvgPoint pixel(const SvgPoint& p) const {
    return {0.5 * kSide + scale_ * (p.x - middle_.x), 0.5 * kSide - scale_ * (p.y - middle_.y)};
  }
  [[nodiscard]] SvgPoint pixel(const Vec3& p) const { return pixel(flat(p)); }
  static bool is_inside(const SvgPoint& p) {
    return p.x >= 0.0 && p.x <= kSide && p.y >= 0.0 && p.y <= kSide;
  }

  void draw_bodies() {
    for (const BarDrawing::Outline& body : drawing_.bodies) {
      Flat corners;
      for (const Vec3& corner : body.corners) corners.push_back(flat(corner));
      Flat hull = convex_hull(std::move(corners));
      if (hull.size() < 3) continue;
      double top = HUGE_VAL, middle = 0.0;
      for (SvgPoint& p : hull) {
        p = pixel(p);
        // Beyond the picture a corner is as good at its edge's far side.
        p = {std::clamp(p.x, -kSide, 2.0 * kSide), std::clamp(p.y, -kSide, 2.0 * kSide)};
        top = std::min(top, p.y);
        middle += p.x / static_cast<double>(hull.size());
      }
      svg_.area(hull, "below");
      hull.push_back(hull.front());
      svg_.polyline(hull, "bed");
      const SvgPoint label{std::clamp(middle, kEdge, kSide - kEdge), top + 14.0};
      if (is_inside(label)) svg_.text(label, body.name);
    }
  }

  // The way of the first pass, with its sense in the middle of it.
  void draw_path() {
    Flat points;
    for (std::size_t i = 1; i < drawing_.path.size(); ++i)
      points.push_back(pixel(drawing_.path[i]));
    svg_.polyline(points, "trace s1");
    double longest = 0.0;
    for (std::size_t i = 1; i < points.size(); ++i) {
      longest = std::max(longest,
                         std::hypot(points[i].x - points[i - 1].x, points[i].y - points[i - 1].y));
    }
    // Along the line of sight there is no arrow.
    if (points.size() < 3 || longest < 0.05) return;
    const std::size_t at = points.size() / 3;
    arrow_head(points[at - 1], points[at], "trace s1");
    svg_.text({points[at].x + 12.0, points[at].y - 8.0}, drawing_.parameter, SvgAnchor::start);
  }

  // The rotary axis: an arc in its sense where it points at the reader, else its line.
  void draw_turning() {
    if (!drawing_.turning) return;
    const auto& [point, direction] = *drawing_.turning;
    const Vec3 sight = axes_.up == 1 ? Vec3(Vec3::UnitZ()) : Vec3(-Vec3::UnitY());
    const double along = direction.dot(sight);
    const SvgPoint at = pixel(point);
    constexpr double kAtReader = 0.9, kArc = 30.0;
    if (std::abs(along) < kAtReader) {
      constexpr double kFar = 1000.0;  // mm: out of the picture
      svg_.line(pixel(Vec3(point - kFar * direction)), pixel(Vec3(point + kFar * direction)),
                "extreme");
      return;
    }
    Flat arc;
    for (int i = 0; i <= 27; ++i) {
      const double angle = std::copysign(1.0, along) * i * 10.0 * kRadPerDeg;
      arc.push_back({at.x + kArc * std::cos(angle), at.y - kArc * std::sin(angle)});
    }
    svg_.polyline(arc, "trace s3");
    arrow_head(arc[arc.size() - 2], arc.back(), "trace s3");
    svg_.text({at.x, at.y + kArc + 16.0}, drawing_.parameter);
  }

  void draw_tool() {
    if (!(drawing_.tool_length > 0.0)) return;
    const Vec3& ball = drawing_.path.front();
    svg_.line(pixel(ball), pixel(Vec3(ball + drawing_.tool_length * drawing_.tool_axis)), "bed");
  }

  void draw_bar() {
    const SvgPoint table = pixel(drawing_.table_ball), spindle = pixel(drawing_.path.front());
    svg_.line(table, spindle, "middle s2");
    svg_.circle(table, kBall, "box s2");
    svg_.circle(spindle, kBall, "dot s1");
    if (std::hypot(spindle.x - table.x, spindle.y - table.y) < kBall) {
      svg_.text({table.x, table.y - 13.0}, words_("spindle ball over table ball"));
      return;
    }
    const bool spindle_above = spindle.y < table.y;
    svg_.text({table.x, table.y + (spindle_above ? 22.0 : -13.0)}, words_("table ball"));
    svg_.text({spindle.x, spindle.y + (spindle_above ? -13.0 : 22.0)}, words_("spindle ball"));
  }

  void draw_offset() {
    const SvgPoint at = pixel(drawing_.offset);
    svg_.line({at.x - 10.0, at.y}, {at.x + 10.0, at.y}, "zero");
    svg_.line({at.x, at.y - 10.0}, {at.x, at.y + 10.0}, "zero");
  }

  // The axes of the table's frame, in the corner.
  void draw_axes() {
    const SvgPoint corner{22.0, kSide - 22.0};
    constexpr double kLong = 40.0;
    const SvgPoint right{corner.x + kLong, corner.y}, up{corner.x, corner.y - kLong};
    svg_.line(corner, right, "axis");
    svg_.line(corner, up, "axis");
    arrow_head(corner, right, "axis");
    arrow_head(corner, up, "axis");
    svg_.text({right.x + 10.0, right.y + 4.0}, axes_.right_name);
    svg_.text({up.x, up.y - 7.0}, axes_.up_name);
  }

  void draw_scale() {
    // A round number of the shown unit.
    const double unit = words_.shown(1.0, "mm");
    const double shown = round_up_125(60.0 / scale_ * unit), length = shown / unit;
    const double y = kSide - 22.0, end = kSide - 14.0;
    svg_.line({end - scale_ * length, y}, {end, y}, "axis");
    svg_.text({end, y - 7.0}, words_.general(shown) + " " + words_.symbol("mm"), SvgAnchor::end);
  }

  void arrow_head(SvgPoint from, SvgPoint to, std::string_view classes) {
    const double dx = to.x - from.x, dy = to.y - from.y, length = std::hypot(dx, dy);
    if (!(length > 0.0)) return;
    const double head = kHead / length;
    for (const double side : {-0.45, 0.45}) {
      svg_.line(to, {to.x - head * (dx - side * dy), to.y - head * (dy + side * dx)}, classes);
    }
  }

  const BarDrawing& drawing_;
  const SheetAxes& axes_;
  const Wording& words_;
  SvgDrawing svg_;
  SvgPoint middle_{};
  double scale_ = 1.0;
};

}  // namespace

std::string bar_figure_of(const BarDrawing& drawing, const Wording& words) {
  if (drawing.path.size() < 2) return {};
  std::string html = "<div class=\"pair\">";
  for (const SheetAxes& axes : kViews) html += View(drawing, axes, words).html();
  return html + "</div>\n";
}

}  // namespace frustum::report

#include "report/sheet/setup_drawing.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "report/html/html_text.hpp"
#include "report/number_text.hpp"

namespace frustum::report {
namespace {

using Point = Eigen::Vector2d;  // pixels, or mm in the plane of a view

constexpr double kWidth = 320.0, kHeight = 240.0, kMargin = 27.0;  // pixels

struct Directions {
  Vec3 right, up, toward;  // toward the viewer
  const char* right_name;
  const char* up_name;
};

Directions directions_of(SheetView view) {
  switch (view) {
    case SheetView::along_x:
      return {Vec3::UnitY(), Vec3::UnitZ(), Vec3::UnitX(), "Y", "Z"};
    case SheetView::along_y:
      return {Vec3::UnitX(), Vec3::UnitZ(), -Vec3::UnitY(), "X", "Z"};
    case SheetView::from_top:
      break;
  }
  return {Vec3::UnitX(), Vec3::UnitY(), Vec3::UnitZ(), "X", "Y"};
}

struct Frame {
  Point low = Point::Constant(std::numeric_limits<double>::infinity());
  Point high = -low;
  void add(const Point& p) {
    low = low.cwiseMin(p);
    high = high.cwiseMax(p);
  }
};

// Draws in one view; what it is to show is announced with include() before anything is drawn.
class Drawing {
 public:
  explicit Drawing(SheetView view) : d_(directions_of(view)) {}

  void include(const Vec3& p) { frame_.add(flat(p)); }
  void include_box(const Vec3& p, double across, double above) {
    for (const double x : {-across, across}) {
      for (const double y : {-across, across}) {
        for (const double z : {0.0, above}) include(p + Vec3(x, y, z));
      }
    }
  }
  void fit() {
    const Point size = (frame_.high - frame_.low).cwiseMax(Point(1.0, 1.0));
    scale_ = std::min((kWidth - 2.0 * kMargin) / size.x(), (kHeight - 2.0 * kMargin) / size.y());
    centre_ = 0.5 * (frame_.low + frame_.high);
  }

  [[nodiscard]] Point at(const Vec3& p) const {
    const Point from_centre = scale_ * (flat(p) - centre_);
    return {0.5 * kWidth + from_centre.x(), 0.5 * kHeight - from_centre.y()};
  }
  [[nodiscard]] double scale() const { return scale_; }
  [[nodiscard]] const Directions& directions() const { return d_; }

  void solid(const std::vector<SheetFace>& faces, const Mat3& machine_from_body) {
    struct Seen {
      double depth = 0.0;
      std::string svg{};
    };
    std::vector<Seen> seen;
    const Vec3 light = (0.35 * d_.right + 0.75 * d_.up + 0.55 * d_.toward).normalized();
    for (const SheetFace& face : faces) {
      SheetFace turned;
      Vec3 middle = Vec3::Zero();
      for (const Vec3& p : face) {
        turned.push_back(machine_from_body * p);
        middle += turned.back() / static_cast<double>(face.size());
      }
      const Vec3 normal = (turned[1] - turned[0]).cross(turned[2] - turned[1]).normalized();
      if (normal.dot(d_.toward) < 1e-6) continue;  // seen edge-on or from behind
      std::string points;
      for (const Vec3& p : turned) points += fmt::format("{:.1f},{:.1f} ", at(p).x(), at(p).y());
      const double shade = 0.84 + 0.14 * normal.dot(light);
      seen.push_back(
          {middle.dot(d_.toward), fmt::format("<polygon class=\"face\" points=\"{}\" "
                                              "fill=\"rgb({:.0f},{:.0f},{:.0f})\"/>",
                                              points, 236 * shade, 241 * shade, 247 * shade)});
    }
    std::stable_sort(seen.begin(), seen.end(),
                     [](const Seen& a, const Seen& b) { return a.depth < b.depth; });
    for (const Seen& face : seen) svg_ += face.svg;
  }

  void tool(const Vec3& tip, double radius, double length, const char* kind) {
    if (std::abs(d_.toward.z()) > 0.5) {
      const Point c = at(tip);
      svg_ += fmt::format("<circle class=\"tool {}\" cx=\"{:.1f}\" cy=\"{:.1f}\" r=\"{:.1f}\"/>",
                          kind, c.x(), c.y(), radius * scale_);
      return;
    }
    const Point bottom = at(tip);
    svg_ += fmt::format(
        "<rect class=\"tool {}\" x=\"{:.1f}\" y=\"{:.1f}\" width=\"{:.1f}\" height=\"{:.1f}\"/>",
        kind, bottom.x() - radius * scale_, bottom.y() - length * scale_, 2.0 * radius * scale_,
        length * scale_);
    const double top = bottom.y() - length * scale_;
    line({bottom.x(), bottom.y() + 4.0}, {bottom.x(), top - 4.0}, "axis");
  }

  void line(const Point& a, const Point& b, const char* kind) {
    svg_ +=
        fmt::format("<line class=\"{}\" x1=\"{:.1f}\" y1=\"{:.1f}\" x2=\"{:.1f}\" y2=\"{:.1f}\"/>",
                    kind, a.x(), a.y(), b.x(), b.y());
  }
  void dot(const Point& p, const char* kind) {
    svg_ += fmt::format("<circle class=\"{}\" cx=\"{:.1f}\" cy=\"{:.1f}\" r=\"2.6\"/>", kind, p.x(),
                        p.y());
  }
  // `from` a point of the line's side, an open arrowhead at `to`.
  void arrow(const Point& from, const Point& to, const char* kind) {
    if ((to - from).norm() < 8.0) return;
    const Point u = (to - from).normalized();
    const Point n(-u.y(), u.x());
    line(from, to - 5.0 * u, kind);
    const Point left = to - 8.0 * u + 3.4 * n, right = to - 8.0 * u - 3.4 * n;
    svg_ += fmt::format(
        "<polygon class=\"{}-head\" points=\"{:.1f},{:.1f} {:.1f},{:.1f} {:.1f},{:.1f}\"/>", kind,
        to.x(), to.y(), left.x(), left.y(), right.x(), right.y());
  }
  void text(const Point& p, const std::string& what, const char* kind,
            const char* anchor = "middle") {
    svg_ += fmt::format("<text class=\"{}\" x=\"{:.1f}\" y=\"{:.1f}\" text-anchor=\"{}\">{}</text>",
                        kind, p.x(), p.y(), anchor, html_text(what));
  }

  // Into the page or out of it, where the feed runs along the view.
  void feed_along_view(const Point& p, bool away) {
    svg_ +=
        fmt::format("<circle class=\"feed\" cx=\"{:.1f}\" cy=\"{:.1f}\" r=\"5\"/>", p.x(), p.y());
    if (!away) {
      dot(p, "feed-head");
      return;
    }
    line(p + Point(-3.5, -3.5), p + Point(3.5, 3.5), "feed");
    line(p + Point(-3.5, 3.5), p + Point(3.5, -3.5), "feed");
  }

  // Between two points of the workpiece, outside it on the side of `away`.
  void dimension(const Point& a, const Point& b, const Point& away, double reach,
                 const std::string& what) {
    if ((b - a).norm() < 20.0) return;
    const Point u = (b - a).normalized();
    Point n(-u.y(), u.x());
    if (n.dot(away) < 0.0) n = -n;
    const Point a2 = a + (reach - n.dot(a)) * n, b2 = b + (reach - n.dot(b)) * n;
    line(a, a2 + 3.0 * n, "extension");
    line(b, b2 + 3.0 * n, "extension");
    const Point middle = 0.5 * (a2 + b2);
    arrow(middle, a2, "dimension");
    arrow(middle, b2, "dimension");
    // Beside an upright line the text begins or ends at it; over a level one it is in the
    // middle.
    const bool upright = std::abs(n.x()) > 0.7;
    const char* anchor = !upright ? "middle" : n.x() > 0.0 ? "start" : "end";
    text(middle + (upright ? 5.0 : 9.0) * n + Point(0.0, 3.5), what, "size", anchor);
  }

  void triad() {
    const Point o(16.0, kHeight - 14.0);
    arrow(o, o + Point(26.0, 0.0), "triad");
    arrow(o, o - Point(0.0, 26.0), "triad");
    text(o + Point(34.0, 3.5), d_.right_name, "note");
    text(o - Point(0.0, 31.0), d_.up_name, "note");
  }

  [[nodiscard]] std::string svg(const std::string& label) const {
    return fmt::format(
        "<svg viewBox=\"0 0 {:.0f} {:.0f}\" role=\"img\" aria-label=\"{}\">{}</svg>\n", kWidth,
        kHeight, html_text(label), svg_);
  }

 private:
  [[nodiscard]] Point flat(const Vec3& p) const { return {p.dot(d_.right), p.dot(d_.up)}; }

  Directions d_;
  Frame frame_;
  double scale_ = 1.0;
  Point centre_ = Point::Zero();
  std::string svg_;
};

}  // namespace

SheetView engagement_view(const SetupSheet& sheet, const SheetStep& step) {
  const Vec3 feed = (step.to - step.from).normalized();
  constexpr double kClimbs = 0.1;  // of the feed along Z
  if (std::abs(feed.z()) > kClimbs) {
    return sheet.tilts_about_x ? SheetView::along_x : SheetView::along_y;
  }
  return std::abs(feed.x()) > std::abs(feed.y()) ? SheetView::along_x : SheetView::along_y;
}

std::string step_drawing(const SetupSheet& sheet, const SheetStep& step, SheetView view) {
  Drawing drawing(view);
  const Mat3& turn = step.machine_from_workpiece;
  for (const SheetFace& face : sheet.workpiece) {
    for (const Vec3& p : face) drawing.include(turn * p);
  }
  const bool from_top = view == SheetView::from_top;
  for (const Vec3& tip : {step.from, step.to}) {
    drawing.include_box(tip, sheet.tool_radius, from_top ? 0.0 : sheet.tool_length);
  }
  // A height is one only where the workpiece is upright, and is marked where the line is seen
  // as a point: beyond the line opposite, over the ledge there, away from the tool.
  constexpr double kTrue = 0.01;
  const Vec3 along_line = turn * (step.line_to - step.line_from);
  const bool marks_height =
      !from_top && turn(2, 2) > 1.0 - kTrue &&
      std::abs(along_line.normalized().dot(drawing.directions().toward)) > 0.9;
  const Vec3 outward =
      (turn * (step.opposite - 0.5 * (step.line_from + step.line_to))).normalized();
  if (marks_height) {
    constexpr double kLabel = 30.0;  // mm: room for its text at the scale of most drawings
    drawing.include(turn * step.opposite + kLabel * outward);
  }
  drawing.fit();
  drawing.solid(sheet.workpiece, turn);

  const Vec3 middle = 0.5 * (step.line_from + step.line_to);
  drawing.line(drawing.at(turn * step.line_from), drawing.at(turn * step.line_to), "cut");
  const Point s = drawing.at(turn * middle);
  const Point from = drawing.at(step.from), to = drawing.at(step.to);
  drawing.tool(step.to, sheet.tool_radius, sheet.tool_length, "end");
  drawing.tool(step.from, sheet.tool_radius, sheet.tool_length, "start");
  if ((to - from).norm() > 8.0) {
    drawing.arrow(from, to, "feed");
  } else {
    const double toward = (step.to - step.from).dot(drawing.directions().toward);
    drawing.feed_along_view(from - Point(0.0, 14.0), toward < 0.0);
  }
  // L beyond the workpiece, on the side away from the middle of the body.
  const Point other = drawing.at(turn * step.opposite);
  Point centroid = Point::Zero();
  double count = 0.0;
  for (const SheetFace& face : sheet.workpiece) {
    for (const Vec3& p : face) {
      centroid += drawing.at(turn * p);
      count += 1.0;
    }
  }
  centroid /= std::max(1.0, count);
  const Point between = 0.5 * (s + other);
  const Point u = other - s;
  Point away(-u.y(), u.x());
  // Dimensioned where it is seen in its true length.
  const bool in_true_length =
      std::abs(u.norm() / drawing.scale() - step.width) < kTrue * step.width;
  if (in_true_length) {
    away.normalize();
    if (away.dot(from_top ? Point(0.0, 1.0) : between - centroid) < 0.0) away = -away;
    double reach = -std::numeric_limits<double>::infinity();
    for (const SheetFace& face : sheet.workpiece) {
      for (const Vec3& p : face) reach = std::max(reach, away.dot(drawing.at(turn * p)));
    }
    drawing.dimension(s, other, away, reach + 10.0, fmt::format("L {:g}", step.width));
  }
  if (marks_height) {
    drawing.dot(s, "cut-end");
    const bool right = other.x() > s.x();
    const Point mark = other + Point(right ? 52.0 : -52.0, 0.0);
    drawing.line(other, mark, "extension");
    drawing.text(mark + Point(right ? -1.0 : 1.0, -4.0), fmt::format("H {:g}", step.height), "size",
                 right ? "end" : "start");
  }
  drawing.triad();
  return drawing.svg(fmt::format("step {}", step.name));
}

std::string placement_drawing(const SetupSheet& sheet, SheetView view) {
  Drawing drawing(view);
  const Mat3& turn = sheet.table_from_workpiece;
  double reach = 40.0;  // mm
  for (const SheetFace& face : sheet.workpiece) {
    for (const Vec3& p : face) {
      drawing.include(turn * p);
      reach = std::max(reach, 0.45 * p.norm());
    }
  }
  const Vec3 tilt = sheet.tilts_about_x ? Vec3::UnitX() : Vec3::UnitY();
  const Vec3& toward = drawing.directions().toward;
  for (const Vec3& axis : {tilt, Vec3(Vec3::UnitZ())}) {
    drawing.include(reach * axis);
    drawing.include(-0.4 * reach * axis);
  }
  drawing.fit();
  drawing.solid(sheet.workpiece, turn);
  const auto axis = [&](const Vec3& direction, const std::string& name) {
    if (std::abs(direction.dot(toward)) > 0.5) {
      drawing.text(drawing.at(Vec3::Zero()) + Point(-9.0, 13.0), name, "axis-name");
      return;
    }
    drawing.line(drawing.at(-0.4 * reach * direction), drawing.at(reach * direction), "axis");
    drawing.text(drawing.at(reach * direction) + Point(11.0, 4.0), name, "axis-name");
  };
  axis(tilt, sheet.tilt_axis);
  axis(Vec3::UnitZ(), sheet.turn_axis);
  const Point o = drawing.at(Vec3::Zero());
  drawing.dot(o, "crossing");
  drawing.text(o + Point(8.0, 15.0), "G54", "size", "start");
  drawing.triad();
  return drawing.svg("placement on the table");
}

}  // namespace frustum::report

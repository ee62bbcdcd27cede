#include "tests/stock/machine_drawing.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <vector>

#include "stock/collision/pair_watch.hpp"

namespace frustum::stock {
namespace {

using Point = Eigen::Vector2d;
using kinematics::Machine;
using kinematics::MachineBody;

constexpr double kWidth = 760.0, kHeight = 470.0;
constexpr double kPicture = 520.0;  // of the width; the rest is for names

struct View {
  Vec3 towards = Vec3::UnitZ(), right = Vec3::UnitX(), up = Vec3::UnitY();

  explicit View(double azimuth) {
    constexpr double kAbove = 0.5;  // rad
    towards = {std::cos(kAbove) * std::cos(azimuth), std::cos(kAbove) * std::sin(azimuth),
               std::sin(kAbove)};
    right = Vec3::UnitZ().cross(towards).normalized();
    up = towards.cross(right);
  }
  [[nodiscard]] Point flat(const Vec3& p) const { return {p.dot(right), -p.dot(up)}; }
};

struct Face {
  std::vector<Vec3> corners{};
  bool has_edge = true;
};

std::vector<Face> faces_of(const kinematics::BoxBody& box) {
  const Vec3 h = 0.5 * box.size;
  std::vector<Face> faces;
  for (int axis = 0; axis < 3; ++axis) {
    for (const double side : {-1.0, 1.0}) {
      const int u = (axis + 1) % 3, v = (axis + 2) % 3;
      Face face;
      for (const auto& [s, t] : {std::pair{-1.0, -1.0}, {1.0, -1.0}, {1.0, 1.0}, {-1.0, 1.0}}) {
        Vec3 p = Vec3::Zero();
        p[axis] = side * h[axis];
        p[u] = side * s * h[u];
        p[v] = t * h[v];
        face.corners.push_back(p + h.z() * Vec3::UnitZ());
      }
      faces.push_back(std::move(face));
    }
  }
  return faces;
}

std::vector<Face> faces_of(const kinematics::CylinderBody& cylinder) {
  constexpr int kSides = 48;
  const double r = 0.5 * cylinder.diameter;
  const auto p = [&](int k, double z) {
    const double t = 2.0 * std::numbers::pi * k / kSides;
    return Vec3(r * std::cos(t), r * std::sin(t), z);
  };
  std::vector<Face> faces;
  Face bottom, top;
  for (int k = 0; k < kSides; ++k) {
    faces.push_back(
        {{p(k, 0), p(k + 1, 0), p(k + 1, cylinder.height), p(k, cylinder.height)}, false});
    bottom.corners.push_back(p(-k, 0));
    top.corners.push_back(p(k, cylinder.height));
  }
  faces.push_back(bottom);
  faces.push_back(top);
  return faces;
}

std::vector<Face> faces_of(const MachineBody& body, const Pose& bed_from_body) {
  std::vector<Face> faces;
  if (const auto* box = std::get_if<kinematics::BoxBody>(&body.shape)) faces = faces_of(*box);
  if (const auto* c = std::get_if<kinematics::CylinderBody>(&body.shape)) faces = faces_of(*c);
  for (Face& face : faces) {
    for (Vec3& corner : face.corners) corner = bed_from_body.point(corner);
  }
  return faces;
}

Vec3 normal_of(const Face& face) {
  return (face.corners[1] - face.corners[0]).cross(face.corners[2] - face.corners[1]).normalized();
}

struct Drawn {
  const MachineBody* body = nullptr;
  std::vector<Face> faces{};
  Point label = Point::Zero();
};

std::string colour_of(const MachineBody& body, double light) {
  Vec3 colour(168, 170, 174);  // of the bed
  if (body.part.side > 0) colour = {96, 140, 196};
  if (body.part.side < 0) colour = {222, 150, 78};
  colour = (0.62 + 0.38 * light) * colour + 18.0 * light * Vec3::Ones();
  const auto byte = [](double c) { return static_cast<int>(std::clamp(c, 0.0, 255.0)); };
  return fmt::format("#{:02x}{:02x}{:02x}", byte(colour.x()), byte(colour.y()), byte(colour.z()));
}

// Which is to be drawn before which: the one behind a plane between them, seen by the viewer.
bool is_behind(const SceneBody& a, const SceneBody& b, const Machine& machine, const View& view) {
  const Pose a_from_b = bed_from_part(machine, a.part, machine.home()).inverse() *
                        bed_from_part(machine, b.part, machine.home());
  const Pose from_a = a.part_from_body.inverse() * a_from_b * b.part_from_body;
  const Separation apart = separation(*a.solid, *b.solid, from_a);
  if (apart.upper == 0.0) {  // as their middles are
    const auto middle = [](const SceneBody& body) -> Vec3 {
      return 0.5 * (body.solid->bounds().min + body.solid->bounds().max);
    };
    const Vec3 between = from_a.point(middle(b)) - middle(a);
    return bed_from_part(machine, a.part, machine.home())
               .direction(a.part_from_body.direction(between))
               .dot(view.towards) > 0.0;
  }
  const Vec3 normal = bed_from_part(machine, a.part, machine.home())
                          .direction(a.part_from_body.direction(apart.normal));
  constexpr double kAskew = 1e-6;
  return normal.dot(view.towards) > kAskew;
}

std::vector<std::size_t> back_to_front(const std::vector<SceneBody>& bodies, const Machine& machine,
                                       const View& view) {
  std::vector<std::size_t> order, left;
  for (std::size_t k = 0; k < bodies.size(); ++k) left.push_back(k);
  while (!left.empty()) {
    auto next = std::ranges::find_if(left, [&](std::size_t i) {
      return std::ranges::none_of(left, [&](std::size_t j) {
        return j != i && is_behind(bodies[j], bodies[i], machine, view);
      });
    });
    if (next == left.end()) next = left.begin();
    order.push_back(*next);
    left.erase(next);
  }
  return order;
}

struct Frame {
  double scale = 1.0;
  Point shift = Point::Zero();
  [[nodiscard]] Point at(const Point& p) const { return scale * p + shift; }
};

Frame frame_of(const std::vector<Drawn>& all, const View& view) {
  Point lo = Point::Constant(std::numeric_limits<double>::infinity()), hi = -lo;
  for (const Drawn& drawn : all) {
    for (const Face& face : drawn.faces) {
      for (const Vec3& corner : face.corners) {
        lo = lo.cwiseMin(view.flat(corner));
        hi = hi.cwiseMax(view.flat(corner));
      }
    }
  }
  constexpr double kMargin = 12.0;
  Frame frame;
  frame.scale = std::min((kPicture - 2 * kMargin) / (hi.x() - lo.x()),
                         (kHeight - 2 * kMargin) / (hi.y() - lo.y()));
  frame.shift = 0.5 * Point(kPicture, kHeight) - 0.5 * frame.scale * (lo + hi);
  return frame;
}

std::string polygon(const Face& face, const std::string& fill, const View& view,
                    const Frame& frame) {
  std::string points;
  for (const Vec3& corner : face.corners) {
    const Point p = frame.at(view.flat(corner));
    points += fmt::format("{}{:.1f},{:.1f}", points.empty() ? "" : " ", p.x(), p.y());
  }
  return fmt::format("<polygon points=\"{}\" fill=\"{}\" stroke=\"{}\"/>\n", points, fill,
                     face.has_edge ? "#333" : fill);
}

std::string part_name(const Machine& machine, const kinematics::MachinePart& part) {
  if (part.side == 0) return "bed";
  const auto& chain = part.side < 0 ? machine.work_chain() : machine.tool_chain();
  return std::string("on ") + kinematics::to_char(chain[part.joints - 1].letter);
}

// The middle of what is seen of a body: of its faces towards the viewer.
Point middle_of(const Drawn& drawn, const View& view) {
  Vec3 sum = Vec3::Zero();
  double count = 0.0;
  for (const Face& face : drawn.faces) {
    if (!face.has_edge || normal_of(face).dot(view.towards) <= 0.0) continue;
    for (const Vec3& corner : face.corners) sum += corner;
    count += static_cast<double>(face.corners.size());
  }
  return view.flat(sum / count);
}

}  // namespace

std::string machine_drawing(const Machine& machine, double azimuth) {
  const View view(azimuth);
  const auto bodies = *bodies_of(machine);
  std::vector<Drawn> all;
  for (const std::size_t k : back_to_front(bodies, machine, view)) {
    const MachineBody& body = machine.bodies()[k];
    Drawn drawn{&body, faces_of(body, bed_from_part(machine, body.part, machine.home()) *
                                          body.part_from_body)};
    drawn.label = middle_of(drawn, view);
    all.push_back(std::move(drawn));
  }
  const Frame frame = frame_of(all, view);
  std::string svg = fmt::format(
      "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{0}\" height=\"{1}\" viewBox=\"0 0 {0} "
      "{1}\" role=\"img\" aria-label=\"Bodies of {2}\">\n<style>text{{font:13px "
      "sans-serif;fill:#222}}polygon{{stroke-width:1;stroke-linejoin:round}}</style>\n<rect "
      "width=\"100%\" height=\"100%\" fill=\"#fff\"/>\n",
      kWidth, kHeight, machine.name());
  const Vec3 light = (view.towards + 0.6 * view.right + 0.9 * Vec3::UnitZ()).normalized();
  for (const Drawn& drawn : all) {
    for (const Face& face : drawn.faces) {
      const Vec3 normal = normal_of(face);
      if (normal.dot(view.towards) <= 0.0) continue;
      svg += polygon(face, colour_of(*drawn.body, std::max(0.0, normal.dot(light))), view, frame);
    }
  }
  std::ranges::stable_sort(all, {}, [](const Drawn& drawn) { return drawn.label.y(); });
  const double step = std::min(26.0, (kHeight - 40.0) / static_cast<double>(all.size()));
  double y = 0.5 * (kHeight - step * static_cast<double>(all.size() - 1));
  for (const Drawn& drawn : all) {
    const Point p = frame.at(drawn.label);
    svg += fmt::format(
        "<path d=\"M{:.1f} {:.1f}L{:.1f} {:.1f}\" stroke=\"#444\" stroke-width=\"0.7\"/><circle "
        "cx=\"{:.1f}\" cy=\"{:.1f}\" r=\"2.5\"/><text x=\"{:.1f}\" y=\"{:.1f}\">{}, {}</text>\n",
        p.x(), p.y(), kPicture + 24.0, y, p.x(), p.y(), kPicture + 30.0, y + 4.5, drawn.body->name,
        part_name(machine, drawn.body->part));
    y += step;
  }
  return svg + "</svg>\n";
}

}  // namespace frustum::stock

// Machines nobody builds, as the text of a machine file: any order of the axes, any side, skew
// directions, nutating rotary axes, offsets everywhere.
#pragma once

#include <fmt/format.h>

#include <algorithm>
#include <cstdint>
#include <cstdlib>
#include <numbers>
#include <string>
#include <vector>

#include "core/random.hpp"
#include "kinematics/model/machine.hpp"

namespace frustum::kinematics {

class RandomMachine {
 public:
  explicit RandomMachine(std::uint32_t number) : number_(number) {}

  [[nodiscard]] std::string text() {
    const std::vector<std::string> axes = shuffled_axes();
    const std::size_t bed = pick(axes.size() + 1);
    std::string structure = "t-(C)";
    for (std::size_t i = 0; i < axes.size(); ++i) {
      structure += (i == bed ? "-b-" : "-") + axes[i];
    }
    structure += bed == axes.size() ? "-b-w" : "-w";
    std::string file = fmt::format(
        "name = \"random-{}\"\nstructure = \"{}\"\nrotation_order = \"{}\"\nrotary_error_frame = "
        "\"{}\"\n",
        number_, structure, chance() ? "zyx" : "xyz", chance() ? "stator" : "rotor");
    file += fmt::format("[spindle]\noffset = {}\n[table]\noffset = {}\n", offset(), offset());
    for (const std::string& axis : axes) file += axis_text(axis);
    return file;
  }

  [[nodiscard]] AxisPositions position() {
    AxisPositions q;
    for (const AxisLetter letter : kAxisLetters) {
      q[letter] = signed_draw(is_rotary(letter) ? 1.8 : 250.0);
    }
    return q;
  }

  // Uniform in [-size, size].
  double signed_draw(double size) { return size * (2.0 * draw() - 1.0); }

 private:
  double draw() { return uniform({.seed = 4711, .draw = number_}, index_++); }
  std::size_t pick(std::size_t n) {
    return static_cast<std::size_t>(static_cast<double>(n) * draw());
  }
  bool chance() { return draw() < 0.5; }

  std::vector<std::string> shuffled_axes() {
    static const std::vector<std::vector<std::string>> kRotary = {
        {"A", "B"}, {"A", "C"}, {"B", "C"}, {"B", "A"}, {"C", "A"}, {"C", "B"}, {"C"}};
    std::vector<std::string> axes = {"X", "Y", "Z"};
    const auto& rotary = kRotary[pick(kRotary.size())];
    axes.insert(axes.end(), rotary.begin(), rotary.end());
    for (std::size_t i = axes.size(); i > 1; --i) {
      std::swap(axes[i - 1], axes[pick(i)]);
    }
    return axes;
  }

  std::string vector(const Vec3& v) const {
    return fmt::format("[{:.17g}, {:.17g}, {:.17g}]", v.x(), v.y(), v.z());
  }
  std::string offset() {
    return vector({signed_draw(400.0), signed_draw(400.0), signed_draw(400.0)});
  }

  // Square, nutating at 45 deg, or skew within 0.3 of square, to either side.
  Vec3 direction(const std::string& axis) {
    const int along = (axis[0] - (axis[0] >= 'X' ? 'X' : 'A')) % 3;
    Vec3 e = Vec3::Unit(along);
    const double kind = draw();
    const bool rotary = axis[0] < 'X';
    if (rotary && kind < 0.3) {
      e = (Vec3::Unit(along) + Vec3::Unit((along + 1) % 3)).normalized();
    } else if (kind < 0.6) {
      e = (e + Vec3(signed_draw(0.3), signed_draw(0.3), signed_draw(0.3))).normalized();
    }
    return chance() ? e : Vec3(-e);
  }

  std::string axis_text(const std::string& axis) {
    std::string text =
        fmt::format("[axis.{}]\n{}\ndirection = {}\noffset = {}\n", axis,
                    axis[0] < 'X' && chance() ? "endless = true" : "travel = [-300, 300]",
                    vector(direction(axis)), offset());
    const double kind = draw();
    if (kind < 0.3) text += "functional_point = \"tip\"\n";
    if (kind > 0.6) text += "functional_point = " + offset() + "\n";
    return text;
  }

  std::uint32_t number_;
  std::uint64_t index_ = 0;
};

inline Machine machine_of(const std::string& text) {
  auto machine = Machine::read(text, "random-machine.toml");
  if (!machine) {
    fmt::print("{}\n{}\n", to_string(machine.error().front()), text);
    std::abort();
  }
  return *std::move(machine);
}

}  // namespace frustum::kinematics

#include "report/exchange/dxf_drawing.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "core/made_by.hpp"
#include "report/number_text.hpp"

namespace frustum::report {
namespace {

// One group: its code, its value.
std::string group(int code, std::string_view value) {
  return fmt::format("{:>3}\n{}\n", code, value);
}

std::string number_group(int code, double value) { return group(code, exact_decimal(value)); }

}  // namespace

std::string DxfDrawing::layer_name(std::string_view name) {
  std::string plain(name.substr(0, 31));
  std::ranges::replace_if(
      plain,
      [](char c) {
        const bool letter = (c >= 'A' && c <= 'Z') || (c >= 'a' && c <= 'z');
        return !letter && !(c >= '0' && c <= '9') && c != '$' && c != '-' && c != '_';
      },
      '_');
  return plain.empty() ? "0" : plain;
}

void DxfDrawing::begin(std::string_view entity, std::string_view layer, int colour) {
  const std::string name = layer_name(layer);
  const auto is_it = [&](const auto& known) { return known.first == name; };
  if (std::ranges::none_of(layers_, is_it)) layers_.emplace_back(name, colour);
  entities_ += group(0, entity) + group(8, name) + group(62, std::to_string(colour));
}

void DxfDrawing::place(int code, const Vec3& at) {
  entities_ += number_group(code, at.x()) + number_group(code + 10, at.y()) +
               number_group(code + 20, at.z());
}

void DxfDrawing::line(std::string_view layer, int colour, const Vec3& from, const Vec3& to) {
  if (!from.allFinite() || !to.allFinite()) return;
  begin("LINE", layer, colour);
  place(10, from);
  place(11, to);
}

void DxfDrawing::arc(std::string_view layer, int colour, const Vec3& centre, double radius,
                     Rad from, Rad to) {
  if (!centre.allFinite() || !std::isfinite(radius)) return;
  begin("ARC", layer, colour);
  place(10, centre);
  entities_ += number_group(40, radius) + number_group(50, from.value * kDegPerRad) +
               number_group(51, to.value * kDegPerRad);
}

void DxfDrawing::point(std::string_view layer, int colour, const Vec3& at) {
  if (!at.allFinite()) return;
  begin("POINT", layer, colour);
  place(10, at);
}

void DxfDrawing::polyline(std::string_view layer, int colour, std::span<const Vec3> points,
                          bool closed) {
  std::vector<Vec3> finite;
  for (const Vec3& p : points) {
    if (p.allFinite()) finite.push_back(p);
  }
  if (finite.size() < 2) return;
  constexpr int kClosed = 1, kInSpace = 8, kVertexInSpace = 32;
  begin("POLYLINE", layer, colour);
  entities_ += group(66, "1");
  place(10, Vec3::Zero());
  entities_ += group(70, std::to_string(kInSpace + (closed ? kClosed : 0)));
  for (const Vec3& p : finite) {
    begin("VERTEX", layer, colour);
    place(10, p);
    entities_ += group(70, std::to_string(kVertexInSpace));
  }
  begin("SEQEND", layer, colour);
}

void DxfDrawing::text(std::string_view layer, int colour, const Vec3& at, double height,
                      std::string_view content) {
  begin("TEXT", layer, colour);
  place(10, at);
  std::string plain(content);
  std::ranges::replace_if(
      plain, [](char c) { return static_cast<unsigned char>(c) < 0x20U; }, ' ');
  entities_ += number_group(40, height) + group(1, plain);
}

std::string DxfDrawing::file() const {
  std::string text = group(999, made_by()) + group(0, "SECTION") + group(2, "HEADER") +
                     group(9, "$ACADVER") + group(1, "AC1009") + group(0, "ENDSEC") +
                     group(0, "SECTION") + group(2, "TABLES") + group(0, "TABLE") +
                     group(2, "LAYER") + group(70, std::to_string(layers_.size()));
  for (const auto& [name, colour] : layers_) {
    text += group(0, "LAYER") + group(2, name) + group(70, "0") +
            group(62, std::to_string(colour)) + group(6, "CONTINUOUS");
  }
  return text + group(0, "ENDTAB") + group(0, "ENDSEC") + group(0, "SECTION") +
         group(2, "ENTITIES") + entities_ + group(0, "ENDSEC") + group(0, "EOF");
}

}  // namespace frustum::report

#include "app/motion/setup_found.hpp"

#include <fmt/format.h>

#include "core/decimal.hpp"
#include "core/linear_algebra.hpp"

namespace frustum::app {
namespace {

std::string in_um_text(const Vec3& v, const char* unit = "um") {
  return fmt::format("{}, {}, {} {}", fixed_decimal(v.x() * kUmPerMm, 2),
                     fixed_decimal(v.y() * kUmPerMm, 2), fixed_decimal(v.z() * kUmPerMm, 2), unit);
}

}  // namespace

void add_setup_found(MotionAnswer& answer, std::span<const BarReadings> runs) {
  // A row of M^T M and M^T y at a time: a few unknowns, thousands of readings.
  Eigen::MatrixXd normal = Eigen::MatrixXd::Zero(4, 4);
  Eigen::VectorXd right = Eigen::VectorXd::Zero(4);
  for (const BarReadings& run : runs) {
    for (std::size_t i = 0; i < run.readings.size(); ++i) {
      Eigen::Vector4d row;
      row << -(run.test.poses[i].spindle_ball - run.test.table_ball).normalized(), -1.0;
      normal += row * row.transpose();
      right += run.readings[i] * row;
    }
  }
  constexpr double kSeen = 1e-10;  // of the largest: a hundred thousandth of its effect
  const Eigen::VectorXd found = shortest_solution(normal, right, kSeen);
  const Vec3 ball = found.head<3>();
  answer.document["setup_found_um"] =
      Document{{"table_ball", coordinates(ball, kUmPerMm)}, {"length", found[3] * kUmPerMm}};
  const std::string length = fixed_decimal(found[3] * kUmPerMm, 2);
  answer.text += fmt::format("set-up found: table ball off by {}, bar longer by {} um\n",
                             in_um_text(ball), length);
  answer.page.facts.push_back({"Set-up found, table ball off", in_um_text(ball, "µm")});
  answer.page.facts.push_back({"Set-up found, bar longer by", length + " µm"});
}

void add_setup_found(MotionAnswer& answer, std::span<const Vec3> displacements) {
  Vec3 mean = Vec3::Zero();
  for (const Vec3& each : displacements) mean -= each / static_cast<double>(displacements.size());
  answer.document["setup_found_um"] = Document{{"table_ball", coordinates(mean, kUmPerMm)}};
  answer.text += fmt::format("set-up found: table ball off by {}\n", in_um_text(mean));
  answer.page.facts.push_back({"Set-up found, table ball off", in_um_text(mean, "µm")});
}

void add_setup_found(MotionAnswer& answer, double first, double second, double radius) {
  answer.document["setup_found_um"] =
      Document{{"center", std::vector<double>{first * kUmPerMm, second * kUmPerMm}},
               {"mean_radius", radius * kUmPerMm}};
  answer.page.facts.push_back({"Set-up found, centre of the circle",
                               fmt::format("{}, {} µm", fixed_decimal(first * kUmPerMm, 2),
                                           fixed_decimal(second * kUmPerMm, 2))});
}

}  // namespace frustum::app

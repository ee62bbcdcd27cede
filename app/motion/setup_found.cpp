#include "app/motion/setup_found.hpp"

#include <fmt/format.h>

#include "core/decimal.hpp"
#include "core/linear_algebra.hpp"

namespace frustum::app {
namespace {

// Of three numbers, without the unit.
std::string place_found(const Vec3& v, const report::Wording& words) {
  return shown_um(v.x(), words, 2) + between(words) + shown_um(v.y(), words, 2) + between(words) +
         shown_um(v.z(), words, 2);
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
  const report::Wording& words = answer.words;
  const std::string length = shown_um(found[3], words, 2), place = place_found(ball, words);
  const std::string um = " " + std::string(words.unit("um")), symbol = " " + words.symbol("um");
  answer.text +=
      words("set-up found: table ball off by {0}, bar longer by {1}", place + um, length + um) +
      "\n";
  answer.page.facts.push_back({words("Set-up found, table ball off"), place + symbol});
  answer.page.facts.push_back({words("Set-up found, bar longer by"), length + symbol});
}

void add_setup_found(MotionAnswer& answer, std::span<const Vec3> displacements) {
  Vec3 mean = Vec3::Zero();
  for (const Vec3& each : displacements) mean -= each / static_cast<double>(displacements.size());
  answer.document["setup_found_um"] = Document{{"table_ball", coordinates(mean, kUmPerMm)}};
  const report::Wording& words = answer.words;
  const std::string place = place_found(mean, words);
  answer.text +=
      words("set-up found: table ball off by {0}", place + " " + std::string(words.unit("um"))) +
      "\n";
  answer.page.facts.push_back(
      {words("Set-up found, table ball off"), place + " " + words.symbol("um")});
}

void add_setup_found(MotionAnswer& answer, double first, double second, double radius) {
  answer.document["setup_found_um"] =
      Document{{"center", std::vector<double>{first * kUmPerMm, second * kUmPerMm}},
               {"mean_radius", radius * kUmPerMm}};
  const report::Wording& words = answer.words;
  answer.page.facts.push_back({words("Set-up found, centre of the circle"),
                               shown_um(first, words, 2) + between(words) +
                                   shown_um(second, words, 2) + " " + words.symbol("um")});
}

}  // namespace frustum::app

#include "report/player/player_data.hpp"

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "report/page/packed_array.hpp"
#include "report/page/packed_mesh.hpp"

namespace frustum::report {
namespace {

using nlohmann::ordered_json;

constexpr double kPlaceStep = 1e-4;      // mm
constexpr double kDeviationStep = 1e-6;  // mm
constexpr double kAngleStep = 1e-7;      // rad
constexpr double kTimeStep = 1e-6;       // s
constexpr double kFeedStep = 1e-3;       // mm/min
constexpr double kMostSteps = 4e9;       // that an unsigned number of 32 bits counts

// Rows of `stride` numbers, each column from its smallest on.
ordered_json packed_reals(const std::vector<double>& values, std::size_t stride, double step) {
  std::vector<double> low(stride, 0.0), high(stride, 0.0);
  for (std::size_t k = 0; k < values.size(); ++k) {
    const std::size_t column = k % stride;
    if (k < stride) low[column] = high[column] = values[k];
    low[column] = std::min(low[column], values[k]);
    high[column] = std::max(high[column], values[k]);
  }
  for (std::size_t column = 0; column < stride; ++column) {
    step = std::max(step, (high[column] - low[column]) / kMostSteps);
  }
  std::vector<std::uint32_t> counts;
  counts.reserve(values.size());
  for (std::size_t k = 0; k < values.size(); ++k) {
    counts.push_back(
        static_cast<std::uint32_t>(std::llround((values[k] - low[k % stride]) / step)));
  }
  return {{"count", values.size()},
          {"stride", stride},
          {"step", step},
          {"origin", low},
          {"data", packed_array(counts, stride)}};
}

ordered_json packed_counts(const std::vector<std::uint32_t>& values) {
  return {{"count", values.size()}, {"data", packed_array(values, 1)}};
}

ordered_json vector_json(const Vec3& v) { return {v.x(), v.y(), v.z()}; }

// Columns of the rotation, then the translation: what a matrix of three.js holds.
ordered_json pose_json(const Pose& pose) {
  ordered_json numbers = ordered_json::array();
  for (Eigen::Index column = 0; column < 3; ++column) {
    for (Eigen::Index row = 0; row < 3; ++row) numbers.push_back(pose.rotation(row, column));
    numbers.push_back(0);
  }
  for (Eigen::Index row = 0; row < 3; ++row) numbers.push_back(pose.translation[row]);
  numbers.push_back(1);
  return numbers;
}

ordered_json mesh_json(const PlayerMesh& mesh) {
  return json_of<ordered_json>(packed_mesh(mesh.vertices, mesh.triangles, kPictureGrid));
}

ordered_json shape_json(const PlayerShape& shape) {
  if (const auto* box = std::get_if<PlayerBox>(&shape)) return {{"box", vector_json(box->size)}};
  if (const auto* turned = std::get_if<PlayerTurned>(&shape)) {
    return {{"meridian", turned->meridian}};
  }
  return {{"mesh", mesh_json(std::get<PlayerMesh>(shape))}};
}

ordered_json machine_json(const PlayerPage& page) {
  ordered_json joints = ordered_json::array(), bodies = ordered_json::array();
  for (const PlayerJoint& joint : page.joints) {
    joints.push_back({{"letter", std::string(1, joint.letter)},
                      {"rotary", joint.rotary},
                      {"side", joint.side},
                      {"direction", vector_json(joint.direction)},
                      {"offset", vector_json(joint.offset)}});
  }
  for (const PlayerBody& body : page.bodies) {
    const bool drawn = !std::holds_alternative<PlayerMesh>(body.shape) ||
                       !std::get<PlayerMesh>(body.shape).triangles.empty();
    if (!drawn) continue;
    bodies.push_back({{"name", body.name},
                      {"fixture", body.is_fixture},
                      {"side", body.side},
                      {"joints", body.joints},
                      {"pose", pose_json(body.part_from_body)},
                      {"shape", shape_json(body.shape)}});
  }
  return {{"joints", joints},
          {"spindle", vector_json(page.spindle_offset)},
          {"table", vector_json(page.table_offset)},
          {"workpiece", pose_json(page.table_from_workpiece)},
          {"bodies", bodies}};
}

ordered_json tools_json(const PlayerPage& page) {
  ordered_json tools = ordered_json::array();
  for (const PlayerTool& tool : page.tools) {
    ordered_json bodies = ordered_json::array();
    for (const auto& [name, turned] : tool.bodies) {
      bodies.push_back({{"name", name}, {"meridian", turned.meridian}});
    }
    tools.push_back({{"number", tool.number},
                     {"title", tool.title},
                     {"length", tool.length},
                     {"bodies", bodies}});
  }
  return tools;
}

ordered_json blocks_json(const PlayerPage& page) {
  std::vector<std::uint32_t> lines, texts, tools, rapids;
  std::vector<double> feeds;
  for (const PlayerBlock& block : page.blocks) {
    lines.push_back(block.line);
    texts.push_back(block.text);
    tools.push_back(static_cast<std::uint32_t>(block.tool));
    rapids.push_back(block.is_rapid ? 1 : 0);
    feeds.push_back(block.feed);
  }
  return {{"lines", packed_counts(lines)},
          {"texts", packed_counts(texts)},
          {"tools", packed_counts(tools)},
          {"rapid", packed_counts(rapids)},
          {"feeds", packed_reals(feeds, 1, kFeedStep)}};
}

ordered_json points_json(const PlayerPage& page) {
  std::vector<double> times, tips, deviations, feeds, linear, rotary;
  std::vector<std::uint32_t> blocks, starts;
  std::size_t rotary_count = 0;
  for (const PlayerJoint& joint : page.joints) rotary_count += joint.rotary ? 1 : 0;
  for (const PlayerPoint& point : page.points) {
    times.push_back(point.time);
    for (Eigen::Index k = 0; k < 3; ++k) {
      tips.push_back(point.tip[k]);
      deviations.push_back(point.deviation[k]);
    }
    for (std::size_t k = 0; k < page.joints.size(); ++k) {
      (page.joints[k].rotary ? rotary : linear).push_back(point.axes[k]);
    }
    feeds.push_back(point.feed);
    blocks.push_back(point.block);
    if (point.starts) starts.push_back(static_cast<std::uint32_t>(&point - page.points.data()));
  }
  const std::size_t linear_count = page.joints.size() - rotary_count;
  ordered_json json{{"count", page.points.size()},
                    {"times", packed_reals(times, 1, kTimeStep)},
                    {"tips", packed_reals(tips, 3, kPlaceStep)},
                    {"deviations", packed_reals(deviations, 3, kDeviationStep)},
                    {"feeds", packed_reals(feeds, 1, kFeedStep)},
                    {"blocks", packed_counts(blocks)},
                    {"starts", packed_counts(starts)}};
  json["linear"] =
      linear_count > 0 ? packed_reals(linear, linear_count, kPlaceStep) : ordered_json(nullptr);
  json["rotary"] =
      rotary_count > 0 ? packed_reals(rotary, rotary_count, kAngleStep) : ordered_json(nullptr);
  return json;
}

}  // namespace

std::string player_data(const PlayerPage& page) {
  ordered_json steps = ordered_json::array(), texts = ordered_json::array();
  for (const PlayerStep& step : page.steps) {
    ordered_json mesh(nullptr);
    if (!step.mesh.triangles.empty()) mesh = mesh_json(step.mesh);
    steps.push_back({{"time", step.time}, {"mesh", std::move(mesh)}});
  }
  for (const PlayerText& text : page.texts) {
    texts.push_back({{"name", text.name}, {"text", packed_text(text.text)}});
  }
  const ordered_json data{{"player",
                           {{"machine", machine_json(page)},
                            {"tools", tools_json(page)},
                            {"blocks", blocks_json(page)},
                            {"points", points_json(page)},
                            {"steps", std::move(steps)},
                            {"texts", std::move(texts)}}}};
  return data.dump(-1, ' ', false, ordered_json::error_handler_t::replace);
}

}  // namespace frustum::report

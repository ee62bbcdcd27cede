#include "programs/test_piece_files.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "core/file_set.hpp"
#include "core/made_by.hpp"
#include "cutter/body/cutter_file.hpp"
#include "stock/mesh/io/mesh_file.hpp"

namespace frustum::programs {
namespace {

namespace fs = std::filesystem;

std::string vector_text(const Vec3& v, double scale = 1.0) {
  return fmt::format("[{}, {}, {}]", v.x() * scale, v.y() * scale, v.z() * scale);
}

std::string blank_text(const stock::BlankShape& shape, const Vec3& origin) {
  if (const auto* box = std::get_if<stock::BoxShape>(&shape)) {
    return fmt::format("{{ shape = \"box\", size = [{}, {}, {}], origin = {} }}", box->size_x,
                       box->size_y, box->height, vector_text(origin));
  }
  if (const auto* loft = std::get_if<stock::LoftShape>(&shape)) {
    std::string rows;
    for (const stock::LoftSection& s : loft->sections) {
      rows += fmt::format("\n    [{}, {}, {}],", s.z, s.size_x, s.size_y);
    }
    return fmt::format(
        "{{ shape = \"loft\", origin = {}, sections = [  # z, size in X, size in Y{}\n]}}",
        vector_text(origin), rows);
  }
  if (const auto* mesh = std::get_if<stock::MeshShape>(&shape)) {
    return fmt::format("{{ shape = \"mesh\", file = \"{}\", origin = {} }}", mesh->file,
                       vector_text(origin));
  }
  const auto& frustum = std::get<stock::FrustumShape>(shape);
  if (frustum.bottom_radius == frustum.top_radius) {
    return fmt::format("{{ shape = \"cylinder\", diameter = {}, height = {}, origin = {} }}",
                       2.0 * frustum.bottom_radius, frustum.height, vector_text(origin));
  }
  return fmt::format(
      "{{ shape = \"frustum\", bottom_diameter = {}, top_diameter = {}, height = {}, origin = {} "
      "}}",
      2.0 * frustum.bottom_radius, 2.0 * frustum.top_radius, frustum.height, vector_text(origin));
}

std::string mesh_text(const stock::FacetSolid& solid, Maker maker) {
  stock::SurfaceMesh mesh;
  mesh.vertices.assign(solid.vertices().begin(), solid.vertices().end());
  mesh.triangles.assign(solid.facets().begin(), solid.facets().end());
  std::string bytes = stock::mesh_bytes(mesh, stock::MeshFormat::ply);
  if (maker == Maker::left_out) {
    const std::string line = "comment " + made_by() + "\n";
    if (const auto at = bytes.find(line); at != std::string::npos) bytes.erase(at, line.size());
  }
  return bytes;
}

}  // namespace

std::string job_text(const TestPiece& piece, const std::string& machine,
                     const std::string& plan_file) {
  std::string text;
  const auto line = [&text](const std::string& s) { text += s + "\n"; };
  line(fmt::format("title   = \"{}\"", piece.title));
  line(fmt::format("machine = \"{}\"", machine));
  line(fmt::format("program = {{ file = \"{}\", dialect = \"{}\" }}", piece.program_file,
                   parser::name_of(piece.dialect)));
  line("");
  line("# Workpiece frame (blank and plan) on the table: mm, degrees (Rz Ry Rx)");
  line(fmt::format("setup   = {{ origin = {}, tilt = {} }}", vector_text(piece.placement.origin),
                   vector_text(piece.placement.tilt, kDegPerRad)));
  line("# origin: centre of the blank's bottom face in the workpiece frame, mm");
  line(fmt::format("blank   = {}", blank_text(piece.blank, piece.blank_origin)));
  for (const auto& [number, tool] : piece.tools) {
    line(fmt::format("tool.{}  = {}", number, cutter::cutter_text(tool)));
  }
  line("");
  line("# Program origins in the table frame, mm");
  line("[offsets]");
  for (const auto& [number, origin] : piece.work_offsets) {
    line(fmt::format("G{} = {}", 53 + number, vector_text(origin)));
  }
  line("");
  line(
      "# Geometric errors of the machine, for example EB0C = \"30 urad\" or EXX = \"linear 10 "
      "um\"");
  line("[errors]");
  if (!piece.error_span.empty()) {
    line("");
    line(
        "# Error shapes without a span of their own extend over the range that this operation "
        "travels");
    line("[error_span]");
    line(fmt::format("operation = \"{}\"", piece.error_span));
  }
  line("");
  line("# Line numbers of the NC program");
  for (const Operation& op : piece.operations) {
    line("[[operation]]");
    line(fmt::format("name  = \"{}\"", op.name));
    if (op.kind == OperationKind::cone) line("kind  = \"cone\"");
    line(fmt::format("lines = [{}, {}]", op.first_line, op.last_line));
    if (!op.makes.empty()) line(fmt::format("makes = [\"{}\"]", fmt::join(op.makes, "\", \"")));
  }
  line("");
  line("[inspection]");
  line(fmt::format("plan = \"{}\"", plan_file));
  line(
      "cmm  = { e0 = \"0 um\" }   # ideal; a real one: { e0 = \"0.5 um\", l_per_um = 600, seed = 1 "
      "}");
  line("");
  line("[output]");
  line("report = true");
  return text;
}

std::vector<std::pair<std::string, std::string>> test_piece_files(const TestPiece& piece,
                                                                  const std::string& machine,
                                                                  Maker maker) {
  const fs::path plan = fs::path(piece.program_file).replace_extension(".plan.toml");
  std::vector<std::pair<std::string, std::string>> contents{
      {"job.toml", job_text(piece, machine, plan.string())},
      {piece.program_file, piece.program},
      {plan.string(), metrology::to_toml(piece.plan)}};
  if (const auto* mesh = std::get_if<stock::MeshShape>(&piece.blank)) {
    contents.emplace_back(mesh->file, mesh_text(*mesh->solid, maker));
  }
  if (maker == Maker::left_out) return contents;
  for (auto& [name, text] : contents) {
    if (name.ends_with(".toml")) text.insert(0, "# " + made_by() + "\n");
  }
  return contents;
}

Result<std::vector<fs::path>> write_test_piece(const TestPiece& piece, const std::string& machine,
                                               const fs::path& folder, const std::string& sheet) {
  auto contents = test_piece_files(piece, machine);
  if (!sheet.empty()) contents.emplace_back("setup.html", sheet);
  std::vector<std::string> names;
  for (const auto& [name, text] : contents) names.push_back(name);
  auto set = FileSet::open(folder, std::move(names));
  if (!set) return set.error();
  std::vector<fs::path> files;
  for (auto& [name, text] : contents) files.push_back(set->add(name, std::move(text)));
  if (const auto written = set->write(); !written) return written.error();
  return files;
}

}  // namespace frustum::programs

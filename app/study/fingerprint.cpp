#include <algorithm>
#include <nlohmann/json.hpp>

#include "app/job/job_evidence.hpp"
#include "app/study/study_file.hpp"
#include "app/study/study_model.hpp"
#include "core/sha256.hpp"
#include "core/whole_file.hpp"

namespace frustum::app {
namespace {

using nlohmann::ordered_json;

ordered_json errors_json(const std::vector<kinematics::ErrorEntry>& entries) {
  ordered_json errors = ordered_json::array();
  for (const kinematics::ErrorEntry& entry : entries) {
    errors.push_back({entry.name, entry.written, kinematics::written(entry.terms)});
  }
  return errors;
}

ordered_json groups_json(const std::vector<studies::CorrelatedGroup>& groups) {
  ordered_json list = ordered_json::array();
  for (const studies::CorrelatedGroup& group : groups) {
    const std::vector<double> matrix(group.correlation.reshaped().begin(),
                                     group.correlation.reshaped().end());
    list.push_back({{"names", group.names}, {"correlation", matrix}});
  }
  return list;
}

ordered_json questions_json(const StudyQuestions& questions) {
  ordered_json doc{{"at_least", questions.at_least},
                   {"shares", questions.shares},
                   {"share_characteristic", questions.share_characteristic},
                   {"groups", questions.groups}};
  for (const auto& rule : questions.rules) doc["rules"].push_back(rule.written);
  if (const auto& allocation = questions.allocation) {
    doc["allocate"] = {allocation->characteristic, allocation->probability, allocation->cost};
  }
  if (const auto& map = questions.map) {
    doc["map"] = {map->cone_angle_deg, map->inclination_deg, map->center_mm};
  }
  return doc;
}

ordered_json resolved_json(const StudyFile& study, studies::EngineKind engine) {
  ordered_json doc{{"schema", "frustum/study-fingerprint/1"},
                   {"seed", study.seed},
                   {"scheme", studies::name_of(study.scheme)},
                   {"engine", engine == studies::EngineKind::linear ? "linear" : "full"},
                   {"keep", {study.keep_amounts, study.keep_points}},
                   {"errors", errors_json(study.errors)},
                   {"read_as", kinematics::name_of(study.read_as)},
                   {"correlated", groups_json(study.correlated)},
                   {"noise", study.measurement.noise},
                   {"questions", questions_json(study.questions)}};
  if (study.measurement.u) doc["u"] = *study.measurement.u;
  for (const studies::ScaleRule& rule : study.scale) {
    doc["scale"].push_back({rule.pattern, rule.factor});
  }
  for (const StudyCharacteristic& c : study.characteristics) {
    doc["characteristics"].push_back({c.name, c.unit(), c.limit ? *c.limit : 0.0});
  }
  if (study.volumetric) {
    doc["volumetric"] = {study.volumetric->axes, study.volumetric->tool_length};
  }
  return doc;
}

}  // namespace

Result<std::string> fingerprint_of(const StudyFile& study, const StudyModel& model,
                                   studies::EngineKind engine) {
  std::vector<report::HashedFile> files;
  if (study.job) {
    auto evidence = evidence_of(*study.job);
    if (!evidence) return evidence.error();
    files = std::move(evidence->files);
  } else {
    const auto& machine =
        study.motion ? study.motion->machine_file : study.volumetric->machine_file;
    if (auto problems = add_hash(files, "machine", machine); !problems.empty()) return problems;
  }
  if (study.motion) {
    const auto test = read_whole_file(study.motion->file);
    if (!test) return test.error();
    files.push_back(report::hashed_file("test", study.motion->file.string(), *test));
    if (auto problems = add_named_hashes(files, *test, study.motion->file); !problems.empty()) {
      return problems;
    }
  }
  const auto text = read_whole_file(study.file);
  if (!text) return text.error();
  if (auto problems = add_named_hashes(files, *text, study.file); !problems.empty()) {
    return problems;
  }
  for (const auto& file : study.error_files) {
    if (auto problems = add_hash(files, "errors", file); !problems.empty()) return problems;
  }
  std::string resolved = resolved_json(study, engine).dump() + "\n";
  for (const report::HashedFile& file : files) resolved += file.role + " " + file.sha256 + "\n";
  for (const std::string& hash : model.program_hashes()) resolved += "subprogram " + hash + "\n";
  return sha256(resolved);
}

}  // namespace frustum::app

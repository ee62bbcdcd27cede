// frustum benchmark: makes the machines of the open blind benchmark, scores submissions, verifies.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <iostream>
#include <memory>
#include <nlohmann/json.hpp>

#include "app/benchmark/benchmark_baseline.hpp"
#include "app/benchmark/benchmark_make.hpp"
#include "app/benchmark/benchmark_score.hpp"
#include "app/benchmark/benchmark_verify.hpp"
#include "app/command/command_line.hpp"
#include "app/command/commands.hpp"
#include "app/view/console.hpp"
#include "core/file_set.hpp"
#include "core/program_version.hpp"
#include "core/whole_file.hpp"

namespace frustum::app {
namespace {

namespace fs = std::filesystem;
using nlohmann::ordered_json;

struct BenchmarkOptions : AnswerOptions {
  std::string folder{}, submission{}, keys{}, method{};
  std::vector<std::string> only{};
};

// The commitments that are there already, and those of what was made. What was committed to once
// stays.
Result<std::string> commitments_json(const fs::path& file,
                                     const std::map<std::string, std::string>& made) {
  const auto refused = [&file](std::string what, std::string hint) {
    Diagnostic failure = error("benchmark-commitments"_id, std::move(what), std::move(hint));
    failure.file = file.string();
    return failure;
  };
  nlohmann::json all = nlohmann::json::object();
  if (std::error_code failure; fs::exists(file, failure)) {
    const auto text = read_to_replace(file);
    if (!text) return text.error();
    all = nlohmann::json::parse(*text, nullptr, false);
    if (!all.is_object()) {
      return refused("this is no JSON object; nothing was written",
                     "mend it, or name another --out");
    }
  }
  for (const auto& [id, commitment] : made) {
    if (const auto before = all.find(id); before != all.end() && *before != commitment) {
      return refused(fmt::format("{} is committed to other answers; nothing was written", id),
                     "a machine keeps its key; name another --out for another one");
    }
    all[id] = commitment;
  }
  return all.dump(2) + "\n";
}

int make(const BenchmarkOptions& options) {
  const auto keys = read_keys(options.keys);
  if (!keys) return refuse(keys.error(), options);
  for (const std::string& id : options.only) {
    if (std::ranges::find(*keys, id, &BenchmarkKey::id) == keys->end()) {
      return refuse(error("benchmark-keys"_id, fmt::format("{} has no key of {}", options.keys, id),
                          "add a line: m01 <32 hexadecimal digits>"),
                    options);
    }
  }
  BenchmarkFiles files;
  std::map<std::string, std::string> commitments;
  for (const BenchmarkKey& key : *keys) {
    if (!options.only.empty() && std::ranges::find(options.only, key.id) == options.only.end()) {
      continue;
    }
    const auto entry = std::ranges::find(benchmark_entries(), key.id, &BenchmarkEntry::id);
    auto made = with_progress(options, key.id.c_str(),
                              [&](report::Progress&) { return benchmark_files(*entry, key.key); });
    if (!made) return refuse(made.error(), options);
    commitments[key.id] = commitment_of(made->at("answers/" + key.id + ".json"), key.key);
    files.merge(*made);
  }
  auto committed = commitments_json(fs::path(options.folder) / "commitments.json", commitments);
  if (!committed) return refuse(committed.error(), options);
  files["commitments.json"] = *std::move(committed);
  std::vector<std::string> names;
  for (const auto& [name, bytes] : files) names.push_back(name);
  auto set = FileSet::open(options.folder, names);
  if (!set) return refuse(set.error(), options);
  for (auto& [name, bytes] : files) static_cast<void>(set->add(name, std::move(bytes)));
  if (const auto written = set->write(); !written) return refuse(written.error(), options);
  if (options.json) {
    std::cout << ordered_json{{"schema", "frustum/benchmark/1"},
                              {"version", program_version()},
                              {"files", names},
                              {"commitments", commitments}}
                     .dump(2)
              << '\n';
  } else if (!options.quiet) {
    for (const auto& [id, commitment] : commitments) std::cout << id << ' ' << commitment << '\n';
  }
  return kDone;
}

int score(const BenchmarkOptions& options) {
  const auto scores = score_submission(options.folder, options.submission);
  if (!scores) return refuse(scores.error(), options);
  for (const MachineScore& each : *scores) print(std::cerr, each.notes);
  std::cout << (options.json ? score_json(*scores) : options.quiet ? "" : score_text(*scores));
  return kDone;
}

std::string verified_text(const VerifiedBenchmark& found) {
  std::string text;
  for (const VerifiedMachine& machine : found.machines) {
    text +=
        fmt::format("{}: commitment {}", machine.id, machine.commitment_holds ? "holds" : "BROKEN");
    if (machine.differing.empty() && machine.unexpected.empty()) {
      text += ", all files as the key makes them";
    }
    if (!machine.differing.empty()) {
      text += fmt::format(", other than the key makes: {}", fmt::join(machine.differing, ", "));
    }
    if (!machine.unexpected.empty()) {
      text += fmt::format(", not of the key: {}", fmt::join(machine.unexpected, ", "));
    }
    text += '\n';
  }
  if (!found.unexpected.empty()) {
    text += fmt::format("of no machine: {}\n", fmt::join(found.unexpected, ", "));
  }
  return text;
}

int verify(const BenchmarkOptions& options) {
  const auto found = verify_benchmark(options.folder, options.only);
  if (!found) return refuse(found.error(), options);
  ordered_json json{{"schema", "frustum/benchmark/1"},
                    {"version", program_version()},
                    {"machines", ordered_json::array()}};
  for (const VerifiedMachine& machine : found->machines) {
    json["machines"].push_back({{"id", machine.id},
                                {"commitment_holds", machine.commitment_holds},
                                {"differing", machine.differing},
                                {"unexpected", machine.unexpected},
                                {"holds", machine.holds()}});
  }
  json["unexpected"] = found->unexpected;
  if (options.json) {
    std::cout << json.dump(2) << '\n';
  } else if (!options.quiet) {
    std::cout << verified_text(*found);
  }
  return found->holds() ? kDone : kOutOfTolerance;
}

// Our own predictions of the machines named, or of all that are there.
int baseline(const BenchmarkOptions& options) {
  BenchmarkFiles files;
  for (const BenchmarkEntry& entry : benchmark_entries()) {
    std::error_code failure;
    if (!options.only.empty() && std::ranges::find(options.only, entry.id) == options.only.end()) {
      continue;
    }
    if (!fs::is_directory(fs::path(options.folder) / "machines" / entry.id, failure)) continue;
    auto made = with_progress(options, entry.id.c_str(), [&](report::Progress&) {
      return baseline_of(options.folder, entry.id, options.method);
    });
    if (!made) return refuse(made.error(), options);
    files[entry.id + "/predictions.csv"] = std::move(made->predictions);
    files[entry.id + "/errors.csv"] = std::move(made->errors);
  }
  files["method.md"] = baseline_method(options.method);
  if (files.size() == 1) {
    return refuse(
        error("benchmark-machine"_id, fmt::format("{} has none of these machines", options.folder),
              "machines/mNN/ of the benchmark's folder"),
        options);
  }
  std::vector<std::string> names;
  for (const auto& [name, bytes] : files) names.push_back(name);
  auto set = FileSet::open(options.submission, names);
  if (!set) return refuse(set.error(), options);
  for (auto& [name, bytes] : files) static_cast<void>(set->add(name, std::move(bytes)));
  if (const auto written = set->write(); !written) return refuse(written.error(), options);
  return kDone;
}

}  // namespace

void add_benchmark(Command& program) {
  Command group = program.command(
      "benchmark", "The open blind benchmark: make machines, score predictions, verify reveals");
  group.needs_a_command();
  auto m = std::make_shared<BenchmarkOptions>();
  Command making = group.command("make", "Make machines by their keys");
  making.option("--keys", m->keys, "File with lines: m01 <32 hexadecimal digits>").required();
  making.option("--out", m->folder, "Folder of the benchmark").required();
  making.option("--only", m->only, "Machines, separated by commas (all that have keys)")
      .separated_by(',');
  add_answer_options(making, *m);
  making.computes([m] { return make(*m); });
  auto s = std::make_shared<BenchmarkOptions>();
  Command scoring = group.command("score", "Score a submission against answers");
  scoring.option("folder", s->folder, "Folder of the benchmark, with answers/ and prior/")
      .required();
  scoring.option("submission", s->submission, "Folder with mNN/predictions.csv and errors.csv")
      .required();
  add_answer_options(scoring, *s);
  scoring.runs([s] { return score(*s); });
  auto b = std::make_shared<BenchmarkOptions>();
  Command baselines = group.command(
      "baseline", "Our own predictions: the laws alone, or with what was measured of some data");
  baselines.option("folder", b->folder, "Folder of the benchmark").required();
  baselines.option("--data", b->method, "prior: the laws alone; cone, steps, s-piece, motion, all")
      .one_of({kBaselines.begin(), kBaselines.end()})
      .required();
  baselines.option("--out", b->submission, "Folder of the submission").required();
  baselines.option("--only", b->only, "Machines, separated by commas (all that are there)")
      .separated_by(',');
  add_answer_options(baselines, *b);
  baselines.computes([b] { return baseline(*b); });
  auto v = std::make_shared<BenchmarkOptions>();
  Command verifying =
      group.command("verify", "Check commitments, and make revealed machines again");
  verifying.option("folder", v->folder, "Folder of the benchmark").required();
  verifying.option("--only", v->only, "Machines, separated by commas (all with answers)")
      .separated_by(',');
  add_answer_options(verifying, *v);
  verifying.footer("Example: frustum benchmark verify benchmark --only m01");
  verifying.computes([v] { return verify(*v); });
}

}  // namespace frustum::app

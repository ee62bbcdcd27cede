// Studies: draws of machines and what they make, as arrays; whole studies as documents.
#include <fmt/format.h>
#include <pybind11/stl.h>
#include <pybind11/stl/filesystem.h>

#include <unistd.h>

#include <algorithm>
#include <iterator>
#include <limits>

#include "app/study/sampler.hpp"
#include "app/study/study_json.hpp"
#include "app/study/study_run.hpp"
#include "app/study/study_statistics.hpp"
#include "python/arrays.hpp"
#include "python/bind.hpp"
#include "python/words.hpp"

namespace frustum::python {
namespace {

namespace py = pybind11;
namespace fs = std::filesystem;

app::StudyWords words_of(std::optional<std::uint64_t> samples, std::optional<std::uint64_t> seed,
                         const std::string& scheme, const std::string& engine,
                         const py::object& errors) {
  return {.samples = samples,
          .seed = seed,
          .scheme = scheme,
          .engine = engine,
          .errors = error_words(errors)};
}

// With the file that its complaints are about.
template <typename T>
T required_of(const std::string& file, Result<T>&& result) {
  if (result) return *std::move(result);
  Diagnostics problems = result.error();
  for (Diagnostic& each : problems) {
    if (each.file.empty()) each.file = file;
  }
  throw Refused(std::move(problems));
}

void check_draws(std::uint32_t count, std::uint32_t first) {
  constexpr std::uint64_t kMost = std::uint64_t{1} << 32U;
  if (std::uint64_t{first} + count > kMost) {
    refuse_argument("count", fmt::format("draws {} to {}", first, std::uint64_t{first} + count),
                    fmt::format("there are {}", kMost));
  }
}

// The machines of a study: draws by their numbers.
class Population {
 public:
  Population(const fs::path& path, std::optional<std::uint64_t> seed, const py::object& errors) {
    const std::string file = path.string();
    const auto words = words_of(std::nullopt, seed, "", "", errors);
    const py::gil_scoped_release released;
    study_ = std::make_unique<app::StudyFile>(required(app::load_study_file(file, words)));
    model_ = required_of(file, app::make_model(*study_));
  }

  [[nodiscard]] std::vector<std::string> characteristics() const {
    return app::names_of(study_->characteristics);
  }
  [[nodiscard]] std::vector<std::string> units() const {
    std::vector<std::string> all;
    for (const auto& each : study_->characteristics) all.push_back(each.unit());
    return all;
  }

  // (values, failures): NaN in the rows of draws that failed.
  [[nodiscard]] py::tuple evaluate(std::uint32_t count, std::uint32_t first,
                                   const std::string& engine) const {
    if (engine != "full" && engine != "linear") {
      refuse_argument("engine", fmt::format("'{}' is not known", engine), "full or linear");
    }
    check_draws(count, first);
    const auto kind = engine == "full" ? studies::EngineKind::full : studies::EngineKind::linear;
    if (const std::string against = model_->against_linear();
        kind == studies::EngineKind::linear && !against.empty()) {
      refuse_argument("engine", "linear cannot stand for this study: " + against, "full");
    }
    const auto sampler = required(app::Sampler::make(*study_, *model_, kind));
    std::vector<app::DrawOutcome> outcomes;
    constexpr std::uint32_t kAtATime = 256;  // so that Ctrl-C is heard soon
    for (std::uint32_t done = 0; done < count; done += std::min(kAtATime, count - done)) {
      if (PyErr_CheckSignals() != 0) throw py::error_already_set();
      const py::gil_scoped_release released;
      const auto drawn = sampler.machines(first + done, std::min(kAtATime, count - done));
      auto some =
          kind == studies::EngineKind::full ? model_->full(drawn, {}) : model_->linear(drawn, {});
      std::ranges::move(some, std::back_inserter(outcomes));
    }
    const std::size_t width = study_->characteristics.size();
    Numbers values({static_cast<py::ssize_t>(count), static_cast<py::ssize_t>(width)});
    py::dict failures;
    double* row = values.mutable_data();
    for (std::size_t i = 0; i < outcomes.size(); ++i, row += width) {
      if (outcomes[i].values.empty()) {
        std::fill_n(row, width, std::numeric_limits<double>::quiet_NaN());
        failures[py::int_(first + i)] = outcomes[i].failure;
      } else {
        std::copy_n(outcomes[i].values.begin(), width, row);
      }
    }
    return py::make_tuple(values, failures);
  }

  // What was drawn: mm, and rad or degrees of phases as in the samples of a study.
  [[nodiscard]] py::dict amounts(std::uint32_t count, std::uint32_t first) const {
    check_draws(count, first);
    std::vector<std::vector<double>> columns;
    std::vector<std::string> names;
    {
      const py::gil_scoped_release released;
      const auto sampler =
          required(app::Sampler::make(*study_, *model_, studies::EngineKind::full));
      const auto drawn = sampler.machines(first, count);
      for (const studies::DrawnAmount& amount : model_->factors().amounts()) {
        names.push_back(amount.name);
        auto& column = columns.emplace_back();
        for (const app::DrawnMachine& machine : drawn) column.push_back(amount(machine.values));
      }
    }
    py::dict all;
    for (std::size_t k = 0; k < names.size(); ++k) all[py::str(names[k])] = array_of(columns[k]);
    return all;
  }

 private:
  std::unique_ptr<app::StudyFile> study_{};
  std::unique_ptr<app::StudyModel> model_{};
};

// Removed at the end with all that is in it.
class TemporaryFolder {
 public:
  TemporaryFolder() {
    std::string name = (fs::temp_directory_path() / "frustum-study-XXXXXX").string();
    if (::mkdtemp(name.data()) == nullptr) {
      throw Refused({error("no-folder"_id, "no folder for the samples can be made: " + name)});
    }
    folder_ = name;
  }
  ~TemporaryFolder() {
    std::error_code ignored;
    fs::remove_all(folder_, ignored);
  }
  TemporaryFolder(const TemporaryFolder&) = delete;
  TemporaryFolder& operator=(const TemporaryFolder&) = delete;
  [[nodiscard]] const fs::path& path() const { return folder_; }

 private:
  fs::path folder_{};
};

std::string study_document(const std::string& file, std::optional<std::uint64_t> samples,
                           std::optional<std::uint64_t> seed, const std::string& scheme,
                           const std::string& engine, const py::object& errors,
                           const std::optional<std::string>& out) {
  const auto words = words_of(samples, seed, scheme, engine, errors);
  std::optional<py::gil_scoped_release> released(std::in_place);
  const auto study = required(app::load_study_file(file, words));
  const auto model = required_of(file, app::make_model(study));
  if (auto problems = app::unanswerable(study, *model); !problems.empty()) {
    throw Refused(std::move(problems));
  }
  const auto chosen = required_of(file, app::choose_engine(study, *model, [](double) {}));
  const auto mark = required(app::fingerprint_of(study, *model, chosen.kind));
  std::optional<TemporaryFolder> temporary;
  if (!out) temporary.emplace();
  const studies::Ranks alone;
  app::StudyRun run(study, *model, chosen, alone, {mark, study.seed});
  const app::Interruption interruption;
  const auto end = required(
      run.run({.folder = out ? fs::path(*out) : temporary->path()}, interruption, [](auto&) {}));
  if (end.interrupted) {
    released.reset();
    PyErr_SetNone(PyExc_KeyboardInterrupt);
    throw py::error_already_set();
  }
  const auto columns = required(run.columns(end.samples));
  return app::study_json(
      required_of(file, app::result_of(study, *model, chosen, columns, end.samples)));
}

}  // namespace

void bind_study(py::module_& module) {
  py::class_<Population>(module, "Population",
                         "The machines that a study draws, by their numbers. um and urad.")
      .def(py::init<const fs::path&, std::optional<std::uint64_t>, const py::object&>(),
           py::arg("file"), py::arg("seed") = py::none(), py::arg("errors") = py::none())
      .def_property_readonly("characteristics", &Population::characteristics)
      .def_property_readonly("units", &Population::units)
      .def(
          "evaluate", &Population::evaluate, py::arg("count"), py::arg("first") = 0,
          py::arg("engine") = "full",
          "(values, failures): (count, characteristics), NaN in rows of draws that failed, and why "
          "they did.")
      .def("amounts", &Population::amounts, py::arg("count"), py::arg("first") = 0,
           "What was drawn: an array a quantity, mm and rad.");
  module.def("_study", &study_document);
}

}  // namespace frustum::python

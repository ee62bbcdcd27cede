#include "trials/travel_as_read.hpp"

#include <oneapi/tbb/task_group.h>

#include <algorithm>
#include <map>
#include <memory>
#include <set>
#include <utility>
#include <variant>

#include "kinematics/controller/controller.hpp"
#include "kinematics/errors/error_size.hpp"
#include "parser/doubts.hpp"
#include "parser/interpreter.hpp"
#include "stock/collision/machine_collision.hpp"
#include "trials/piece_reading.hpp"

namespace frustum::trials {
namespace {

using kinematics::CommandedStep;
using parser::Motion;

// Motions that are commanded together, some megabytes.
constexpr std::size_t kPortion = 16384;

// Commands motions and follows them.
class Follower {
 public:
  Follower(const kinematics::Machine& machine, const kinematics::Setup& setup,
           const kinematics::GeometricErrors& errors, const stock::MachineScene& scene,
           const kinematics::TravelOptions& options)
      : recorder_(machine, setup, errors, machine.home(), options),
        collisions_(scene, machine.home()),
        controller_(machine, setup, [this](CommandedStep&& step) { follow(step); }, {}) {}

  // Nothing more is commanded once something was wrong.
  void command(const std::vector<Motion>& motions) {
    for (const Motion& motion : motions) {
      if (!problems_.empty()) return;
      problems_ = controller_.command(motion);
    }
  }

  [[nodiscard]] const Diagnostics& problems() const { return problems_; }
  [[nodiscard]] const Diagnostics& warnings() const { return controller_.warnings(); }
  [[nodiscard]] kinematics::Travel finish() {
    kinematics::Travel done{.path = recorder_.finish()};
    done.cycle_time = recorder_.clock();
    return done;
  }
  [[nodiscard]] stock::MachineCollisions collisions(const kinematics::Setup& setup) {
    return collisions_.finish(setup);
  }

 private:
  void follow(const CommandedStep& step) {
    if (const auto* move = std::get_if<kinematics::CommandedMove>(&step)) collisions_.follow(*move);
    recorder_.follow(step);
  }

  kinematics::PathRecorder recorder_;
  stock::MachineCollisionSearch collisions_;
  kinematics::Controller controller_;
  Diagnostics problems_{};
};

// Hands motions on in portions, one of which is at work while the next is filled.
class Portions {
 public:
  explicit Portions(Follower& follower) : follower_(follower) { next_.reserve(kPortion); }

  void add(Motion&& motion) {
    note_doubt(motion);
    next_.push_back(std::move(motion));
    if (next_.size() == kPortion) hand_on();
  }
  void finish() {
    hand_on();
    work_.wait();
  }
  [[nodiscard]] const std::vector<Motion>& doubtful() const { return doubtful_; }

 private:
  // The first of each name are all that doubts_of() looks at.
  void note_doubt(const Motion& motion) {
    const auto* event = std::get_if<parser::Event>(&motion.command);
    if (event == nullptr || event->grade == parser::EventGrade::known) return;
    if (doubted_.insert(event->name).second) doubtful_.push_back(motion);
  }
  void hand_on() {
    work_.wait();
    std::swap(next_, at_work_);
    next_.clear();
    work_.run([this] { follower_.command(at_work_); });
  }

  Follower& follower_;
  std::vector<Motion> next_{}, at_work_{};
  std::set<std::string> doubted_{};
  std::vector<Motion> doubtful_{};
  tbb::task_group work_{};
};

// With all tools: those that are never in the spindle meet nothing. What is no tool or no blank is
// for those to tell who cut with it.
Result<stock::MachineScene> scene_before(const kinematics::Machine& machine,
                                         const programs::TestPiece& piece,
                                         const kinematics::Setup& setup,
                                         const TrialOptions& options) {
  const auto blank = stock::Blank::make(piece.blank, piece.blank_origin);
  if (!options.find_collisions || !blank) return stock::MachineScene{.machine = &machine};
  std::map<int, cutter::Cutter> tools;
  for (const auto& [number, spec] : piece.tools) {
    if (auto tool = cutter::Cutter::make(spec)) tools.emplace(number, *std::move(tool));
  }
  return stock::scene_of(machine, piece.fixtures, setup, tools, *blank);
}

void begin(const TrialOptions& options, Stage stage) {
  if (options.on_stage) options.on_stage(stage);
}

}  // namespace

bool may_travel_as_read(const kinematics::Machine& machine,
                        const kinematics::GeometricErrors& errors, const programs::TestPiece& piece,
                        const TrialOptions& options) {
  const auto varies = [&](kinematics::AxisLetter axis) {
    return !std::ranges::all_of(errors[axis].component, &kinematics::ErrorFunction::is_zero);
  };
  return options.poses_alone && !options.has_dynamics() && piece.operations.empty() &&
         std::ranges::none_of(kinematics::kAxisLetters, varies) &&
         !has_error(kinematics::oversize_errors(machine, errors, {}));
}

Result<TravelAsRead> travel_as_read(const kinematics::Machine& machine,
                                    const kinematics::GeometricErrors& errors,
                                    const programs::TestPiece& piece, const TrialOptions& options) {
  begin(options, Stage::parse);
  // The piece keeps the text.
  const std::shared_ptr<const std::string> text(std::shared_ptr<const void>(), &piece.program);
  const parser::Program program{piece.program_file, piece.dialect, parser::ProgramText(text)};
  if (Diagnostics wrong = syntax_errors(program); !wrong.empty()) return wrong;

  begin(options, Stage::execute);
  const kinematics::Setup setup = setup_of(piece);
  const auto scene = scene_before(machine, piece, setup, options);
  if (!scene) return scene.error();
  Follower follower(machine, setup, errors, *scene,
                    {.path_bound = options.path_bound,
                     .time_law = options.time_law,
                     .servo_lag = options.servo_lag,
                     .poses_alone = true});
  Portions portions(follower);
  std::vector<std::string> opened;
  const auto summary = parser::interpret(
      program, [&portions](Motion&& motion) { portions.add(std::move(motion)); },
      reading_of(machine, piece, opened));
  portions.finish();
  if (!summary) return summary.error();
  auto files = hashed(opened);
  if (!files) return files.error();
  if (!follower.problems().empty()) return in_file(follower.problems(), piece.program_file);

  TravelAsRead result;
  result.program_files = *std::move(files);
  result.warnings = parser::doubts_of(portions.doubtful());
  const Diagnostics& warned = follower.warnings();
  result.warnings.insert(result.warnings.end(), warned.begin(), warned.end());
  result.warnings = in_file(std::move(result.warnings), piece.program_file);
  const Diagnostics oversize = kinematics::oversize_errors(machine, errors, {});
  result.warnings.insert(result.warnings.end(), oversize.begin(), oversize.end());
  result.machine_collisions = follower.collisions(setup);
  result.travel = follower.finish();
  return result;
}

}  // namespace frustum::trials

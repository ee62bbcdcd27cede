// frustum motion: motion tests on the virtual machine, and measured traces.
#include <filesystem>
#include <iostream>
#include <memory>

#include "app/command/command_line.hpp"
#include "app/command/commands.hpp"
#include "app/command/option/style_option.hpp"
#include "app/motion/probe_motion.hpp"
#include "app/motion/test_file.hpp"
#include "app/motion/trace_motion.hpp"
#include "app/motion/vectors_motion.hpp"
#include "app/view/text_table.hpp"
#include "core/file_set.hpp"
#include "core/whole_file.hpp"
#include "instruments/standard_names.hpp"
#include "report/page/motion_page.hpp"

namespace frustum::app {
namespace {

int show_motion(Result<MotionAnswer> answer, const AnswerOptions& options, const std::string& out,
                const std::string& program = {}) {
  if (!answer) return refuse(answer.error(), options);
  add_warnings(*answer);
  if (answer->program && !program.empty()) {
    const auto written = write_whole_file(program, answer->program->text);
    if (!written) return refuse(written.error(), options);
  }
  if (!out.empty()) {
    std::vector<std::string> names{"motion.json", "motion.html"};
    for (const auto& [name, bytes] : answer->files) names.push_back(name);
    auto set = FileSet::open(out, names);
    if (!set) return refuse(set.error(), options);
    set->add("motion.json", answer->document.json() + "\n");
    report::MotionPage page = answer->page;
    for (const Diagnostic& each : answer->warnings) page.remarks.push_back(each.message);
    set->add("motion.html", report::motion_html(page));
    for (const auto& [name, bytes] : answer->files) set->add(name, bytes);
    if (const auto written = set->write(); !written) return refuse(written.error(), options);
  }
  print(std::cerr, answer->warnings);
  if (options.json) {
    std::cout << answer->document.json() << '\n';
  } else if (!options.quiet) {
    std::cout << answer->text;
  }
  return kDone;
}

constexpr const char* kNoiseOfAReading =
    "Standard deviation of a reading, for example 0.3um (default: none)";

void add_machine_options(Command& command, MotionWords& words,
                         const char* noise = kNoiseOfAReading) {
  command
      .option("machine,--machine", words.machine, "Machine file, or the name of a shipped machine")
      .required();
  add_error_options(command, words.errors);
  command.option(
      "--setup", words.setup,
      "\"ball=10,-5,3;table_ball=6,-4,2;length=2\" (um): spindle ball off the tip, in the "
      "frame of the tool; table ball off its place, in that of the table; bar longer than "
      "nominal (default: none)");
  command.option("--tool-length", words.tool_length,
                 "mm from the gauge point to the spindle ball (default 0)");
  command.flag(
      "--ball-known", words.ball_known,
      "What is identified where the offset of the spindle ball is known (default: it is not)");
  command.option("--noise", words.noise, noise);
  command.option("--resolution", words.resolution,
                 "Step of the readings, for example 0.1um (default: none)");
  command.option("--seed", words.seed, "Of the noise (default 1)");
  command.option("--out", words.out,
                 "Folder for motion.html, motion.json, trace.csv and test.toml, which `motion run` "
                 "runs again");
  add_answer_options(command, words);
}

void add_stroke_option(Command& command, MotionWords& words) {
  command.option("--stroke", words.stroke, "Of the bar to either side, mm (default 1)");
}

// Of a test that is read at rest without them.
void add_run_options(Command& command, MotionWords& words, const char* feed) {
  command.option("--feed", words.feed, feed);
  command.option("--dynamics", words.dynamics,
                 "quasi_static or linear: masses and springs of the machine move the tip while the "
                 "test is run at the feed (default: off)");
  command.flag("--jerk", words.jerk, "The time law of that run limits jerk, too");
}
constexpr const char* kFeedOfTheTip = "mm/min of the tip, for --dynamics";

std::shared_ptr<StyleWords> style_option(Command& command) {
  auto style = std::make_shared<StyleWords>();
  add_style_options(command, *style);
  return style;
}

// A test whose words become an answer, and a file by which it can be run again.
template <typename Words>
void runs_test(Command& command, const std::shared_ptr<Words>& words) {
  const auto style = style_option(command);
  command.runs([words, style] {
    words->style = style_of(*style);
    auto answer = with_progress(*words, "motion", [&](report::Progress& progress) {
      words->progress = &progress;
      auto found = answer_of(TestWords(*words));
      words->progress = nullptr;
      return found;
    });
    Words named = *words;
    if (answer && answer->program && words->nc.file.empty() && !words->out.empty()) {
      named.nc.file = (std::filesystem::path(words->out) / answer->program->name).string();
      answer->files[answer->program->name] = answer->program->text;
    }
    if (answer && !words->out.empty()) {
      answer->files["test.toml"] = test_toml(named, words->out);
    }
    return show_motion(answer, *words, words->out, words->nc.file);
  });
}

void add_program_options(Command& command, ProgramWords& words) {
  command.option("--program", words.file,
                 "NC program of the test, to be written (default: with --dialect and --out beside "
                 "the other files)");
  command.option("--dialect", words.dialect, "fanuc (default), linuxcnc, sinumerik or heidenhain")
      .one_of({"fanuc", "linuxcnc", "sinumerik", "heidenhain"});
  command
      .option("--form", words.form,
              "tcp: tip and rotary axes under tool centre point control (default); axes: positions "
              "of all axes")
      .one_of({"tcp", "axes"});
  command.option("--program-feed", words.feed,
                 "mm/min, deg/min where only rotary axes move (default 1000)");
}

void add_circle(Command& tests) {
  auto words = std::make_shared<CircleWords>();
  Command command = tests.command("circle", "Ball bar on a circle of two linear axes");
  add_machine_options(command, *words);
  command.option("--plane", words->plane, "XY, YZ or ZX: the angle runs from the first letter")
      .required();
  command.option("--length", words->length, "Of the bar, mm (default 150)");
  add_stroke_option(command, *words);
  command.option("--center", words->centre, "x,y,z of the table ball in the table frame, mm")
      .required();
  command.option("--at", words->at, "\"A=-90,C=0\": held rotary axes, degrees (default 0)");
  command.option("--angles", words->angles,
                 "0,30,60: degrees (default: 3600 midpoints of a full turn)");
  command.option("--feed", words->feed,
                 "mm/min: the axes lag behind by their servo gains (default: they follow at once)");
  command.option("--dynamics", words->dynamics,
                 "quasi_static or linear: instead of that lag, masses and springs of the machine "
                 "move the tip (default: off)");
  add_program_options(command, words->nc);
  command.footer(
      "Example: frustum motion circle --machine iwf-bc --plane XY --length 150 --center 0,0,150 "
      "--error EC0Y=30urad");
  runs_test(command, words);
}

void add_rotary(Command& tests) {
  auto words = std::make_shared<RotaryWords>();
  Command command = tests.command("rotary", "Ball bar while one rotary axis turns");
  add_machine_options(command, *words);
  command.option("--axis", words->axis, "The rotary axis that turns").required();
  command.option("--direction", words->direction,
                 "Of the bar: axial, radial (from the axis) or tangential");
  command.option("--hold", words->hold,
                 "rotor: the bar turns with the axis; bed: it keeps its direction in the bed "
                 "(default: with which the tip stands still under tool centre point control: rotor "
                 "for a table, bed for a head)");
  command.option("--ball", words->ball, "x,y,z of the table ball in the table frame, mm")
      .required();
  command.option("--length", words->length, "Of the bar, mm (default 150)");
  add_stroke_option(command, *words);
  command.option("--at", words->at, "\"A=-90\": the other rotary axes, degrees (default 0)");
  command.option("--angles", words->angles,
                 "0,30,60: degrees (default: 3600 midpoints of a full turn or of the travel)");
  add_run_options(command, *words, "deg/min of the axis, for --dynamics");
  add_program_options(command, words->nc);
  command.footer(
      "Example: frustum motion rotary --machine zx-yac --axis C --direction radial --ball "
      "100,0,100 --length 150 --error EX0C=10um");
  runs_test(command, words);
}

void add_cone_motion(Command& tests) {
  auto words = std::make_shared<ConeMotionWords>();
  Command command = tests.command("cone", "Ball bar on the five-axis path of the cone test");
  add_machine_options(command, *words);
  command.option("--cone-angle", words->cone_angle, "Half the apex angle, degrees (default 45)");
  command.option("--inclination", words->inclination,
                 "Of the cone against the table, degrees (default 30)");
  command.option("--radius", words->radius, "Of the circle of the tip, mm (default 40)");
  command.option("--center", words->centre,
                 "x,y,z of that circle in the table frame, mm (default -65,0,150)");
  add_stroke_option(command, *words);
  command.option("--sense", words->sense,
                 "normal: along the surface normal (default); radial: in the plane of the path");
  command.option("--angles", words->angles,
                 "0,30,60: phi, degrees (default: 3600 midpoints of a full turn)");
  add_run_options(command, *words, kFeedOfTheTip);
  add_program_options(command, words->nc);
  command.footer(
      "Example: frustum motion cone --machine iwf-bc --cone-angle 45 --inclination 30 --radius 40 "
      "--center=-65,0,150 --sense normal --error EX0C=10um");
  runs_test(command, words);
}

void add_chase(Command& tests) {
  auto words = std::make_shared<ChaseWords>();
  Command command = tests.command("chase", "R-test: the tip stays at the table ball");
  add_machine_options(command, *words);
  command.option("--ball", words->ball, "x,y,z of the table ball in the table frame, mm")
      .required();
  command
      .option("--at", words->at,
              "\"A=-90,C=0;A=0,C=60\": rotary poses, degrees; maps: those of error maps")
      .required();
  add_run_options(command, *words, "deg/min from pose to pose, for --dynamics");
  add_program_options(command, words->nc);
  command.footer(
      "Example: frustum motion chase --machine zx-yac --ball 100,0,100 --at \"A=-90,C=0;A=0,C=60\" "
      "--error EX0C=10um");
  runs_test(command, words);
}

void add_line(Command& tests) {
  auto words = std::make_shared<LineWords>();
  Command command =
      tests.command("line", "Laser along an axis: accuracy, repeatability, straightness");
  add_machine_options(command, *words);
  command.option("--axis", words->axis, "X, Y or Z").required();
  command.option("--targets", words->targets, "0,37,75: positions of the axis, mm").required();
  command.option("--runs", words->runs, "In each direction (default 5)").within(2, 1000);
  command.option("--at", words->at, "\"Y=100,Z=50\": the other axes, mm and degrees (default 0)");
  add_run_options(command, *words, kFeedOfTheTip);
  add_program_options(command, words->nc);
  command.footer(
      "Example: frustum motion line --machine zx-yac --axis X --targets=-180,-97,-31,42,111,178 "
      "--error \"EXX=linear 10um + reversal 3um\"");
  runs_test(command, words);
}

void add_diagonal(Command& tests) {
  auto words = std::make_shared<DiagonalWords>();
  Command command = tests.command("diagonal", "Laser along the diagonals of a box or a face");
  add_machine_options(command, *words);
  command.option("--box", words->box, "\"X=-200:200,Y=-200:200,Z=100:400\" (mm); two axes: a face")
      .required();
  command.option("--points", words->points, "On each diagonal (default 11)").within(2, 100000);
  command.option("--at", words->at, "\"Z=50,B=30\": the other axes, mm and degrees (default 0)");
  add_run_options(command, *words, kFeedOfTheTip);
  add_program_options(command, words->nc);
  command.footer(
      "Example: frustum motion diagonal --machine iwf-bc --box \"X=-200:200,Y=-150:150,Z=0:300\" "
      "--error EC0Y=20urad");
  runs_test(command, words);
}

void add_lobe_options(Command& command, LobeWords& words) {
  command.option("--pretravel", words.constant,
                 "Of the probe, the same in every direction, for example 5um (default: none)");
  command.option("--lobe", words.amplitude,
                 "Amplitude of its three-lobed part across the stylus, for example 1um (default: "
                 "none)");
  command.option("--lobe-phase", words.phase,
                 "Degrees about the stylus from X to a lobe (default 0)");
}

void add_touch(Command& tests) {
  auto words = std::make_shared<TouchWords>();
  Command command = tests.command(
      "touch", "Touch-trigger calibration of a table's axes A and C: maps of their errors");
  add_machine_options(command, *words,
                      "Two standard deviations of a touch, for example 0.35um (default: none)");
  command.option("--repeat", words->repeat, "Calibrations whose scatter is shown (default 1)")
      .within(1, kMostCalibrations);
  add_lobe_options(command, words->lobes);
  command.footer(
      "In --setup, ball is that of the probe, table_ball the artefact. --out also writes "
      "errors.toml, the maps as an error file, touches.csv, which `motion trace` reads, and "
      "touch.ngc, touch.nc, touch.mpf and touch.h, the programs for LinuxCNC, Fanuc, Sinumerik and "
      "Klartext (whose touch.a is the mask of its log).\n"
      "Example: frustum motion touch --machine ac-probe --errors ibaraki-position-dependent "
      "--noise 0.35um --out touch");
  runs_test(command, words);
}

void add_probe(Command& tests) {
  auto words = std::make_shared<ProbeWords>();
  Command command = tests.command(
      "probe", "The cut part of a job on the machine that cut it: which errors cancel there");
  command.option("job,--job", words->job, "Job file with an inspection plan").required();
  add_error_options(command, words->overrides.errors);
  command.option("--tool-radius-error", words->overrides.tool_radius_error, "for example 2um");
  command.option("--at", words->at,
                 "\"A=0,C=0;A=-90,C=0\": rotary poses, degrees; each point is probed at the first "
                 "from which it is reached (default: Z of the workpiece along the tool)");
  command.option("--tool-length", words->tool_length,
                 "mm from the gauge point to the centre of the ball (default: length of the job's "
                 "first tool)");
  command.option("--setup", words->setup,
                 "\"ball=10,-5,3\" (um): ball of the probe off the tip, in the frame of the tool");
  command.option("--noise", words->noise,
                 "Two standard deviations of a touch, for example 0.35um (default: none)");
  command.option("--seed", words->seed, "Of the noise (default 1)");
  add_lobe_options(command, words->lobes);
  command.option("--measured", words->measured,
                 "CSV that the probing program has logged, in place of simulated touches");
  command.option("--out", words->out,
                 "Folder for motion.html, motion.json, touches.csv, points.csv (centres of the "
                 "ball in the frame of the plan) and the probing programs probe.ngc, probe.nc, "
                 "probe.mpf and probe.h");
  add_answer_options(command, *words);
  command.footer(
      "The ball and the ways of approach are those of the plan.\n"
      "Example: frustum motion probe examples/cone/job.toml --noise 0.35um --out probed");
  const auto style = style_option(command);
  command.computes([words, style] {
    words->style = style_of(*style);
    auto answer =
        with_progress(*words, "probe", [&](report::Progress&) { return probe_answer(*words); });
    return show_motion(std::move(answer), *words, words->out);
  });
}

struct RunWords : AnswerOptions {
  std::string file{};
  ErrorWords errors{};
  bool servo_lag = false;
  std::string out{};
};

void add_motion_run(Command& tests) {
  auto words = std::make_shared<RunWords>();
  Command command = tests.command("run", "A motion test of a file, as --out writes one");
  command.option("file", words->file, "test.toml").required();
  add_error_options(command, words->errors);
  command.flag("--servo-lag", words->servo_lag,
               "While the NC program of the test runs, the axes follow late by their servo gains "
               "(a circle with a feed: always)");
  command.option("--out", words->out, "Folder for motion.html, motion.json and trace.csv");
  add_answer_options(command, *words);
  command.footer("Example: frustum motion run ballbar/test.toml --error EC0Y=30urad");
  const auto style = style_option(command);
  command.runs([words, style] {
    auto test = read_test_file(words->file);
    if (!test) return refuse(test.error(), *words);
    MotionWords& common = common_words(test->words);
    common.errors = words->errors;
    common.style = style_of(*style);
    if (words->servo_lag) common.nc.servo_lag = true;
    auto answer = with_progress(*words, "motion", [&](report::Progress& progress) {
      common.progress = &progress;
      auto found = answer_of(test->words);
      common.progress = nullptr;
      return found;
    });
    if (!answer) return refuse(in_test_file(*test, answer.error()), *words);
    return show_motion(std::move(answer), *words, words->out);
  });
}

void add_trace(Command& tests) {
  auto words = std::make_shared<TraceWords>();
  Command command =
      tests.command("trace", "What measured readings of a ball bar, a laser or a touch probe say");
  command
      .option(
          "files", words->files,
          "CSV: run,angle_deg,radial_um (or time_s, radial_mm, length_mm; semicolons and decimal "
          "commas too), one run or two, in one file or two; of a line run,direction,target_mm,"
          "deviation_um; touches with --machine: A_deg,C_deg,point,x_mm,y_mm,z_mm")
      .required();
  command.option("--plane", words->plane, "XY, YZ or ZX (default: as the file says, else XY)");
  command.option("--length", words->length, "Of the bar, mm (default: as the file says)");
  command.option("--capture", words->capture,
                 "From,to in degrees: the arc over which times are spread (default 0,360)");
  command
      .option("--angle", words->angle,
              "feed: a recording by time, from before the bar comes in to after it has gone out; "
              "the way between is divided evenly (default: angles, or times over the capture)")
      .one_of({"command", "feed"});
  command.option("--overshoot", words->overshoot,
                 "For --angle feed: degrees before and after the capture (default 180 in XY, else "
                 "2)");
  command.option("--stroke", words->stroke, "Of the bar to either side, mm (default 1)");
  command.option("--axis", words->axis, "The axis of a line");
  command.option("--machine", words->machine, "The machine of a touch-trigger calibration");
  command.option(
      "--balls", words->balls,
      "\"x,y,z;x,y,z;x,y,z\" of the table balls, mm: the files are R-tests at the poses of "
      "`chase --at maps`, and the answer are the error maps of A and C (errors.toml)");
  command.option("--noise", words->noise,
                 "Of a touch, two standard deviations, for example 0.35um (default: none)");
  command.option("--out", words->out, "Folder for motion.html and motion.json");
  add_answer_options(command, *words);
  command.footer("Example: frustum motion trace measured.csv --plane XY --length 150");
  const auto style = style_option(command);
  command.runs([words, style] {
    words->style = style_of(*style);
    return show_motion(trace_answer(*words), *words, words->out);
  });
}

void add_vectors(Command& tests) {
  auto words = std::make_shared<MotionWords>();
  Command command = tests.command(
      "vectors", "Lines of the rotary axes, as controls correct their kinematics by them");
  command
      .option("machine,--machine", words->machine, "Machine file, or the name of a shipped machine")
      .required();
  add_error_options(command, words->errors);
  command.option("--out", words->out, "Folder for motion.html, motion.json and vectors.csv");
  add_answer_options(command, *words);
  command.footer(
      "Example: frustum motion vectors --machine zx-yac --error EX0C=10um --error EB0C=20urad");
  const auto style = style_option(command);
  command.runs([words, style] {
    words->style = style_of(*style);
    return show_motion(vectors_answer(*words), *words, words->out);
  });
}

void add_names(Command& tests) {
  auto options = std::make_shared<AnswerOptions>();
  Command command = tests.command("names", "Which test a name of ISO 10791-6 means here");
  add_answer_options(command, *options);
  command.footer("Example: frustum motion names");
  command.runs([options] {
    TextTable table({"name", "machines", "test", "shows", "attributed by"});
    Document doc;
    for (const auto& each : instruments::standard_tests()) {
      const char* by = each.attributed ? "a maker's paper" : "us, not verified";
      table.row({std::string(each.name), std::string(each.machines), std::string(each.test),
                 std::string(each.shows), by});
      doc[each.name] = Document{{"machines", each.machines},
                                {"test", each.test},
                                {"shows", each.shows},
                                {"attributed_by", by}};
    }
    if (options->json) {
      std::cout << doc.json() << '\n';
    } else if (!options->quiet) {
      std::cout << table.text();
    }
    return kDone;
  });
}

}  // namespace

void add_motion(Command& program) {
  Command tests = program.command(
      "motion", "Ball bar, R-test, laser and touch probe on the virtual machine; measured traces");
  tests.needs_a_command();
  add_circle(tests);
  add_rotary(tests);
  add_cone_motion(tests);
  add_chase(tests);
  add_line(tests);
  add_diagonal(tests);
  add_touch(tests);
  add_probe(tests);
  add_motion_run(tests);
  add_trace(tests);
  add_vectors(tests);
  add_names(tests);
}

}  // namespace frustum::app

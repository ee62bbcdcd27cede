#include "instruments/touch_program.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <memory>

#include "core/decimal.hpp"

namespace frustum::instruments {
namespace {

using parser::Dialect;

constexpr double kFeed = 100.0;  // mm/min, as touches are slow
constexpr double kAbove = 10.0;  // mm, between the ball and the highest that a column turns to
constexpr const char* kColumns = "A_deg,C_deg,point,ball_x_mm,ball_y_mm,ball_z_mm";

// One touch as its program needs it.
struct ProgrammedTouch {
  std::string a{}, c{};  // degrees
  std::size_t point = 0;
  Vec3 approach = Vec3::Zero(), end = Vec3::Zero();
};

// What differs among the controls.
class ProbingText {
 public:
  virtual ~ProbingText() = default;
  ProbingText() = default;
  ProbingText(const ProbingText&) = delete;
  ProbingText& operator=(const ProbingText&) = delete;

  [[nodiscard]] std::string take() { return std::move(text_); }
  virtual void begin() = 0;
  virtual void rapid(const std::string& words) { line("G0 " + words); }
  virtual void probe(const ProgrammedTouch& touch) = 0;
  virtual void end() = 0;
  // "X1 Y2", to a nanometre.
  [[nodiscard]] virtual std::string word(char axis, double value) const {
    return fmt::format("{}{}", axis, fixed_decimal(value, 6));
  }
  [[nodiscard]] virtual std::string turn(char axis, const std::string& degrees) const {
    return fmt::format("{}{}", axis, degrees);
  }
  [[nodiscard]] std::string words(const Vec3& p) const {
    return word('X', p.x()) + " " + word('Y', p.y()) + " " + word('Z', p.z());
  }

 protected:
  virtual void line(const std::string& text) { text_ += text + "\n"; }

 private:
  std::string text_{};
};

constexpr const char* kTitle = "TOUCH-TRIGGER CALIBRATION OF A AND C";
constexpr const char* kSetUp =
    "ORIGIN WHERE THE AXES A AND C CROSS. TOOL LENGTH: TO THE CENTRE OF THE BALL";

class LinuxCncText : public ProbingText {
 public:
  void begin() override {
    line(fmt::format("({})", kTitle));
    line(fmt::format("(G54: {})", kSetUp));
    line("G21 G17 G90 G94 G40 G80 G54");
    line("(LOGOPEN,touches.csv)");
    line(fmt::format("(LOG,{})", kColumns));
  }
  void probe(const ProgrammedTouch& t) override {
    line(fmt::format("G38.2 {} F{:g}", words(t.end), kFeed));
    line(fmt::format("(LOG,{},{},{},#5061,#5062,#5063)", t.a, t.c, t.point));
  }
  void end() override {
    line("(LOGCLOSE)");
    line("M2");
  }
};

// DPRNT has no commas: fields are separated by blanks, decimals are counted.
class FanucText : public ProbingText {
 public:
  void begin() override {
    line("%");
    line(fmt::format("O5007 ({})", kTitle));
    line(fmt::format("(G54: {})", kSetUp));
    line("G21 G17 G90 G94 G40 G80 G49");
    line("T1 M6");
    line("G54 G43 H1");
    line("POPEN");
    line("DPRNT[A*C*POINT*BALLX*BALLY*BALLZ]");
  }
  [[nodiscard]] std::string word(char axis, double value) const override {
    return with_point(ProbingText::word(axis, value));
  }
  [[nodiscard]] std::string turn(char axis, const std::string& degrees) const override {
    return with_point(ProbingText::turn(axis, degrees));
  }
  void probe(const ProgrammedTouch& t) override {
    line(fmt::format("G31 {} F{:g}", words(t.end), kFeed));
    line(fmt::format("DPRNT[{}*{}*{}*#5061[44]*#5062[44]*#5063[44]]", t.a, t.c, t.point));
  }
  void end() override {
    line("PCLOS");
    line("G49");
    line("M30");
    line("%");
  }

 private:
  static std::string with_point(std::string text) {
    return text.find('.') == std::string::npos ? text + "." : text;
  }
};

class SinumerikText : public ProbingText {
 public:
  void begin() override {
    line(fmt::format("; {}", kTitle));
    line(fmt::format("; G54: {}", kSetUp));
    line("DEF INT _FAILED");
    line("G710 G17 G90 G94 G40 G54");
    line("T1");
    line("M6");
    line("D1");
    line(fmt::format("WRITE(_FAILED,\"touches.csv\",\"{}\")", kColumns));
  }
  void probe(const ProgrammedTouch& t) override {
    line(fmt::format("MEAS=1 G1 {} F{:g}", words(t.end), kFeed));
    line("STOPRE");
    line("IF $AC_MEA[1]==0");
    line(fmt::format("SETAL(65000,\"NO TOUCH OF POINT {}\")", t.point));
    line("ENDIF");
    line(
        fmt::format("WRITE(_FAILED,\"touches.csv\",\"{},{},{},\"<<$AA_MW[X]<<\",\"<<$AA_MW[Y]<<"
                    "\",\"<<$AA_MW[Z])",
                    t.a, t.c, t.point));
  }
  void end() override { line("M30"); }
};

class KlartextText : public ProbingText {
 public:
  void begin() override {
    line("BEGIN PGM TOUCH MM");
    line(fmt::format("; {}", kTitle));
    line(fmt::format("; DATUM 1: {}", kSetUp));
    line("TOOL CALL 1 Z");
    line("CYCL DEF 247 DATUM SETTING Q339=+1");
  }
  void rapid(const std::string& words) override { line("L " + words + " R0 FMAX"); }
  [[nodiscard]] std::string word(char axis, double value) const override {
    return fmt::format("{}{}{}", axis, value < 0.0 ? "" : "+", fixed_decimal(value, 6));
  }
  [[nodiscard]] std::string turn(char axis, const std::string& degrees) const override {
    return fmt::format("{}{}{}", axis, degrees.starts_with('-') ? "" : "+", degrees);
  }
  void probe(const ProgrammedTouch& t) override {
    const Vec3 way = t.end - t.approach;
    line("TCH PROBE 4.0 MEASURING IN 3-D");
    line("TCH PROBE 4.1 Q1");
    line(fmt::format("TCH PROBE 4.2 I{} I{} I{}", word('X', way.x()), word('Y', way.y()),
                     word('Z', way.z())));
    line(fmt::format("TCH PROBE 4.3 DIST+{:g} F{:g} MB+{:g} REFERENCE SYSTEM:0", way.norm(), kFeed,
                     kTouchApproach));
    line("FN 0: Q11 = " + t.a);
    line("FN 0: Q12 = " + t.c);
    line(fmt::format("FN 0: Q13 = {}", t.point));
    line("FN 16: F-PRINT touch.a / touches.csv");
  }
  void end() override {
    line("M30");
    line("END PGM TOUCH MM");
  }

 protected:
  void line(const std::string& text) override {
    ProbingText::line(fmt::format("{} {}", number_++, text));
  }

 private:
  int number_ = 0;
};

std::unique_ptr<ProbingText> text_of(Dialect dialect) {
  switch (dialect) {
    case Dialect::fanuc:
      return std::make_unique<FanucText>();
    case Dialect::sinumerik:
      return std::make_unique<SinumerikText>();
    case Dialect::heidenhain:
      return std::make_unique<KlartextText>();
    default:
      return std::make_unique<LinuxCncText>();
  }
}

std::string degrees(const TablePosition& position) {
  return shortest_decimal(as_stated(position.axis * kDegPerRad));
}

}  // namespace

std::string touch_program(const TouchPlan& plan, const TouchProbe& probe, Dialect dialect) {
  const double safe = column_reach() + probe.ball_radius + kAbove;
  const auto out = text_of(dialect);
  out->begin();
  const std::string up = out->word('Z', safe);
  const PlannedTouch* before = nullptr;
  for (const PlannedTouch& planned : plan.touches) {
    const TouchPoint& point = touch_points().at(planned.point);
    const Mat3 rotation = plan.rotation(planned);
    const Vec3 normal = rotation * point.normal;
    const Vec3 contact = rotation * point.place + probe.ball_radius * normal;
    const ProgrammedTouch touch{
        degrees(plan.tilts[planned.tilt]), degrees(plan.turns[planned.turn]), planned.point,
        contact + kTouchApproach * normal, contact - kTouchApproach * normal};
    if (before == nullptr || before->tilt != planned.tilt || before->turn != planned.turn) {
      out->rapid(up);
      out->rapid(out->turn('A', touch.a) + " " + out->turn('C', touch.c));
    }
    out->rapid(out->word('X', touch.approach.x()) + " " + out->word('Y', touch.approach.y()));
    out->rapid(out->word('Z', touch.approach.z()));
    out->probe(touch);
    out->rapid(out->words(touch.approach));
    out->rapid(up);
    before = &planned;
  }
  out->end();
  return out->take();
}

std::string touch_mask() {
  return "M_APPEND;\n\"%.4F,%.4F,%.0F,%.4F,%.4F,%.4F\",Q11,Q12,Q13,Q1,Q2,Q3;\n";
}

}  // namespace frustum::instruments

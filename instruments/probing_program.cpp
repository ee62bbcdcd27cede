#include "instruments/probing_program.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <memory>

#include "core/decimal.hpp"
#include "core/units.hpp"

namespace frustum::instruments {
namespace {

using parser::Dialect;

constexpr double kFeed = 100.0;  // mm/min, as touches are slow

std::string degrees_of(double angle) { return shortest_decimal(as_stated(angle * kDegPerRad)); }

// What differs among the controls.
class ProbingText {
 public:
  virtual ~ProbingText() = default;
  explicit ProbingText(const ProbingProgram& program) : program_(program) {}
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
  [[nodiscard]] virtual std::string turn(char axis, double angle) const {
    return fmt::format("{}{}", axis, degrees_of(angle));
  }
  [[nodiscard]] std::string words(const Vec3& p) const {
    return word('X', p.x()) + " " + word('Y', p.y()) + " " + word('Z', p.z());
  }
  [[nodiscard]] std::string turns(const ProgrammedTouch& touch) const {
    std::string words;
    for (std::size_t k = 0; k < program_.rotary.size(); ++k) {
      words += (k > 0 ? " " : "") + turn(program_.rotary[k], touch.turned[k]);
    }
    return words;
  }

 protected:
  virtual void line(const std::string& text) { text_ += text + "\n"; }
  [[nodiscard]] const ProbingProgram& program() const { return program_; }
  // "A_deg,C_deg,point,ball_x_mm,ball_y_mm,ball_z_mm"
  [[nodiscard]] std::string columns() const {
    std::string text;
    for (const char axis : program_.rotary) text += fmt::format("{}_deg,", axis);
    return text + "point,ball_x_mm,ball_y_mm,ball_z_mm";
  }
  // What is known of a touch before it is made: positions and number, each with `after` it.
  [[nodiscard]] static std::string known(const ProgrammedTouch& touch, char after) {
    std::string text;
    for (const double angle : touch.turned) text += degrees_of(angle) + after;
    return text + fmt::format("{}{}", touch.point, after);
  }

 private:
  const ProbingProgram& program_;
  std::string text_{};
};

class LinuxCncText : public ProbingText {
 public:
  using ProbingText::ProbingText;
  void begin() override {
    line(fmt::format("({})", program().title));
    line(fmt::format("(G54: {})", program().origin));
    line("G21 G17 G90 G94 G40 G80 G54");
    line("T1 M6");
    line("G43 H1");
    line("(LOGOPEN,touches.csv)");
    line(fmt::format("(LOG,{})", columns()));
  }
  void probe(const ProgrammedTouch& t) override {
    line(fmt::format("G38.2 {} F{:g}", words(t.end), kFeed));
    line(fmt::format("(LOG,{}#5061,#5062,#5063)", known(t, ',')));
  }
  void end() override {
    line("(LOGCLOSE)");
    line("G49");
    line("M2");
  }
};

// DPRNT has no commas: fields are separated by blanks, decimals are counted.
class FanucText : public ProbingText {
 public:
  using ProbingText::ProbingText;
  void begin() override {
    line("%");
    line(fmt::format("O{} ({})", program().number, program().title));
    line(fmt::format("(G54: {})", program().origin));
    line("G21 G17 G90 G94 G40 G80 G49");
    line("T1 M6");
    line("G54 G43 H1");
    line("POPEN");
    std::string fields;
    for (const char axis : program().rotary) fields += fmt::format("{}*", axis);
    line(fmt::format("DPRNT[{}POINT*BALLX*BALLY*BALLZ]", fields));
  }
  [[nodiscard]] std::string word(char axis, double value) const override {
    return with_point(ProbingText::word(axis, value));
  }
  [[nodiscard]] std::string turn(char axis, double angle) const override {
    return with_point(ProbingText::turn(axis, angle));
  }
  void probe(const ProgrammedTouch& t) override {
    line(fmt::format("G31 {} F{:g}", words(t.end), kFeed));
    line(fmt::format("DPRNT[{}#5061[44]*#5062[44]*#5063[44]]", known(t, '*')));
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
  using ProbingText::ProbingText;
  void begin() override {
    line(fmt::format("; {}", program().title));
    line(fmt::format("; G54: {}", program().origin));
    line("DEF INT _FAILED");
    line("G710 G17 G90 G94 G40 G54");
    line("T1");
    line("M6");
    line("D1");
    line(fmt::format("WRITE(_FAILED,\"touches.csv\",\"{}\")", columns()));
  }
  void probe(const ProgrammedTouch& t) override {
    line(fmt::format("MEAS=1 G1 {} F{:g}", words(t.end), kFeed));
    line("STOPRE");
    line("IF $AC_MEA[1]==0");
    line(fmt::format("SETAL(65000,\"NO TOUCH OF POINT {}\")", t.point));
    line("ENDIF");
    line(fmt::format(
        "WRITE(_FAILED,\"touches.csv\",\"{}\"<<$AA_MW[X]<<\",\"<<$AA_MW[Y]<<\",\"<<$AA_MW[Z])",
        known(t, ',')));
  }
  void end() override { line("M30"); }
};

// Q11 and on: the rotary axes; Q13: the number.
class KlartextText : public ProbingText {
 public:
  using ProbingText::ProbingText;
  void begin() override {
    line(fmt::format("BEGIN PGM {} MM", capitals()));
    line(fmt::format("; {}", program().title));
    line(fmt::format("; DATUM 1: {}", program().origin));
    line("TOOL CALL 1 Z");
    line("CYCL DEF 247 DATUM SETTING Q339=+1");
  }
  void rapid(const std::string& words) override { line("L " + words + " R0 FMAX"); }
  [[nodiscard]] std::string word(char axis, double value) const override {
    return fmt::format("{}{}{}", axis, value < 0.0 ? "" : "+", fixed_decimal(value, 6));
  }
  [[nodiscard]] std::string turn(char axis, double angle) const override {
    const std::string degrees = degrees_of(angle);
    return fmt::format("{}{}{}", axis, degrees.starts_with('-') ? "" : "+", degrees);
  }
  void probe(const ProgrammedTouch& t) override {
    const Vec3 way = t.end - t.approach;
    line("TCH PROBE 4.0 MEASURING IN 3-D");
    line("TCH PROBE 4.1 Q1");
    line(fmt::format("TCH PROBE 4.2 I{} I{} I{}", word('X', way.x()), word('Y', way.y()),
                     word('Z', way.z())));
    line(fmt::format("TCH PROBE 4.3 DIST+{:g} F{:g} MB+{:g} REFERENCE SYSTEM:0", way.norm(), kFeed,
                     program().back));
    for (std::size_t k = 0; k < t.turned.size(); ++k) {
      line(fmt::format("FN 0: Q{} = {}", 11 + k, degrees_of(t.turned[k])));
    }
    line(fmt::format("FN 0: Q13 = {}", t.point));
    line(fmt::format("FN 16: F-PRINT {}.a / touches.csv", program().name));
  }
  void end() override {
    line("M30");
    line(fmt::format("END PGM {} MM", capitals()));
  }

 protected:
  void line(const std::string& text) override {
    ProbingText::line(fmt::format("{} {}", number_++, text));
  }

 private:
  [[nodiscard]] std::string capitals() const {
    std::string name = program().name;
    std::ranges::transform(name, name.begin(),
                           [](char c) { return c >= 'a' && c <= 'z' ? char(c - 'a' + 'A') : c; });
    return name;
  }
  int number_ = 0;
};

std::unique_ptr<ProbingText> text_of(const ProbingProgram& program, Dialect dialect) {
  switch (dialect) {
    case Dialect::fanuc:
      return std::make_unique<FanucText>(program);
    case Dialect::sinumerik:
      return std::make_unique<SinumerikText>(program);
    case Dialect::heidenhain:
      return std::make_unique<KlartextText>(program);
    default:
      return std::make_unique<LinuxCncText>(program);
  }
}

}  // namespace

std::string probing_text(const ProbingProgram& program, Dialect dialect) {
  const auto out = text_of(program, dialect);
  out->begin();
  const std::string up = out->word('Z', program.safe);
  const std::string over = out->word('Z', std::max(program.safe, program.turning));
  const ProgrammedTouch* before = nullptr;
  for (const ProgrammedTouch& touch : program.touches) {
    if (before == nullptr || before->turned != touch.turned) {
      out->rapid(over);
      if (!program.rotary.empty()) out->rapid(out->turns(touch));
    }
    out->rapid(out->word('X', touch.approach.x()) + " " + out->word('Y', touch.approach.y()));
    out->rapid(out->word('Z', touch.approach.z()));
    out->probe(touch);
    out->rapid(out->words(touch.approach));
    out->rapid(up);
    before = &touch;
  }
  out->end();
  return out->take();
}

std::string probing_mask(const ProbingProgram& program) {
  std::string formats, parameters;
  for (std::size_t k = 0; k < program.rotary.size(); ++k) {
    formats += "%.4F,";
    parameters += fmt::format("Q{},", 11 + k);
  }
  return fmt::format("M_APPEND;\n\"{}%.0F,%.4F,%.4F,%.4F\",{}Q13,Q1,Q2,Q3;\n", formats, parameters);
}

}  // namespace frustum::instruments

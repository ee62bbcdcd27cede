// The parameters of a program: numbered (#1 .. #99999) and named (#<feed>), each set or not.
//
// The first numbers and the names that do not begin with _ belong to the subprogram at work: a call
// begins with its arguments and none of its caller's. All others are of the whole program.
// Units: as the program wrote them; a parameter has no unit until a word uses it.
// Errors: reading a parameter that was never set, or a number that no parameter has.
#pragma once

#include <cmath>
#include <limits>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <unordered_map>
#include <utility>
#include <vector>

#include "core/result.hpp"
#include "parser/language/variable_kind.hpp"

namespace frustum::parser {

constexpr int kMaxParameterNumber = 99999;

struct ParameterRules {
  int locals = 0;             // #1 up to this number belong to the subprogram
  bool named_locals = false;  // so do names without _ before them
  // Names that begin so belong to the program file at work (Klartext's QL); all other names are of
  // the whole run.
  std::string_view local_names{};
  bool unset_is_zero = false;  // a number that was never set reads as 0
  // A number that was never set is vacant, as #0 is: 0 in a computation, equal to nothing but
  // vacant ones, and a word of that value is not given at all (Custom Macro).
  bool unset_is_vacant = false;
  // What only the machine knows is read all the same, as a vacant value that makes all that is
  // computed from it vacant; what needs the value is an error (LinuxCNC).
  bool values_may_be_unknown = false;
  // A condition of what only the machine knows does not hold, as an assumption.
  bool conditions_may_be_unknown = false;
  // From the first number to the last they are the controller's own: the values of those that it
  // does not keep only the machine knows. 0: none are.
  int first_system = 0;
  int last_system = kMaxParameterNumber;
  // Numbers from the first to the last keep what they were set to when the power is off. 0: none.
  int first_stored = 0;
  int last_stored = 0;
  char prefix = '#';  // how numbers are spelled
  int first = 1;
  int last = kMaxParameterNumber;
  // R5 names the number 5; other names are set only when they were defined (Sinumerik).
  bool names_are_defined = false;

  [[nodiscard]] constexpr bool is_system(int number) const {
    return first_system != 0 && number >= first_system && number <= last_system;
  }
};

// The parameters that a controller keeps itself; no value for what it does not keep, NaN for what
// it keeps and the program cannot know.
class KeptParameters {
 public:
  KeptParameters() = default;
  KeptParameters(const KeptParameters&) = default;
  KeptParameters& operator=(const KeptParameters&) = default;
  virtual ~KeptParameters() = default;
  [[nodiscard]] virtual std::optional<double> number(int index) const = 0;
  [[nodiscard]] virtual std::optional<double> named(std::string_view name) const = 0;
};

// A vacant parameter among numbers.
constexpr double kVacant = std::numeric_limits<double>::quiet_NaN();
[[nodiscard]] inline bool is_vacant(double value) { return std::isnan(value); }

// Texts are values like numbers, which stand for them, and so are the values of system variables
// that only the machine knows. Both are beyond the numbers that words can have.
constexpr double kFirstText = 8e15;
constexpr double kFirstUnknown = 8.5e15;
[[nodiscard]] constexpr bool is_symbol(double value) { return value >= kFirstText && value < 9e15; }
[[nodiscard]] constexpr bool is_text(double value) {
  return value >= kFirstText && value < kFirstUnknown;
}
[[nodiscard]] constexpr bool is_unknown(double value) {
  return value >= kFirstUnknown && value < 9e15;
}

class Parameters {
 public:
  explicit Parameters(const ParameterRules& rules = {}, const KeptParameters* system = nullptr)
      : rules_(rules), system_(system) {}

  [[nodiscard]] Result<double> read(double number) const;
  [[nodiscard]] Result<double> read(std::string_view name) const;
  // One that the machine has stored, maybe, was read before the program set it.
  [[nodiscard]] std::optional<int> take_stored_read() const {
    return std::exchange(stored_read_, std::nullopt);
  }
  // An angle, in degrees, that another setting of the control gives a full turn less.
  void note_angle_from_zero(double angle) const { angle_from_zero_ = angle; }
  [[nodiscard]] std::optional<double> take_angle_from_zero() const {
    return std::exchange(angle_from_zero_, std::nullopt);
  }
  [[nodiscard]] bool has(std::string_view name) const;
  // Whether there is a parameter of that number; where numbers are vacant until set, a set one.
  [[nodiscard]] bool has(double number) const;
  // The number as an index, when a parameter of that number can exist.
  [[nodiscard]] static Result<int> index_of(double number, const ParameterRules& rules = {});

  void set(int index, double value) { numbered(index)[index] = value; }
  void set(std::string_view name, double value);
  // A variable of the subprogram at work, which keeps its kind: whole numbers are rounded.
  void define(std::string_view name, VariableKind kind, double value);
  [[nodiscard]] bool can_set(std::string_view name) const;
  // An array of the subprogram at work, each element of that value.
  void define_array(std::string_view name, VariableKind kind, std::vector<std::size_t> dimensions,
                    double value);
  // The place of an element in its array; that of a text variable's length is left out.
  [[nodiscard]] Result<std::size_t> place_in(std::string_view name,
                                             std::span<const double> indices) const;
  [[nodiscard]] Result<double> read_element(std::string_view name,
                                            std::span<const double> indices) const;
  // Whether the array has that place.
  [[nodiscard]] bool set_element(std::string_view name, std::size_t place, double value);
  // An array of the caller, under another name, and back; false when it is not there, has another
  // number of indices, or other sizes than those given (0: any).
  [[nodiscard]] bool take_array(std::string_view from, std::string_view name,
                                std::span<const std::size_t> sizes);
  void give_array_back(std::string_view name, std::string_view to);
  // How many elements it has; 0 when there is no such array.
  [[nodiscard]] std::size_t size_of(std::string_view name) const;
  // The name of a system variable with its indices: $TC_DP6[1,1].
  [[nodiscard]] static std::string name_of_element(std::string_view name,
                                                   std::span<const double> indices);

  // The value that stands for a text, or for what only the machine knows, and back.
  [[nodiscard]] double text_value(std::string_view text) const;
  [[nodiscard]] double unknown_value(std::string_view name) const;
  [[nodiscard]] const std::string& text_of(double symbol) const;
  [[nodiscard]] const ParameterRules& rules() const { return rules_; }

  // A call: #1, #2, .. are `arguments` until the matching leave().
  void enter(std::span<const double> arguments);
  void leave();

 private:
  using Numbered = std::unordered_map<int, double>;
  using Named = std::map<std::string, double, std::less<>>;
  struct Array {
    VariableKind kind = VariableKind::real;
    std::vector<std::size_t> dimensions{};
    std::vector<double> values{};
  };
  struct Locals {
    std::map<std::string, Array, std::less<>> arrays{};
    Numbered numbered{};
    Named named{};
    std::map<std::string, VariableKind, std::less<>> kinds{};
  };
  [[nodiscard]] const Array* array_of(std::string_view name) const;
  // The number that a name such as R5 represents.
  [[nodiscard]] std::optional<double> number_in(std::string_view name) const;
  [[nodiscard]] bool is_local(int index) const { return index <= rules_.locals; }
  [[nodiscard]] bool is_local(std::string_view name) const {
    if (!rules_.local_names.empty()) return name.starts_with(rules_.local_names);
    if (name.starts_with('$')) return false;
    return rules_.named_locals && (rules_.names_are_defined || !name.starts_with('_'));
  }
  [[nodiscard]] Numbered& numbered(int index) {
    return is_local(index) ? locals_.back().numbered : numbered_;
  }
  [[nodiscard]] const Numbered& numbered(int index) const {
    return is_local(index) ? locals_.back().numbered : numbered_;
  }
  [[nodiscard]] Named& named(std::string_view name) {
    return is_local(name) ? locals_.back().named : named_;
  }
  [[nodiscard]] const Named& named(std::string_view name) const {
    return is_local(name) ? locals_.back().named : named_;
  }

  ParameterRules rules_;
  const KeptParameters* system_;
  // Texts and names that values stand for. Reading an expression may add one.
  mutable std::map<std::string, std::size_t, std::less<>> symbol_numbers_{};
  mutable std::vector<const std::string*> symbols_{};
  mutable std::optional<int> stored_read_{};
  mutable std::optional<double> angle_from_zero_{};
  Numbered numbered_{};
  Named named_{};
  std::vector<Locals> locals_{
      1};  // of the main program and the subprograms at work, innermost last
};

}  // namespace frustum::parser

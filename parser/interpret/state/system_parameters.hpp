// The parameters that a controller keeps itself: where the tool is, which modes are on.
//
//   LinuxCNC   #<_x>, #<_feed>, #<_motion_mode>, ..., #5420 to #5425
//   Fanuc #5001 to #5006 (end of the last block), #5041 to #5046 (the same without tool length),
//              #4001 to #4130 (modes), #1000 to #1035 (inputs)
// and the data of control_data.hpp.
//
// Units : positions in the program's own unit (mm or inch) and degrees, feeds per minute in it
// Errors: none; no value for what is not such a parameter, or for a position that is not known; NaN
//         for data that only the setup knows
#pragma once

#include <optional>
#include <string_view>
#include <vector>

#include "parser/dialect.hpp"
#include "parser/interpret/state/modal_state.hpp"
#include "parser/interpret/state/program_position.hpp"
#include "parser/language/parameters.hpp"

namespace frustum::parser {

// A value that the control or the machine decides, and how it is taken.
struct AssumedValue {
  std::string_view name{};
  std::string_view text{};
};

extern const AssumedValue kStartUnit;

class SystemParameters final : public KeptParameters {
 public:
  SystemParameters(Dialect of, const ModalState& modes, const ProgramPosition& place,
                   const ControlData& kept)
      : dialect(of), state(modes), position(place), data(kept) {}

  [[nodiscard]] std::optional<double> number(int index) const override;
  [[nodiscard]] std::optional<double> named(std::string_view name) const override;
  // Whether a program may not set the name.
  [[nodiscard]] bool keeps(std::string_view name) const;

  // A length, or a feed in lengths, counts in the unit in force: an assumption where none is known.
  void read_by_unit(double value) const;

  Dialect dialect;
  const ModalState& state;
  const ProgramPosition& position;
  const ControlData& data;
  int call_level = 0;
  // What has been read of values that are assumed, until it is told.
  mutable std::vector<const AssumedValue*> assumed{};
};

// Of Klartext: the preassigned Q parameters and what FN 18 reads (klartext_data.cpp).
[[nodiscard]] std::optional<double> klartext_variable(const SystemParameters& of,
                                                      std::string_view name);

}  // namespace frustum::parser

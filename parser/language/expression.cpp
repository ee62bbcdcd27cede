#include "parser/language/expression.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>
#include <optional>

#include "core/decimal.hpp"
#include "core/units.hpp"

namespace frustum::parser {
namespace {

constexpr double kMostBits = 2147483648.0;  // 32 of them, one the sign
constexpr double kMostDigits = 99'999'999.0;
constexpr double kDegreesOfTurn = 360.0;
bool has_bits(double value) {
  return value == std::floor(value) && value >= -kMostBits && value < kMostBits;
}
std::uint32_t bits_of(double value) {
  return static_cast<std::uint32_t>(static_cast<std::int64_t>(value));
}
double of_bits(std::uint32_t bits) { return static_cast<std::int32_t>(bits); }

// Four bits a decimal digit.
double to_bcd(double value) {
  auto rest = static_cast<std::uint32_t>(value);
  std::uint32_t coded = 0;
  for (unsigned shift = 0; rest != 0; shift += 4, rest /= 10) coded |= (rest % 10) << shift;
  return coded;
}
double from_bcd(double value) {
  auto rest = static_cast<std::uint32_t>(value);
  double decoded = 0.0;
  for (double place = 1.0; rest != 0; place *= 10.0, rest >>= 4U) decoded += place * (rest & 15U);
  return decoded;
}
bool is_bcd(double value) {
  if (value != std::floor(value) || value < 0.0 || value >= 2.0 * kMostBits) return false;
  for (auto rest = static_cast<std::uint32_t>(value); rest != 0; rest >>= 4U) {
    if ((rest & 15U) > 9) return false;
  }
  return true;
}

struct Domain {
  bool holds;
  DiagnosticId id;
  const char* message;  // {0}, {1}: the operands
  const char* hint;
};

// What the operands must satisfy, or nothing when every number will do.
std::optional<Domain> domain_of(Operation operation, double a, double b) {
  switch (operation) {
    case Operation::divide:
      return Domain{b != 0.0, "division-by-zero"_id, "division of {0} by zero",
                    "check the divisor before dividing"};
    case Operation::whole_quotient:
      return Domain{b != 0.0, "division-by-zero"_id, "{0} DIV zero",
                    "check the divisor before DIV"};
    case Operation::modulo:
      return Domain{b != 0.0, "division-by-zero"_id, "{0} MOD zero",
                    "check the divisor before MOD"};
    case Operation::power:
      return Domain{!(a < 0.0 && b != std::floor(b)) && !(a == 0.0 && b < 0.0),
                    "function-domain"_id, "{0} ** {1} has no real value",
                    "a negative base needs a whole exponent, zero one that is not negative"};
    case Operation::arc_sine:
    case Operation::arc_sine_from_zero:
      return Domain{std::abs(a) <= 1.0, "function-domain"_id, "ASIN of {0}",
                    "its argument is between -1 and 1"};
    case Operation::arc_cosine:
      return Domain{std::abs(a) <= 1.0, "function-domain"_id, "ACOS of {0}",
                    "its argument is between -1 and 1"};
    case Operation::square_root:
      return Domain{a >= 0.0, "function-domain"_id, "SQRT of {0}",
                    "its argument must not be negative"};
    case Operation::logarithm:
      return Domain{a > 0.0, "function-domain"_id, "LN of {0}", "its argument must be positive"};
    case Operation::common_logarithm:
      return Domain{a > 0.0, "function-domain"_id, "LOG of {0}", "its argument must be positive"};
    case Operation::remainder:
      return Domain{std::round(b) != 0.0, "division-by-zero"_id, "{0} MOD zero",
                    "check the divisor before MOD"};
    case Operation::bit_and:
    case Operation::bit_or:
    case Operation::bit_xor:
      return Domain{
          has_bits(a) && has_bits(b), "function-domain"_id, "the bits of {0} and {1}",
          "AND, OR and XOR combine the bits of whole numbers of 32 bits; round them before"};
    case Operation::to_bcd:
      return Domain{a == std::floor(a) && a >= 0.0 && a <= kMostDigits, "function-domain"_id,
                    "BCD of {0}", "its argument is a whole number from 0 to 99999999"};
    case Operation::from_bcd:
      return Domain{is_bcd(a), "function-domain"_id, "BIN of {0}",
                    "each four bits of its argument are a digit up to 9"};
    default:
      return std::nullopt;
  }
}

double modulo(double a, double b) {
  const double rest = std::fmod(a, b);
  return rest < 0.0 ? rest + std::abs(b) : rest;
}

// RS-274 compares within this.
constexpr double kSame = 1e-4;
bool same(double a, double b) { return std::abs(a - b) < kSame; }

double from_zero(double degrees) { return degrees < 0.0 ? degrees + kDegreesOfTurn : degrees; }

double apply(Operation operation, double a, double b) {
  switch (operation) {
    case Operation::negate:
      return -a;
    case Operation::add:
      return a + b;
    case Operation::subtract:
      return a - b;
    case Operation::multiply:
      return a * b;
    case Operation::divide:
      return a / b;
    case Operation::power:
      return std::pow(a, b);
    case Operation::modulo:
      return modulo(a, b);
    case Operation::whole_quotient:
      return std::trunc(a / b);
    case Operation::equal:
      return same(a, b) ? 1.0 : 0.0;
    case Operation::not_equal:
      return same(a, b) ? 0.0 : 1.0;
    case Operation::greater:
      return a > b ? 1.0 : 0.0;
    case Operation::greater_or_equal:
      return a >= b ? 1.0 : 0.0;
    case Operation::less:
      return a < b ? 1.0 : 0.0;
    case Operation::less_or_equal:
      return a <= b ? 1.0 : 0.0;
    case Operation::logical_and:
      return a != 0.0 && b != 0.0 ? 1.0 : 0.0;
    case Operation::logical_or:
      return a != 0.0 || b != 0.0 ? 1.0 : 0.0;
    case Operation::logical_xor:
      return (a != 0.0) != (b != 0.0) ? 1.0 : 0.0;
    case Operation::sine:
      return std::sin(a * kRadPerDeg);
    case Operation::cosine:
      return std::cos(a * kRadPerDeg);
    case Operation::tangent:
      return std::tan(a * kRadPerDeg);
    case Operation::arc_sine:
      return std::asin(a) * kDegPerRad;
    case Operation::arc_cosine:
      return std::acos(a) * kDegPerRad;
    case Operation::arc_tangent:
      return std::atan2(a, b) * kDegPerRad;
    case Operation::arc_sine_from_zero:
      return from_zero(std::asin(a) * kDegPerRad);
    case Operation::arc_tangent_from_zero:
      return from_zero(std::atan2(a, b) * kDegPerRad);
    case Operation::square_root:
      return std::sqrt(a);
    case Operation::absolute:
      return std::abs(a);
    case Operation::round:
      return std::round(a);
    case Operation::fix:
      return std::floor(a);
    case Operation::fup:
      return std::ceil(a);
    case Operation::least:
      return std::min(a, b);
    case Operation::greatest:
      return std::max(a, b);
    case Operation::logarithm:
      return std::log(a);
    case Operation::exponential:
      return std::exp(a);
    case Operation::bit_and:
      return of_bits(bits_of(a) & bits_of(b));
    case Operation::bit_or:
      return of_bits(bits_of(a) | bits_of(b));
    case Operation::bit_xor:
      return of_bits(bits_of(a) ^ bits_of(b));
    case Operation::remainder:
      return std::fmod(std::round(a), std::round(b)) + 0.0;
    case Operation::truncate:
      return std::trunc(a) + 0.0;
    case Operation::round_away:
      return (a < 0.0 ? std::floor(a) : std::ceil(a)) + 0.0;
    case Operation::from_bcd:
      return from_bcd(a);
    case Operation::to_bcd:
      return to_bcd(a);
    case Operation::square:
      return a * a;
    case Operation::fraction:
      return a - std::trunc(a);
    case Operation::sign:
      return a > 0.0 ? 1.0 : a < 0.0 ? -1.0 : 0.0;
    case Operation::common_logarithm:
      return std::log10(a);
    case Operation::as_it_is:
    case Operation::text:
    case Operation::join:
    case Operation::element:
    case Operation::number:
    case Operation::parameter:
    case Operation::named_parameter:
    case Operation::exists:
    case Operation::exists_number:
      break;
  }
  return a;
}

constexpr bool takes_two(Operation operation) {
  return (operation >= Operation::add && operation <= Operation::remainder) ||
         operation == Operation::arc_tangent || operation == Operation::arc_tangent_from_zero ||
         operation == Operation::least || operation == Operation::greatest ||
         operation == Operation::join;
}

constexpr bool is_from_zero(Operation operation) {
  return operation == Operation::arc_sine_from_zero ||
         operation == Operation::arc_tangent_from_zero;
}

Diagnostic at_column(Diagnostic diagnostic, std::uint32_t column) {
  diagnostic.column = static_cast<int>(column);
  return diagnostic;
}

// Of a text as it is, of a number its digits.
std::string joined_text(const Parameters& parameters, double value) {
  return is_text(value) ? parameters.text_of(value) : shortest_decimal(value);
}

// Where an operand is a text or unknown.
Result<double> apply_to_symbols(const Parameters& parameters, Operation operation, double a,
                                double b) {
  if (is_unknown(a)) return a;
  if (is_unknown(b)) return b;
  if (operation == Operation::join) {
    return parameters.text_value(joined_text(parameters, a) + joined_text(parameters, b));
  }
  if (operation == Operation::equal) return a == b ? 1.0 : 0.0;
  if (operation == Operation::not_equal) return a == b ? 0.0 : 1.0;
  return error("wrong-type"_id,
               "a computation with the text \"" + parameters.text_of(is_text(a) ? a : b) + "\"",
               "texts can be compared by == and <> and joined by <<");
}

}  // namespace

Result<double> evaluate(const ExpressionContext& context, ExpressionRange range) {
  // Each open bracket holds at most eight pending operands: two indices, of ATAN, a logical term, a
  // comparison, a sum, a product, a power.
  std::array<double, 8 * (kMaxExpressionDepth + 2)> stack;  // NOLINT: written before it is read
  std::size_t top = 0;
  for (const ExpressionStep& step : context.steps.subspan(range.first, range.count)) {
    if (step.operation == Operation::number) {
      stack[top++] = step.number;
      continue;
    }
    if (step.operation == Operation::named_parameter) {
      auto value = context.parameters.read(context.names[static_cast<std::size_t>(step.number)]);
      if (!value) return at_column(value.error().front(), step.column);
      stack[top++] = *value;
      continue;
    }
    if (step.operation == Operation::exists) {
      const bool set = context.parameters.has(context.names[static_cast<std::size_t>(step.number)]);
      stack[top++] = set ? 1.0 : 0.0;
      continue;
    }
    if (step.operation == Operation::exists_number) {
      stack[top - 1] = context.parameters.has(stack[top - 1]) ? 1.0 : 0.0;
      continue;
    }
    if (step.operation == Operation::text) {
      stack[top++] =
          context.parameters.text_value(context.names[static_cast<std::size_t>(step.number)]);
      continue;
    }
    if (step.operation == Operation::element) {
      const std::uint32_t indices = indices_of_element(step);
      top -= indices;
      auto value =
          context.parameters.read_element(context.names[name_of_element(step)],
                                          std::span<const double>(stack).subspan(top, indices));
      if (!value) return at_column(value.error().front(), step.column);
      stack[top++] = *value;
      continue;
    }
    if (step.operation == Operation::parameter) {
      auto value = context.parameters.read(stack[top - 1]);
      if (!value) return at_column(value.error().front(), step.column);
      stack[top - 1] = *value;
      continue;
    }
    double b = takes_two(step.operation) ? stack[--top] : 0.0;
    double a = stack[top - 1];
    if (is_vacant(a) || is_vacant(b)) {
      if (context.parameters.rules().values_may_be_unknown) {
        stack[top - 1] = kVacant;
        continue;
      }
      const bool asks =
          step.operation == Operation::equal || step.operation == Operation::not_equal;
      if (asks) {
        const bool both = is_vacant(a) && is_vacant(b);
        stack[top - 1] = both == (step.operation == Operation::equal) ? 1.0 : 0.0;
        continue;
      }
      if (is_vacant(a)) a = 0.0;
      if (is_vacant(b)) b = 0.0;
    }
    if (is_symbol(a) || is_symbol(b) || step.operation == Operation::join) {
      const auto value = apply_to_symbols(context.parameters, step.operation, a, b);
      if (!value) return at_column(value.error().front(), step.column);
      stack[top - 1] = *value;
      continue;
    }
    if (const auto domain = domain_of(step.operation, a, b); domain && !domain->holds) {
      return at_column(error(domain->id,
                             fmt::format(fmt::runtime(domain->message), shortest_decimal(a),
                                         shortest_decimal(b)),
                             domain->hint),
                       step.column);
    }
    const double steps = step.operation == Operation::round ? context.steps_of_unit : 1.0;
    stack[top - 1] = apply(step.operation, a * steps, b) / steps;
    if (is_from_zero(step.operation) && stack[top - 1] > kDegreesOfTurn / 2.0) {
      context.parameters.note_angle_from_zero(stack[top - 1]);
    }
    if (!std::isfinite(stack[top - 1])) {
      return at_column(error("number-too-large"_id, "the result is too large for a number",
                             "check the operands"),
                       step.column);
    }
  }
  return stack[0];
}

}  // namespace frustum::parser

// Subprograms by name: their calls, arguments and ends.
#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "parser/interpret/cycles/hole_call.hpp"
#include "parser/interpret/program_run.hpp"
#include "parser/interpret/saved_modes.hpp"
#include "parser/interpret/state/word_values.hpp"

namespace frustum::parser {
namespace {

constexpr std::size_t kMaxArguments = 30;
constexpr double kMostElements = 1e6;  // more than any array has
constexpr const char* kEndOfLabel = "LBL 0";

std::string unlabelled(std::string_view kind, const std::string& label) {
  return label.empty() ? std::string(kind) : fmt::format("{} {}", kind, label);
}

}  // namespace

ProgramRun::Failure ProgramRun::call(const Block& block) {
  const FlowStatement& flow = *block.flow;
  const auto name = label_of(block, flow);
  if (!name) return name.error().front();
  if (flow.arguments.size() > kMaxArguments) {
    return at(block, flow.column, "call-arguments"_id,
              fmt::format("{} arguments in a call", flow.arguments.size()),
              fmt::format("a subprogram takes up to {}", kMaxArguments));
  }
  std::vector<double> arguments;
  std::vector<std::string> variables;
  for (const ExpressionRange& argument : flow.arguments) {
    const bool variable =
        argument.count == 1 && block.steps[argument.first].operation == Operation::named_parameter;
    variables.push_back(
        variable ? block.names[static_cast<std::size_t>(block.steps[argument.first].number)] : "");
    if (argument.empty()) {
      arguments.push_back(kVacant);
      continue;
    }
    const auto value = parser::value_of(executor_.state(), block, argument);
    if (!value) return in_this_file(value.error().front());
    arguments.push_back(*value);
  }
  const auto count = count_of(block, flow.condition);
  if (!count) return count.error().front();
  if (*count == 0) return std::nullopt;
  if (rules_.subprograms_are_programs) {
    return call_program(block, *name, {std::move(arguments), std::move(variables)}, *count);
  }
  if (flow.of_file) {
    if (!flow.by_cycle) return follow(block, CallFile{*name, flow.column});
    set_called_program(executor_.state(), *name);
    return std::nullopt;
  }
  const auto holder = rules_.calls_whole_files ? frame().program : program_with(*name);
  const Landmark* entry = holder == nullptr ? nullptr : holder->map().target(*name);
  // Labels share the parameters of their file.
  const bool has_locals = !rules_.calls_whole_files;
  if (holder != nullptr && !rules_.faults_count_when_run && !holder->map().faults().empty()) {
    return holder->map().faults().front();
  }
  if (entry != nullptr && entry->fault) return holder->map().faults()[*entry->fault];
  if (entry == nullptr) {
    return at(block, flow.column, "missing-subprogram"_id, unlabelled("no subprogram", *name),
              options_.search_path.empty() || rules_.calls_whole_files
                  ? "define it in the program"
                  : "define it in the program or in a file of its name");
  }
  if (has_locals) defined_.insert({holder.get(), entry->place.offset});
  CallFrame next{holder,        BlockCursor(holder->program()),
                 *name,         rules_.calls_whole_files ? kEndOfLabel : "endsub",
                 entry->behind, {entry->place.line, entry->column},
                 *count,        has_locals};
  if (auto failure = push_call(block, flow.column, std::move(next))) return failure;
  if (has_locals) executor_.state().parameters.enter(arguments);
  return std::nullopt;
}

// A program with its head in a file that is open, or in one of its own.
ProgramRun::Failure ProgramRun::call_program(const Block& block, const std::string& name,
                                             GivenArguments arguments, std::uint64_t count) {
  std::shared_ptr<LoadedProgram> holder = frame().program;
  if (holder->map().head(name) == nullptr) holder = main_;
  if (holder->map().head(name) == nullptr) holder = file_of(name);
  if (holder == nullptr) {
    return at(
        block, block.flow->column, "missing-subprogram"_id, fmt::format("no subprogram {}", name),
        fmt::format("write it after the program, under %_N_{0}_SPF, or in a file {0}.spf", name));
  }
  const Landmark* head = holder->map().head(name);
  CallFrame next{holder,
                 BlockCursor(holder->program()),
                 name,
                 "RET",
                 head == nullptr ? TextPlace{} : head->place,
                 head == nullptr ? SourcePlace{1, 1} : SourcePlace{head->place.line, head->column},
                 count,
                 true};
  next.arguments = std::move(arguments);
  if (auto failure = push_call(block, block.flow->column, std::move(next))) return failure;
  executor_.state().parameters.enter({});
  return std::nullopt;
}

// PROC NAME(REAL WIDTH, INT COUNT=2): what the call gave gets its names.
ProgramRun::Failure ProgramRun::receive(const Block& block) {
  const FlowStatement& flow = *block.flow;
  if (frames_.size() == 1) return std::nullopt;
  const std::vector<double>& given = frame().arguments.values;
  // A head without PROC takes none, which the call cannot know.
  if (given.size() > flow.parameters.size() && !block.tape_mark) {
    return at(block, flow.column, "call-arguments"_id,
              fmt::format("{} is called with {} arguments and has {} parameters", frame().name,
                          given.size(), flow.parameters.size()),
              "name the parameters in PROC, or leave arguments out");
  }
  if (flow.keeps_modes && frame().runs_left > 0) keep_modes_for_call(executor_.state());
  for (std::size_t i = 0; i < flow.parameters.size(); ++i) {
    const FormalParameter& parameter = flow.parameters[i];
    if (!parameter.sizes.empty()) {
      if (auto failure = receive_array(block, i)) return failure;
      continue;
    }
    double value = i < given.size() ? given[i] : kVacant;
    if (is_vacant(value) && !parameter.otherwise.empty()) {
      const auto otherwise = value_of(block, parameter.otherwise);
      if (!otherwise) return otherwise.error().front();
      value = *otherwise;
    }
    const std::string& name = block.names[parameter.name];
    executor_.state().parameters.define(name, parameter.kind, is_vacant(value) ? 0.0 : value);
    if (!parameter.gives_back || i >= frame().arguments.variables.size()) continue;
    const std::string& variable = frame().arguments.variables[i];
    if (variable.empty()) {
      return at(
          block, flow.column, "call-arguments"_id,
          fmt::format("{} gives {} back, and the call has no variable there", frame().name, name),
          "give a variable of DEF, or an R parameter");
    }
    frame().given_back.emplace_back(name, variable);
  }
  return std::nullopt;
}

// PROC NAME(VAR REAL FIELD[3]): an array of the call.
ProgramRun::Failure ProgramRun::receive_array(const Block& block, std::size_t index) {
  const FlowStatement& flow = *block.flow;
  const FormalParameter& parameter = flow.parameters[index];
  const std::string& name = block.names[parameter.name];
  const std::vector<std::string>& given = frame().arguments.variables;
  std::vector<std::size_t> sizes;
  for (const ExpressionRange& size : parameter.sizes) {
    const auto value = size.empty() ? Result<double>(0.0) : value_of(block, size);
    if (!value) return value.error().front();
    sizes.push_back(*value > 0.0 ? static_cast<std::size_t>(std::min(*value, kMostElements)) : 0);
  }
  const std::string variable = index < given.size() ? given[index] : "";
  if (variable.empty() || !executor_.state().parameters.take_array(variable, name, sizes)) {
    return at(block, flow.column, "call-arguments"_id,
              fmt::format("{} takes an array as {}, and the call gives none of that size",
                          frame().name, name),
              "give the name of an array of DEF with the same sizes");
  }
  if (!parameter.gives_back) return std::nullopt;
  for (const auto& [other, to] : frame().given_back_arrays) {
    if (to != variable) continue;
    return at(block, flow.column, "call-arguments"_id,
              fmt::format("{} and {} of {} are one array of the call", other, name, frame().name),
              "give two arrays");
  }
  frame().given_back_arrays.emplace_back(name, variable);
  return std::nullopt;
}

ProgramRun::Failure ProgramRun::give_back(const Block& block) {
  const FlowStatement& flow = *block.flow;
  if (frames_.size() == 1 && rules_.subprograms_are_programs)
    return end_program(block, flow.column);
  // Klartext passes the end of a subprogram that was not called.
  if (rules_.calls_whole_files && frame().end != kEndOfLabel) return std::nullopt;
  if (frames_.size() == 1) {
    return at(block, flow.column, "flow-outside-call"_id, "return outside a subprogram",
              "end the main program with M2");
  }
  double returned = 0.0;
  if (!flow.condition.empty()) {
    const auto value = value_of(block, flow.condition);
    if (!value) return value.error().front();
    returned = *value;
  }
  executor_.state().parameters.set("_value", returned);
  executor_.state().parameters.set("_value_returned", flow.condition.empty() ? 0.0 : 1.0);
  return_from_call();
  return std::nullopt;
}

}  // namespace frustum::parser

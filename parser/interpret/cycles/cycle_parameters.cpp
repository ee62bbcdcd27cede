#include "parser/interpret/cycles/cycle_parameters.hpp"

#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <utility>

#include "parser/interpret/cycles/hole_call.hpp"
#include "parser/interpret/state/block_words.hpp"

namespace frustum::parser {
namespace {

// "Q201" of "Q201="; empty for other words.
std::string_view parameter_of(const Word& word) {
  if (word.spelled == nullptr) return {};
  const std::string_view spelled = word.spelled;
  if (!spelled.starts_with('Q') || !spelled.ends_with('=')) return {};
  return spelled.substr(0, spelled.size() - 1);
}

}  // namespace

void set_cycle_parameters(InterpreterState& state, const BlockWords& words, bool defines) {
  const Block& block = *state.at_work.block;
  std::shared_ptr<Block> kept;
  if (defines) {
    kept = std::make_shared<Block>();
    kept->line = block.line;
    kept->words = block.words;
    kept->steps = block.steps;
    kept->names = block.names;
  }
  for (std::size_t i = 0; i < block.words.size(); ++i) {
    const Word& word = block.words[i];
    if (defines && words.has(word.letter)) {
      kept->words[i].expression = {};
      kept->words[i].number = words[word.letter].value;
    }
    const std::string_view name = parameter_of(word);
    if (name.empty() || !words.has(word.letter)) continue;
    // AUTO and MAX are no numbers.
    if (word.source != ValueSource::number) continue;
    state.parameters.set(name, words[word.letter].value);
  }
  if (defines) state.modes.hole_cycle.definition = std::move(kept);
}

Outcome renew_cycle(InterpreterState& state) {
  const HoleCycle& cycle = state.modes.hole_cycle;
  if (!cycle.definition) return Done{};
  std::shared_ptr<Block> next;
  for (std::size_t i = 0; i < cycle.definition->words.size(); ++i) {
    const Word& word = cycle.definition->words[i];
    const std::string_view name = parameter_of(word);
    if (name.empty() || word.source != ValueSource::number) continue;
    const auto value = state.parameters.read(name);
    if (!value || *value == word.number) continue;
    if (!next) next = std::make_shared<Block>(*cycle.definition);
    next->words[i].number = *value;
  }
  if (!next) return Done{};
  const bool at_moves = cycle.at_moves;
  BlockWords words;
  if (auto failure =
          words.read(*next, state.parameters, state.rules, state.control, state.modes.unit)) {
    return in_this_block(state, *std::move(failure));
  }
  assume(
      state, 1, "cycle parameter",
      "one that is set after CYCL DEF counts at the call, as the parameters of cycles are global");
  if (auto done = define_hole_cycle(state, words); !done) return done;
  state.modes.hole_cycle.at_moves = at_moves;
  state.modes.hole_cycle.definition = std::move(next);
  return Done{};
}

}  // namespace frustum::parser

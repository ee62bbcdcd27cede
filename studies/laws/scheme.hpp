// Which points of the unit cube the draws of a study are.
//
// Model    : random  u of draw d and variable j is uniform(seed, d, stream of j); FactorSet::draw
//                    makes the draw itself, this class gives the same u
//            latin   blocks of 1,024 draws. In block b variable j has one draw in each of 1,024
//                    slices: (permutation_bj(d) + u) / 1024, u as in random. The permutation is a
//                    Feistel network on two halves of five bits, keyed by (seed, b, stream of j):
//                    every point can be computed alone
//            sobol   16 replicates; draw d is point d / 16 of replicate d mod 16. A replicate is
//                    the Sobol sequence (Joe and Kuo, in the order of the Gray code) scrambled
//                    after Owen: each bit is turned or not by a hash of the bits above it, keyed
//                    by (seed, replicate, stream of j); 21 bits below them are random
//            Both have intervals from the scatter of blocks or replicates alone
// Units    : none
// Shape    : one u in (0, 1) a variable
// Errors   : sobol with more dimensions than its table has (3,667)
// Accuracy : uniform margins: each block of 1,024 (latin), each replicate of 2^k points (sobol)
//            has exactly one point in each of as many slices (tests/studies/scheme_test.cpp)
// Source   : McKay, Beckman, Conover 1979; Joe and Kuo 2008 through Boost.Random; Owen 1995; Laine
//            and Karras 2011
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string_view>
#include <vector>

#include "core/result.hpp"

namespace frustum::studies {

enum class SchemeKind : std::uint8_t { random, latin, sobol };
[[nodiscard]] std::string_view name_of(SchemeKind kind);
[[nodiscard]] std::optional<SchemeKind> scheme_named(std::string_view text);

inline constexpr std::uint32_t kLatinBlock = 1024;
inline constexpr std::uint32_t kSobolReplicates = 16;

class Scheme {
 public:
  // `streams`: one a variable (Variable::stream).
  [[nodiscard]] static Result<Scheme> make(SchemeKind kind, std::uint64_t seed,
                                           std::vector<std::uint64_t> streams,
                                           std::uint32_t replicates = kSobolReplicates);

  [[nodiscard]] SchemeKind kind() const { return kind_; }
  void point(std::uint32_t draw, std::span<double> u) const;

  // Draws whose statistics are independent of those of other groups: blocks (latin) or replicates
  // (sobol). Random draws have none.
  [[nodiscard]] std::optional<std::uint32_t> group_of(std::uint32_t draw) const;
  // Groups that are whole among the first n draws.
  [[nodiscard]] std::uint32_t whole_groups(std::uint64_t n) const;

 private:
  struct Directions;
  Scheme() = default;
  [[nodiscard]] double latin(std::uint32_t draw, std::size_t j) const;
  [[nodiscard]] double sobol(std::uint32_t draw, std::size_t j) const;

  SchemeKind kind_ = SchemeKind::random;
  std::uint64_t seed_ = 0;
  std::vector<std::uint64_t> streams_{};
  std::uint32_t replicates_ = kSobolReplicates;
  std::shared_ptr<const Directions> directions_{};
};

// Point i (in the order of the Gray code, the first one 0) of the unscrambled sequence: 32 bits a
// dimension. Dimensions above the table's are not asked for.
[[nodiscard]] std::vector<std::uint32_t> sobol_point(std::uint32_t i, std::size_t dimensions);

}  // namespace frustum::studies

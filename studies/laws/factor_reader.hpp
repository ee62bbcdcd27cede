// Turns entries into factors: see factors.hpp.
// Units: mm, rad. Errors: those of FactorSet::make.
#pragma once

#include <map>
#include <set>

#include "studies/laws/error_pattern.hpp"
#include "studies/laws/factors.hpp"

namespace frustum::studies {

class FactorReader {
 public:
  FactorReader(const kinematics::Machine& machine, const FactorOptions& options);
  [[nodiscard]] Result<FactorSet> read(std::span<const kinematics::ErrorEntry> entries);

 private:
  struct Scaling {
    ErrorPattern pattern{};
    std::string text{};
    double factor = 1.0;
    bool matched = false;
  };
  void read_scale();
  void add_entry(const kinematics::ErrorEntry& entry);
  void add_term(const kinematics::ErrorEntry& entry, const kinematics::ErrorShape& shape,
                const std::string& number);
  [[nodiscard]] double scale_of(const std::string& name, const kinematics::ErrorShape& shape);
  // The index of the amount, where it is drawn.
  std::optional<std::size_t> add_amount(kinematics::Amount& amount, const std::string& place,
                                        const std::string& name, double scale,
                                        std::vector<std::size_t>& variables);
  std::size_t variable(const kinematics::DrawnFactor& factor, const std::string& place);
  void add_column(const kinematics::ErrorEntry& entry, kinematics::ErrorShape shape,
                  std::string name, std::size_t amount);
  void add_waves(const kinematics::ErrorEntry& entry, const kinematics::ErrorShape& shape,
                 const std::string& number, std::optional<std::size_t> amount,
                 std::optional<std::size_t> phase);
  [[nodiscard]] std::optional<kinematics::GeometricErrors> unit_of(
      const kinematics::ErrorEntry& entry, kinematics::ErrorShape shape);
  void correlate();
  void join_factors();

  const kinematics::Machine& machine_;
  const FactorOptions& options_;
  FactorSet set_{};
  std::vector<Scaling> scale_{};
  std::map<std::string, std::size_t> variable_at_{};
  std::vector<kinematics::ErrorEntry> datum_{};
  std::vector<kinematics::ErrorEntry> fixed_{};
  std::set<std::string> refused_{};
  Diagnostics problems_{};
};

}  // namespace frustum::studies

// Frequency responses as files: universal files of modal-test programs (dataset 58), and CSV.
//
// Units  : compliance in m/N; in CSV um/N under frequency_hz,Gxx_re,Gxx_im,.. (motion, then force);
//          in universal files SI as written; read are displacement, velocity or acceleration for
//          force in the units of their labels, without labels in those of dataset 164, or SI. Other
//          functions beside them are passed over
// Errors : of a file that is read, with its line: no response in it, fields that are no numbers,
//          units that are unknown, two responses of the same directions, frequencies that do not
//          rise
// Source : Universal File Format 58, University of Cincinnati SDRL
#pragma once

#include <Eigen/Core>
#include <complex>
#include <filesystem>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "core/result.hpp"

namespace frustum::dynamics {

struct FrequencyResponse {
  Eigen::Index motion = 0;  // x, y, z of the tip
  Eigen::Index force = 0;
  std::vector<double> frequencies{};               // Hz, rising
  std::vector<std::complex<double>> compliance{};  // m/N

  [[nodiscard]] std::string name() const;  // "Gxy"
};

[[nodiscard]] std::string universal_file(std::span<const FrequencyResponse> responses,
                                         std::string_view title);
// All at the same frequencies.
[[nodiscard]] std::string response_csv(std::span<const FrequencyResponse> responses);

// Of either kind.
[[nodiscard]] Result<std::vector<FrequencyResponse>> load_responses(
    const std::filesystem::path& file);
[[nodiscard]] Result<std::vector<FrequencyResponse>> read_responses(
    std::string_view text, const std::filesystem::path& file);

}  // namespace frustum::dynamics

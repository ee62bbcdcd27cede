// Up to eight machines of a population, from their weights to the values of their characteristics.
//
// Model    : population.hpp
// Units    : mm, rad
// Errors   : those of each machine, with it
// Accuracy : population.hpp
// Source   : metrology/cmm.cpp measures in the same rounds
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "metrology/characteristic/fitted_feature.hpp"
#include "metrology/plan/strategy.hpp"
#include "metrology/probing/cmm_errors.hpp"
#include "trials/population/follow_plan.hpp"
#include "trials/population/population.hpp"

namespace frustum::trials {

// What all machines share.
struct PopulationCommon {
  kinematics::Machine machine;
  programs::TestPiece piece{};
  CommandedPiece commanded{};
  PopulationLaws laws{};
  PopulationOptions options{};
  Trial middle{};
  FollowPlan plan{};
  std::vector<std::vector<metrology::PlannedPoint>> planned{};  // by feature
  std::vector<metrology::Element> near{};                       // by feature: the middle machine's
  std::vector<double> middle_weights{}, limits{};               // by column
};

// Room that a block needs and leaves behind.
struct DrawScratch {
  std::vector<LanePose> poses{};
  std::vector<LaneContact> contacts{};
  std::vector<std::uint32_t> wanted{};
};

class DrawBlock {
 public:
  DrawBlock(const PopulationCommon& common, std::span<const Weights> draws, DrawScratch& scratch);

  // `cmms`: one a draw; empty: all without errors.
  void evaluate(std::span<const metrology::CmmModel> cmms, bool travels,
                std::span<PopulationMember> members);

 private:
  struct Lane {
    bool is_done = false;  // has its values, or failed
    Pose workpiece_from_datum{};
    double scale = 0.0;
    std::optional<metrology::CmmErrors> cmm{};
    std::vector<std::vector<double>> travels{};  // by feature
    std::vector<Pose> probed_in{};               // by feature: the frame in which it was approached
    std::vector<std::optional<metrology::FittedFeature>> features{};  // by feature
    std::vector<bool> has_surroundings{};                             // by node: poses are known
    std::optional<MachineNearness> nearness{};                        // when first asked for
    std::shared_ptr<const stock::Workpiece> whole{};                  // if it had to be cut
    PopulationMember* member = nullptr;
  };
  void probe(std::size_t feature);
  void probe_point(std::size_t feature, std::size_t index, std::size_t lane,
                   const LaneContact* contact);
  // Whether what is beside the point's surroundings keeps out of the way of its contact.
  [[nodiscard]] bool others_keep_away(const FollowedPoint& point, std::size_t lane, double drift,
                                      double moved);
  [[nodiscard]] std::optional<double> travel_on_edge(const FollowedPoint& point, std::size_t lane,
                                                     const metrology::BallApproach& approach) const;
  [[nodiscard]] std::optional<double> travel_on_blank(
      const FollowedPoint& point, double scale, const metrology::BallApproach& approach) const;
  [[nodiscard]] std::optional<double> local_travel(const FollowedPoint& point, std::size_t lane,
                                                   const metrology::BallApproach& approach);
  void fit(std::size_t feature, Lane& lane);
  // Of all points in the datum system at last: datum features were approached before it was known.
  [[nodiscard]] std::vector<double> all_travels(const Lane& lane) const;
  void align();
  void whole_trial(std::size_t lane);
  [[nodiscard]] metrology::BallApproach approach_of(const Lane& lane, std::size_t feature,
                                                    std::size_t index) const;
  [[nodiscard]] std::vector<metrology::FittedFeature> datums_of(const Lane& lane) const;
  void find_poses_of(const FollowedPoint& point);
  [[nodiscard]] PosesOfPiece poses_of(const std::array<std::uint32_t, 3>& node,
                                      std::size_t lane) const;

  const PopulationCommon& common_;
  std::span<const Weights> draws_;
  DrawScratch& scratch_;
  LaneMachines machines_;
  std::vector<bool> known_{};  // by node
  std::vector<Lane> lanes_{};
};

}  // namespace frustum::trials

#pragma once

#include <cstdint>
#include <initializer_list>
#include <optional>
#include <vector>

#include "modules/geometry/solid.h"
#include "modules/model_verifier/box_splitting.h"
#include "modules/model_verifier/late_proposals.h"
#include "modules/model_verifier/model_verifier.pb.h"
#include "modules/model_verifier/part_completion.h"
#include "modules/model_verifier/ray_casting.h"
#include "modules/model_verifier/surface_fit.h"
#include "modules/model_verifier/surface_parts.h"

namespace declutter {

// A hypothesis with what the depth image says of it.
struct Candidate {
  Hypothesis hypothesis;
  RayEvidence evidence;
  bool is_refined = false;
  bool is_out = false;  // does not take part
  bool is_selected = false;
  bool is_gain_known = false;
  bool is_reshaped = false;   // the other shape was tried
  int num_blockers = 0;       // selected candidates in its space
  double gain_factor = 1;     // of what others must explain to take its place, see ReplaceBoth
  double misfit_share = 0;    // of its pixels, that count against it as it looks like another shape
  double gain = 0;            // [px] explained by it alone, less what speaks against it
  double selection_gain = 0;  // [px] the same when it was chosen

  // Makes this the candidate of another hypothesis; the evidence stays.
  void Begin(const Hypothesis& begun) {
    hypothesis = begun;
    is_refined = is_out = is_selected = is_gain_known = is_reshaped = false;
    num_blockers = 0;
    misfit_share = 0;
    gain_factor = 1;
  }
};

// The set of solids that explains the image best: takes the hypothesis that explains the most
// pixels nobody else explains, again and again, until none explains enough; proposes more for what
// is left; then exchanges those whose place another fills better. Solids do not share space.
// Buffers are used again for the next frame.
class ModelSelection {
 public:
  explicit ModelSelection(const ModelVerifierConfig& config) : config_(config) {}

  void Run(const std::vector<Hypothesis>& hypotheses, const Observation& observation,
           FitBuffers* buffers);

  // The candidates selected by the last run, in the order of their selection.
  const std::vector<size_t>& selected() const { return selected_; }
  Candidate& candidate(size_t index) { return candidates_[index]; }

 private:
  static constexpr double kMinImprovement = 1.02;  // of the gain, by an exchange

  // What one run works on.
  struct Input {
    const Observation& observation;
    FitBuffers* buffers;
  };

  void AddCandidates(const std::vector<Hypothesis>& hypotheses, const Input& input);
  void SelectBest(const Input& input);
  // model_selection_late.cpp
  void ProposeLeaning(const std::vector<Hypothesis>& hypotheses, const Input& input);
  void AddProposal(const LateProposal& proposal, double min_share_before, const Input& input);
  void ProposeAboveBlockers(const Input& input);
  void ProposeUpperParts(const Input& input);
  bool IsOneColumn(const Candidate& lower, const Solid& upper, const Input& input);
  void AddUpperPart(size_t index, double floor, const Input& input);
  void ProposeForUnexplained(const Input& input);
  // model_selection_exchange.cpp
  bool Exchange(const Input& input);
  bool TryInPlaceOfBlockers(size_t index, const Input& input);
  bool IsWorthTrying(size_t index);
  bool ReplaceWithRest(size_t index, const Input& input);
  const std::vector<size_t>& BlockersOf(size_t index);
  const std::vector<size_t>& Only(std::initializer_list<size_t> indices);
  bool Replace(const std::vector<size_t>& old, std::optional<size_t> first, const Input& input,
               double share_of_old = 1);
  void PutBack(const std::vector<size_t>& old);
  // model_selection_changes.cpp
  bool SplitByArea(size_t old, const Input& input);
  bool CutLower(size_t old, const Input& input);
  bool Reshape(size_t old, const Input& input);
  std::optional<size_t> AddOver(const std::vector<uint8_t>& is_marked, const PixelWindow& window,
                                std::optional<Shape> but_shape, const Observation& fitted,
                                const Input& input);
  bool StackInstead(size_t old, const Solid& upper, double step, const Input& input);
  void FindLowerParts(size_t old, double step);
  bool ReplaceByParts(const std::vector<Solid>& parts, size_t old, double share_of_old,
                      const Input& input);
  // model_selection_union.cpp
  bool Unite(size_t old, const Input& input);
  bool JoinColumn(size_t old, const Input& input);
  std::optional<Solid> Through(const Solid& solid, const Candidate& candidate, const Input& input);
  std::optional<size_t> AddForBoth(size_t first, size_t second, const Hypothesis& whole,
                                   double max_new_violating, const Input& input);
  bool ReplaceBoth(size_t first, size_t second, size_t whole, double share_of_both,
                   const Input& input);
  // model_selection_division.cpp
  bool SplitByCandidate(size_t old, const Input& input);
  void FindPartsInside(size_t old);
  void ProposeForRest(size_t old, size_t part, const Input& input);
  int TotalSeenThrough(const std::vector<size_t>& indices, const Input& input);
  // model_selection.cpp
  std::optional<size_t> AddRefined(const Hypothesis& hypothesis, double min_px, const Input& input);
  std::optional<size_t> AddRefined(const Hypothesis& hypothesis, double min_px,
                                   const Observation& fitted, const Input& input);
  void RefineCandidate(Candidate* candidate, const Observation& fitted, const Input& input) const;
  std::optional<size_t> Best(const Input& input);
  bool RefineRivals(const Candidate& best, const Input& input);
  bool IsPlausible(const RayEvidence& evidence) const;
  bool IsFree(const Candidate& candidate) const;
  bool AreRivals(size_t a, size_t b);
  void OnMoved(size_t index);
  double Gain(Candidate* candidate) const;
  double CountGain(const Candidate& candidate) const;
  double UnsharedFit(const RayEvidence& evidence) const;
  void Select(size_t index);
  void Release(size_t index);
  void Mark(size_t index, int change);

  ModelVerifierConfig config_;
  std::vector<uint8_t> num_explaining_;  // selected solids on each pixel of the grid
  std::vector<Candidate> candidates_;    // the first num_candidates_ are of this frame
  size_t num_candidates_ = 0, max_candidates_ = 0;
  std::vector<int8_t> are_rivals_;  // of each pair of candidates: 1, 0 or kUnknown
  std::vector<size_t> selected_;

  LateProposer late_proposer_;
  PartFinder part_finder_;
  PartCompletion part_completion_;
  // Buffers of the functions that are named.
  std::vector<size_t> blockers_;        // BlockersOf
  std::vector<size_t> only_;            // Only
  std::vector<size_t> order_;           // Exchange
  std::vector<size_t> instead_;         // Replace
  std::vector<size_t> inside_;          // FindPartsInside
  PixelGrid unclaimed_;                 // ProposeForRest
  std::vector<uint8_t> is_own_;         // Reshape, ProposeForRest
  BoxSplitter box_splitter_;            // SplitByArea
  std::vector<Solid> parts_;            // SplitByArea, CutLower
  std::vector<Solid> selected_solids_;  // ProposeForUnexplained
  std::vector<uint8_t> is_explained_;
};

}  // namespace declutter

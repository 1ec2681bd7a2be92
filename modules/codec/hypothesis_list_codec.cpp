#include "modules/codec/solid_parts.h"

namespace declutter::codec {

hypothesis_list_t Encode(const HypothesisList& list) {
  hypothesis_list_t message{};
  WriteHeader(list.header, &message);
  message.mode = static_cast<int8_t>(list.mode);
  for (const Plane& plane : list.planes) AppendPlane(plane, &message);
  message.num_hypotheses = static_cast<int32_t>(list.hypotheses.size());
  for (const Hypothesis& hypothesis : list.hypotheses) {
    AppendSolid(hypothesis.solid, hypothesis.evidence, &message);
    message.component.push_back(hypothesis.component);
    message.num_votes.push_back(hypothesis.num_votes);
    message.num_inliers.push_back(hypothesis.num_inliers);
    message.score.push_back(hypothesis.score);
  }
  return Fitting(std::move(message));
}

HypothesisList Decode(const hypothesis_list_t& message) {
  HypothesisList list;
  list.header = ReadHeader(message);
  list.mode = Enumerator("mode", message.mode, FeatureMode::kPaper);
  list.planes = ReadPlanes(message);
  const int32_t num = message.num_hypotheses;
  CheckSolidLengths(message, "num_hypotheses", num);
  CheckLength("component", message.component, "num_hypotheses", num);
  CheckLength("num_votes", message.num_votes, "num_hypotheses", num);
  CheckLength("num_inliers", message.num_inliers, "num_hypotheses", num);
  CheckLength("score", message.score, "num_hypotheses", num);
  for (size_t i = 0; i < message.shape.size(); ++i) {
    Hypothesis hypothesis;
    hypothesis.solid = ReadSolid(message, i);
    hypothesis.evidence = ReadEvidence(message, i);
    hypothesis.component = NotNegative({"component", i}, message.component[i]);
    hypothesis.num_votes = NotNegative({"num_votes", i}, message.num_votes[i]);
    hypothesis.num_inliers = NotNegative({"num_inliers", i}, message.num_inliers[i]);
    hypothesis.score = Fraction({"score", i}, message.score[i]);
    list.hypotheses.push_back(hypothesis);
  }
  return list;
}

}  // namespace declutter::codec

#pragma once

#include "modules/codec/frame_parts.h"

// The solids that hypothesis_list_t and object_list_t carry under the same field names.
namespace declutter::codec {

template <typename Message>
void AppendSolid(const Solid& solid, const std::array<Evidence, 3>& evidence, Message* message) {
  message->shape.push_back(static_cast<int8_t>(solid.shape));
  const PoseNumbers pose = ToNumbers(solid.X_CO);
  message->qw.push_back(pose.q[0]);
  message->qx.push_back(pose.q[1]);
  message->qy.push_back(pose.q[2]);
  message->qz.push_back(pose.q[3]);
  message->px.push_back(pose.p[0]);
  message->py.push_back(pose.p[1]);
  message->pz.push_back(pose.p[2]);
  message->size_x.push_back(solid.size.x());
  message->size_y.push_back(solid.size.y());
  message->size_z.push_back(solid.size.z());
  message->evidence_x.push_back(static_cast<int8_t>(evidence[0]));
  message->evidence_y.push_back(static_cast<int8_t>(evidence[1]));
  message->evidence_z.push_back(static_cast<int8_t>(evidence[2]));
}

// The arrays of AppendSolid are all as long as the field called count_name states, and empty in a
// frame with an error.
template <typename Message>
void CheckSolidLengths(const Message& message, const char* count_name, int32_t count) {
  CheckLength("shape", message.shape, count_name, count);
  CheckLength("qw", message.qw, count_name, count);
  CheckLength("qx", message.qx, count_name, count);
  CheckLength("qy", message.qy, count_name, count);
  CheckLength("qz", message.qz, count_name, count);
  CheckLength("px", message.px, count_name, count);
  CheckLength("py", message.py, count_name, count);
  CheckLength("pz", message.pz, count_name, count);
  CheckLength("size_x", message.size_x, count_name, count);
  CheckLength("size_y", message.size_y, count_name, count);
  CheckLength("size_z", message.size_z, count_name, count);
  CheckLength("evidence_x", message.evidence_x, count_name, count);
  CheckLength("evidence_y", message.evidence_y, count_name, count);
  CheckLength("evidence_z", message.evidence_z, count_name, count);
  Check(message.error.empty() || count == 0, count_name, count,
        "must be 0 in a frame with an error");
}

template <typename Message>
Solid ReadSolid(const Message& message, size_t i) {
  Solid solid;
  solid.shape = Enumerator({"shape", i}, message.shape[i], Shape::kCylinder);
  solid.X_CO =
      ToPose({{message.qw[i], message.qx[i], message.qy[i], message.qz[i]},
              {message.px[i], message.py[i], message.pz[i]}},
             {{{{"qw", i}, {"qx", i}, {"qy", i}, {"qz", i}}}, {{{"px", i}, {"py", i}, {"pz", i}}}});
  solid.size = {Positive({"size_x", i}, message.size_x[i]),
                Positive({"size_y", i}, message.size_y[i]),
                Positive({"size_z", i}, message.size_z[i])};
  Check(solid.shape == Shape::kBox || solid.size.x() == solid.size.y(), {"size_y", i},
        solid.size.y(), "must be size_x, the diameter, in a cylinder");
  return solid;
}

template <typename Message>
std::array<Evidence, 3> ReadEvidence(const Message& message, size_t i) {
  return {Enumerator({"evidence_x", i}, message.evidence_x[i], Evidence::kAssumed),
          Enumerator({"evidence_y", i}, message.evidence_y[i], Evidence::kAssumed),
          Enumerator({"evidence_z", i}, message.evidence_z[i], Evidence::kAssumed)};
}

}  // namespace declutter::codec

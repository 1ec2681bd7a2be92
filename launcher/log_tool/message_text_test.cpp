#include "launcher/log_tool/message_text.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "launcher/wire.h"

namespace declutter::log_tool {
namespace {

using testing::Contains;
using testing::ElementsAre;
using testing::StartsWith;

template <typename Type>
runtime::Bytes Encoded(const Type& message) {
  return launcher::Encode(Channel<Type>{""}, message).bytes;
}

TEST(FieldLines, TellTheFieldsOfAMessage) {
  depth_frame_t frame = {};
  frame.utime = 33'000;
  frame.frame = "mug\n\x1b[2J";
  frame.fx = 525.5;
  frame.q_WC[0] = 1;
  frame.num_bytes = 10;
  frame.data = {1, 2, 3, 4, 5, 6, 7, 255, 9, 10};
  const auto lines = FieldLines(Encoded(frame));
  EXPECT_THAT(lines, Contains("utime 33000"));
  EXPECT_THAT(lines, Contains("frame \"mug  [2J\""));
  EXPECT_THAT(lines, Contains("error \"\""));
  EXPECT_THAT(lines, Contains("fx 525.5"));
  EXPECT_THAT(lines, Contains("q_WC[4] 1 0 0 0"));
  EXPECT_THAT(lines, Contains("data[10] 1 2 3 4 5 6 7 255 ..."));
}

TEST(FieldLines, TellNegativeNumbersAndFloats) {
  hypothesis_list_t list = {};
  list.num_hypotheses = 2;
  for (auto* doubles : {&list.qw, &list.qx, &list.qy, &list.qz, &list.px, &list.py, &list.pz,
                        &list.size_x, &list.size_y, &list.size_z}) {
    doubles->assign(2, -0.25);
  }
  for (auto* bytes : {&list.shape, &list.evidence_x, &list.evidence_y, &list.evidence_z}) {
    bytes->assign(2, 1);
  }
  for (auto* counts : {&list.component, &list.num_votes, &list.num_inliers}) counts->assign(2, -7);
  list.score = {0.5f, 1.0f};
  const auto lines = FieldLines(Encoded(list));
  EXPECT_THAT(lines, Contains("px[2] -0.25 -0.25"));
  EXPECT_THAT(lines, Contains("component[2] -7 -7"));
  EXPECT_THAT(lines, Contains("score[2] 0.5 1"));
  EXPECT_THAT(lines, Contains("normal_x[0]"));
}

TEST(FieldLines, TellWhyThereAreNone) {
  runtime::Bytes bytes = Encoded(object_list_t{});
  bytes.pop_back();
  EXPECT_THAT(FieldLines(bytes), ElementsAre(StartsWith("damaged: ")));
  EXPECT_THAT(FieldLines({1, 2, 3}), ElementsAre("of no type of this version"));
}

}  // namespace
}  // namespace declutter::log_tool

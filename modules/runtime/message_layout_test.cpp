#include "modules/runtime/message_layout.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstring>
#include <random>

#include "lcmtypes/channels.h"
#include "modules/runtime/part.h"

namespace declutter::runtime {
namespace {

using Type = MessageLayout::Type;

void AppendInt32(std::int32_t value, Bytes* bytes) {
  const auto bits = static_cast<std::uint32_t>(value);
  for (const int shift : {24, 16, 8, 0}) bytes->push_back((bits >> shift) & 0xFF);
}

void AppendRandom(int size, std::mt19937* random, Bytes* bytes) {
  for (int i = 0; i < size; ++i) bytes->push_back((*random)() & 0xFF);
}

int SizeOf(Type type) {
  if (type == Type::kInt64 || type == Type::kDouble) return 8;
  if (type == Type::kInt32 || type == Type::kFloat) return 4;
  return type == Type::kInt16 ? 2 : 1;
}

// A message with random content, every array counted by a field with 0 to 9 elements.
Bytes RandomMessage(const MessageLayout& layout, std::mt19937* random) {
  Bytes bytes(8);
  for (int i = 0; i < 8; ++i) {
    bytes[static_cast<std::size_t>(i)] =
        static_cast<std::uint8_t>(layout.fingerprint() >> (56 - 8 * i));
  }
  std::vector<int> values;
  for (const MessageLayout::Field& field : layout.fields()) {
    const int count = field.count_field < 0 ? field.fixed_count
                                            : values[static_cast<std::size_t>(field.count_field)];
    const int value = static_cast<int>((*random)() % 10);
    values.push_back(value);
    if (field.type == Type::kString) {
      AppendInt32(value + 1, &bytes);
      bytes.insert(bytes.end(), static_cast<std::size_t>(value), 'x');
      bytes.push_back(0);
    } else if (field.type == Type::kInt32 && !field.is_array) {
      AppendInt32(value, &bytes);
    } else {
      AppendRandom(count * SizeOf(field.type), random, &bytes);
    }
  }
  return bytes;
}

// What lcm-gen's decoder and encoder make of bytes.
template <typename Message>
Bytes DecodeAndEncode(const Bytes& bytes) {
  Message message;
  const int size = static_cast<int>(bytes.size());
  EXPECT_EQ(message.decode(bytes.data(), 0, size), size);
  Bytes encoded(static_cast<std::size_t>(message.getEncodedSize()));
  message.encode(encoded.data(), 0, static_cast<int>(encoded.size()));
  return encoded;
}

bool Fits(const MessageLayout& layout, const Bytes& bytes) {
  try {
    layout.Locate(bytes.data(), bytes.size());
    return true;
  } catch (const std::runtime_error&) {
    return false;
  }
}

Bytes Damage(Bytes bytes, std::mt19937* random) {
  const auto any = [random](std::size_t size) { return (*random)() % size; };
  switch (any(4)) {
    case 0:
      bytes[any(bytes.size())] = static_cast<std::uint8_t>((*random)());
      break;
    case 1:
      bytes.resize(any(bytes.size()));
      break;
    case 2:
      AppendRandom(1 + static_cast<int>(any(8)), random, &bytes);
      break;
    default:
      const std::int32_t extremes[] = {-1, 0x7FFFFFFF, static_cast<std::int32_t>(0x80000000), 0, 1};
      Bytes number;
      AppendInt32(extremes[any(5)], &number);
      const std::size_t at = any(bytes.size() - 3);
      std::copy(number.begin(), number.end(), bytes.begin() + static_cast<std::ptrdiff_t>(at));
  }
  return bytes;
}

template <typename Message>
class EveryMessageType : public testing::Test {};
using MessageTypes = testing::Types<color_frame_t, depth_frame_t, feature_cloud_t,
                                    hypothesis_list_t, module_status_t, object_list_t, tabletop_t>;
TYPED_TEST_SUITE(EveryMessageType, MessageTypes);

TYPED_TEST(EveryMessageType, HasTheFingerprintThatLcmGenComputes) {
  EXPECT_EQ(LayoutOf(TypeParam::getTypeName()).fingerprint(), TypeParam::getHash());
}

TYPED_TEST(EveryMessageType, FitsWhatLcmGenEncodes) {
  const MessageLayout& layout = LayoutOf(TypeParam::getTypeName());
  std::mt19937 random(1);
  for (int i = 0; i < 100; ++i) {
    const Bytes bytes = RandomMessage(layout, &random);
    EXPECT_EQ(DecodeAndEncode<TypeParam>(bytes), bytes);
    EXPECT_TRUE(Fits(layout, bytes));
  }
}

TYPED_TEST(EveryMessageType, NeverLetsADamagedMessageHarmTheDecoder) {
  const MessageLayout& layout = LayoutOf(TypeParam::getTypeName());
  std::mt19937 random(2);
  int num_refused = 0;
  int num_decoded = 0;
  for (int i = 0; i < 10'000; ++i) {
    const Bytes bytes = Damage(RandomMessage(layout, &random), &random);
    if (!Fits(layout, bytes)) {
      ++num_refused;
      continue;
    }
    ++num_decoded;
    TypeParam message;
    const int size = static_cast<int>(bytes.size());
    ASSERT_NO_THROW(ASSERT_EQ(message.decode(bytes.data(), 0, size), size));
  }
  EXPECT_GT(num_refused, 5000);
  EXPECT_GT(num_decoded, 500);
}

constexpr const char* kLabelled = R"(package declutter;
  struct labelled_t {
    int64_t utime;  // [us]
    string label;   /* of all
                       points */
    double p[3];
    int32_t num_points;
    float x[num_points];
  })";

TEST(MessageLayout, KnowsNameTypeAndCountOfEachField) {
  const MessageLayout layout = MessageLayout::Parse(kLabelled);
  EXPECT_EQ(layout.name(), "labelled_t");
  ASSERT_EQ(layout.fields().size(), 5u);
  EXPECT_EQ(layout.fields()[1].name, "label");
  EXPECT_EQ(layout.fields()[1].type, Type::kString);
  EXPECT_EQ(layout.fields()[2].fixed_count, 3);
  EXPECT_EQ(layout.fields()[4].count_field, 3);
}

TEST(MessageLayout, LocatesEachField) {
  const MessageLayout layout = MessageLayout::Parse(kLabelled);
  std::mt19937 random(3);
  const Bytes bytes = RandomMessage(layout, &random);
  const std::vector<MessageLayout::Span> spans = layout.Locate(bytes.data(), bytes.size());
  const int num_points = static_cast<int>(ReadInteger(bytes.data() + spans[3].offset, 4));
  EXPECT_EQ(spans[0].offset, 8u);
  EXPECT_EQ(spans[1].offset, 16u);
  EXPECT_EQ(spans[2].size, 24u);
  EXPECT_EQ(spans[4].count, num_points);
  EXPECT_EQ(spans[4].offset + spans[4].size, bytes.size());
}

// fingerprint, utime, label "a", p, num_points, no x
Bytes WithCount(const MessageLayout& layout, std::int32_t label_bytes, std::int32_t num_points) {
  Bytes bytes(16);
  for (int i = 0; i < 8; ++i) {
    bytes[static_cast<std::size_t>(i)] =
        static_cast<std::uint8_t>(layout.fingerprint() >> (56 - 8 * i));
  }
  AppendInt32(label_bytes, &bytes);
  bytes.insert(bytes.end(), {'a', '\0'});
  bytes.insert(bytes.end(), 24, 0);
  AppendInt32(num_points, &bytes);
  return bytes;
}

TEST(MessageLayout, NamesTheFieldThatIsBroken) {
  const MessageLayout layout = MessageLayout::Parse(kLabelled);
  const auto fault = [&layout](const Bytes& bytes) -> std::string {
    try {
      layout.Locate(bytes.data(), bytes.size());
      return "none";
    } catch (const std::runtime_error& error) {
      return error.what();
    }
  };
  EXPECT_EQ(fault(WithCount(layout, 2, 0)), "none");
  EXPECT_EQ(fault(WithCount(layout, 2, -3)), "x has a negative count (-3)");
  EXPECT_EQ(fault(WithCount(layout, 2, 1)), "x is longer than its message (1)");
  EXPECT_EQ(fault(WithCount(layout, 0, 0)), "label has a bad length (0)");
  EXPECT_EQ(fault(WithCount(layout, 1, 0)), "label does not end in NUL (1)");
  EXPECT_EQ(fault(Bytes(4)), "not a labelled_t (4 byte)");
}

TEST(MessageLayout, TellsAnotherTypeFromAnotherVersion) {
  const auto fault = [](const Bytes& bytes) -> std::string {
    try {
      LayoutOf("tabletop_t").CheckType(bytes.data(), bytes.size());
      return "none";
    } catch (const std::runtime_error& error) {
      return error.what();
    }
  };
  std::mt19937 random(1);
  Bytes tabletop = RandomMessage(LayoutOf("tabletop_t"), &random);
  EXPECT_EQ(fault(tabletop), "none");
  EXPECT_EQ(fault(RandomMessage(LayoutOf("object_list_t"), &random)),
            "of type object_list_t, not tabletop_t");
  tabletop[7] ^= 1;
  EXPECT_THAT(fault(tabletop),
              testing::MatchesRegex("not a tabletop_t of this version \\(fingerprint "
                                    "0x[0-9a-f]{16}, here 0x[0-9a-f]{16}\\)"));
}

TEST(MessageLayout, RefusesDefinitionsThatAreNotFlat) {
  EXPECT_THROW(MessageLayout::Parse("struct a_t { double p[3][3]; }"), std::logic_error);
  EXPECT_THROW(MessageLayout::Parse("struct a_t { other_t other; }"), std::logic_error);
  EXPECT_THROW(MessageLayout::Parse("struct a_t { byte x[n]; int32_t n; }"), std::logic_error);
  EXPECT_THROW(MessageLayout::Parse("struct a_t { int8_t x }"), std::logic_error);
}

}  // namespace
}  // namespace declutter::runtime

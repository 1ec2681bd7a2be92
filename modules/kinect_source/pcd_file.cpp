#include "modules/kinect_source/pcd_file.h"

#include <cctype>
#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <fstream>
#include <iterator>
#include <stdexcept>
#include <string>

#include "modules/kinect_source/pcd_header.h"

namespace declutter {
namespace {

constexpr const char* kTruncated = "truncated .pcd file";

// The longest run that LZF writes from the three bytes of a back reference.
constexpr size_t kMaxLzfRatio = 264;

std::string ReadFile(const std::filesystem::path& path) {
  std::ifstream stream(path, std::ios::binary);
  if (!stream) throw std::runtime_error(std::strerror(errno));
  return {std::istreambuf_iterator<char>(stream), std::istreambuf_iterator<char>()};
}

// Decompresses LZF, the format of binary_compressed: a control byte below 32 is followed by that
// many literals and one; others hold the length (upper 3 bits, 7: one more byte) and the distance
// (lower 5 bits and one byte) of a copy of what was written before.
std::string DecompressLzf(const char* data, size_t num_bytes, size_t num_decompressed) {
  std::string out;
  out.reserve(num_decompressed);
  const auto* in = reinterpret_cast<const unsigned char*>(data);
  const auto* end = in + num_bytes;
  const auto require = [](bool condition) {
    if (!condition) throw std::runtime_error("damaged .pcd file: its points do not decompress");
  };
  while (in < end) {
    const size_t control = *in++;
    if (control < 32) {
      require(control + 1 <= static_cast<size_t>(end - in));
      out.append(reinterpret_cast<const char*>(in), control + 1);
      in += control + 1;
    } else {
      size_t length = control >> 5;
      if (length == 7) {
        require(in < end);
        length += *in++;
      }
      require(in < end);
      const size_t distance = ((control & 31) << 8 | *in++) + 1;
      require(distance <= out.size());
      for (size_t i = 0; i < length + 2; ++i) out.push_back(out[out.size() - distance]);
    }
    require(out.size() <= num_decompressed);
  }
  require(out.size() == num_decompressed);
  return out;
}

// Four-byte values of one field, in the order of the points.
using Words = std::vector<uint32_t>;

Words ReadStrided(const char* first, size_t stride, size_t num_points) {
  Words words(num_points);
  for (size_t i = 0; i < num_points; ++i) {
    std::memcpy(&words[i], first + i * stride, sizeof words[i]);
  }
  return words;
}

uint32_t ParseWord(const std::string& token, char type) {
  if (type != 'F') return static_cast<uint32_t>(std::strtoll(token.c_str(), nullptr, 10));
  const float number = std::strtof(token.c_str(), nullptr);
  uint32_t word;
  std::memcpy(&word, &number, sizeof word);
  return word;
}

// The points of a file and how to get a field of them.
class PointData {
 public:
  PointData(const std::string& file, const PcdHeader& header) : header_(header) {
    const char* data = file.data() + header.header_bytes;
    const size_t num_bytes = file.size() - header.header_bytes;
    if (header.encoding == "ascii") {
      ReadTokens(data, num_bytes);
    } else if (header.encoding == "binary") {
      if (num_bytes < header.num_points() * header.point_bytes)
        throw std::runtime_error(kTruncated);
      bytes_.assign(data, num_bytes);
    } else {
      Decompress(data, num_bytes);
    }
  }

  Words Read(const PcdField& field) const {
    const size_t num_points = header_.num_points();
    if (header_.encoding == "binary") {
      return ReadStrided(bytes_.data() + field.offset, header_.point_bytes, num_points);
    }
    if (header_.encoding == "binary_compressed") {  // field after field
      return ReadStrided(bytes_.data() + field.offset * num_points, sizeof(uint32_t), num_points);
    }
    Words words(num_points);
    for (size_t i = 0; i < num_points; ++i) {
      words[i] = ParseWord(tokens_[i * header_.point_tokens + field.token_offset], field.type);
    }
    return words;
  }

 private:
  void ReadTokens(const char* data, size_t num_bytes) {
    const size_t num_tokens = header_.num_points() * header_.point_tokens;
    const char* const end = data + num_bytes;
    while (tokens_.size() < num_tokens) {
      while (data < end && std::isspace(static_cast<unsigned char>(*data))) ++data;
      if (data == end) throw std::runtime_error(kTruncated);
      const char* const begin = data;
      while (data < end && !std::isspace(static_cast<unsigned char>(*data))) ++data;
      tokens_.emplace_back(begin, data);
    }
  }

  void Decompress(const char* data, size_t num_bytes) {
    uint32_t sizes[2];  // compressed, decompressed
    if (num_bytes < sizeof sizes) throw std::runtime_error(kTruncated);
    std::memcpy(sizes, data, sizeof sizes);
    if (num_bytes - sizeof sizes < sizes[0]) throw std::runtime_error(kTruncated);
    const size_t num_expected = header_.num_points() * header_.point_bytes;
    if (sizes[1] != num_expected || num_expected > sizes[0] * kMaxLzfRatio) {
      throw std::runtime_error("damaged .pcd file: it does not hold the points it announces");
    }
    bytes_ = DecompressLzf(data + sizeof sizes, sizes[0], num_expected);
  }

  const PcdHeader& header_;
  std::string bytes_;
  std::vector<std::string> tokens_;
};

PointCloudFile Read(const std::filesystem::path& path) {
  const std::string file = ReadFile(path);
  const PcdHeader header = ParsePcdHeader(file);
  const PcdField* axes[] = {header.Find("x"), header.Find("y"), header.Find("z")};
  for (const PcdField* axis : axes) {
    if (axis == nullptr || axis->type != 'F') {
      throw std::runtime_error("has no 32-bit float fields x, y and z");
    }
  }
  const PointData data(file, header);
  PointCloudFile cloud;
  cloud.width = header.width;
  cloud.height = header.height;
  cloud.points.resize(header.num_points());
  for (int axis = 0; axis < 3; ++axis) {
    const Words words = data.Read(*axes[axis]);
    for (size_t i = 0; i < words.size(); ++i) {
      std::memcpy(&cloud.points[i][axis], &words[i], sizeof words[i]);
    }
  }
  const PcdField* color = header.Find("rgba") ? header.Find("rgba") : header.Find("rgb");
  if (color != nullptr) cloud.colors = data.Read(*color);
  return cloud;
}

}  // namespace

PointCloudFile ReadPcdFile(const std::filesystem::path& path) {
  try {
    return Read(path);
  } catch (const std::runtime_error& error) {
    throw std::runtime_error(path.string() + ": " + error.what());
  }
}

}  // namespace declutter

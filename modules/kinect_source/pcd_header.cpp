#include "modules/kinect_source/pcd_header.h"

#include <algorithm>
#include <cctype>
#include <cstdint>
#include <sstream>
#include <stdexcept>

#include "modules/geometry/image_limits.h"

namespace declutter {
namespace {

constexpr int64_t kMaxPoints = int64_t{kMaxImageSide_px} * kMaxImageSide_px;
constexpr int64_t kMaxValuesPerPoint = 4096;

// The beginning of a word of any file.
std::string Printable(const std::string& word) {
  std::string text = word.substr(0, 40);
  std::replace_if(
      text.begin(), text.end(), [](unsigned char c) { return !std::isprint(c); }, '?');
  return text;
}

int64_t ParseNumber(const std::string& key, const std::string& word, int64_t min, int64_t max) {
  size_t num_parsed = 0;
  int64_t number = 0;
  try {
    number = std::stoll(word, &num_parsed);
  } catch (const std::logic_error&) {  // no number, or none that fits
  }
  if (word.empty() || num_parsed != word.size() || number < min || number > max) {
    throw std::runtime_error("not a .pcd file: " + key + " is '" + Printable(word) + "'");
  }
  return number;
}

// The lines of the header as words, and where the points begin.
class HeaderLines {
 public:
  explicit HeaderLines(const std::string& file) : file_(file) {}

  // Words of the next line that is not a comment; throws at the end of the file.
  std::vector<std::string> Next() {
    while (true) {
      const size_t end = file_.find('\n', begin_);
      if (end == std::string::npos)
        throw std::runtime_error("not a .pcd file: it has no DATA line");
      std::istringstream line(file_.substr(begin_, end - begin_));
      begin_ = end + 1;
      std::vector<std::string> words;
      for (std::string word; line >> word;) words.push_back(word);
      if (!words.empty() && words[0][0] != '#') return words;
    }
  }
  size_t num_bytes() const { return begin_; }

 private:
  const std::string& file_;
  size_t begin_ = 0;
};

// SIZE, TYPE and COUNT have one word per field.
void SetProperty(const std::vector<std::string>& words, std::vector<PcdField>* fields) {
  if (words.size() != fields->size() + 1) {
    throw std::runtime_error("not a .pcd file: " + words[0] + " does not have a value per field");
  }
  for (size_t i = 0; i < fields->size(); ++i) {
    PcdField& field = (*fields)[i];
    const std::string& word = words[i + 1];
    if (words[0] == "SIZE") field.size = static_cast<size_t>(ParseNumber("SIZE", word, 1, 8));
    if (words[0] == "TYPE") field.type = word[0];
    if (words[0] == "COUNT") {
      field.count = static_cast<size_t>(ParseNumber("COUNT", word, 1, kMaxValuesPerPoint));
    }
  }
}

void SetOffsets(PcdHeader* header) {
  for (PcdField& field : header->fields) {
    field.offset = header->point_bytes;
    field.token_offset = header->point_tokens;
    header->point_bytes += field.num_bytes();
    header->point_tokens += field.count;
  }
  if (header->point_tokens > kMaxValuesPerPoint) {
    throw std::runtime_error("not a .pcd file: too many values per point");
  }
}

}  // namespace

const PcdField* PcdHeader::Find(const std::string& name) const {
  for (const PcdField& field : fields) {
    if (field.name == name && field.num_bytes() == 4) return &field;
  }
  return nullptr;
}

PcdHeader ParsePcdHeader(const std::string& file) {
  PcdHeader header;
  HeaderLines lines(file);
  while (header.encoding.empty()) {
    const std::vector<std::string> words = lines.Next();
    const std::string& key = words[0];
    const std::string value = words.size() > 1 ? words[1] : "";
    if (key == "FIELDS" || key == "COLUMNS") {
      for (size_t i = 1; i < words.size(); ++i) header.fields.push_back({words[i]});
    } else if (key == "SIZE" || key == "TYPE" || key == "COUNT") {
      SetProperty(words, &header.fields);
    } else if (key == "WIDTH") {
      header.width = static_cast<int>(ParseNumber(key, value, 0, kMaxPoints));
    } else if (key == "HEIGHT") {
      header.height = static_cast<int>(ParseNumber(key, value, 0, kMaxImageSide_px));
    } else if (key == "DATA") {
      header.encoding = value;
      if (value != "ascii" && value != "binary" && value != "binary_compressed") {
        throw std::runtime_error("not a .pcd file: DATA is '" + Printable(value) + "'");
      }
    } else if (key != "VERSION" && key != "VIEWPOINT" && key != "POINTS") {
      throw std::runtime_error("not a .pcd file: line '" + Printable(key) + "' in its header");
    }
  }
  header.header_bytes = lines.num_bytes();
  SetOffsets(&header);
  if (header.num_points() == 0) throw std::runtime_error("a cloud without points");
  if (header.height > 1 && header.width > kMaxImageSide_px) {
    throw std::runtime_error("a grid of points over " + std::to_string(kMaxImageSide_px) + " wide");
  }
  return header;
}

}  // namespace declutter

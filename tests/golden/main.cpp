// golden_replay: replays logs through the modules and compares with what is expected of them.
#include <spawn.h>
#include <stdlib.h>
#include <sys/wait.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <iterator>
#include <map>
#include <stdexcept>

#include "modules/codec/codec.h"
#include "modules/runtime/event_log.h"
#include "modules/runtime/message_layout.h"
#include "tests/golden/stage_text.h"
#include "tests/golden/tolerant_diff.h"

namespace declutter::golden {
namespace {

namespace fs = std::filesystem;
using runtime::EventLogReader;
using runtime::EventLogWriter;
using runtime::LogEvent;

constexpr int kDiffers = 1;
constexpr int kBadCommand = 2;

constexpr char kUsage[] =
    "golden_replay FOLDER [--rewrite]\n"
    "Replays each FOLDER/NAME.lcmlog, depth images, through the modules and compares what they "
    "find\n"
    "with NAME.txt, within the tolerances of tolerances.txt. With --rewrite NAME.txt becomes what\n"
    "they find.\n"
    "Ends with 0 when nothing differs, with 1 when something does or a module fails, with 2 on "
    "wrong\n"
    "use.\n";

class TemporaryFolder {
 public:
  TemporaryFolder() {
    std::string name = fs::temp_directory_path() / "golden_replay_XXXXXX";
    if (mkdtemp(name.data()) == nullptr) throw std::runtime_error("no temporary folder");
    path_ = name;
  }
  ~TemporaryFolder() { fs::remove_all(path_); }
  TemporaryFolder(const TemporaryFolder&) = delete;
  TemporaryFolder& operator=(const TemporaryFolder&) = delete;

  const fs::path& path() const { return path_; }

 private:
  fs::path path_;
};

void Run(std::vector<std::string> words) {
  std::vector<char*> argv;
  for (std::string& word : words) argv.push_back(word.data());
  argv.push_back(nullptr);
  pid_t pid = 0;
  int status = 0;
  if (posix_spawn(&pid, argv[0], nullptr, nullptr, argv.data(), environ) != 0 ||
      waitpid(pid, &status, 0) != pid || status != 0) {
    throw std::runtime_error(words[0] + " failed on " + words[2]);
  }
}

void Append(const fs::path& log, EventLogWriter* writer) {
  EventLogReader reader(log);
  while (const auto event = reader.Next()) writer->Write(*event);
}

// A log of what is in `log` and what the modules, each after the one before, make of it.
fs::path ReplayThroughModules(const fs::path& log, const fs::path& folder) {
  const fs::path programs = fs::read_symlink("/proc/self/exe").parent_path();
  fs::path all = log;
  for (const std::string module :
       {"plane_filter", "feature_estimator", "hough_segmenter", "model_verifier"}) {
    const fs::path results = folder / (module + ".lcmlog");
    const fs::path next = folder / ("with_" + module + ".lcmlog");
    Run({programs / module, "--replay", all, "--record", results});
    EventLogWriter writer(next);
    Append(all, &writer);
    Append(results, &writer);
    all = next;
  }
  return all;
}

template <typename Message>
std::string TextOf(const LogEvent& event) {
  const int size = static_cast<int>(event.message.size());
  Message message;
  if (message.decode(event.message.data(), 0, size) != size) {
    throw std::runtime_error(event.channel + ": not a " + Message::getTypeName());
  }
  const auto decoded = codec::Decode(message);
  const std::string error = decoded.header.error;
  return event.channel + "\n" + (error.empty() ? Text(decoded) : "error " + error + "\n");
}

std::string TextOf(const LogEvent& event) {
  if (event.channel == kTabletop.name) return TextOf<tabletop_t>(event);
  if (event.channel == kFeatures.name) return TextOf<feature_cloud_t>(event);
  if (event.channel == kHypotheses.name) return TextOf<hypothesis_list_t>(event);
  if (event.channel == kObjects.name) return TextOf<object_list_t>(event);
  return "";
}

std::string NameOf(const LogEvent& depth) {
  depth_frame_t frame;
  const int size = static_cast<int>(depth.message.size());
  if (frame.decode(depth.message.data(), 0, size) != size) {
    throw std::runtime_error("not a depth_frame_t");
  }
  return frame.frame;
}

std::string TextOfLog(const fs::path& log) {
  std::map<int64_t, std::string> frames;  // by utime
  EventLogReader reader(log);
  while (const auto event = reader.Next()) {
    std::string& text = frames[runtime::UtimeOf(event->message.data())];
    if (event->channel == kDepthFrame.name) text = "== " + NameOf(*event) + "\n";
    text += TextOf(*event);
  }
  std::string text;
  for (const auto& [utime, frame] : frames) text += frame;
  return text;
}

std::string ReadFile(const fs::path& path) {
  std::ifstream file(path, std::ios::binary);
  if (!file) throw std::runtime_error(path.string() + ": cannot be read");
  return {std::istreambuf_iterator<char>(file), {}};
}

// True when it is as expected.
bool Check(const fs::path& log, const Tolerances& tolerances, bool rewrites) {
  const TemporaryFolder folder;
  const std::string actual = TextOfLog(ReplayThroughModules(log, folder.path()));
  const fs::path path = fs::path(log).replace_extension(".txt");
  if (rewrites) {
    std::ofstream file(path, std::ios::binary | std::ios::trunc);
    if (!(file << actual << std::flush)) throw std::runtime_error(path.string() + ": not written");
    return true;
  }
  const std::string diff = TolerantDiff(ReadFile(path), actual, tolerances);
  if (!diff.empty()) std::cout << path.string() << "\n" << diff;
  return diff.empty();
}

int Act(const std::vector<std::string>& arguments) {
  std::vector<std::string> folders = arguments;
  const auto flag = std::find(folders.begin(), folders.end(), "--rewrite");
  const bool rewrites = flag != folders.end();
  if (rewrites) folders.erase(flag);
  if (folders.size() != 1 || folders[0].rfind("--", 0) == 0 || !fs::is_directory(folders[0])) {
    std::cerr << kUsage;
    return kBadCommand;
  }
  const fs::path folder = folders[0];
  const Tolerances tolerances = ParseTolerances(ReadFile(folder / "tolerances.txt"));
  int num_logs = 0;
  bool is_same = true;
  for (const auto& entry : fs::directory_iterator(folder)) {
    if (entry.path().extension() != ".lcmlog") continue;
    is_same = Check(entry.path(), tolerances, rewrites) && is_same;
    ++num_logs;
  }
  if (num_logs == 0) throw std::runtime_error(folder.string() + ": holds no .lcmlog");
  if (is_same) return 0;
  std::cout << "If that is meant: build/bin/golden_replay " << folder.string() << " --rewrite\n";
  return kDiffers;
}

}  // namespace
}  // namespace declutter::golden

int main(int argc, char** argv) {
  try {
    return declutter::golden::Act({argv + 1, argv + argc});
  } catch (const std::exception& error) {
    std::cerr << "golden_replay: " << error.what() << "\n";
    return 1;
  }
}

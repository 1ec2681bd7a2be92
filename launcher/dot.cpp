#include "launcher/dot.h"

#include <map>
#include <utility>

namespace declutter::launcher {
namespace {

bool Publishes(const WiredModule& module, const std::string& channel) {
  for (const Port& output : module.outputs) {
    if (output.channel == channel) return true;
  }
  return false;
}

}  // namespace

std::string Dot(const std::vector<WiredModule>& modules) {
  std::map<std::pair<std::string, std::string>, std::string> labels;  // by publisher and consumer
  std::string text = "digraph graph_of_modules {\n  node [shape=box]\n";
  for (const WiredModule& consumer : modules) {
    text += "  " + consumer.name + "\n";
    for (const Port& input : consumer.inputs) {
      for (const WiredModule& publisher : modules) {
        if (!Publishes(publisher, input.channel)) continue;
        std::string& label = labels[{publisher.name, consumer.name}];
        label += (label.empty() ? "" : "\\n") + input.channel;
      }
    }
  }
  for (const WiredModule& consumer : modules) {
    const std::string style = IsSource(consumer) ? " style=dashed" : "";
    for (const auto& [ends, label] : labels) {
      if (ends.second != consumer.name) continue;
      text +=
          "  " + ends.first + " -> " + ends.second + " [label=\"" + label + "\"" + style + "]\n";
    }
  }
  return text + "}\n";
}

}  // namespace declutter::launcher

#pragma once

#include <string>
#include <vector>

#include "launcher/supervisor.h"

namespace declutter::launcher {

// Actions as tests write them.
inline std::string Words(const Action& action) {
  if (const auto* start = std::get_if<Start>(&action)) return "start " + start->name;
  if (const auto* terminate = std::get_if<Terminate>(&action)) return "stop " + terminate->name;
  if (const auto* kill = std::get_if<Kill>(&action)) return "kill " + kill->name;
  if (const auto* next = std::get_if<StartSuccessor>(&action)) return "prepare " + next->name;
  if (const auto* next = std::get_if<EndSuccessor>(&action)) return "drop " + next->name;
  if (const auto* next = std::get_if<Promote>(&action)) return "promote " + next->name;
  if (const auto* adopted = std::get_if<Adopt>(&action)) return "adopt " + adopted->name;
  if (const auto* reverted = std::get_if<Revert>(&action)) return "revert " + reverted->name;
  return "say " + std::get<Say>(action).text;
}

inline std::vector<std::string> Words(const std::vector<Action>& actions) {
  std::vector<std::string> words;
  for (const Action& action : actions) words.push_back(Words(action));
  return words;
}

}  // namespace declutter::launcher

#include "launcher/orders.h"

namespace declutter::launcher {
namespace {

using Verb = Asked::Verb;

ControlReply Reply(int code, const std::string& text) {
  ControlReply reply;
  reply.set_code(code);
  reply.set_text(text);
  return reply;
}

bool IsComing(State state) {
  return state == State::kStarting || state == State::kTerminating || state == State::kKilled;
}

std::optional<ControlReply> SettleSwap(const std::string& module, int num_swaps_before,
                                       const Supervisor& supervisor) {
  if (supervisor.num_swaps(module) > num_swaps_before) return Reply(0, "");
  if (supervisor.is_swapping(module)) return std::nullopt;
  return Reply(1, module + " was not swapped: it is " + NameOf(supervisor.state(module)) +
                      "; why is in the messages of the launcher");
}

std::optional<ControlReply> Settle(Verb verb, const std::string& module, State state) {
  const State wanted = verb == Verb::kStop ? State::kStopped : State::kRunning;
  if (state == wanted) return Reply(0, "");
  if (IsComing(state) && (verb != Verb::kStop || state != State::kStarting)) return std::nullopt;
  return Reply(1, module + " is " + NameOf(state) + "; `launcher logs " + module + "` tells more");
}

}  // namespace

void Orders::Add(ControlSocket::Id id, Verb verb, const std::string& module,
                 const Supervisor& supervisor) {
  orders_.push_back({id, verb, module, supervisor.num_swaps(module)});
}

std::vector<std::pair<ControlSocket::Id, ControlReply>> Orders::Settle(
    const Supervisor& supervisor) {
  std::vector<std::pair<ControlSocket::Id, ControlReply>> answers;
  std::vector<Order> open;
  for (const Order& order : orders_) {
    auto reply = order.verb == Verb::kSwap
                     ? SettleSwap(order.module, order.num_swaps, supervisor)
                     : launcher::Settle(order.verb, order.module, supervisor.state(order.module));
    if (supervisor.is_stopping()) reply = Reply(1, "the run ends");
    if (reply) {
      answers.emplace_back(order.id, std::move(*reply));
    } else {
      open.push_back(order);
    }
  }
  orders_ = std::move(open);
  return answers;
}

std::string NameOf(State state) {
  switch (state) {
    case State::kWaiting:
      return "waiting";
    case State::kStarting:
      return "starting";
    case State::kRunning:
      return "running";
    case State::kTerminating:
    case State::kKilled:
      return "ending";
    case State::kPausing:
      return "pausing";
    case State::kStopped:
      return "stopped";
    case State::kEnded:
      break;
  }
  return "ended";
}

}  // namespace declutter::launcher

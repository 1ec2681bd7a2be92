#pragma once

#include <functional>
#include <memory>

#include <google/protobuf/message.h>

#include "modules/runtime/bus.h"

// The process around a module: command line, configuration, bus, status, signals, exit code.
namespace declutter::runtime {

using ModuleFactory = std::function<std::shared_ptr<void>(Bus&)>;

// config is filled before factory is called. Returns the exit code: 0 clean end, 1 failure, 2 bad
// command line or configuration.
int RunModule(int argc, char** argv, google::protobuf::Message* config,
              const ModuleFactory& factory);

// Module has a type Config (its parameters, a proto message) and a constructor
// (const Config&, runtime::Bus&).
template <class Module>
int Run(int argc, char** argv) {
  typename Module::Config config;
  return RunModule(argc, argv, &config,
                   [&config](Bus& bus) { return std::make_shared<Module>(config, bus); });
}

}  // namespace declutter::runtime

#include "catena/core/environment.h"

#include <fmt/format.h>

#include <fstream>
#include <thread>
#include <vector>

namespace catena {
namespace {

std::vector<RegisterEnvironment::Facts>& contributors() {
  static std::vector<RegisterEnvironment::Facts> list;
  return list;
}

std::string cpu_model() {
  std::ifstream info("/proc/cpuinfo");
  for (std::string line; std::getline(info, line);)
    if (line.starts_with("model name")) return line.substr(line.find(':') + 2);
  return "unknown";
}

}  // namespace

RegisterEnvironment::RegisterEnvironment(Facts facts) { contributors().push_back(std::move(facts)); }

std::map<std::string, std::string> environment() {
  std::map<std::string, std::string> facts{
      {"catena", CATENA_VERSION},
      {"commit", CATENA_COMMIT},
      {"build type", CATENA_BUILD_TYPE},
      {"compiler", fmt::format("{} {}", CATENA_COMPILER, __VERSION__)},
      {"flags", CATENA_FLAGS},
      {"cpu", cpu_model()},
      {"cores", std::to_string(std::thread::hardware_concurrency())},
  };
  for (const auto& contributor : contributors()) facts.merge(contributor());
  return facts;
}

}  // namespace catena

#include "catena/core/environment.h"

#include <fmt/format.h>

#include <fstream>
#include <string_view>
#include <thread>
#include <vector>

#include "catena/core/error.h"
#include "catena/core/plan/machine.h"

#include CATENA_COMMIT_HEADER

namespace catena {
namespace {

std::vector<RegisterEnvironment::Facts>& contributors() {
  static std::vector<RegisterEnvironment::Facts> list;
  return list;
}

std::string cpu_model() {
  std::ifstream info("/proc/cpuinfo");
  return processor_of(info);
}

/// How the clock of the CPU is governed. Not shown in most virtual machines.
std::string governor() {
  std::ifstream file("/sys/devices/system/cpu/cpu0/cpufreq/scaling_governor");
  std::string name;
  return std::getline(file, name) ? name : "not shown here";
}

}  // namespace

RegisterEnvironment::RegisterEnvironment(Facts facts) { contributors().push_back(std::move(facts)); }

std::map<std::string, std::string> environment() {
  std::map<std::string, std::string> facts{
      {"catena", CATENA_VERSION},        {"commit", CATENA_COMMIT},
      {"build type", CATENA_BUILD_TYPE}, {"compiler", fmt::format("{} {}", CATENA_COMPILER, __VERSION__)},
      {"flags", CATENA_FLAGS},           {"cpu", cpu_model()},
      {"governor", governor()},          {"cores", std::to_string(std::thread::hardware_concurrency())},
  };
  for (const auto& contributor : contributors()) facts.merge(contributor());
  return facts;
}

void require_release_build() {
  if (std::string_view(CATENA_BUILD_TYPE) != "Release")
    throw InputError(fmt::format("this is a {} build; its times mean nothing. Configure with --preset release",
                                 CATENA_BUILD_TYPE));
}

}  // namespace catena

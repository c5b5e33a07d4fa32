#include "catena/core/ranks/mpi/rank_fault.h"

#include <fmt/format.h>

#include <csignal>
#include <cstdlib>
#include <new>
#include <string>
#include <thread>

#include "catena/core/error.h"

namespace catena::ranks {

void meet_fault(std::string_view phase, unsigned rank) {
  const char* const told = std::getenv("CATENA_RANK_FAULT");
  if (told == nullptr) return;
  const std::string faults = fmt::format(",{},", told), here = fmt::format(",{}:{}:", phase, rank);
  const std::size_t at = faults.find(here);
  if (at == std::string::npos) return;
  const std::size_t begin = at + here.size();
  const std::string kind = faults.substr(begin, faults.find(',', begin) - begin);
  if (kind == "error") throw InputError(fmt::format("a fault was asked for in {}", phase));
  if (kind == "memory") throw std::bad_alloc();
  if (kind == "end") std::raise(SIGKILL);
  if (kind == "busy") std::this_thread::sleep_for(std::chrono::minutes(1));
}

std::chrono::milliseconds patience_with_others() {
  const char* const told = std::getenv("CATENA_RANK_PATIENCE");
  return std::chrono::milliseconds(told == nullptr ? 5000 : std::atoi(told));
}

}  // namespace catena::ranks

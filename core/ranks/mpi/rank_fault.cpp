#include "catena/core/ranks/mpi/rank_fault.h"

#include <fmt/format.h>

#include <csignal>
#include <cstdlib>
#include <new>
#include <string>

#include "catena/core/error.h"

namespace catena::ranks {

void meet_fault(std::string_view phase, unsigned rank) {
  const char* const told = std::getenv("CATENA_RANK_FAULT");
  if (told == nullptr) return;
  const std::string fault(told), here = fmt::format("{}:{}:", phase, rank);
  if (!fault.starts_with(here)) return;
  const std::string kind = fault.substr(here.size());
  if (kind == "error") throw InputError(fmt::format("a fault was asked for in {}", phase));
  if (kind == "memory") throw std::bad_alloc();
  if (kind == "end") std::raise(SIGKILL);
}

}  // namespace catena::ranks

#pragma once
#include <fmt/format.h>

#include <string>

#include "catena/core/error.h"

namespace catena {

/// work(), which is about what this names: an input, or a frame of one. An InputError gets the name in front
/// unless it begins with it, as one call may have many inputs.
template <class Work>
decltype(auto) naming(const std::string& name, const Work& work) {
  try {
    return work();
  } catch (const InputError& error) {
    const std::string what = error.what();
    if (what.starts_with(name) && what.substr(name.size()).find_first_of(":, ") == 0) throw;
    throw InputError(fmt::format("{}: {}", name, what));
  }
}

}  // namespace catena

#pragma once
#include <fmt/format.h>

#include <string>

#include "catena/core/error.h"

namespace catena {

/// work(), which is about what this names: an input, or a frame of one. An InputError gets the name in front
/// unless it begins with it, as one call may have many inputs; so does PairLimitExceeded.
template <class Work>
decltype(auto) naming(const std::string& name, const Work& work) {
  try {
    return work();
  } catch (const InputError& error) {
    const std::string what = error.what();
    for (const char* const after : {":", ",", " frame "})
      if (what.starts_with(name + after)) throw;
    throw InputError(fmt::format("{}: {}", name, what));
  } catch (const PairLimitExceeded& error) {
    throw PairLimitExceeded(error.found(), error.limit(), name);
  }
}

}  // namespace catena

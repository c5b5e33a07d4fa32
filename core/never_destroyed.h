#pragma once
#include <utility>

namespace catena {

/// A value that lives as long as the process does, for a static of the library that is made when it is first
/// asked for: `static const T& value = never_destroyed(T(...))`. A search may be asked for by a function that
/// runs at the exit of the program, by the destructor of a static of the caller's, or in a thread that main()
/// leaves behind: by then a static made later than those is destroyed.
template <class T>
T& never_destroyed(T value) {
  return *new T(std::move(value));  // reachable through the static: no leak
}

}  // namespace catena

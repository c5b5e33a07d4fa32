#pragma once
#include <memory>

#include "catena/core/export.h"

namespace catena {

/// How many cores this process may use, at least 1: fewer than the machine has where it was given some of
/// them (taskset, a container's cpuset, a CoreLimit).
CATENA_API unsigned usable_cores();

/// While it lives this process uses no more cores than these, at least 1, as others need them.
class CATENA_API CoreLimit {
 public:
  explicit CoreLimit(unsigned cores);
  ~CoreLimit();
  CoreLimit(const CoreLimit&) = delete;
  CoreLimit& operator=(const CoreLimit&) = delete;

 private:
  struct Control;
  std::unique_ptr<Control> control_;
};

}  // namespace catena

#pragma once
#include <functional>
#include <map>
#include <string>

namespace catena {

/// What a measurement was taken with: compiler, flags, build type, commit (ending in "-dirty" when the
/// sources differ from it), CPU and its governor, and on machines with a device GPU, driver and toolkit.
/// Every result file carries it.
std::map<std::string, std::string> environment();

/// Throws InputError unless this is a Release build, the only one whose times mean anything.
void require_release_build();

/// One object of this at namespace scope adds facts to environment().
struct RegisterEnvironment {
  using Facts = std::function<std::map<std::string, std::string>()>;
  explicit RegisterEnvironment(Facts facts);
};

}  // namespace catena

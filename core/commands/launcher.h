#pragma once
#include <functional>

namespace catena {

/// How several processes that were started together do one command together; registered by a folder that
/// knows such a start. Without one, or where this process is alone, a command runs as always.
class Launcher {
 public:
  virtual ~Launcher() = default;
  /// This process is one of those.
  virtual bool launched() const = 0;
  /// Runs `body` as guarded_main does, in the company of the others. When it throws in one process, all fail:
  /// none waits for one that gave up, wherever that was. Only the first process is heard.
  virtual int run(const std::function<int()>& body) = 0;
};

}  // namespace catena

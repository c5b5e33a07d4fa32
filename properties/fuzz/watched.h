#pragma once
#include <functional>
#include <string>

#include "catena/properties/fuzz/notebook.h"

namespace catena::properties {

/// How a watched process ended.
struct Ending {
  int code = 0;  ///< its exit code, where it ended by itself
  std::string fault =
      {};  ///< else what befell it: "crashed: Segmentation fault", "hung: ..."; empty when nothing
  bool hung = false;
};

/// Runs `work` in a child process and waits for its end. It is killed when its notebook shows nothing new for
/// `timeout` seconds; 0 waits for ever. An interrupt of this process (Ctrl-C, SIGTERM) is passed to the
/// child, which interrupted() tells of it; one more, seconds later, kills it.
///
/// The child returns from this function, too, with its code in `mine` set, and is to leave the program with
/// it; its exceptions pass. No variant of a device may have been made or described before: a child cannot use
/// what its parent has opened.
Ending watched(Notebook& notebook, double timeout, const std::function<int()>& work, bool& mine);

/// The same for a piece of work that prints nothing and whose child never returns: its exceptions are a code
/// of 2.
Ending tried(Notebook& notebook, double timeout, const std::function<int()>& work);

/// Whether the process that calls, a child of `watched`, was asked to stop.
bool interrupted();

}  // namespace catena::properties

#pragma once
#include <functional>
#include <string_view>

namespace catena {

/// What a program's main does around its own work: `body` gives the exit code, 0 or 1, and every way to fail
/// ends with exit code 2 and one line on standard error that begins with `program`: an exception of any kind,
/// and standard output that did not take everything (a full disk). A reader of standard output that left
/// early (`| head`) is no news: 2, in silence.
int guarded_main(std::string_view program, const std::function<int()>& body);

}  // namespace catena

#include "catena/core/commands/guarded_main.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>

#include <cerrno>
#include <csignal>
#include <cstdio>
#include <cstring>
#include <iostream>
#include <new>
#include <system_error>

#include "catena/core/error.h"
#include "catena/core/notice.h"

namespace catena {
namespace {

int refuse(std::string_view program, std::string_view what) {
  notice(program, what);
  return 2;
}

int refuse_output(std::string_view program, int reason) {
  if (reason == EPIPE) return 2;
  if (reason == EBADF || (fcntl(STDOUT_FILENO, F_GETFL) & O_ACCMODE) == O_RDONLY)
    return refuse(program, "cannot write the output: standard output is closed");
  if (reason == 0)
    return refuse(program, "cannot write the output");  // a stream failed long ago and kept no reason
  return refuse(program, fmt::format("cannot write the output: {}", std::strerror(reason)));
}

/// A closed standard stream would give its number to the next file that is opened, which then takes what is
/// printed.
void keep_standard_streams() {
  for (const int stream : {STDIN_FILENO, STDOUT_FILENO, STDERR_FILENO})
    if (fcntl(stream, F_GETFD) == -1) open("/dev/null", stream == STDIN_FILENO ? O_WRONLY : O_RDONLY);
}

}  // namespace

int guarded_main(std::string_view program, const std::function<int()>& body) {
  keep_standard_streams();
  for (const int signal : {SIGPIPE, SIGXFSZ})  // a closed pipe or too long a file is an error like others
    std::signal(signal, SIG_IGN);
  std::clearerr(stdout);
  try {
    const int code = body();
    errno = 0;
    if (std::fflush(stdout) != 0 || std::ferror(stdout) != 0 || !std::cout.flush())
      return refuse_output(program, errno);
    return code;
  } catch (const PairLimitExceeded& error) {
    return refuse(program, fmt::format("{} (catena detect has --counts-only and --pair-limit)", error.what()));
  } catch (const Error& error) {
    return refuse(program, error.what());
  } catch (const std::bad_alloc&) {
    return refuse(program, "out of memory; take fewer spheres");
  } catch (const std::system_error& error) {
    if (std::ferror(stdout)) return refuse_output(program, error.code().value());
    return refuse(program, error.what());
  } catch (const std::exception& error) {
    return refuse(program,
                  fmt::format("internal error: {}; please report it with the command line", error.what()));
  } catch (...) {
    return refuse(program, "internal error of an unknown kind; please report it with the command line");
  }
}

}  // namespace catena

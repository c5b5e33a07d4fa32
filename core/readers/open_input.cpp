#include "catena/core/readers/open_input.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <poll.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>

#include "catena/core/error.h"
#include "catena/core/readers/file_bytes.h"

namespace catena {

OpenInput::OpenInput(const std::filesystem::path& file)
    : is_standard_input_(catena::is_standard_input(file)),
      shown_(shown_name(file)),
      descriptor_(is_standard_input_ ? STDIN_FILENO : open(file.c_str(), O_RDONLY | O_CLOEXEC)) {
  if (descriptor_ < 0) fail(errno);
}

OpenInput::~OpenInput() {
  if (!is_standard_input_) close(descriptor_);
}

std::size_t OpenInput::told_size() const {
  struct stat status {};
  if (fstat(descriptor_, &status) != 0) fail(errno);
  const off_t at = S_ISREG(status.st_mode) ? lseek(descriptor_, 0, SEEK_CUR) : -1;
  return at < 0 || at > status.st_size ? 0 : static_cast<std::size_t>(status.st_size - at);
}

std::size_t OpenInput::read(char* to, std::size_t most) {
  constexpr std::size_t most_at_once = std::size_t{1} << 30;
  std::size_t done = 0;
  while (done < most) {
    const ssize_t got = ::read(descriptor_, to + done, std::min(most - done, most_at_once));
    if (got == 0) break;
    if (got > 0) {
      done += static_cast<std::size_t>(got);
    } else if (errno == EAGAIN || errno == EWOULDBLOCK) {
      pollfd more{descriptor_, POLLIN, 0};
      if (poll(&more, 1, -1) < 0 && errno != EINTR) fail(errno);
    } else if (errno != EINTR) {
      fail(errno);
    }
  }
  return done;
}

std::string OpenInput::read_all() {
  constexpr std::size_t piece = std::size_t{1} << 20;
  // One byte more than is told, so that the end is seen without growing.
  const std::size_t told = told_size();
  std::size_t asked = told > 0 ? told + 1 : piece;
  std::string bytes;
  for (;; asked = piece) {
    const std::size_t before = bytes.size();
    bytes.resize(before + asked);
    const std::size_t got = read(bytes.data() + before, asked);
    bytes.resize(before + got);
    if (got < asked) return bytes;
  }
}

void OpenInput::fail(int reason) const {
  const char* const words =
      reason == EBADF ? "it is closed, or open for writing alone" : std::strerror(reason);
  throw InputError(fmt::format("{}: cannot be {}: {}", shown_, descriptor_ < 0 ? "opened" : "read", words));
}

}  // namespace catena

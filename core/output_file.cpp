#include "catena/core/output_file.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <signal.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <cerrno>
#include <charconv>
#include <climits>
#include <cstring>
#include <optional>
#include <utility>

#include "catena/core/error.h"

namespace catena {
namespace {

namespace fs = std::filesystem;

/// The number of the open descriptor that this name stands for: /dev/fd/N, /proc/self/fd/N.
std::optional<int> descriptor_of(const fs::path& name) {
  std::error_code absent;
  const auto folder = fs::canonical(name.parent_path(), absent);
  const std::string number = name.filename().string();
  if (absent || folder != fs::path("/proc") / std::to_string(getpid()) / "fd") return std::nullopt;
  unsigned descriptor = 0;  // no sign is a descriptor's
  const auto [end, error] = std::from_chars(number.data(), number.data() + number.size(), descriptor);
  if (error != std::errc() || end != number.data() + number.size() || descriptor > INT_MAX)
    return std::nullopt;
  return static_cast<int>(descriptor);
}

bool regular_or_new(const fs::path& name) {
  std::error_code unknown;
  const auto status = fs::symlink_status(name, unknown);
  return status.type() == fs::file_type::regular || status.type() == fs::file_type::not_found;
}

std::string open_name(int file) { return fmt::format("/proc/self/fd/{}", file); }

/// A file without a name in the folder of this one, which vanishes with the process however that ends; -1
/// where the file system has none, or where there is no /proc, by which it would get its name. To be read,
/// too: see copied().
int open_nameless(const fs::path& target) {
  const auto folder = target.has_parent_path() ? target.parent_path() : fs::path(".");
  const int file = open(folder.c_str(), O_TMPFILE | O_RDWR | O_CLOEXEC, 0666);
  if (file < 0 || access(open_name(file).c_str(), F_OK) == 0) return file;
  ::close(file);
  return -1;
}

int open_named(const fs::path& unfinished) {
  return open(unfinished.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_NOFOLLOW | O_CLOEXEC, 0666);
}

/// Whether the second has all of the first, copied by way of `part`; else errno says why not.
bool copied(int from, int to, std::string& part) {
  for (off_t at = 0;;) {
    const ssize_t got = pread(from, part.data(), part.size(), at);
    if (got == 0) return true;
    if (got < 0 && errno != EINTR) return false;
    for (ssize_t done = 0; done < got;) {
      const ssize_t written = ::write(to, part.data() + done, static_cast<std::size_t>(got - done));
      if (written < 0 && errno != EINTR) return false;
      done += std::max<ssize_t>(written, 0);
    }
    at += std::max<ssize_t>(got, 0);
  }
}

/// Of a file that will be replaced, so that it is read by nobody new. Where a file system has no permissions,
/// there are none to keep.
void keep_permissions(int file, const fs::path& replaced) {
  struct stat status {};
  if (stat(replaced.c_str(), &status) == 0) fchmod(file, status.st_mode & 0777);
}

/// Ctrl-C waits while this lives, where no other thread takes it. Where one does, a whole file may be left
/// that has not its name yet.
class SignalsHeld {
 public:
  SignalsHeld() {
    sigset_t all;
    sigfillset(&all);
    pthread_sigmask(SIG_BLOCK, &all, &before_);
  }
  ~SignalsHeld() { pthread_sigmask(SIG_SETMASK, &before_, nullptr); }
  SignalsHeld(const SignalsHeld&) = delete;
  SignalsHeld& operator=(const SignalsHeld&) = delete;

 private:
  sigset_t before_;
};

}  // namespace

fs::path OutputFile::target(fs::path name) {
  constexpr int most_links = 40;  // the kernel's limit
  std::error_code none;
  for (int link = 0; link < most_links && !descriptor_of(name); ++link) {
    const auto to = fs::read_symlink(name, none);
    if (none) return name;
    name = name.parent_path() / to;  // `to` itself, when it is absolute
  }
  return name;
}

bool OutputFile::written_through(const fs::path& target) {
  return descriptor_of(target) || !regular_or_new(target);
}

fs::path OutputFile::unfinished_beside(const fs::path& target) {
  constexpr std::size_t longest = 200;  // of the 255 bytes of a name
  static std::atomic<unsigned> files{0};
  const std::string name = target.filename().string();
  return target.parent_path() /
         fmt::format("{}.{}-{}.unfinished", name.size() > longest ? "catena" : name, getpid(), ++files);
}

OutputFile::OutputFile(const fs::path& name) : name_(name), target_(target(name)) {
  int file = -1;
  if (const auto open_already = descriptor_of(target_)) {
    file = fcntl(*open_already, F_DUPFD_CLOEXEC, 3);
  } else if (regular_or_new(target_)) {
    unfinished_ = unfinished_beside(target_);
    file = open_nameless(target_);
    nameless_ = file >= 0;
    if (!nameless_) file = open_named(unfinished_);
    if (file >= 0) keep_permissions(file, target_);
  } else {
    file = open(target_.c_str(), O_WRONLY | O_CLOEXEC);
  }
  if (file < 0) fail(errno);
  out_ = fdopen(file, "wb");
  if (out_ != nullptr) return;
  const int reason = errno;
  ::close(file);
  if (!unfinished_.empty() && !nameless_) unlink(unfinished_.c_str());
  fail(reason);
}

OutputFile::~OutputFile() {
  if (out_ != nullptr) std::fclose(out_);
  if (!unfinished_.empty()) unlink(unfinished_.c_str());
}

void OutputFile::write(std::string_view text) {
  if (std::fwrite(text.data(), 1, text.size(), out_) != text.size()) fail(errno);
}

void OutputFile::close() {
  const SignalsHeld held;
  if (std::fflush(out_) != 0) fail(errno);
  if (nameless_) {
    unlink(unfinished_.c_str());  // of a process that had our number and was killed
    if (linkat(AT_FDCWD, open_name(fileno(out_)).c_str(), AT_FDCWD, unfinished_.c_str(), AT_SYMLINK_FOLLOW) !=
        0)
      copy_to_named();  // a sandbox forbids links, perhaps
  }
  std::FILE* const out = std::exchange(out_, nullptr);
  if (std::fclose(out) != 0) fail(errno);
  if (unfinished_.empty()) return;
  if (std::rename(unfinished_.c_str(), target_.c_str()) != 0) fail(errno);
  unfinished_.clear();
}

void OutputFile::copy_to_named() const {
  std::string part(std::size_t{1} << 20, '\0');
  const int file = open_named(unfinished_);
  if (file < 0) fail(errno);
  keep_permissions(file, target_);
  const bool all = copied(fileno(out_), file, part);
  const int reason = errno;
  if (::close(file) != 0) fail(errno);
  if (!all) fail(reason);
}

void OutputFile::fail(int reason) const {
  throw InputError(fmt::format("cannot write {}: {}", name_.string(), std::strerror(reason)));
}

void write_file(const fs::path& name, std::string_view text) {
  OutputFile file(name);
  file.write(text);
  file.close();
}

}  // namespace catena

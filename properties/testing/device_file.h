#pragma once
#include <fcntl.h>
#include <sys/stat.h>
#include <sys/sysmacros.h>
#include <unistd.h>

#include <optional>
#include <string>

namespace catena::properties {

/// A device like /dev/null or /dev/full for a test to write: one of its own at this path, for a program with
/// a fault may put a file in its place. Where none can be made there the machine's own, if it is safe from
/// us; else nothing.
class DeviceFile {
 public:
  static std::optional<std::string> null(const std::string& own) { return make(own, "/dev/null", 3); }
  static std::optional<std::string> full(const std::string& own) { return make(own, "/dev/full", 7); }

 private:
  static std::optional<std::string> make(const std::string& own, const char* of_the_machine, unsigned minor) {
    constexpr unsigned memory = 1;  // the major number of both
    if (mknod(own.c_str(), S_IFCHR | 0600, makedev(memory, minor)) == 0) {
      const int open_already = open(own.c_str(), O_WRONLY | O_CLOEXEC);  // not on every file system
      if (open_already != -1) return close(open_already), own;
      unlink(own.c_str());
    }
    if (access("/dev", W_OK) == 0) return std::nullopt;
    return of_the_machine;
  }
};

}  // namespace catena::properties

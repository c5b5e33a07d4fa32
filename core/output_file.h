#pragma once
#include <cstdio>
#include <filesystem>
#include <string_view>

namespace catena {

/// A file being written; every file of catena is written by this.
///
/// A regular file, or a new one, gets its name only when it is complete: a failed run leaves no half file and
/// does not touch an older one, whose permissions it takes over. Until then it has none, so that nothing is
/// left of it even by a signal or a crash of the process (a system without nameless files, or without /proc,
/// keeps it beside, and one that forbids links copies it there in the end, as NAME.PROCESS-NUMBER.unfinished,
/// or catena... where NAME is long). Where the name is a symbolic link, the file that it points to is
/// replaced, and the link stays. What is no regular file (a device, a FIFO) is written through, and so is an
/// open descriptor, /dev/stdout or /dev/fd/N, whatever is behind it. Nothing waits for the disk: what the
/// machine loses when it stops is the file system's affair.
///
/// Every function throws InputError, naming the file and the system's reason, when not all can be written.
class OutputFile {
 public:
  explicit OutputFile(const std::filesystem::path& name);
  ~OutputFile();  ///< without close(): what was written of a regular file is removed
  OutputFile(const OutputFile&) = delete;
  OutputFile& operator=(const OutputFile&) = delete;

  void write(std::string_view text);
  void close();

  /// What a name stands for: links are followed to what is none (it need not exist), or to the name of an
  /// open descriptor.
  static std::filesystem::path target(std::filesystem::path name);
  /// Whether what lies behind a target is written through: a device, a FIFO, an open descriptor.
  static bool written_through(const std::filesystem::path& target);
  /// A name beside a target that no other file being written has, and that a file system takes where it takes
  /// that one.
  static std::filesystem::path unfinished_beside(const std::filesystem::path& target);

 private:
  void copy_to_named() const;
  [[noreturn]] void fail(int reason) const;

  std::filesystem::path name_;        // as the caller wrote it
  std::filesystem::path target_;      // what it stands for
  std::filesystem::path unfinished_;  // beside target_; empty when written through
  bool nameless_ = false;            // until close(): unfinished_ is what it will be called
  std::FILE* out_ = nullptr;
};

/// All of a file at once.
void write_file(const std::filesystem::path& name, std::string_view text);

}  // namespace catena

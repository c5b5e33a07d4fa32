#pragma once
#include <mpi.h>

#include <cstdint>
#include <string>

namespace catena::ranks {

/// A file of this rank alone, by MPI-IO. Errors are InputError: "cannot read NAME: reason", or write.
class MpiFile {
 public:
  enum class Use { read, write };

  MpiFile() = default;
  /// `shown` is what errors call it.
  MpiFile(const std::string& name, Use use, std::string shown);
  ~MpiFile();
  MpiFile(MpiFile&& other) noexcept;
  MpiFile& operator=(MpiFile&& other) noexcept;

  std::uint64_t size() const;
  void read(std::uint64_t at, void* bytes, std::size_t size) const;
  void write(std::uint64_t at, const void* bytes, std::size_t size);
  /// What was written is in the file.
  void close();

 private:
  void check(int code) const;
  [[noreturn]] void fail(const std::string& reason) const;

  MPI_File file_ = MPI_FILE_NULL;
  Use use_ = Use::read;
  std::string shown_;
};

}  // namespace catena::ranks

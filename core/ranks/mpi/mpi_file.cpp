#include "catena/core/ranks/mpi/mpi_file.h"

#include <fmt/format.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <utility>

#include "catena/core/error.h"

namespace catena::ranks {
namespace {

constexpr std::size_t most_bytes = std::size_t{1} << 30;  // of a call; MPI counts them in an int

/// transfer(at, bytes done, bytes now, status) until all are, or none is.
template <class Transfer>
bool in_pieces(std::uint64_t at, std::size_t size, const Transfer& transfer) {
  for (std::size_t done = 0; done < size;) {
    const std::size_t piece = std::min(most_bytes, size - done);
    MPI_Status status;
    int count = 0;
    transfer(static_cast<MPI_Offset>(at + done), done, static_cast<int>(piece), &status);
    MPI_Get_count(&status, MPI_BYTE, &count);
    if (count <= 0) return false;
    done += static_cast<std::size_t>(count);
  }
  return true;
}

}  // namespace

MpiFile::MpiFile(const std::string& name, Use use, std::string shown) : use_(use), shown_(std::move(shown)) {
  check(MPI_File_open(MPI_COMM_SELF, name.c_str(), use == Use::read ? MPI_MODE_RDONLY : MPI_MODE_WRONLY,
                      MPI_INFO_NULL, &file_));
}

MpiFile::~MpiFile() {
  if (file_ != MPI_FILE_NULL) MPI_File_close(&file_);
}

MpiFile::MpiFile(MpiFile&& other) noexcept { *this = std::move(other); }

MpiFile& MpiFile::operator=(MpiFile&& other) noexcept {
  std::swap(file_, other.file_);
  std::swap(use_, other.use_);
  std::swap(shown_, other.shown_);
  return *this;
}

std::uint64_t MpiFile::size() const {
  MPI_Offset size = 0;
  check(MPI_File_get_size(file_, &size));
  return static_cast<std::uint64_t>(size);
}

void MpiFile::read(std::uint64_t at, void* bytes, std::size_t size) const {
  const bool all = in_pieces(at, size, [&](MPI_Offset from, std::size_t done, int piece, MPI_Status* status) {
    check(MPI_File_read_at(file_, from, static_cast<char*>(bytes) + done, piece, MPI_BYTE, status));
  });
  if (!all) fail("the file ends too early");
}

void MpiFile::write(std::uint64_t at, const void* bytes, std::size_t size) {
  errno = 0;
  const bool all = in_pieces(at, size, [&](MPI_Offset from, std::size_t done, int piece, MPI_Status* status) {
    check(MPI_File_write_at(file_, from, static_cast<const char*>(bytes) + done, piece, MPI_BYTE, status));
  });
  // Open MPI takes a full disk for success, and says why on standard error alone.
  if (!all) fail(errno != 0 ? std::strerror(errno) : "the file does not take it all");
}

void MpiFile::close() {
  if (use_ == Use::write) check(MPI_File_sync(file_));
  check(MPI_File_close(&file_));
}

void MpiFile::check(int code) const {
  if (code == MPI_SUCCESS) return;
  std::string words(MPI_MAX_ERROR_STRING, '\0');
  int length = 0;
  MPI_Error_string(code, words.data(), &length);
  words.resize(static_cast<std::size_t>(length));
  fail(words);
}

void MpiFile::fail(const std::string& reason) const {
  throw InputError(fmt::format("cannot {} {}: {}", use_ == Use::read ? "read" : "write", shown_, reason));
}

}  // namespace catena::ranks

#include "catena/ranks/mpi/shared_output.h"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <cstdio>
#include <filesystem>

#include "catena/ranks/bytes.h"

namespace catena::ranks {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t most_bytes = std::size_t{1} << 30;

/// What rank 0 says.
std::string said_by_first(Communicator& ranks, const std::string& text) {
  const Gathered all = ranks.all_gather(
      ranks.rank() == 0 ? ByteWriter().put_all(std::span(text.data(), text.size())).take() : Bytes());
  const Bytes& first = all->front();
  return {reinterpret_cast<const char*>(first.data()), first.size()};
}

std::string unfinished_name(const std::string& name) {
  std::error_code unknown;
  const auto status = fs::status(name, unknown);
  if (fs::exists(status) && !fs::is_regular_file(status))
    throw InputError(fmt::format("cannot write {}: ranks write a file together, and this is none", name));
  const fs::path target = fs::exists(status) ? fs::canonical(name) : fs::path(name);
  const std::string unfinished = fmt::format("{}.{}.unfinished", target.string(), getpid());
  std::FILE* const made = std::fopen(unfinished.c_str(), "wx");
  if (made == nullptr) throw InputError(fmt::format("cannot write {}: {}", name, std::strerror(errno)));
  std::fclose(made);
  return unfinished;
}

}  // namespace

SharedOutput::SharedOutput(Communicator& ranks, std::string name) : ranks_(ranks), name_(std::move(name)) {
  if (ranks_.rank() == 0) unfinished_ = unfinished_name(name_);
  try {
    unfinished_ = said_by_first(ranks_, unfinished_);
    check(MPI_File_open(MPI_COMM_SELF, unfinished_.c_str(), MPI_MODE_WRONLY, MPI_INFO_NULL, &file_));
  } catch (...) {
    if (ranks_.rank() == 0) unlink(unfinished_.c_str());
    throw;
  }
}

SharedOutput::~SharedOutput() {
  if (file_ != MPI_FILE_NULL) MPI_File_close(&file_);
  if (ranks_.rank() == 0 && !unfinished_.empty()) unlink(unfinished_.c_str());
}

void SharedOutput::append(std::string_view own) {
  std::uint64_t at = written_;
  const auto sizes = all_gather_value(ranks_, std::uint64_t{own.size()});
  for (unsigned rank = 0; rank < ranks_.size(); ++rank) {
    if (rank < ranks_.rank()) at += sizes[rank];
    written_ += sizes[rank];
  }
  while (!own.empty()) {
    const auto piece = static_cast<int>(std::min(own.size(), most_bytes));
    MPI_Status status;
    int count = 0;
    check(MPI_File_write_at(file_, static_cast<MPI_Offset>(at), own.data(), piece, MPI_CHAR, &status));
    MPI_Get_count(&status, MPI_CHAR, &count);
    if (count != piece) throw InputError(fmt::format("cannot write {}: the file does not take it all", name_));
    own.remove_prefix(static_cast<std::size_t>(piece));
    at += static_cast<std::uint64_t>(piece);
  }
}

void SharedOutput::close() {
  check(MPI_File_sync(file_));
  check(MPI_File_close(&file_));
  ranks_.vote();  // all have written
  if (ranks_.rank() == 0) {
    const fs::path target = fs::exists(name_) ? fs::canonical(name_) : fs::path(name_);
    if (std::rename(unfinished_.c_str(), target.c_str()) != 0)
      throw InputError(fmt::format("cannot write {}: {}", name_, std::strerror(errno)));
  }
  unfinished_.clear();
}

void SharedOutput::check(int code) const {
  if (code == MPI_SUCCESS) return;
  std::string words(MPI_MAX_ERROR_STRING, '\0');
  int length = 0;
  MPI_Error_string(code, words.data(), &length);
  words.resize(static_cast<std::size_t>(length));
  throw InputError(fmt::format("cannot write {}: {}", name_, words));
}

}  // namespace catena::ranks

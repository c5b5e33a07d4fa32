#pragma once
#include <cstdint>
#include <string>
#include <string_view>

#include "catena/core/ranks/communicator.h"
#include "catena/core/ranks/mpi/mpi_file.h"

namespace catena::ranks {

/// A file that all ranks write at once, each its own part, by MPI-IO; whole or not at all, also when a signal
/// asks the ranks to end. It has another name until it is complete. Every rank opens it for itself, so that
/// one that cannot leaves none waiting. Throws InputError, naming the file and the reason.
class SharedOutput {
 public:
  SharedOutput(Communicator& ranks, std::string name);
  ~SharedOutput();
  SharedOutput(const SharedOutput&) = delete;
  SharedOutput& operator=(const SharedOutput&) = delete;

  /// The texts of all ranks, in their order, after what is there.
  void append(std::string_view own);
  void close();

  /// Of all files of this process that are not closed, for one that ends the others, too: none stays. Any
  /// rank knows all names.
  static void remove_unfinished() noexcept;

 private:
  Communicator& ranks_;
  std::string name_, target_, unfinished_;
  MpiFile file_;
  std::uint64_t written_ = 0;  ///< by all
};

}  // namespace catena::ranks

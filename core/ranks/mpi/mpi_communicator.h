#pragma once
#include <mpi.h>

#include <string>

#include "catena/core/ranks/communicator.h"

namespace catena::ranks {

/// The ranks that mpirun started. One object a process, after MPI_Init_thread.
class MpiCommunicator final : public Communicator {
 public:
  /// `standard_error` is a descriptor for what cannot wait for rank 0.
  MpiCommunicator(MPI_Comm world, int standard_error);
  unsigned rank() const override { return rank_; }
  unsigned size() const override { return size_; }

  void vote() override;
  /// Where the others do not come to a vote within seconds, as they are deep in a search of their own, this
  /// rank, or the first of those that wait so, says why it failed itself, and ends them all; no file is left.
  std::string fail(const std::string& what) override;

 private:
  Gathered gather(Bytes own) override;
  std::vector<Message> deliver(std::vector<Message> out) override;
  void transfer(std::span<const Outgoing> out, const Destination& to) override;
  /// How many bytes come from each rank, by what each sends to others.
  std::vector<std::uint64_t> told_sizes(const std::vector<std::uint64_t>& sent);
  [[noreturn]] void end_all(const std::string& what);
  /// The words of the first rank that failed.
  std::string words_of(int failed, std::string own);

  const MPI_Comm world_;
  const int standard_error_;
  unsigned rank_ = 0, size_ = 1;
};

}  // namespace catena::ranks

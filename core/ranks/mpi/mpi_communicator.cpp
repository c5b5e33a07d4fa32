#include "catena/core/ranks/mpi/mpi_communicator.h"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <climits>
#include <cstdlib>
#include <numeric>
#include <thread>

#include "catena/core/executor/large_vector.h"
#include "catena/core/one_line.h"
#include "catena/core/ranks/mpi/rank_fault.h"
#include "catena/core/ranks/mpi/shared_output.h"

namespace catena::ranks {
namespace {

constexpr std::size_t most_bytes = std::size_t{1} << 30;  // of a message; MPI counts them in an int
constexpr int tag = 0, tag_of_the_end = 1;

std::size_t pieces_of(std::size_t bytes) { return (bytes + most_bytes - 1) / most_bytes; }

/// Of messages of so many bytes each.
std::size_t pieces_in(const std::vector<std::uint64_t>& bytes) {
  return std::accumulate(bytes.begin(), bytes.end(), std::size_t{0},
                         [](std::size_t sum, std::uint64_t of) { return sum + pieces_of(of); });
}

/// Messages on their way, in pieces. There is room for all from the start, as nothing may throw once one is
/// on its way: it would come into memory that is gone.
class Transfers {
 public:
  Transfers(MPI_Comm world, std::size_t pieces) : world_(world) { requests_.reserve(pieces); }
  void receive(unsigned rank, std::byte* to, std::size_t bytes) {
    in_pieces(bytes, [&](std::size_t done, int piece, MPI_Request* request) {
      MPI_Irecv(to + done, piece, MPI_BYTE, static_cast<int>(rank), tag, world_, request);
    });
  }
  void send(unsigned rank, std::span<const std::byte> bytes) {
    in_pieces(bytes.size(), [&](std::size_t done, int piece, MPI_Request* request) {
      MPI_Isend(bytes.data() + done, piece, MPI_BYTE, static_cast<int>(rank), tag, world_, request);
    });
  }
  void wait() { MPI_Waitall(static_cast<int>(requests_.size()), requests_.data(), MPI_STATUSES_IGNORE); }

 private:
  template <class Begin>
  void in_pieces(std::size_t bytes, const Begin& begin) {
    for (std::size_t done = 0; done < bytes; done += most_bytes)
      begin(done, static_cast<int>(std::min(most_bytes, bytes - done)), &requests_.emplace_back());
  }

  const MPI_Comm world_;
  std::vector<MPI_Request> requests_;
};

}  // namespace

MpiCommunicator::MpiCommunicator(MPI_Comm world, int standard_error)
    : world_(world), standard_error_(standard_error) {
  int rank = 0, size = 1;
  MPI_Comm_rank(world_, &rank);
  MPI_Comm_size(world_, &size);
  rank_ = static_cast<unsigned>(rank), size_ = static_cast<unsigned>(size);
}

void MpiCommunicator::vote() {
  int well = static_cast<int>(size_), failed = 0;
  MPI_Request request;
  // Not MPI_Allreduce, which would not meet what a failed rank calls.
  MPI_Iallreduce(&well, &failed, 1, MPI_INT, MPI_MIN, world_, &request);
  MPI_Wait(&request, MPI_STATUS_IGNORE);
  if (failed < static_cast<int>(size_)) throw RankFailed(words_of(failed, ""));
}

std::string MpiCommunicator::fail(const std::string& what) {
  const int own = static_cast<int>(rank_);
  int failed = 0, done = 0;
  MPI_Request request;
  MPI_Iallreduce(&own, &failed, 1, MPI_INT, MPI_MIN, world_, &request);
  const auto last = std::chrono::steady_clock::now() + patience_with_others();
  for (MPI_Test(&request, &done, MPI_STATUS_IGNORE); !done; MPI_Test(&request, &done, MPI_STATUS_IGNORE)) {
    if (std::chrono::steady_clock::now() > last) end_all(what);
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
  }
  return words_of(failed, what);
}

void MpiCommunicator::end_all(const std::string& what) {
  const auto wait_ms = [] { std::this_thread::sleep_for(std::chrono::milliseconds(1)); };
  // Ranks that wait so look for messages, others do not: the first of the former is known to them all.
  std::vector<MPI_Request> told(size_, MPI_REQUEST_NULL);
  for (unsigned rank = 0; rank < size_; ++rank)
    if (rank != rank_)
      MPI_Isend(nullptr, 0, MPI_BYTE, static_cast<int>(rank), tag_of_the_end, world_, &told[rank]);
  bool first = true;
  for (int ms = 0; ms < 300; ++ms, wait_ms()) {
    int came = 0;
    MPI_Status from;
    MPI_Iprobe(MPI_ANY_SOURCE, tag_of_the_end, world_, &came, &from);
    if (came == 0) continue;
    MPI_Recv(nullptr, 0, MPI_BYTE, from.MPI_SOURCE, tag_of_the_end, world_, MPI_STATUS_IGNORE);
    first = first && static_cast<int>(rank_) < from.MPI_SOURCE;
  }
  if (first) {
    SharedOutput::remove_unfinished();
    const std::string line = fmt::format("catena: {}\n", one_line(what));
    static_cast<void>(::write(standard_error_, line.data(), line.size()) < 0);  // there is nobody to tell
  } else {
    std::this_thread::sleep_for(patience_with_others());  // for the first to end this one
  }
  MPI_Abort(world_, 2);
  std::abort();
}

std::string MpiCommunicator::words_of(int failed, std::string own) {
  int length = static_cast<int>(own.size());
  MPI_Bcast(&length, 1, MPI_INT, failed, world_);
  own.resize(static_cast<std::size_t>(length));
  MPI_Bcast(own.data(), length, MPI_CHAR, failed, world_);
  return own;
}

Gathered MpiCommunicator::gather(Bytes own) {
  const auto own_size = static_cast<std::uint64_t>(own.size());
  std::vector<std::uint64_t> sizes(size_);
  MPI_Allgather(&own_size, 1, MPI_UINT64_T, sizes.data(), 1, MPI_UINT64_T, world_);
  std::uint64_t sum = 0;
  std::vector<int> counts, offsets;
  for (const std::uint64_t size : sizes) {
    offsets.push_back(static_cast<int>(sum)), counts.push_back(static_cast<int>(size));
    sum += size;
    if (sum > INT_MAX)
      throw Error(fmt::format("{} ranks are more than can tell one another where they are", size_));
  }
  Bytes all(sum);
  auto parts = std::make_shared<std::vector<Bytes>>();
  vote();  // all have the memory
  MPI_Allgatherv(own.data(), static_cast<int>(own.size()), MPI_BYTE, all.data(), counts.data(),
                 offsets.data(), MPI_BYTE, world_);
  for (unsigned r = 0; r < size_; ++r)
    parts->emplace_back(all.begin() + offsets[r], all.begin() + offsets[r] + counts[r]);
  return parts;
}

std::vector<std::uint64_t> MpiCommunicator::told_sizes(const std::vector<std::uint64_t>& sent) {
  std::vector<std::uint64_t> coming(size_);
  MPI_Alltoall(sent.data(), 1, MPI_UINT64_T, coming.data(), 1, MPI_UINT64_T, world_);
  return coming;
}

std::vector<Message> MpiCommunicator::deliver(std::vector<Message> out) {
  std::vector<std::uint64_t> sent(size_);
  for (const Message& message : out) sent[message.rank] = message.bytes.size();
  const std::vector<std::uint64_t> coming = told_sizes(sent);
  std::vector<Message> in;
  for (unsigned rank = 0; rank < size_; ++rank)
    if (coming[rank] > 0) {
      in.push_back({rank, {}});
      if (rank != rank_) resize_large(in.back().bytes, coming[rank]);
    }
  Transfers transfers(world_, pieces_in(sent) + pieces_in(coming));
  vote();  // all have the memory, and none waits for another's

  for (Message& message : in)
    if (message.rank != rank_) transfers.receive(message.rank, message.bytes.data(), message.bytes.size());
  for (Message& message : out) {
    if (message.rank != rank_) {
      transfers.send(message.rank, message.bytes);
    } else if (!message.bytes.empty()) {
      std::ranges::find(in, rank_, &Message::rank)->bytes = std::move(message.bytes);
    }
  }
  transfers.wait();
  return in;
}

void MpiCommunicator::transfer(std::span<const Outgoing> out, const Destination& to) {
  std::vector<std::uint64_t> sent(size_);
  for (const Outgoing& message : out) sent[message.rank] = message.bytes.size();
  const std::vector<std::uint64_t> coming = told_sizes(sent);
  std::vector<std::byte*> places(size_);
  for (unsigned rank = 0; rank < size_; ++rank)
    if (coming[rank] > 0) places[rank] = to(rank, coming[rank]);
  Transfers transfers(world_, pieces_in(sent) + pieces_in(coming));
  vote();  // all have the memory

  for (unsigned rank = 0; rank < size_; ++rank) transfers.receive(rank, places[rank], coming[rank]);
  for (const Outgoing& message : out) transfers.send(message.rank, message.bytes);
  transfers.wait();
}

}  // namespace catena::ranks

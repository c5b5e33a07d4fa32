#pragma once
#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "catena/core/error.h"

namespace catena::ranks {

/// What ranks send one another, as it lies in memory.
using Bytes = std::vector<std::byte>;

/// To a rank, or from one.
struct Message {
  unsigned rank;
  Bytes bytes;
};

/// Bytes to a rank, which stay where they are.
struct Outgoing {
  unsigned rank;
  std::span<const std::byte> bytes;
};

/// Where so many bytes of a rank are to come.
using Destination = std::function<std::byte*(unsigned rank, std::size_t bytes)>;

/// What each rank gave, in the order of the ranks.
using Gathered = std::shared_ptr<const std::vector<Bytes>>;

/// The work of a rank failed, and with it that of all. Every rank throws it, with what the first of those
/// that failed said.
class RankFailed : public Error {
 public:
  using Error::Error;
};

/// What a rank has sent.
struct Traffic {
  std::uint64_t bytes = 0, messages = 0;  ///< of exchange, to other ranks
  std::uint64_t gathered = 0;             ///< bytes that it gave to all_gather
  std::uint64_t steps = 0;                ///< calls that all ranks made together
};

/// Ranks that work in step: each calls the same functions in the same order. Every call begins with a vote on
/// whether a rank has failed since the last one; then it throws RankFailed on all. So none waits for one that
/// will not come. One thread a rank.
class Communicator {
 public:
  virtual ~Communicator() = default;
  virtual unsigned rank() const = 0;
  virtual unsigned size() const = 0;

  /// What every rank gives. O(all bytes) memory.
  Gathered all_gather(Bytes own) {
    vote();
    ++traffic_.steps;
    traffic_.gathered += own.size();
    return gather(std::move(own));
  }

  /// Delivers messages, at most one to a rank; to itself, too. Returns those that came and are not empty, by
  /// rising rank.
  std::vector<Message> exchange(std::vector<Message> out) {
    vote();
    ++traffic_.steps;
    for (const Message& message : out)
      if (message.rank != rank()) traffic_.bytes += message.bytes.size(), ++traffic_.messages;
    return deliver(std::move(out));
  }

  /// As exchange, but to other ranks only, and each message comes to the place that is told for it, by rising
  /// rank. What is sent may be overwritten afterwards. No memory but the caller's.
  void exchange_in_place(std::span<const Outgoing> out, const Destination& to) {
    vote();
    ++traffic_.steps;
    for (const Outgoing& message : out) traffic_.bytes += message.bytes.size(), ++traffic_.messages;
    transfer(out, to);
  }

  /// Throws RankFailed when a rank has failed.
  virtual void vote() = 0;

  /// Instead of the next call: this rank has failed, and says why. Returns, when all ranks know, the words of
  /// the first that failed.
  virtual std::string fail(const std::string& what) = 0;

  const Traffic& traffic() const { return traffic_; }

 protected:
  virtual Gathered gather(Bytes own) = 0;
  virtual std::vector<Message> deliver(std::vector<Message> out) = 0;
  virtual void transfer(std::span<const Outgoing> out, const Destination& to) = 0;

 private:
  Traffic traffic_;
};

/// Runs the work of this rank. When that of any rank throws, every rank throws RankFailed, with the words of
/// the first such rank; `what` in them names the rank. Each rank calls this with its part of the same work.
void together(Communicator& ranks, const std::function<void()>& work);

}  // namespace catena::ranks

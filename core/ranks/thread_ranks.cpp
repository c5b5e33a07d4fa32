#include "catena/core/ranks/thread_ranks.h"

#include <algorithm>
#include <array>
#include <condition_variable>
#include <exception>
#include <mutex>
#include <optional>
#include <thread>
#include <utility>

namespace catena::ranks {
namespace {

/// What the ranks share. A call puts down what it brings and meets the others; what they brought is read
/// before the next but one meeting, so that two boxes, in turn, are enough.
class World {
 public:
  explicit World(unsigned ranks) : ranks_(ranks) {
    for (Box& box : boxes_) box.given.resize(ranks), box.inbox.resize(ranks), box.lent.resize(ranks);
  }
  unsigned ranks() const { return ranks_; }

  /// `bring` is called under the lock with the box of this meeting, `close` by the last rank to come.
  template <class Bring, class Close>
  void meet(std::size_t& turn, const Bring& bring, const Close& close) {
    std::unique_lock lock(mutex_);
    Box& box = boxes_[turn % 2];
    bring(box);
    if (++here_ == ranks_) {
      here_ = 0;
      ++meeting_;
      close(box);
      lock.unlock();  // so that those who wake do not wait for it
      met_.notify_all();
    } else {
      const std::size_t this_one = meeting_;
      met_.wait(lock, [&] { return meeting_ != this_one; });
    }
    ++turn;
  }

  struct Box {
    std::vector<Bytes> given;                 // [rank]
    Gathered gathered;                        // all of `given`
    std::vector<std::vector<Message>> inbox;  // [rank]
    std::vector<std::vector<Outgoing>> lent;  // [rank]: what is read where it lies, and from whom
    std::optional<unsigned> failed;           // the first rank that did, and what it said
    std::string failure;
  };
  Box& box_of_last(std::size_t turn) { return boxes_[(turn + 1) % 2]; }

 private:
  const unsigned ranks_;
  std::mutex mutex_;
  std::condition_variable met_;
  unsigned here_ = 0;
  std::size_t meeting_ = 0;
  std::array<Box, 2> boxes_;
};

class ThreadRank final : public Communicator {
 public:
  ThreadRank(World& world, unsigned rank) : world_(world), rank_(rank) {}
  unsigned rank() const override { return rank_; }
  unsigned size() const override { return world_.ranks(); }

  void vote() override {
    world_.meet(
        turn_, [](World::Box&) {}, [](World::Box&) {});
    if (const World::Box& box = world_.box_of_last(turn_); box.failed) throw RankFailed(box.failure);
  }

  std::string fail(const std::string& what) override {
    const auto take_down = [&](World::Box& box) {
      if (!box.failed || rank_ < *box.failed) box.failed = rank_, box.failure = what;
    };
    world_.meet(turn_, take_down, [](World::Box&) {});
    return world_.box_of_last(turn_).failure;
  }

 private:
  Gathered gather(Bytes own) override {
    world_.meet(
        turn_, [&](World::Box& box) { box.given[rank_] = std::move(own); },
        [](World::Box& box) {
          box.gathered = std::make_shared<const std::vector<Bytes>>(
              std::exchange(box.given, std::vector<Bytes>(box.given.size())));
        });
    return world_.box_of_last(turn_).gathered;
  }

  std::vector<Message> deliver(std::vector<Message> out) override {
    world_.meet(
        turn_,
        [&](World::Box& box) {
          for (Message& message : out)
            if (!message.bytes.empty()) box.inbox[message.rank].push_back({rank_, std::move(message.bytes)});
        },
        [](World::Box&) {});
    std::vector<Message> in = std::exchange(world_.box_of_last(turn_).inbox[rank_], {});
    std::ranges::sort(in, {}, &Message::rank);
    return in;
  }

  void transfer(std::span<const Outgoing> out, const Destination& to) override {
    world_.meet(
        turn_,
        [&](World::Box& box) {
          for (const Outgoing& message : out)
            if (!message.bytes.empty()) box.lent[message.rank].push_back({rank_, message.bytes});
        },
        [](World::Box&) {});
    std::vector<Outgoing> in = std::exchange(world_.box_of_last(turn_).lent[rank_], {});
    std::ranges::sort(in, {}, &Outgoing::rank);
    for (const auto& [rank, bytes] : in) std::ranges::copy(bytes, to(rank, bytes.size()));
    vote();  // all have read
  }

  World& world_;
  const unsigned rank_;
  std::size_t turn_ = 0;
};

}  // namespace

void run_in_threads(unsigned ranks, const std::function<void(Communicator&)>& work) {
  World world(ranks);
  std::vector<std::exception_ptr> thrown(ranks);
  const auto run = [&](unsigned rank) {
    ThreadRank communicator(world, rank);
    try {
      work(communicator);
    } catch (...) {
      thrown[rank] = std::current_exception();
    }
  };
  std::vector<std::jthread> others;
  for (unsigned rank = 1; rank < ranks; ++rank) others.emplace_back(run, rank);
  run(0);
  others.clear();  // joins
  for (const std::exception_ptr& problem : thrown)
    if (problem) std::rethrow_exception(problem);
}

}  // namespace catena::ranks

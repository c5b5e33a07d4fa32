#include "catena/core/ranks/thread_ranks.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <condition_variable>
#include <exception>
#include <mutex>
#include <new>
#include <optional>
#include <system_error>
#include <thread>
#include <utility>

#include "catena/core/error.h"
#include "catena/core/thrown.h"

namespace catena::ranks {
namespace {

/// What the ranks share. A call puts down what it brings and meets the others; what they brought is read
/// before the next but one meeting, so that two boxes, in turn, are enough.
class World {
 public:
  struct Box {
    std::vector<Bytes> given;                 // [rank]
    Gathered gathered;                        // all of `given`
    std::vector<std::vector<Message>> inbox;  // [rank]
    std::vector<std::vector<Outgoing>> lent;  // [rank]: what is read where it lies, and from whom
    std::optional<unsigned> failed;           // the first rank that did, and what it said
    std::string failure;

    void fail(unsigned rank, const std::string& what) {
      if (failed && *failed <= rank) return;
      failure = what;
      failed = rank;
    }
  };

  explicit World(unsigned ranks) : ranks_(ranks) {
    for (Box& box : boxes_) box.given.resize(ranks), box.inbox.resize(ranks), box.lent.resize(ranks);
  }
  unsigned ranks() const { return ranks_; }

  /// `bring` is called under the lock with the box of this meeting, `close` by the last rank to come. Where
  /// either has too little memory, or a rank has left, the meeting has failed, for all alike.
  template <class Bring, class Close>
  Box& meet(unsigned rank, const Bring& bring, const Close& close) {
    std::unique_lock lock(mutex_);
    Box& box = boxes_[meeting_ % 2];
    in_memory(box, rank, bring);
    const std::size_t this_one = meeting_;
    if (++here_ + gone_ == ranks_) {
      in_memory(box, rank, close);
      end_meeting();
      lock.unlock();  // so that those who wake do not wait for it
      met_.notify_all();
    } else {
      met_.wait(lock, [&] { return meeting_ != this_one; });
    }
    return box;
  }

  /// A rank comes to no meeting any more: nobody waits for it.
  void leave() {
    const std::lock_guard lock(mutex_);
    ++gone_;
    if (here_ == 0 || here_ + gone_ < ranks_) return;
    end_meeting();
    met_.notify_all();
  }

 private:
  template <class Work>
  static void in_memory(Box& box, unsigned rank, const Work& work) {
    try {
      work(box);
    } catch (const std::bad_alloc&) {
      box.fail(rank, "out of memory");  // so few letters need none
    }
  }
  void end_meeting() {
    if (gone_ > 0) boxes_[meeting_ % 2].fail(ranks_, "a rank is gone");
    here_ = 0;
    ++meeting_;
  }

  const unsigned ranks_;
  std::mutex mutex_;
  std::condition_variable met_;
  unsigned here_ = 0, gone_ = 0;
  std::size_t meeting_ = 0;
  std::array<Box, 2> boxes_;
};

class ThreadRank final : public Communicator {
 public:
  ThreadRank(World& world, unsigned rank) : world_(world), rank_(rank) {}
  unsigned rank() const override { return rank_; }
  unsigned size() const override { return world_.ranks(); }

  void vote() override {
    meet([](World::Box&) {});
  }

  std::string fail(const std::string& what) override {
    return world_
        .meet(
            rank_, [&](World::Box& box) { box.fail(rank_, what); }, [](World::Box&) {})
        .failure;
  }

 private:
  Gathered gather(Bytes own) override {
    return meet([&](World::Box& box) { box.given[rank_] = std::move(own); },
                [](World::Box& box) {
                  box.gathered = std::make_shared<const std::vector<Bytes>>(
                      std::exchange(box.given, std::vector<Bytes>(box.given.size())));
                })
        .gathered;
  }

  std::vector<Message> deliver(std::vector<Message> out) override {
    World::Box& box = meet([&](World::Box& to) {
      for (Message& message : out)
        if (!message.bytes.empty()) to.inbox[message.rank].push_back({rank_, std::move(message.bytes)});
    });
    std::vector<Message> in = std::exchange(box.inbox[rank_], {});
    std::ranges::sort(in, {}, &Message::rank);
    return in;
  }

  void transfer(std::span<const Outgoing> out, const Destination& to) override {
    World::Box& box = meet([&](World::Box& with) {
      for (const Outgoing& message : out)
        if (!message.bytes.empty()) with.lent[message.rank].push_back({rank_, message.bytes});
    });
    std::vector<Outgoing> in = std::exchange(box.lent[rank_], {});
    std::ranges::sort(in, {}, &Outgoing::rank);
    try {
      for (const auto& [rank, bytes] : in) std::ranges::copy(bytes, to(rank, bytes.size()));
    } catch (...) {  // what this rank lent is read yet by others
      meet([&](World::Box& with) { with.fail(rank_, thrown_words()); });
    }
    vote();  // all have read
  }

  template <class Bring, class Close>
  World::Box& meet(const Bring& bring, const Close& close) {
    World::Box& box = world_.meet(rank_, bring, close);
    if (box.failed) throw RankFailed(box.failure);
    return box;
  }
  template <class Bring>
  World::Box& meet(const Bring& bring) {
    return meet(bring, [](World::Box&) {});
  }

  World& world_;
  const unsigned rank_;
};

/// What the lowest rank threw that failed itself, not because another had.
void rethrow_first(const std::vector<std::exception_ptr>& thrown) {
  std::exception_ptr first;
  for (const std::exception_ptr& problem : thrown) {
    if (!problem) continue;
    if (!first) first = problem;
    try {
      std::rethrow_exception(problem);
    } catch (const RankFailed&) {
    } catch (...) {
      throw;
    }
  }
  if (first) std::rethrow_exception(first);
}

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
    world.leave();
  };
  std::vector<std::jthread> others;
  others.reserve(ranks - 1);
  const auto without_the_rest = [&] {
    for (std::size_t rank = others.size(); rank < ranks; ++rank) world.leave();  // and without this one
  };
  try {
    for (unsigned rank = 1; rank < ranks; ++rank) others.emplace_back(run, rank);
  } catch (const std::system_error&) {
    without_the_rest();
    throw CapacityError(
        fmt::format("{} ranks are more threads than the system starts here: take fewer", ranks));
  } catch (...) {
    without_the_rest();
    throw;
  }
  run(0);
  others.clear();  // joins
  rethrow_first(thrown);
}

}  // namespace catena::ranks

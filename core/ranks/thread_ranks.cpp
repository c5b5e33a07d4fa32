#include "catena/core/ranks/thread_ranks.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <condition_variable>
#include <exception>
#include <mutex>
#include <optional>
#include <system_error>
#include <thread>
#include <utility>

namespace catena::ranks {
namespace {

/// What the ranks share. A call puts down what it brings and meets the others; what they brought is read
/// before the next but one meeting, so that two boxes, in turn, are enough.
class World {
 public:
  explicit World(unsigned ranks) : ranks_(ranks), boxes_{Box(ranks), Box(ranks)} {}
  unsigned ranks() const { return ranks_; }

  /// `bring` is called under the lock with the box of this meeting, `close` by the last rank to come. It has
  /// failed where a rank has left.
  template <class Bring, class Close>
  void meet(std::size_t& turn, const Bring& bring, const Close& close) {
    std::unique_lock lock(mutex_);
    Box& box = boxes_[turn % 2];
    if (here_ == 0 && box.failed)
      box = Box(ranks_);  // of what a failure two meetings ago kept from being read
    bring(box);
    if (here_ + 1 + gone_ == ranks_) {
      close(box);  // before anything is changed: where it throws, this rank has not come, and comes to fail()
      end_meeting();
      lock.unlock();  // so that those who wake do not wait for it
      met_.notify_all();
    } else {
      ++here_;
      const std::size_t this_one = meeting_;
      met_.wait(lock, [&] { return meeting_ != this_one; });
    }
    ++turn;
  }

  /// A rank comes to no meeting any more, and nobody waits for it: it is done, or has not even the memory to
  /// say that it has failed.
  void leave() {
    const std::lock_guard lock(mutex_);
    ++gone_;
    if (here_ == 0 || here_ + gone_ < ranks_) return;
    end_meeting();
    met_.notify_all();
  }

  struct Box {
    explicit Box(unsigned ranks) : given(ranks), inbox(ranks), lent(ranks) {}
    std::vector<Bytes> given;                 // [rank]
    Gathered gathered;                        // all of `given`
    std::vector<std::vector<Message>> inbox;  // [rank]
    std::vector<std::vector<Outgoing>> lent;  // [rank]: what is read where it lies, and from whom
    std::optional<unsigned> failed;           // the first rank that did, and what it said
    std::string failure;
  };
  Box& box_of_last(std::size_t turn) { return boxes_[(turn + 1) % 2]; }

 private:
  void end_meeting() {
    if (Box& box = boxes_[meeting_ % 2]; gone_ > 0 && !box.failed)
      box.failed = ranks_, box.failure = "a rank is gone";  // so few letters need no memory
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
    meet([](World::Box&) {}, [](World::Box&) {});
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
    meet([&](World::Box& box) { box.given[rank_] = std::move(own); },
         [](World::Box& box) {
           auto all = std::make_shared<std::vector<Bytes>>(box.given.size());
           all->swap(box.given);
           box.gathered = std::move(all);
         });
    return world_.box_of_last(turn_).gathered;
  }

  std::vector<Message> deliver(std::vector<Message> out) override {
    meet(
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
    meet(
        [&](World::Box& box) {
          for (const Outgoing& message : out)
            if (!message.bytes.empty()) box.lent[message.rank].push_back({rank_, message.bytes});
        },
        [](World::Box&) {});
    std::vector<Outgoing> in = std::exchange(world_.box_of_last(turn_).lent[rank_], {});
    std::ranges::sort(in, {}, &Outgoing::rank);
    std::vector<std::byte*> places;
    places.reserve(in.size());
    for (const auto& [rank, bytes] : in) places.push_back(to(rank, bytes.size()));
    vote();  // all have the memory: what a rank without it has lent is read by nobody
    for (std::size_t k = 0; k < in.size(); ++k) std::ranges::copy(in[k].bytes, places[k]);
    vote();  // all have read
  }

  /// Throws RankFailed where another came to fail() instead.
  template <class Bring, class Close>
  void meet(const Bring& bring, const Close& close) {
    world_.meet(turn_, bring, close);
    if (const World::Box& box = world_.box_of_last(turn_); box.failed) throw RankFailed(box.failure);
  }

  World& world_;
  const unsigned rank_;
  std::size_t turn_ = 0;
};

}  // namespace

void run_in_threads(unsigned ranks, const std::function<void(Communicator&)>& work) {
  World world(ranks);
  std::vector<std::exception_ptr> thrown(ranks), failed(ranks);
  const auto run = [&](unsigned rank) {
    ThreadRank communicator(world, rank);
    try {
      together(communicator, [&] {  // none waits for a rank that has thrown
        try {
          work(communicator);
        } catch (const RankFailed&) {
          throw;
        } catch (...) {
          thrown[rank] = std::current_exception();
          throw;
        }
      });
    } catch (...) {
      if (!thrown[rank]) failed[rank] = std::current_exception();
    }
    world.leave();
  };
  // No rank begins before all have a thread: it would wait for one that never comes.
  enum class Start { waits, begins, given_up };
  std::atomic<Start> start = Start::waits;
  const auto tell = [&](Start what) {
    start = what;
    start.notify_all();
  };
  std::vector<std::jthread> others;
  others.reserve(ranks - 1);
  try {
    for (unsigned rank = 1; rank < ranks; ++rank)
      others.emplace_back([&, rank] {
        start.wait(Start::waits);
        if (start == Start::begins) run(rank);
      });
  } catch (const std::system_error& error) {
    tell(Start::given_up);
    throw CapacityError(fmt::format("only {} of {} ranks could be started, a thread each ({}); ask for fewer",
                                    others.size() + 1, ranks, error.code().message()));
  } catch (...) {
    tell(Start::given_up);
    throw;
  }
  tell(Start::begins);
  run(0);
  others.clear();  // joins
  for (const auto* const problems : {&thrown, &failed})
    for (const std::exception_ptr& problem : *problems)
      if (problem) std::rethrow_exception(problem);
}

}  // namespace catena::ranks

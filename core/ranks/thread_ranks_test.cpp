#include "catena/core/ranks/thread_ranks.h"

#include <gtest/gtest.h>
#include <sys/resource.h>
#include <unistd.h>

#include <array>
#include <atomic>
#include <cstdint>
#include <cstdlib>
#include <fstream>
#include <new>
#include <stdexcept>
#include <string>
#include <vector>

#include "catena/core/error.h"
#include "catena/core/ranks/rank_search.h"
#include "catena/core/ranks/test_chain.h"
#include "catena/properties/failing_allocations.h"
#include "catena/properties/testing/sanitized.h"

namespace catena::ranks {
namespace {

/// Of this process: ranks that it has not the addresses for, as each thread wants some for its stack.
bool refuses_more_ranks_than_threads() {
  std::uint64_t pages = 0;
  std::ifstream("/proc/self/statm") >> pages;
  const rlim_t some = pages * static_cast<rlim_t>(sysconf(_SC_PAGESIZE)) + (rlim_t{1} << 28);
  const rlimit most{some, some};
  setrlimit(RLIMIT_AS, &most);
  std::atomic<unsigned> begun = 0;
  try {
    run_in_threads(4000, [&](Communicator& c) {
      ++begun;
      c.vote();
    });
  } catch (const CapacityError& error) {
    return begun == 0 &&
           std::string(error.what()).find(" of 4000 ranks could be started") != std::string::npos;
  }
  return false;
}

TEST(ThreadRanks, AllBeginOrNone) {
  if (properties::sanitized) GTEST_SKIP() << "a sanitizer takes terabytes of addresses";
  EXPECT_EXIT(std::_Exit(refuses_more_ranks_than_threads() ? 0 : 1), testing::ExitedWithCode(0), "");
}

/// Before its first call of the communicator, between two, or after the last: the others wait for none that
/// has thrown.
TEST(ThreadRanks, EndWhereOneThrows) {
  for (unsigned calls = 0; calls <= 3; ++calls)
    for (unsigned failing = 0; failing < 3; ++failing)
      EXPECT_THROW(run_in_threads(3,
                                  [&](Communicator& c) {
                                    for (unsigned call = 0; call < 3; ++call) {
                                      if (call == calls && c.rank() == failing) throw std::bad_alloc();
                                      c.all_gather(Bytes(c.rank()));
                                    }
                                    if (calls == 3 && c.rank() == failing) throw std::bad_alloc();
                                  }),
                   std::bad_alloc)
          << calls << ' ' << failing;
}

/// As processes do.
TEST(ThreadRanks, GoOnAfterAFailureThatIsCaught) {
  run_in_threads(3, [](Communicator& c) {
    for (unsigned failing = 0; failing < 3; ++failing) {
      EXPECT_THROW(together(c,
                            [&] {
                              if (c.rank() == failing) throw InputError("no more");
                            }),
                   RankFailed);
      for (unsigned call = 0; call < 3; ++call) {
        EXPECT_EQ(c.all_gather(Bytes(call))->size(), 3u);
        EXPECT_EQ(c.exchange({{0, Bytes(c.rank() + 1)}}).size(), c.rank() == 0 ? 3u : 0u);
      }
    }
  });
}

/// The lowest rank's own, rather than what others said of another.
TEST(ThreadRanks, ThrowWhatTheLowestThrew) {
  const auto thrown = [](unsigned first, unsigned second) -> std::string {
    try {
      run_in_threads(4, [&](Communicator& c) {
        if (c.rank() == first) throw std::runtime_error("first");
        if (c.rank() == second) throw std::runtime_error("second");
      });
    } catch (const std::runtime_error& error) {
      return error.what();
    }
    return "";
  };
  EXPECT_EQ(thrown(1, 3), "first");
  EXPECT_EQ(thrown(3, 1), "second");
  EXPECT_EQ(thrown(3, 7), "first");
}

/// What is lent is read in no rank once its owner may be gone.
TEST(ThreadRanks, EndWhereOneHasNoPlaceForWhatComes) {
  std::atomic<unsigned> told = 0;
  const auto work = [&](Communicator& c) {
    const Bytes own(1000, std::byte{7});
    std::array<Bytes, 3> came;
    std::vector<Outgoing> out;
    for (unsigned rank = 0; rank < 3; ++rank)
      if (rank != c.rank()) out.push_back({rank, own});
    try {
      c.exchange_in_place(out, [&](unsigned rank, std::size_t bytes) {
        if (c.rank() == 1) throw std::bad_alloc();
        came[rank].resize(bytes);
        return came[rank].data();
      });
    } catch (const RankFailed&) {
      for (const Bytes& bytes : came)
        for (const std::byte byte : bytes)
          EXPECT_EQ(byte, std::byte{0}) << "is read before all have the memory";
      ++told;
      throw;
    }
  };
  EXPECT_THROW(run_in_threads(3, work), std::bad_alloc);
  EXPECT_EQ(told, 2u);
}

/// However little memory there is, and wherever it ends: to say so may want more than there is.
TEST(ThreadRanks, EndWithoutMemory) {
  const Chain chain = chain_of("yarn:n=300");
  for (const Order order : {Order::chain, Order::space}) {
    bool done = false;
    for (std::int64_t given = 0; !done; given += 1 + given / 8) {
      std::vector<RankAnswer> answers(3);
      try {
        const properties::FailingAllocations none(given);
        run_in_threads(3, [&](Communicator& c) {
          RankWork work;
          answers[c.rank()] = search(c, even_part_of(chain, 3, c.rank()), {.order = order}, work);
        });
        done = true;
      } catch (const std::bad_alloc&) {
      } catch (const Error& error) {
        EXPECT_NE(std::string(error.what()).find("out of memory"), std::string::npos) << error.what();
      }
    }
  }
}

/// A rank that has nothing more to say comes to no other call.
TEST(ThreadRanks, WaitForNoneThatIsDone) {
  for (const unsigned done : {0u, 1u, 2u})
    EXPECT_THROW(run_in_threads(3,
                                [&](Communicator& c) {
                                  c.vote();
                                  if (c.rank() != done) c.all_gather(Bytes(1));
                                }),
                 RankFailed);
}

}  // namespace
}  // namespace catena::ranks

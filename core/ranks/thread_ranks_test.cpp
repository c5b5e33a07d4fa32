#include "catena/core/ranks/thread_ranks.h"

#include <gtest/gtest.h>

#include <memory>
#include <new>
#include <stdexcept>
#include <string>
#include <vector>

#include "catena/core/error.h"
#include "catena/core/ranks/rank_search.h"
#include "catena/core/ranks/test_chain.h"
#include "catena/properties/failing_allocations.h"

namespace catena::ranks {
namespace {

/// However little memory there is, and wherever it ends.
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

/// What it lent is read by the others while it has no place for what comes.
TEST(ThreadRanks, KeepWhatTheyLentUntilAllHaveRead) {
  for (int again = 0; again < 100; ++again) try {
      run_in_threads(4, [&](Communicator& c) {
        together(c, [&] {
          const auto own = std::make_unique<Bytes>(1u << 16, std::byte(c.rank()));
          std::vector<Outgoing> lent;
          for (unsigned rank = 0; rank < 4; ++rank)
            if (rank != c.rank()) lent.push_back({rank, *own});
          std::vector<Bytes> came(4);
          c.exchange_in_place(lent, [&](unsigned rank, std::size_t bytes) {
            if (c.rank() == 3) throw std::bad_alloc();
            came[rank].resize(bytes);
            return came[rank].data();
          });
        });
      });
      FAIL() << "one had no memory";
    } catch (const RankFailed& failed) {
      EXPECT_STREQ(failed.what(), "out of memory");
    }
}

/// A rank that throws, or has nothing more to say, comes to no other call.
TEST(ThreadRanks, WaitForNoneThatHasEnded) {
  for (const unsigned gone : {0u, 1u, 2u}) {
    std::vector<std::string> said(3);
    const auto work = [&](bool throws) {
      run_in_threads(3, [&](Communicator& c) {
        c.vote();
        if (c.rank() == gone && throws) throw std::range_error("gone");
        if (c.rank() == gone) return;
        try {
          c.all_gather(Bytes(1));
        } catch (const RankFailed& failed) {
          said[c.rank()] = failed.what();
          throw;
        }
      });
    };
    EXPECT_THROW(work(false), RankFailed);
    EXPECT_THROW(work(true), std::range_error) << "what went wrong first";
    for (unsigned rank = 0; rank < 3; ++rank) EXPECT_EQ(said[rank], rank == gone ? "" : "a rank is gone");
  }
}

}  // namespace
}  // namespace catena::ranks

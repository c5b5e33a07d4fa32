#include "catena/core/thrown.h"

#include <gtest/gtest.h>

#include <new>
#include <stdexcept>
#include <string>
#include <system_error>

namespace catena {
namespace {

template <class Thrown>
std::string blamed(const Thrown& thrown) {
  try {
    blaming("CPU9", [&]() -> int { throw thrown; });
  } catch (const VariantThrew& error) {
    return error.what();
  }
  return "";
}

TEST(Thrown, NamesTheVariantWhateverItThrows) {
  const std::string after = "; the fault is in this variant: see catena fuzz --variant";
  EXPECT_EQ(blamed(std::out_of_range("past the end")), "CPU9 threw: past the end" + after);
  EXPECT_EQ(blamed(std::bad_alloc()),
            "CPU9: out of memory; take fewer spheres or ask for counts instead of pairs");
  const std::string no_thread =
      "CPU9: no more threads can be started; raise ulimit -u or the container's limit of processes, or take "
      "threads=1";
  EXPECT_EQ(blamed(std::system_error(std::make_error_code(std::errc::resource_unavailable_try_again))),
            no_thread);
  EXPECT_EQ(blamed(std::runtime_error("pthread_create has failed: Resource temporarily unavailable")),
            no_thread);
  EXPECT_EQ(blamed(std::system_error(std::make_error_code(std::errc::io_error))).substr(0, 11),
            "CPU9 threw:");
  EXPECT_EQ(blamed(7), "CPU9 threw: a foreign exception" + after);
}

TEST(Thrown, TellsWantOfTheMachineFromAFault) {
  const auto want_of = [](const auto& thrown) {
    try {
      throw thrown;
    } catch (...) {
      return thrown_for_want();
    }
  };
  EXPECT_TRUE(want_of(std::bad_alloc()).starts_with("out of memory"));
  EXPECT_TRUE(want_of(std::runtime_error("pthread_create has failed")).starts_with("no more threads"));
  EXPECT_EQ(want_of(std::runtime_error("a fault")), "");
  EXPECT_EQ(want_of(std::system_error(std::make_error_code(std::errc::io_error))), "");
}

TEST(Thrown, LetsErrorsAndAnswersPass) {
  EXPECT_EQ(blaming("CPU9", [] { return 3; }), 3);
  EXPECT_THROW(blaming("CPU9", [] { throw CapacityError("too long"); }), CapacityError);
  EXPECT_THROW(blaming("CPU9", [] { throw PairLimitExceeded(2, 1); }), PairLimitExceeded);
}

}  // namespace
}  // namespace catena

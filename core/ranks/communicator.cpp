#include "catena/core/ranks/communicator.h"

#include <fmt/format.h>

#include <new>

#include "catena/core/thrown.h"

namespace catena::ranks {

void together(Communicator& ranks, const std::function<void()>& work) {
  const auto fail = [&](const std::string& what) {
    const bool alone = ranks.size() == 1;
    throw RankFailed(
        ranks.fail(alone ? what : fmt::format("rank {} of {}: {}", ranks.rank(), ranks.size(), what)));
  };
  try {
    work();
    ranks.vote();
  } catch (const RankFailed&) {
    throw;
  } catch (const Error& error) {
    fail(error.what());
  } catch (const std::bad_alloc&) {
    fail("out of memory; take more ranks, on more machines, or ask for counts instead of pairs");
  } catch (...) {
    fail(fmt::format("internal error: {}; please report it with the command line", thrown_words()));
  }
}

}  // namespace catena::ranks

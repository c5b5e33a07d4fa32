#include "catena/core/executor/team.h"

#include <oneapi/tbb/blocked_range.h>
#include <oneapi/tbb/parallel_for.h>
#include <oneapi/tbb/task_arena.h>

#include <algorithm>

#include "catena/core/executor/startable_threads.h"
#include "catena/core/executor/usable_cores.h"

namespace catena {

struct Team::Arena {
  explicit Arena(unsigned threads) : arena(static_cast<int>(threads)) {}
  oneapi::tbb::task_arena arena;
};

Team::Team() = default;
Team::Team(const Parameters& parameters)
    : size_(static_cast<unsigned>(parameters.unsigned_integer("threads", 0, 1024))) {
  // More bring nothing, and oneTBB would complain of them.
  const unsigned cores = usable_cores();
  const bool asked = size_ > 1;
  size_ = size_ == 0 ? cores : std::min(size_, cores);
  if (size_ > 1) size_ = 1 + startable_threads(size_ - 1);
  if (size_ == 1 && asked && cores > 1) refuse_threads();
  if (size_ > 1) arena_ = std::make_unique<Arena>(size_);
}
Team::~Team() = default;

unsigned Team::member() const {
  // Outside a body it is the number in an arena of the caller's, or none.
  const auto at = static_cast<unsigned>(oneapi::tbb::this_task_arena::current_thread_index());
  return at < size_ ? at : 0;
}

// Compiled without ThreadSanitizer, which does not see how oneTBB hands its ranges over.
void Team::share_out(std::uint32_t n, std::uint32_t grain, void* body, Call call) const {
  arena_->arena.execute([&] {
    oneapi::tbb::parallel_for(oneapi::tbb::blocked_range<std::uint32_t>(0, n, grain),
                              [&](const auto& range) { call(body, range.begin(), range.end()); });
  });
}

}  // namespace catena

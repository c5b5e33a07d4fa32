#pragma once
#include <atomic>
#include <cstdint>
#include <memory>

#include "catena/core/export.h"
#include "catena/core/parameters/parameters.h"

namespace catena {

/// Host threads that share out ranges of work by stealing (oneTBB). A team of one is the caller alone, and
/// costs nothing.
class CATENA_API Team {
 public:
  static ParameterInfo threads_parameter() {
    return {"threads", "1", "host threads, one a core at most; 0: all cores"};
  }

  Team();  ///< one
  explicit Team(const Parameters& parameters);
  ~Team();
  Team(const Team&) = delete;
  Team& operator=(const Team&) = delete;

  unsigned size() const { return size_; }
  /// The number of the calling thread below size(), in a range's body; elsewhere any below size().
  unsigned member() const;

  /// body(begin, end) for ranges that part 0 .. n, at most about `grain` long, by any members at a time. May
  /// be called in a body: then the member goes on with other ranges while it waits. What body throws, one of
  /// the exceptions, reaches the caller, and other ranges may be left out.
  template <class Body>
  void for_each_range(std::uint32_t n, std::uint32_t grain, const Body& body) const {
    if (n == 0) return;
    if (size_ == 1) return body(0u, n);
    // What a range did is seen by the caller, what it throws or not: oneTBB sees to that, and these say it
    // where ThreadSanitizer, which does not look into oneTBB, can see it.
    struct Shared {
      const Body& body;
      std::atomic<bool> begun{false};
      std::atomic<std::uint32_t> ended{0};
      ~Shared() { static_cast<void>(ended.load(std::memory_order_acquire)); }
    } shared{body};
    struct Range {
      Shared& of;
      explicit Range(Shared& shared) : of(shared) {
        static_cast<void>(of.begun.load(std::memory_order_acquire));
      }
      ~Range() { of.ended.fetch_add(1, std::memory_order_release); }
    };
    shared.begun.store(true, std::memory_order_release);
    share_out(n, grain, &shared, [](void* of, std::uint32_t begin, std::uint32_t end) {
      const Range range(*static_cast<Shared*>(of));
      range.of.body(begin, end);
    });
  }

 private:
  struct Arena;
  using Call = void (*)(void* body, std::uint32_t begin, std::uint32_t end);
  void share_out(std::uint32_t n, std::uint32_t grain, void* body, Call call) const;

  unsigned size_ = 1;
  std::unique_ptr<Arena> arena_;
};

}  // namespace catena

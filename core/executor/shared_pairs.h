#pragma once
#include <algorithm>
#include <atomic>
#include <span>
#include <vector>

#include "catena/core/compiled_for.h"
#include "catena/core/executor/large_vector.h"
#include "catena/core/pair.h"

namespace catena {

/// The pairs of one result, written by several threads at once. They share out the memory of an earlier
/// result in stretches, which costs no copy; what that has no room for each keeps to itself.
class SharedPairs {
 public:
  static constexpr std::size_t stretch = 4096;

  /// One thread's part.
  class Writer {
   public:
    explicit Writer(SharedPairs& all) : all_(all) {}

    void write(std::span<const Pair> pairs) {
      while (!pairs.empty()) {
        if (at_ == end_ && !all_.take_stretch(at_, end_)) {
          append_large(own_, pairs, all_.likely_);
          return;
        }
        const std::size_t fit = std::min(end_ - at_, pairs.size());
        std::copy_n(pairs.begin(), fit, all_.memory_.data() + at_);
        at_ += fit;
        pairs = pairs.subspan(fit);
      }
    }

   private:
    friend class SharedPairs;
    SharedPairs& all_;
    std::size_t at_ = 0, end_ = 0;  // what is left of its stretch
    std::vector<Pair> own_;
  };

  /// Takes the memory of a result, whose pairs are lost. `likely`: how many pairs a thread has addresses for,
  /// once it has kept many to itself.
  explicit SharedPairs(std::vector<Pair>& result, std::size_t likely = 0) : likely_(likely) {
    memory_.swap(result);
  }

  /// All that was written, when the writers are done, in no order. Writers(body) calls body(writer) for each
  /// of them.
  template <class Writers>
  void gather(const Writers& writers, std::vector<Pair>& result) {
    std::size_t end = std::min<std::size_t>(taken_.load(), memory_.size());
    std::vector<std::span<Pair>> holes;
    std::vector<Writer*> keepers;
    writers([&](Writer& writer) {
      if (writer.at_ < writer.end_)
        holes.push_back({memory_.data() + writer.at_, memory_.data() + writer.end_});
      if (!writer.own_.empty()) keepers.push_back(&writer);
    });
    for (std::span<Pair>& hole : holes)
      while (!hole.empty() && !keepers.empty()) fill(hole, keepers);
    // Nobody kept anything: the last pairs come into the holes.
    std::sort(holes.begin(), holes.end(), [](const auto& a, const auto& b) { return a.data() < b.data(); });
    while (!holes.empty()) {
      std::span<Pair>& hole = holes.front();
      if (hole.empty())
        holes.erase(holes.begin());
      else if (holes.back().data() + holes.back().size() == memory_.data() + end)
        end -= holes.back().size(), holes.pop_back();
      else
        hole.front() = memory_[--end], hole = hole.subspan(1);
    }
    append(end, keepers);
    result.swap(memory_);
  }

 private:
  bool take_stretch(std::size_t& at, std::size_t& end) {
    const std::size_t size = memory_.size();
    if (taken_.load(std::memory_order_relaxed) >= size) return false;
    const std::size_t begin = taken_.fetch_add(stretch, std::memory_order_relaxed);
    if (begin >= size) return false;
    at = begin;
    end = std::min(begin + stretch, size);
    return true;
  }

  static void fill(std::span<Pair>& hole, std::vector<Writer*>& keepers) {
    std::vector<Pair>& own = keepers.back()->own_;
    const std::size_t some = std::min(own.size(), hole.size());
    std::copy(own.end() - static_cast<std::ptrdiff_t>(some), own.end(), hole.begin());
    own.resize(own.size() - some);
    hole = hole.subspan(some);
    if (own.empty()) keepers.pop_back();
  }

  void append(std::size_t end, const std::vector<Writer*>& keepers) {
    memory_.resize(end);
    if (keepers.empty()) return;
    std::size_t all = end;
    for (const Writer* writer : keepers) all += writer->own_.size();
    if (memory_.capacity() < all) {
      std::vector<Pair>& largest = (*std::ranges::max_element(keepers, {}, [](const Writer* writer) {
                                     return writer->own_.size();
                                   }))->own_;
      if (largest.capacity() >= all) {  // what is here is appended to it, as to any
        memory_.swap(largest);
      } else {
        memory_.reserve(all + all / 8);  // the next result may be a little larger
        wish_large_pages(memory_.data(), all * sizeof(Pair));
      }
    }
    // By one thread: for all to copy at once, all would first have to be set to zero.
    for (const Writer* writer : keepers)
      memory_.insert(memory_.end(), writer->own_.begin(), writer->own_.end());
  }

  const std::size_t likely_;
  std::vector<Pair> memory_;
  alignas(64) std::atomic<std::size_t> taken_{0};
};

}  // namespace catena

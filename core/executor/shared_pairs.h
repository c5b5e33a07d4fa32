#pragma once
#include <algorithm>
#include <atomic>
#include <cstdint>
#include <span>
#include <vector>

#include "catena/core/executor/large_vector.h"
#include "catena/core/executor/team.h"
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
          own_.insert(own_.end(), pairs.begin(), pairs.end());
          return;
        }
        const std::size_t fit = std::min(end_ - at_, pairs.size());
        std::copy_n(pairs.begin(), fit, all_.memory_.begin() + at_);
        at_ += fit;
        pairs = pairs.subspan(fit);
      }
    }

   private:
    friend class SharedPairs;
    SharedPairs& all_;
    std::size_t at_ = 0, end_ = 0;  // what is left of its stretch
    LargeVector<Pair> own_;
  };

  /// Takes the memory of a result, whose pairs are lost.
  explicit SharedPairs(std::vector<Pair>& result) { memory_.swap(result); }

  /// All that was written, when the writers are done, in no order. Writers(body) calls body(writer) for each
  /// of them.
  template <class Writers>
  void gather(const Writers& writers, const Team& team, std::vector<Pair>& result) {
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
    append(end, keepers, team);
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
    LargeVector<Pair>& own = keepers.back()->own_;
    const std::size_t some = std::min(own.size(), hole.size());
    std::copy(own.end() - some, own.end(), hole.begin());
    own.resize(own.size() - some);
    hole = hole.subspan(some);
    if (own.empty()) keepers.pop_back();
  }

  void append(std::size_t end, const std::vector<Writer*>& keepers, const Team& team) {
    std::vector<std::size_t> begin{end};
    for (const Writer* writer : keepers) begin.push_back(begin.back() + writer->own_.size());
    const std::size_t all = begin.back();
    if (memory_.capacity() < all) {
      std::vector<Pair> larger;
      larger.reserve(all + all / 8);  // the next result may be a little larger
      wish_large_pages(larger.data(), all * sizeof(Pair));
      larger.assign(memory_.begin(), memory_.begin() + end);
      memory_.swap(larger);
    }
    memory_.resize(all);
    team.for_each_range(
        static_cast<std::uint32_t>(keepers.size()), 1, [&](std::uint32_t first, std::uint32_t last) {
          for (std::uint32_t k = first; k < last; ++k)
            std::copy(keepers[k]->own_.begin(), keepers[k]->own_.end(), memory_.begin() + begin[k]);
        });
  }

  std::vector<Pair> memory_;
  alignas(64) std::atomic<std::size_t> taken_{0};
};

}  // namespace catena

#pragma once
#include <vector>

#include "catena/core/cells/buckets.h"

namespace catena {

/// Memory of a Buckets on the host, and its second step. Keeps its memory.
class HostBuckets {
 public:
  /// For that many things; none is sorted yet.
  Buckets reserve(const CellTable& table, std::size_t things) {
    chunks_ = Buckets::chunks(table);
    count_.resize(chunks_ * std::size_t{Buckets::chunk});
    start_.resize(Buckets::starts(chunks_));
    rank_.resize(things);
    places_ = 0;
    return {count_.data(), start_.data(), rank_.data(), &places_};
  }

  /// The second step. Returns the sum of the squares of all buckets' numbers of things.
  float allocate() {
    float squares = 0;
    for (std::uint32_t c = 0; c < chunks_; ++c) {
      std::uint32_t* const start = start_.data() + Buckets::starts(c);
      std::uint32_t* const count = count_.data() + c * std::size_t{Buckets::chunk};
      for (std::uint32_t k = 0; k < Buckets::chunk; ++k) {
        start[k] = places_;
        places_ += count[k];
        squares += static_cast<float>(count[k]) * static_cast<float>(count[k]);
        count[k] = 0;
      }
      start[Buckets::chunk] = places_;
    }
    return squares;
  }

  std::uint32_t places() const { return places_; }

 private:
  std::uint32_t chunks_ = 0, places_ = 0;
  std::vector<std::uint32_t> count_, start_, rank_;
};

}  // namespace catena

#pragma once
#include <cstddef>
#include <vector>

#include "catena/core/executor/large_vector.h"

namespace catena {

/// [level]: boxes, in groups of sixteen. The memory of levels that a frame does without is kept for one that
/// has them again: a crowd that comes and goes must not allocate.
class BoxLevels {
 public:
  std::size_t size() const { return size_; }
  bool empty() const { return size_ == 0; }
  LargeVector<float>& operator[](std::size_t level) { return levels_[level]; }
  const LargeVector<float>& operator[](std::size_t level) const { return levels_[level]; }
  void resize(std::size_t size) {
    if (size > levels_.size()) levels_.resize(size);
    size_ = size;
  }

 private:
  std::vector<LargeVector<float>> levels_;  ///< at least size_
  std::size_t size_ = 0;
};

}  // namespace catena

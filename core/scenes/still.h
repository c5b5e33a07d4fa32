#pragma once
#include <utility>

#include "catena/core/scenes/animation.h"
#include "catena/core/scenes/row.h"

namespace catena {

/// A scene that does not move: one chain, whose spheres are made when they are asked for.
class StillScene final : public Animation {
 public:
  explicit StillScene(Row row, Strands strands = {}, Exclusion exclusion = {})
      : row_(std::move(row)), strands_(std::move(strands)), exclusion_(std::move(exclusion)) {}

  Chain frame(std::uint32_t) const override {
    return Chain(row_.spheres(0, row_.size()), strands_, exclusion_);
  }
  std::optional<ChainByStretches> in_stretches(std::uint32_t) const override {
    return ChainByStretches{
        row_.size(), strands_, exclusion_,
        [row = row_](std::uint32_t first, std::uint32_t end) { return row.spheres(first, end); }};
  }

 private:
  Row row_;
  Strands strands_;
  Exclusion exclusion_;
};

}  // namespace catena

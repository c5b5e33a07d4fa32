#pragma once
#include "catena/core/scenes/animation.h"

namespace catena {

/// A scene that does not move: one chain, made when the scene is opened.
class StillScene final : public Animation {
 public:
  explicit StillScene(Chain chain) : chain_(std::move(chain)) {}
  Chain frame(std::uint32_t) const override { return chain_; }

 private:
  Chain chain_;
};

}  // namespace catena

#pragma once
#include <cstdint>
#include <span>
#include <vector>

#include "catena/core/strategy/evidence.h"

namespace catena {

/// Between a search of all spheres and the sink: a pair with a sphere that was left out as alone was not
/// compared, but told apart by that.
class LoneSink final : public EvidenceSink {
 public:
  /// The sink must outlive this; `others` are those that are not alone.
  LoneSink(std::uint32_t spheres, std::span<const std::uint32_t> others, EvidenceSink& sink)
      : alone_(spheres, true), sink_(sink) {
    for (const std::uint32_t i : others) alone_[i] = false;
  }

  void discarded(std::uint32_t a, std::uint32_t b) override { sink_.discarded(a, b); }
  void tested(std::uint32_t i, std::uint32_t j) override {
    alone_[i] || alone_[j] ? sink_.discarded(i, j) : sink_.tested(i, j);
  }
  void excluded(std::uint32_t i, std::uint32_t j) override {
    alone_[i] || alone_[j] ? sink_.discarded(i, j) : sink_.excluded(i, j);
  }
  void compared(std::uint32_t a, std::uint32_t b) override { sink_.compared(a, b); }

 private:
  std::vector<bool> alone_;
  EvidenceSink& sink_;
};

/// Hears nothing: for a search whose pairs are accounted for elsewhere.
struct NoOnesSink final : EvidenceSink {
  void discarded(std::uint32_t, std::uint32_t) override {}
  void tested(std::uint32_t, std::uint32_t) override {}
  void excluded(std::uint32_t, std::uint32_t) override {}
};

}  // namespace catena

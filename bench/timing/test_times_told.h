#pragma once
#include <chrono>
#include <cstdint>
#include <string>
#include <thread>
#include <vector>

#include "catena/core/executor/pair_collector.h"
#include "catena/core/strategy/test_variant.h"
#include "catena/reference/exact_gap.h"

namespace catena::bench {

/// For tests of who times what: a right answer, with times that are told and not measured, each stage its
/// own, and a list of the calls. Hidden, so that no other test meets it.
class TimesTold final : public Variant {
 public:
  static constexpr double build_ms = 100, update_ms = 200, find_ms = 400, transfer_ms = 50;
  static constexpr double slept_ms = 3;  ///< by build and find together, so that a wall clock sees both

  struct Call {
    std::string stage;
    Sphere last;  ///< of the chain: which frame it is
    friend bool operator==(const Call&, const Call&) = default;
  };
  static inline std::vector<Call> calls;  ///< of all objects

  static VariantInfo info() {
    VariantInfo variant;
    variant.name = "TimesTold", variant.arithmetic = Robust::name, variant.places = {Place::host()};
    return variant;
  }

  void build(const Chain& chain) override {
    called("build", chain);
    timings_.build_ms = build_ms;
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
  }
  void update(const Chain& moved, const Moved&) override {
    called("update", moved);
    timings_.build_ms = update_ms;
  }
  void find(const Chain& chain, const Request& request, Collisions& result) override {
    called("find", chain);
    PairCollector collector(chain.size(), request, result);
    for (std::uint32_t i = 0; i < chain.size(); ++i)
      for (std::uint32_t j = i + 1; j < chain.size(); ++j)
        if (!chain.neighbours(i, j) && reference::gap_sign(chain[i], chain[j]) <= 0)
          collector.lane(0).collide(i, j);
    collector.finish();
    timings_.find_ms = find_ms, timings_.transfer_ms = transfer_ms;
    std::this_thread::sleep_for(std::chrono::milliseconds(2));
  }
  Timings timings() const override { return timings_; }

 private:
  static void called(const std::string& stage, const Chain& chain) {
    calls.push_back({stage, chain[chain.size() - 1]});
  }
  Timings timings_;
};

inline const test::RegisterHidden<TimesTold> times_told{
    {.name = "TimesTold", .summary = "times that are told"}};

}  // namespace catena::bench

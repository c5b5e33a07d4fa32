#pragma once
#include <algorithm>
#include <cstdint>
#include <exception>
#include <string>
#include <system_error>
#include <thread>
#include <vector>

#include "catena/core/chain/chain_view.h"
#include "catena/core/executor/host_group.h"
#include "catena/core/executor/pair_collector.h"
#include "catena/core/executor/startable_threads.h"
#include "catena/core/executor/usable_cores.h"
#include "catena/core/parameters/parameters.h"
#include "catena/core/policies/visitor.h"
#include "catena/core/strategy/evidence.h"
#include "catena/core/strategy/plan.h"

namespace catena {

/// Runs device policies on host threads, so that the logic of a GPU strategy is tested, with sanitizers, on
/// any machine. A host run is never a GPU time: strategies run by it carry "@host" in their name.
class HostExecutor {
 public:
  static ParameterInfo threads_parameter() { return {"threads", "0", "host threads; 0: one a core"}; }

  explicit HostExecutor(const Parameters& parameters)
      : threads_(static_cast<unsigned>(parameters.unsigned_integer("threads", 0, 1024))),
        split_always_(parameters.given("threads")) {
    if (threads_ == 0) threads_ = usable_cores();
  }

  /// visit(i, visitor) for every sphere i that is asked about: the per-sphere strategies. Pairs come in order
  /// of i, whatever the number of threads.
  template <class Visit>
  void for_each_sphere(std::uint32_t n, const Request& request, Collisions& result,
                       const Visit& visit) const {
    collect(n, workers_for(request.queries.within(n).size()), request, result, visit,
            [](std::uint32_t) { return Visitor{}; });
  }

  /// The same on one thread, and the sink is told what every search left out.
  template <class Visit>
  void for_each_sphere(std::uint32_t n, const Request& request, Collisions& result, EvidenceSink& sink,
                       const Visit& visit) const {
    collect(n, 1, request, result, visit, [&](std::uint32_t i) { return EvidenceVisitor(i, sink); });
  }

  /// What it decides for a search of n spheres.
  Decision decision(std::uint32_t n) const {
    const unsigned workers = workers_for(n);
    return {"more threads", workers < threads_,
            std::to_string(workers) + " of " + std::to_string(threads_) + " for " + std::to_string(n) +
                " spheres" +
                (workers < threads_ ? ": one is worth starting for " + std::to_string(items_worth_a_thread)
                                    : "")};
  }

  /// body(group, block) for every block < blocks, each with its own group of `threads_per_block` threads.
  template <class Body>
  void for_each_block(std::uint32_t blocks, std::uint32_t threads_per_block, const Body& body) const {
    split(blocks, workers_for(std::uint64_t{blocks} * threads_per_block),
          [&](unsigned, std::uint32_t begin, std::uint32_t end) {
            HostGroup group(threads_per_block);
            for (std::uint32_t block = begin; block < end; ++block) {
              body(group, block);
              group.barrier();
            }
          });
  }

 private:
  /// Gathers the hits of sphere i; what else the search reports goes to `Observer`, which may ignore it.
  template <class Observer>
  struct LaneVisitor : Observer {
    LaneVisitor(std::uint32_t sphere, PairCollector::Lane& to, const Observer& observer)
        : Observer(observer), i(sphere), lane(to) {}
    void hit(std::uint32_t j) {
      ++collisions;
      if (i < j) lane.pair(i, j);
    }
    std::uint32_t i, collisions = 0;
    PairCollector::Lane& lane;
  };

  template <class Visit, class Observe>
  void collect(std::uint32_t n, unsigned workers, const Request& request, Collisions& result,
               const Visit& visit, const Observe& observe) const {
    PairCollector collector(n, request, result, workers);
    const SphereRange queries = collector.queries();
    split(queries.size(), workers, [&](unsigned worker, std::uint32_t begin, std::uint32_t end) {
      PairCollector::Lane& lane = collector.lane(worker);
      for (std::uint32_t i = queries.begin + begin; i < queries.begin + end && !lane.satisfied(); ++i) {
        LaneVisitor visitor(i, lane, observe(i));
        visit(i, visitor);
        lane.count(i, visitor.collisions);
      }
    });
    collector.finish();
  }

  /// Starting a thread costs more than a short chain, unless the caller asked for that many threads.
  unsigned workers_for(std::uint64_t items) const {
    const std::uint64_t worth = split_always_ ? items : items / items_worth_a_thread;
    return static_cast<unsigned>(std::clamp<std::uint64_t>(worth, 1, threads_));
  }

  template <class Work>
  void split(std::uint32_t n, unsigned workers, const Work& work) const {
    if (workers == 1) return work(0u, 0u, n);
    const auto bound = [&](unsigned w) { return static_cast<std::uint32_t>(std::uint64_t{n} * w / workers); };
    std::vector<std::exception_ptr> failures(workers);
    const auto part = [&](unsigned w) noexcept {
      try {
        work(w, bound(w), bound(w + 1));
      } catch (...) {
        failures[w] = std::current_exception();
      }
    };
    {
      std::vector<std::jthread> threads;
      threads.reserve(workers - 1);
      unsigned w = 1;
      try {
        for (; w < workers; ++w) threads.emplace_back(part, w);
      } catch (const std::system_error&) {
        if (split_always_ && w == 1) refuse_threads();
      }
      for (; w < workers; ++w) part(w);  // of those that could not be started
      part(0);
    }
    for (const auto& failure : failures)
      if (failure) std::rethrow_exception(failure);
  }

  static constexpr std::uint64_t items_worth_a_thread = 4096;
  unsigned threads_;
  bool split_always_;
};

}  // namespace catena

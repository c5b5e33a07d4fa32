#pragma once
#include <vector>

#include "catena/bench/timing/workload.h"
#include "catena/reports/faults.h"
#include "catena/reports/section.h"

namespace catena::reports {

/// For each of the inputs that has a first chain to search, and each exact variant of the host:
/// body(workload, chain, info), in an attempt of its own.
template <class Body>
void for_each_host_variant(const Profile& profile, const std::vector<bench::WorkloadSpec>& inputs,
                           const Body& body) {
  for (const auto& spec : inputs) {
    if (spec.all_frames) continue;
    const auto work = bench::workload(spec);
    const Chain& chain = work->chains.front();
    for (const auto& info : exact_variants(profile)) {
      if (info.on_device() || (info.all_pairs && chain.size() > profile.most_all_pairs)) continue;
      attempt(info.name, [&] { body(*work, chain, info); });
    }
  }
}

/// The same of the inputs that all is measured of.
template <class Body>
void for_each_host_variant(const Profile& profile, const Body& body) {
  for_each_host_variant(profile, profile.inputs, body);
}

}  // namespace catena::reports

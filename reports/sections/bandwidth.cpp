#include <algorithm>
#include <cstddef>
#include <set>
#include <vector>

#include "catena/bench/timing/workload.h"
#include "catena/core/strategy/timings.h"
#include "catena/reports/copied_rate.h"
#include "catena/reports/section.h"

namespace catena::reports {
namespace {

constexpr int repetitions = 9;

/// The rates of copies of an array of `size` bytes, read and written, on one core as the host's variants run.
/// Each is of as many copies as copy `least` bytes, so that no clock's tick shows, and all follow one from
/// which the caches have what they can hold of the arrays.
nlohmann::ordered_json copies(std::size_t size, std::size_t least) {
  const std::vector<std::byte> from(size, std::byte{1});
  std::vector<std::byte> to(size);
  const std::size_t times = std::max<std::size_t>(1, least / size);
  auto rates = nlohmann::ordered_json::array();
  for (int k = -1; k < repetitions; ++k) {
    const Stopwatch watch;
    for (std::size_t copy = 0; copy < times; ++copy) {
      std::ranges::copy(from, to.begin());
      asm volatile("" : : "r"(to.data()) : "memory");  // somebody reads it: no copy is left out
    }
    const double ms = watch.ms(), bytes = static_cast<double>(size) * static_cast<double>(times);
    if (k >= 0) rates.push_back(copied_gb_s(bytes, ms));
  }
  return rates;
}

/// Bytes of the chains whose searches `steps` counts, each once.
std::set<std::size_t> sizes_of_chains(const Profile& profile) {
  std::set<std::size_t> sizes;
  for (const auto* inputs : {&profile.inputs, &profile.long_inputs})
    for (const auto& spec : *inputs)
      if (!spec.all_frames) sizes.insert(bench::facts_of(spec).n * sizeof(Sphere));
  return sizes;
}

/// What the machine's memory carries: a copy between two arrays that no cache holds, against which stages are
/// held; and of arrays as long as the chains, which lie in a cache as those do.
nlohmann::ordered_json bandwidth(const Profile& profile) {
  if (profile.copy_bytes == 0) return {};
  const std::size_t longest = profile.copy_bytes / 2;
  auto sizes = nlohmann::ordered_json::array();
  for (const std::size_t size : sizes_of_chains(profile)) {
    if (size == 0 || size >= longest) continue;  // a longer one lies where the longest does
    constexpr std::size_t least = 16 << 20;      // a millisecond or so
    sizes.push_back({{"copied_bytes", 2 * size}, {"gb_s", copies(size, least)}});
  }
  return {{"place", "host"},
          {"copied_bytes", 2 * longest},
          {"gb_s", copies(longest, longest)},
          {"sizes", std::move(sizes)}};
}

const RegisterSection registered{"bandwidth", bandwidth};

}  // namespace
}  // namespace catena::reports

#include <algorithm>
#include <cstddef>
#include <vector>

#include "catena/core/strategy/timings.h"
#include "catena/reports/section.h"

namespace catena::reports {
namespace {

/// What the machine's memory carries: a copy between two arrays that no cache holds, on one core as the
/// host's variants run, bytes read and written. Its stages are held against this.
nlohmann::ordered_json bandwidth(const Profile& profile) {
  constexpr int repetitions = 9;
  if (profile.copy_bytes == 0) return {};
  const std::vector<std::byte> from(profile.copy_bytes / 2, std::byte{1});
  std::vector<std::byte> to(from.size());
  auto copies = nlohmann::ordered_json::array();
  for (int k = 0; k < repetitions; ++k) {
    const Stopwatch watch;
    std::ranges::copy(from, to.begin());
    copies.push_back(2 * static_cast<double>(from.size()) / (watch.ms() * 1e6));
  }
  return {{"place", "host"}, {"copied_bytes", 2 * from.size()}, {"gb_s", std::move(copies)}};
}

const RegisterSection registered{"bandwidth", bandwidth};

}  // namespace
}  // namespace catena::reports

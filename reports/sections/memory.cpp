#include <malloc.h>
#include <unistd.h>

#include <algorithm>
#include <fstream>
#include <string>

#include "catena/reports/host_variants.h"

namespace catena::reports {
namespace {

/// Bytes that the heap has handed out and that were not given back.
std::int64_t allocated() {
  const struct mallinfo2 heap = mallinfo2();
  return static_cast<std::int64_t>(heap.uordblks + heap.hblkhd);
}

/// A figure of /proc/self/status in bytes; -1 where there is none.
std::int64_t status(const std::string& key) {
  std::ifstream file("/proc/self/status");
  for (std::string line; std::getline(file, line);)
    if (line.starts_with(key + ":")) return 1024 * std::stoll(line.substr(key.size() + 1));
  return -1;
}

/// The most that was resident since this was called last, at least as much as is now.
void forget_peak() { std::ofstream("/proc/self/clear_refs") << 5; }

/// What a host variant holds after a build and a find, its answer apart, and the most that was resident
/// meanwhile beyond what was before; of a device variant the host's part would say nothing, and it is left
/// out.
nlohmann::ordered_json memory(const Profile& profile) {
  auto rows = nlohmann::ordered_json::array();
  for_each_host_variant(profile,
                        [&](const bench::Workload& work, const Chain& chain, const VariantInfo& info) {
                          Collisions found;
                          malloc_trim(0);
                          forget_peak();
                          const std::int64_t before = allocated(), resident = status("VmRSS");
                          auto variant = work.make(info.name);
                          variant->build(chain);
                          variant->find(chain, {}, found);
                          const std::int64_t peak = status("VmHWM") - resident;
                          found = {};
                          rows.push_back({{"input", work.label},
                                          {"variant", info.name},
                                          {"held_bytes", allocated() - before},
                                          {"peak_bytes", std::max<std::int64_t>(0, peak)}});
                        });
  return rows;
}

const RegisterSection registered{"memory", memory};

}  // namespace
}  // namespace catena::reports

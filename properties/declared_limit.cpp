#include "catena/properties/declared_limit.h"

#include <string>

namespace catena::properties {

std::optional<DeclaredLimit> declared_limit(const Subject& subject) {
  if (subject.info.parts.stages.empty()) return std::nullopt;
  const StageName& build = subject.info.parts.stages[0];
  if (build.algorithm() != "bGPU2") return std::nullopt;
  // The paper's block is the host's default; a device's is its own, of 1,024 threads or what the kernel
  // leaves of them.
  std::uint32_t least = 768, most = build.is_host_twin() ? 768 : 1024;
  for (const Setting& setting : build.settings)
    if (setting.key == "block") least = most = static_cast<std::uint32_t>(std::stoul(setting.value));
  return DeclaredLimit{2 * least, 2 * most};
}

bool may_refuse(const std::optional<DeclaredLimit>& limit, std::uint32_t n) {
  return limit && 2 * n > limit->takes;
}

}  // namespace catena::properties

#include "catena/properties/declared_limit.h"

#include <charconv>

namespace catena::properties {

std::optional<DeclaredLimit> declared_limit(const Subject& subject) {
  const std::string& name = subject.info.name;
  if (!name.starts_with("bGPU2")) return std::nullopt;
  const bool on_host = name.starts_with("bGPU2@host");
  // The paper's block is the host's default; a device's is its own, of 1,024 threads or what the kernel
  // leaves of them.
  std::uint32_t least = 768, most = on_host ? 768 : 1024;
  const auto at = name.find("block=");
  if (at != std::string::npos) {
    std::from_chars(name.data() + at + 6, name.data() + name.size(), least);
    most = least;
  }
  return DeclaredLimit{2 * least, 2 * most};
}

bool may_refuse(const std::optional<DeclaredLimit>& limit, std::uint32_t n) {
  return limit && 2 * n > limit->takes;
}

}  // namespace catena::properties

#include "catena/properties/fuzz/sequence.h"

#include <algorithm>
#include <utility>

#include "catena/properties/generators/simplifications.h"

namespace catena::properties {
namespace {

constexpr std::uint32_t tries_a_chain = 200;

/// Takes runs of chains out, long ones first, while the rest fails.
template <class Fails>
void leave_out(std::vector<Chain>& chains, const Fails& fails) {
  for (std::size_t run = chains.size() / 2; run > 0; run /= 2)
    for (std::size_t at = 0; at + run <= chains.size() && chains.size() > 1;) {
      std::vector<Chain> rest = chains;
      rest.erase(rest.begin() + static_cast<std::ptrdiff_t>(at),
                 rest.begin() + static_cast<std::ptrdiff_t>(at + run));
      if (!rest.empty() && fails(rest))
        chains = std::move(rest);
      else
        at += run;
    }
}

}  // namespace

bool fails_in_sequence(const Subject& subject, const std::string& property, const std::vector<Chain>& chains,
                       const Suite::Watch& watch) {
  Suite suite({subject});
  suite.watch(watch);
  for (const Chain& chain : chains)
    for (const Finding& f : suite.check_all(Case::of(chain)))
      if (f.property == property) return true;
  return false;
}

std::optional<std::vector<Chain>> shortest_sequence(const Subject& subject, const std::string& property,
                                                    std::vector<Chain> chains, const Suite::Watch& watch) {
  return shortest_sequence(std::move(chains), [&](const std::vector<Chain>& some) {
    return fails_in_sequence(subject, property, some, watch);
  });
}

std::optional<std::vector<Chain>> shortest_sequence(
    std::vector<Chain> chains, const std::function<bool(const std::vector<Chain>&)>& fails) {
  if (!fails(chains)) return std::nullopt;
  leave_out(chains, fails);
  for (std::size_t k = 0; k < chains.size(); ++k) {
    const auto with = [&](const Chain& simpler) {
      std::vector<Chain> changed = chains;
      changed[k] = simpler;
      return fails(changed);
    };
    Chain simplest = shrink(chains[k], with, tries_a_chain);
    chains[k] = std::move(simplest);
  }
  return chains;
}

}  // namespace catena::properties

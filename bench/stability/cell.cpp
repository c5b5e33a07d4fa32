#include "catena/bench/stability/cell.h"

#include <fmt/format.h>

#include <utility>

#include "catena/bench/stability/not_finite.h"
#include "catena/core/scenes/scene.h"
#include "catena/core/thrown.h"

namespace catena::bench {
namespace {

Outcome judge(const reference::Verification& v, std::uint64_t not_finite_nodes) {
  if (v.verdict == reference::Verdict::unavailable) return Outcome::unavailable;
  if (v.verdict == reference::Verdict::refused) return Outcome::refused;
  if (v.verdict == reference::Verdict::undecided) return Outcome::undecided;
  if (not_finite_nodes > 0) return Outcome::not_finite;
  if (!v.ran || !v.comparison.right()) return Outcome::wrong;
  return v.verdict == reference::Verdict::exact ? Outcome::exact : Outcome::unenclosed;
}

}  // namespace

std::string name_of(Outcome outcome) {
  switch (outcome) {
    case Outcome::exact:
      return "exact";
    case Outcome::unavailable:
      return "unavailable";
    case Outcome::refused:
      return "refused";
    case Outcome::undecided:
      return "undecided";
    case Outcome::unenclosed:
      return "unenclosed";
    case Outcome::wrong:
      return "wrong";
    case Outcome::not_finite:
      return "not finite";
  }
  return "";
}

Cell measure(const std::string& scene, const VariantInfo& info, Variant& variant, const Chain& chain,
             const reference::Answer& exact) {
  Cell cell{scene, info.name, info.arithmetic, chain.size(), exact.pair_count, {}, {}, {}, {}};
  cell.found = reference::verify(variant, !info.exact, chain, exact);
  if (cell.found.ran) {
    NotFiniteNodes nodes;
    blaming(info.name, [&] { variant.visit_bounds(nodes); });
    cell.not_finite_nodes = nodes.count();
  }
  cell.outcome = judge(cell.found, cell.not_finite_nodes);
  cell.defect =
      cell.found.verdict == reference::Verdict::wrong || (info.exact && cell.outcome > Outcome::undecided);
  return cell;
}

Cell unavailable(const std::string& scene, const VariantInfo& info, const Chain& chain,
                 const reference::Answer& exact, std::string why) {
  Cell cell{scene, info.name, info.arithmetic, chain.size(), exact.pair_count, {}, {}, {}, {}};
  cell.found.verdict = reference::Verdict::unavailable;
  cell.found.reason = std::move(why);
  cell.outcome = Outcome::unavailable;
  return cell;
}

std::vector<std::string> stability_scenes(std::uint32_t n) {
  std::vector<std::string> specs;
  for (const SceneInfo& scene : SceneRegistry::instance().scenes()) {
    const std::string sized = fmt::format("{}:n={}", scene.name, n);
    if (scene.settings.empty()) specs.push_back(sized);
    for (const std::string& setting : scene.settings) specs.push_back(sized + "," + setting);
  }
  return specs;
}

}  // namespace catena::bench

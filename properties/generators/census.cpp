#include "catena/properties/generators/census.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>
#include <set>
#include <tuple>

#include "catena/properties/generators/family.h"
#include "catena/reference/all_pairs.h"

namespace catena::properties {
namespace {

struct TraitInfo {
  std::string_view name;
  double quota;  ///< least share of all chains
};

// About a third of what the families give, so that a generator that goes astray is seen and chance is not.
constexpr std::array<TraitInfo, static_cast<std::size_t>(Trait::count)> traits{{
    {"colliding", 0.25},
    {"free of collisions", 0.02},
    {"more pairs than spheres", 0.1},
    {"touching exactly", 0.08},
    {"within 2^-20 of touching", 0.1},
    {"coincident centres", 0.1},
    {"zero radius", 0.05},
    {"denormal numbers", 0.05},
    {"numbers above 2^100", 0.03},
    {"scales 1e30 apart", 0.03},
    {"several strands", 0.05},
    {"closed strand", 0.05},
    {"window above 1", 0.04},
    {"arc window", 0.03},
    {"extra pairs", 0.05},
    {"n near a power of two", 0.1},
    {"n near 384, 768 or 1536", 0},
}};

bool near(std::uint32_t n, std::uint32_t limit) { return n + 1 >= limit && n <= limit + 1; }

bool has_coincident_centres(const Chain& chain) {
  std::set<std::tuple<float, float, float>> places;
  for (const Sphere& s : chain.spheres()) places.insert({s.x, s.y, s.z});
  return places.size() < chain.size();
}

}  // namespace

std::string_view name_of(Trait trait) { return traits[static_cast<std::size_t>(trait)].name; }

void Census::add(const std::string& family, const Case& test) {
  const Chain& chain = test.chain;
  const std::uint32_t n = chain.size();
  ++chains_;
  ++families_[family];
  const auto mark = [&](Trait trait, bool has) { traits_[static_cast<std::size_t>(trait)] += has; };

  float least = std::numeric_limits<float>::infinity(), greatest = 0;
  bool point = false;
  for (const Sphere& s : chain.spheres()) {
    point |= s.radius == 0;
    for (const float number : {s.x, s.y, s.z, s.radius}) {
      if (number != 0) least = std::min(least, std::fabs(number));
      greatest = std::max(greatest, std::fabs(number));
    }
  }
  mark(Trait::zero_radius, point);
  mark(Trait::denormal, least < std::numeric_limits<float>::min());
  mark(Trait::huge, greatest > 0x1p100f);
  mark(Trait::separated, greatest > 0 && double{greatest} / least > 1e30);

  const std::uint64_t pairs = test.exact.pair_count;
  mark(Trait::colliding, pairs > 0);
  mark(Trait::free, pairs == 0 && n >= 2);
  mark(Trait::dense, pairs > n);
  const double margin = reference::all_pairs(chain, {Request::Want::counts}).tightest.margin;
  mark(Trait::touching, margin == 0);
  mark(Trait::nearly_touching, margin < 0x1p-20);
  mark(Trait::coincident, has_coincident_centres(chain));

  const Exclusion& rule = chain.exclusion();
  mark(Trait::several_strands, chain.strand_count() > 1);
  mark(Trait::closed, std::ranges::count(chain.strands().closed, 1) > 0);
  mark(Trait::wide_window, rule.rule == Exclusion::Rule::index_window && rule.window > 1);
  mark(Trait::arc_window, rule.rule == Exclusion::Rule::arc_window);
  mark(Trait::extra_pairs, !rule.extra_pairs.empty());

  bool power = false;
  for (std::uint32_t p = 4; p <= 1u << 20; p *= 2) power |= near(n, p);
  mark(Trait::power_of_two, power);
  mark(Trait::block_limit, near(n, 384) || near(n, 768) || near(n, 1536));
}

std::string Census::report() const {
  std::string text = fmt::format("{} chains\n", chains_);
  const auto line = [&](std::string_view name, std::uint64_t hits) {
    text += fmt::format("  {:<28}{:>8}{:>7.1f} %\n", name, hits,
                        100.0 * static_cast<double>(hits) / static_cast<double>(chains_));
  };
  for (const auto& [family, hits] : families_) line(family, hits);
  text += "traits\n";
  for (std::size_t t = 0; t < traits_.size(); ++t) line(traits[t].name, traits_[t]);
  return text;
}

std::vector<std::string> Census::missed() const {
  std::vector<std::string> missed;
  for (const Family& family : FamilyRegistry::instance().families())
    if (!families_.contains(family.name))
      missed.push_back(fmt::format("family '{}' was never drawn", family.name));
  for (std::size_t t = 0; t < traits_.size(); ++t)
    if (traits_[t] == 0 || static_cast<double>(traits_[t]) < traits[t].quota * static_cast<double>(chains_))
      missed.push_back(fmt::format("'{}' in {} of {} chains, the quota is {:g} %", traits[t].name, traits_[t],
                                   chains_, 100 * traits[t].quota));
  return missed;
}

}  // namespace catena::properties

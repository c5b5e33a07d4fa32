#include "catena/properties/generators/simplifications.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <tuple>

namespace catena::properties {
namespace {

constexpr float Sphere::*members[] = {&Sphere::x, &Sphere::y, &Sphere::z, &Sphere::radius};
constexpr std::uint32_t rules = 8, roundings = 12;

/// 0 for 0; else by significant bits, distance of the exponent from that of 1, and sign.
std::uint32_t complexity(float v) {
  if (v == 0) return std::signbit(v) ? 1 : 0;
  int exponent;
  const auto significand = static_cast<std::uint32_t>(std::ldexp(std::frexp(std::fabs(v), &exponent), 24));
  const int bits = 24 - std::countr_zero(significand);
  return 2 + 2 * static_cast<std::uint32_t>(bits) + static_cast<std::uint32_t>(std::abs(exponent - 1)) +
         (v < 0);
}

std::uint64_t complexity(const std::vector<Sphere>& spheres) {
  std::uint64_t sum = 0;
  for (const Sphere& s : spheres)
    for (const auto member : members) sum += complexity(s.*member);
  return sum;
}

std::uint64_t complexity(const Strands& strands, const Exclusion& exclusion) {
  const auto closed = std::ranges::count_if(strands.closed, [](auto flag) { return flag != 0; });
  // No offsets say the same as two: one strand.
  const std::uint64_t parts = exclusion.extra_pairs.size() + std::max<std::size_t>(strands.first.size(), 2) + closed;
  const std::uint64_t rule = exclusion.rule == Exclusion::Rule::arc_window ? 1u << 31 : exclusion.window;
  return parts * (std::uint64_t{1} << 32) + rule;
}

/// x with all but its first `bits` significant bits dropped.
float shortened(float x, int bits) {
  int exponent;
  const float significand = std::frexp(x, &exponent);
  return std::ldexp(std::trunc(std::ldexp(significand, bits)), exponent - bits);
}

bool simpler_draft(const Draft& a, const Draft& b) {
  const auto measure = [](const Draft& d) {
    return std::make_tuple(d.size(), complexity(d.strands, d.exclusion), complexity(d.spheres));
  };
  return measure(a) < measure(b);
}

}  // namespace

bool simpler(const Chain& a, const Chain& b) { return simpler_draft(Draft::of(a), Draft::of(b)); }

Simplifications::Simplifications(const Chain& chain) : draft_(Draft::of(chain)) {
  using enum Edit::Kind;
  const std::uint32_t n = chain.size();
  for (std::uint32_t count = n / 2; count > 0; count /= 2)
    for (std::uint32_t at = 0; at < n; at += count) edits_.push_back({remove, at, std::min(count, n - at)});
  for (std::uint32_t at = 0; at < n; ++at) edits_.push_back({cut, at, 0});
  const std::uint32_t ways = rules + static_cast<std::uint32_t>(draft_.exclusion.extra_pairs.size());
  for (std::uint32_t how = 0; how < ways; ++how) edits_.push_back({rule, 0, how});
  for (std::uint32_t at = 0; at < n; ++at) edits_.push_back({to_origin, at, 0});
  edits_.push_back({to_scale, 0, 0});
  for (const auto kind : {equal_numbers, number})
    for (std::uint32_t at = 0; at < 4 * n; ++at)
      for (std::uint32_t how = 0; how < roundings; ++how) edits_.push_back({kind, at, how});
}

std::optional<Chain> Simplifications::next() {
  while (next_ < edits_.size()) {
    auto draft = apply(edits_[next_++]);
    if (draft && draft->finite() && simpler_draft(*draft, draft_)) return std::move(*draft).chain();
  }
  return std::nullopt;
}

std::optional<Draft> Simplifications::apply(const Edit& edit) const {
  using enum Edit::Kind;
  Draft draft = draft_;
  switch (edit.kind) {
    case remove:
      draft.remove(edit.at, edit.how);
      return draft;
    case cut:
      draft.remove(edit.at, 1);
      draft.cut(edit.at);
      return draft;
    case rule:
      return plainer_rule(edit.how);
    case to_origin: {
      const Sphere origin = draft.spheres[edit.at];
      for (Sphere& s : draft.spheres) s.x -= origin.x, s.y -= origin.y, s.z -= origin.z;
      return draft;
    }
    case to_scale: {
      float largest = 0;
      for (const Sphere& s : draft.spheres)
        for (const auto member : members) largest = std::max(largest, std::fabs(s.*member));
      if (largest == 0) return std::nullopt;
      const int exponent = std::ilogb(largest);
      for (Sphere& s : draft.spheres)
        for (const auto member : members) s.*member = std::ldexp(s.*member, -exponent);
      return draft;
    }
    case equal_numbers:
    case number:
      return rounder_number(edit.at, edit.how, edit.kind == equal_numbers);
  }
  return std::nullopt;
}

std::optional<Draft> Simplifications::plainer_rule(std::uint32_t how) const {
  Draft draft = draft_;
  auto& exclusion = draft.exclusion;
  switch (how) {
    case 0:
      exclusion.extra_pairs.clear();
      return draft;
    case 1:
      draft.strands = {};
      return draft;
    case 2:
      if (!draft.strands.first.empty()) draft.strands = {{0, draft.size()}, {draft.strands.closed[0]}};
      return draft;
    case 3:
      draft.strands.closed.assign(draft.strands.closed.size(), 0);
      return draft;
    case 4:
    case 5:
    case 6:
    case 7:
      exclusion.rule = Exclusion::Rule::index_window;
      exclusion.factor = 0;
      exclusion.window = how == 4 ? 1 : how == 5 ? 2 : how == 6 ? exclusion.window / 2 : exclusion.window - 1;
      if (exclusion.window < 1) return std::nullopt;
      return draft;
    default:
      exclusion.extra_pairs.erase(exclusion.extra_pairs.begin() + (how - rules));
      return draft;
  }
}

std::optional<Draft> Simplifications::rounder_number(std::uint32_t at, std::uint32_t how,
                                                     bool equal_too) const {
  const auto member = members[at % 4];
  const float old = draft_.spheres[at / 4].*member;
  float value = 0;
  switch (how) {
    case 0:
      break;
    case 1:
      value = 1;
      break;
    case 2:
      value = -old;
      break;
    case 3:
      value = std::fabs(old) >= 2 ? old / 2 : 2 * old;
      break;
    case 4:
      value = std::fabs(old) >= 2 ? old / 1024 : 1024 * old;
      break;
    case 5:
      value = shortened(old, 23);
      break;
    default:
      value = shortened(old, 1 << (how - 6));  // 1, 2, 4, 8, 16 bits; 32 changes nothing
  }
  if (complexity(value) >= complexity(old)) return std::nullopt;
  Draft draft = draft_;
  draft.spheres[at / 4].*member = value;
  if (!equal_too) return draft;
  bool others = false;
  for (Sphere& s : draft.spheres)
    for (const auto each : members)
      if (s.*each == old && old != 0) s.*each = value, others = true;
  return others ? std::optional(std::move(draft)) : std::nullopt;
}

Chain shrink(Chain chain, const std::function<bool(const Chain&)>& fails, std::uint32_t tries) {
  for (bool simpler = true; simpler;) {
    simpler = false;
    Simplifications candidates(chain);
    while (!simpler && tries > 0)
      if (auto candidate = candidates.next()) {
        --tries;
        if (!fails(*candidate)) continue;
        chain = std::move(*candidate);
        simpler = true;
      } else {
        break;
      }
  }
  return chain;
}

}  // namespace catena::properties

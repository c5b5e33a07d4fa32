#pragma once
#include <gtest/gtest.h>

#include <algorithm>
#include <cstring>
#include <set>
#include <string>
#include <vector>

#include "catena/core/input/input.h"
#include "catena/core/readers/base64.h"
#include "catena/core/strategy/registry.h"
#include "catena/reference/reference.h"
#include "catena/reports/section.h"

namespace catena::reports {

using Json = nlohmann::ordered_json;

inline Json section(const std::string& name, const Profile& profile) {
  const auto all = sections();
  return std::ranges::find(all, name, &Section::name)->measure(profile);
}

/// Nothing but these variants.
inline Profile profile_of(const std::set<std::string>& names) {
  Profile p;
  for (const auto& name : names) p.variants.push_back(StrategyRegistry::instance().describe(name));
  p.section_seconds = 0.01;
  p.section_rounds = 3;
  p.stopping.seed = 1;
  return p;
}

/// Two frames of four spheres in a box each, with a pair across a face in the second.
inline bench::WorkloadSpec in_box(bool all_frames = false) {
  bench::WorkloadSpec spec{CATENA_SOURCE_DIR "/core/readers/examples/melt.dump", all_frames};
  spec.options.radius = 0.5f;
  return spec;
}

/// Three spheres in a box of such edges along x each; the second moves after the first frame.
inline std::string in_boxes(const std::vector<std::string>& edges) {
  std::string text;
  for (const std::string& edge : edges)
    text += "3\nLattice=\"" + edge + " 0 0 0 9 0 0 0 9\"\nC 0 0 0\nC 3.5 " + (text.empty() ? "4" : "4.5") +
            " 0\nC 7 0 0\n";
  return text;
}

inline std::string decoded(const std::string& text) {
  std::string bytes;
  EXPECT_TRUE(Base64(text).read(text.size() / 4 * 3 - std::ranges::count(text, '='), bytes));
  return bytes;
}
template <class T>
std::vector<T> array_of(const Json& text) {
  const std::string bytes = decoded(text);
  std::vector<T> values(bytes.size() / sizeof(T));
  if (!values.empty()) std::memcpy(values.data(), bytes.data(), values.size() * sizeof(T));
  return values;
}

inline std::uint64_t exact_pairs(const std::string& spec, std::uint32_t frame) {
  return reference::find(open_input(spec).animation->frame(frame)).pair_count;
}

}  // namespace catena::reports

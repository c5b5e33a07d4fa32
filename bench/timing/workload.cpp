#include "catena/bench/timing/workload.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <deque>
#include <filesystem>
#include <string_view>

#include "catena/core/input/input.h"
#include "catena/core/scenes/scene.h"

namespace catena::bench {
namespace {

constexpr std::uint64_t most_spheres = std::uint64_t{1} << 27;  // kept; about 4 GiB with few pairs

bool same(const WorkloadSpec& a, const WorkloadSpec& b) {
  return a.input == b.input && a.all_frames == b.all_frames;
}

std::uint64_t spheres(const Workload& work) {
  std::uint64_t sum = 0;
  for (const Chain& chain : work.chains) sum += chain.size();
  return sum;
}

Workload made(const WorkloadSpec& spec) {
  Workload work;
  work.spec = spec;
  work.label = label_of(spec);
  const Input input = open_input(spec.input);
  work.frames = input.animation->frames();
  work.first_frame = spec.all_frames ? 0 : work.frames / 2;
  const std::uint32_t end = spec.all_frames ? work.frames : work.first_frame + 1;
  for (std::uint32_t f = work.first_frame; f < end; ++f) {
    work.chains.push_back(input.animation->frame(f));
    work.exact.push_back(reference::find(work.chains.back()));
  }
  return work;
}

}  // namespace

std::string label_of(const WorkloadSpec& spec) {
  const auto colon = spec.input.find(':');
  std::string name = spec.input.substr(0, colon), n;
  std::vector<std::string> others;
  if (SceneRegistry::instance().contains(name) && colon != std::string::npos) {
    std::string_view rest = std::string_view(spec.input).substr(colon + 1);
    while (!rest.empty()) {
      const std::string_view item = rest.substr(0, rest.find(','));
      rest.remove_prefix(std::min(rest.size(), item.size() + 1));
      if (item.starts_with("n="))
        n = item.substr(2);
      else
        others.emplace_back(item);
    }
  } else {
    name = std::filesystem::path(spec.input).filename();
  }
  if (n.empty()) n = std::to_string(open_input(spec.input).animation->frame(0).size());
  if (spec.all_frames) others.emplace_back("frames=all");
  return fmt::format("{}{}{}/n:{}", name, others.empty() ? "" : ":", fmt::join(others, ","), n);
}

std::shared_ptr<const Workload> workload(const WorkloadSpec& spec) {
  static std::deque<std::shared_ptr<const Workload>> recent;
  for (const auto& kept : recent)
    if (same(kept->spec, spec)) return kept;
  recent.push_front(std::make_shared<const Workload>(made(spec)));
  std::uint64_t kept = 0;
  for (const auto& work : recent) kept += spheres(*work);
  for (; kept > most_spheres && recent.size() > 1; recent.pop_back()) kept -= spheres(*recent.back());
  return recent.front();
}

}  // namespace catena::bench

#include "catena/bench/timing/workload.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <deque>
#include <filesystem>
#include <map>
#include <string_view>

#include "catena/core/input/input.h"
#include "catena/core/parameters/whole_number.h"
#include "catena/core/readers/number_text.h"
#include "catena/core/scenes/scene.h"

namespace catena::bench {
namespace {

constexpr std::uint64_t most_spheres = std::uint64_t{1} << 27;  // kept; about 4 GiB with few pairs

bool same(const WorkloadSpec& a, const WorkloadSpec& b) {
  return a.input == b.input && a.all_frames == b.all_frames;
}

std::uint64_t spheres(const Workload& work) {
  std::uint64_t sum = work.beside ? work.beside->size() : 0;
  for (const Chain& chain : work.chains) sum += chain.size();
  return sum;
}

/// What stands before and behind the "/n:" of a label.
struct Label {
  std::string scene;
  std::string n;  ///< in digits, or what the user wrote instead; empty: not said
  std::string text() const { return fmt::format("{}/n:{}", scene, n); }
};

/// 1e6 as 1000000: one label for one input.
std::string in_digits(std::string_view n) {
  const auto number = whole_number(n);
  return number ? std::to_string(*number) : std::string(n);
}

Label written_label(const WorkloadSpec& spec) {
  const auto colon = spec.input.find(':');
  std::string name = spec.input.substr(0, colon), n;
  std::vector<std::string> others;
  if (SceneRegistry::instance().contains(name) && colon != std::string::npos) {
    std::string_view rest = std::string_view(spec.input).substr(colon + 1);
    while (!rest.empty()) {
      const std::string_view item = rest.substr(0, rest.find(','));
      rest.remove_prefix(std::min(rest.size(), item.size() + 1));
      if (item.starts_with("n="))
        n = in_digits(item.substr(2));
      else
        others.emplace_back(item);
    }
  } else {
    name = std::filesystem::path(spec.input).filename();
  }
  if (spec.all_frames) others.emplace_back("frames=all");
  return {fmt::format("{}{}{}", name, others.empty() ? "" : ":", fmt::join(others, ",")), n};
}

Label label_of(const WorkloadSpec& spec, const Input& input) {
  Label label = written_label(spec);
  if (label.n.empty()) label.n = std::to_string(input.animation->frame(0).size());
  return label;
}

Workload made(const WorkloadSpec& spec) {
  Workload work;
  work.spec = spec;
  const Input input = open_input(spec.input);
  work.label = label_of(spec, input).text();
  work.frames = input.animation->frames();
  work.first_frame = spec.all_frames ? 0 : work.frames / 2;
  const std::uint32_t end = spec.all_frames ? work.frames : work.first_frame + 1;
  for (std::uint32_t f = work.first_frame; f < end; ++f) {
    work.chains.push_back(input.animation->frame(f));
    work.exact.push_back(reference::find(work.chains.back()));
  }
  if (!spec.all_frames && work.frames > 1)
    work.beside = input.animation->frame(work.first_frame > 0 ? work.first_frame - 1 : 1);
  return work;
}

}  // namespace

std::string label_of(const WorkloadSpec& spec) {
  const Label written = written_label(spec);
  return written.n.empty() ? label_of(spec, open_input(spec.input)).text() : written.text();
}

WorkloadFacts facts_of(const WorkloadSpec& spec) {
  static std::map<std::string, std::uint32_t> frames_of;  // of scenes that say n
  const Label written = written_label(spec);
  const auto [n, problem] = parse_integer(written.n);
  const auto known = frames_of.find(written.scene);
  if (problem.empty() && n >= 0 && known != frames_of.end())
    return {written.text(), static_cast<std::uint64_t>(n), known->second};
  const Input input = open_input(spec.input);  // says what is wrong with n, too
  const std::uint32_t frames = input.animation->frames();
  if (written.n.empty()) {
    const std::uint32_t size = input.animation->frame(0).size();
    return {label_of(spec, input).text(), size, frames};
  }
  frames_of[written.scene] = frames;
  return {written.text(), static_cast<std::uint64_t>(n), frames};
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

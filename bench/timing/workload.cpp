#include "catena/bench/timing/workload.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <deque>
#include <filesystem>
#include <iterator>
#include <map>
#include <set>
#include <string_view>
#include <system_error>
#include <utility>
#include <vector>

#include "catena/core/commands/input_options.h"
#include "catena/core/commands/show_warnings.h"
#include "catena/core/counted.h"
#include "catena/core/error.h"
#include "catena/core/input/naming.h"
#include "catena/core/parameters/settings.h"
#include "catena/core/parameters/whole_number.h"
#include "catena/core/readers/number_text.h"
#include "catena/core/scenes/scene.h"
#include "catena/core/strategy/registry.h"
#include "catena/reference/find_in_box.h"

namespace catena::bench {
namespace {

constexpr std::uint64_t most_spheres = std::uint64_t{1} << 27;  // kept; about 4 GiB with few pairs

bool same(const WorkloadSpec& a, const WorkloadSpec& b) {
  return a.input == b.input && a.all_frames == b.all_frames &&
         arguments_of(a.options) == arguments_of(b.options);
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

/// What is said of an input, but for its box, as in the name of a case, where commas and slashes part other
/// things.
std::vector<std::string> said_of(InputOptions options) {
  options.box_from = BoxFrom::told;
  std::vector<std::string> said;
  for (const std::string& argument : arguments_of(options))
    if (argument.starts_with("--"))
      said.push_back(argument.substr(2));
    else
      said.back().append("=").append(std::filesystem::path(argument).filename().string());
  for (std::string& text : said) std::ranges::replace(text, ',', '_');
  return said;
}

std::string named(const std::vector<PeriodicBox>& boxes) {
  if (std::ranges::any_of(boxes, [&](const PeriodicBox& box) { return box != boxes[0]; })) return "box=file";
  std::string text = written(boxes[0]);
  std::ranges::replace(text, ',', 'x');
  return "box=" + text;
}

Label written_label(const WorkloadSpec& spec, const std::vector<PeriodicBox>& boxes) {
  const auto colon = spec.input.find(':');
  std::string name = spec.input.substr(0, colon), n;
  std::vector<std::string> others;
  if (SceneRegistry::instance().contains(name) && colon != std::string::npos) {
    for (const auto& [key, value] : parse_settings(name, std::string_view(spec.input).substr(colon + 1)))
      if (key == "n")
        n = in_digits(value);
      else
        others.push_back(key + "=" + value);
  } else {
    name = std::filesystem::path(spec.input).filename();
  }
  if (spec.all_frames) others.emplace_back("frames=all");
  std::ranges::move(said_of(spec.options), std::back_inserter(others));
  if (!boxes.empty()) others.push_back(named(boxes));
  return {fmt::format("{}{}{}", name, others.empty() ? "" : ":", fmt::join(others, ",")), n};
}

/// Throws InputError where the name says another number of spheres than there are: of a `serpentine` its side
/// sets it.
Label label_of(const WorkloadSpec& spec, const Input& input) {
  Label label = written_label(spec, input.boxes);
  const std::uint32_t size = input.animation->frame(0).size();
  if (label.n.empty()) label.n = std::to_string(size);
  if (label.n != std::to_string(size))
    throw InputError(
        fmt::format("{} has {}, whatever n is; leave out n", spec.input, counted(size, "sphere")));
  return label;
}

Workload made(const WorkloadSpec& spec) {
  Workload work;
  work.spec = spec;
  const Input input = open_input(spec.input, spec.options);
  work.label = label_of(spec, input).text();
  work.frames = input.animation->frames();
  work.first_frame = spec.all_frames ? 0 : work.frames / 2;
  const std::uint32_t end = spec.all_frames ? work.frames : work.first_frame + 1;
  for (std::uint32_t f = work.first_frame; f < end; ++f) {
    const PeriodicBox* const box = box_of(input.boxes, f);
    if (box != nullptr) work.boxes.push_back(*box);
    work.chains.push_back(input.animation->frame(f));
    try {
      work.exact.push_back(reference::find_in(work.chains.back(), box));
    } catch (const PairLimitExceeded& exceeded) {
      throw TooManyPairs(work.label, exceeded);
    }
  }
  if (!spec.all_frames && work.frames > 1) {
    const std::uint32_t beside = work.first_frame > 0 ? work.first_frame - 1 : 1;
    work.beside = input.animation->frame(beside);
    if (const PeriodicBox* const box = box_of(input.boxes, beside)) work.box_beside = *box;
  }
  return work;
}

/// Those of a scene, whose label is known before it is opened.
std::vector<PeriodicBox> boxes_of_options(const WorkloadSpec& spec) {
  if (spec.options.box_from != BoxFrom::options) return {};
  return {spec.options.box};
}

/// Refuses a box before anything is measured.
void check_boxes(const Input& input) {
  naming(input.name, [&] {
    for (std::uint32_t f = 0; f < input.boxes.size(); ++f)
      check_box(input.boxes[f], 2 * double{input.animation->frame(f).view().extent.greatest_radius});
  });
}

/// Says what had to be assumed of an input, once.
void show_new_warnings(const Input& input) {
  static std::set<std::string> shown;
  if (shown.insert(input.name).second) show_warnings(input);
}

}  // namespace

TooManyPairs::TooManyPairs(const std::string& label, const PairLimitExceeded& exceeded)
    : CapacityError(fmt::format("{}: {} pairs collide; with more than {} no answer is compared", label,
                                exceeded.found(), exceeded.limit())) {}

const PeriodicBox* Workload::box_of(const Chain& chain) const {
  if (boxes.empty()) return nullptr;
  return beside && &chain == &*beside ? &*box_beside
                                      : &boxes[static_cast<std::size_t>(&chain - chains.data())];
}

std::unique_ptr<Variant> Workload::make(const std::string& variant) const {
  Periodic* unused = nullptr;
  return make(variant, unused);
}

std::unique_ptr<Variant> Workload::make(const std::string& variant, Periodic*& periodic) const {
  auto made = StrategyRegistry::instance().make(variant);
  periodic = put_into_boxes(made, boxes);
  return made;
}

std::string label_of(const WorkloadSpec& spec) {
  const Label written = written_label(spec, boxes_of_options(spec));
  return written.n.empty() ? label_of(spec, open_input(spec.input, spec.options)).text() : written.text();
}

void require_names_apart(const std::vector<WorkloadSpec>& inputs) {
  namespace fs = std::filesystem;
  std::map<fs::path, std::string> files;
  for (const auto& spec : inputs) {
    if (SceneRegistry::instance().contains(spec.input.substr(0, spec.input.find(':')))) continue;
    const std::string& other = files.emplace(fs::path(spec.input).filename(), spec.input).first->second;
    std::error_code absent;
    if (other != spec.input && !fs::equivalent(other, spec.input, absent) && !absent)
      throw InputError(fmt::format(
          "{} and {} have one name without their folders, by which what is measured is told apart; "
          "rename one, or give a link to it",
          other, spec.input));
  }
}

WorkloadFacts facts_of(const WorkloadSpec& spec) {
  static std::map<std::string, std::uint32_t> frames_of;  // of scenes that say n
  const std::vector<PeriodicBox> boxes = boxes_of_options(spec);
  const Label written = written_label(spec, boxes);
  const auto [n, problem] = parse_integer(written.n);
  const auto known = frames_of.find(written.scene);
  if (problem.empty() && n >= 0 && known != frames_of.end() && boxes.empty())
    return {written.text(), static_cast<std::uint64_t>(n), known->second};
  const Input input = open_input(spec.input, spec.options);  // says what is wrong with n, too
  show_new_warnings(input);
  check_boxes(input);
  const Label label = label_of(spec, input);
  const std::uint32_t frames = input.animation->frames();
  if (!written.n.empty()) frames_of[written.scene] = frames;
  return {label.text(), std::stoull(label.n), frames, !input.boxes.empty()};
}

std::shared_ptr<const Workload> workload(const WorkloadSpec& spec) {
  static std::deque<std::shared_ptr<const Workload>> recent;
  static std::vector<std::pair<WorkloadSpec, TooManyPairs>> refused;  // it took as long as others to find out
  for (const auto& kept : recent)
    if (same(kept->spec, spec)) return kept;
  for (const auto& [known, why] : refused)
    if (same(known, spec)) throw TooManyPairs(why);
  try {
    recent.push_front(std::make_shared<const Workload>(made(spec)));
  } catch (const TooManyPairs& why) {
    refused.emplace_back(spec, why);
    throw;
  }
  std::uint64_t kept = 0;
  for (const auto& work : recent) kept += spheres(*work);
  for (; kept > most_spheres && recent.size() > 1; recent.pop_back()) kept -= spheres(*recent.back());
  return recent.front();
}

}  // namespace catena::bench

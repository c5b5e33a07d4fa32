#include <fmt/format.h>

#include <algorithm>
#include <numeric>
#include <utility>

#include "catena/core/readers/reader.h"
#include "catena/core/readers/text_lines.h"

/// SWC neurons: one sample a line, `id type x y z radius parent`. Every sample, those of a soma too, becomes
/// one sphere: nothing is merged or left out, so a soma of three points that overlap is reported as it is
/// stored. A strand runs from a root, or from the first sample of a side branch, always to the first child in
/// file order; a joint ties each side branch to the sample that it grows from. So neighbours are those of the
/// tree.
namespace catena {
namespace {

constexpr std::uint32_t none = 0xFFFFFFFFu;

struct Sample {
  Sphere sphere;
  std::int64_t id, parent;
  std::uint32_t first_child = none, next_sibling = none;
};

class Neuron {
 public:
  Neuron(const std::filesystem::path& file, const ReadOptions& options) : lines_(file), curves_(options) {
    reserve();
    lines_.read_once();
    while (lines_.next_content()) add_sample();
    lines_.forget();
    sort_ids();
    // Backwards, so that each is put in front of its siblings.
    for (auto i = static_cast<std::uint32_t>(samples_.size()); i > 0; --i) link_to_parent(i - 1);
    std::ranges::reverse(roots_);
    if (orphans_ > 0)
      curves_.warnings.push_back(
          fmt::format("line {}: sample {} has the parent {}, which is not in the file; {} such sample{} a "
                      "strand of its own",
                      line_of(first_orphan_), samples_[first_orphan_].id, samples_[first_orphan_].parent,
                      orphans_, orphans_ == 1 ? " starts" : "s start each"));
  }

  CurveFile curves() {
    curves_.has_radii = true;
    curves_.is_tree = true;
    place_.assign(samples_.size(), none);
    for (const std::uint32_t root : roots_) lay_out(root);
    if (curves_.spheres.size() != samples_.size()) fail_for_cycle();
    return std::move(curves_);
  }

 private:
  void add_sample() {
    const auto& fields = lines_.fields();
    if (fields.size() < 7)
      lines_.fail(
          fmt::format("a sample needs 7 columns (id type x y z radius parent), got {}", fields.size()));
    Sample sample{};
    sample.id = lines_.integer(fields[0], "id");
    if (sample.id < 0) lines_.fail(fmt::format("id {} is negative", sample.id));
    sample.sphere =
        curves_.rounding.round(lines_.coordinate(fields[2], "x"), lines_.coordinate(fields[3], "y"),
                               lines_.coordinate(fields[4], "z"), lines_.radius(fields[5]));
    sample.parent = lines_.integer(fields[6], "parent");
    samples_.push_back(sample);
    line_.add(static_cast<std::int64_t>(lines_.line_number()));
  }

  // So that a file of millions of samples is not copied while it is read.
  void reserve() {
    const auto start = lines_.mark();
    std::size_t samples = 0;
    while (lines_.next_content()) ++samples;
    lines_.return_to(start);
    samples_.reserve(samples);
    curves_.spheres.reserve(samples);
  }

  std::size_t line_of(std::uint32_t sample) const {
    return static_cast<std::size_t>(line_.number_of(sample));
  }

  void sort_ids() {
    const auto id_of = [&](std::uint32_t i) { return samples_[i].id; };
    by_id_.resize(samples_.size());
    std::iota(by_id_.begin(), by_id_.end(), 0u);
    std::ranges::stable_sort(by_id_, {}, id_of);
    const auto twice = std::ranges::adjacent_find(by_id_, {}, id_of);
    if (twice != by_id_.end())
      lines_.fail_at(line_of(twice[1]),
                     fmt::format("id {} is already that of line {}", id_of(*twice), line_of(*twice)));
  }

  /// none where no sample has this id.
  std::uint32_t sample_of(std::int64_t id) const {
    const auto id_of = [&](std::uint32_t i) { return samples_[i].id; };
    const auto found = std::ranges::lower_bound(by_id_, id, {}, id_of);
    return found == by_id_.end() || id_of(*found) != id ? none : *found;
  }

  void link_to_parent(std::uint32_t i) {
    const std::int64_t parent = samples_[i].parent;
    if (parent < 0) return roots_.push_back(i);
    const std::uint32_t found = sample_of(parent);
    if (found == none) {
      ++orphans_;
      first_orphan_ = i;
      return roots_.push_back(i);
    }
    samples_[i].next_sibling = std::exchange(samples_[found].first_child, i);
  }

  // Depth first, so that a branch lies near what it grows from; with a stack of our own, as neurons can be
  // deep.
  void lay_out(std::uint32_t root) {
    std::vector<std::uint32_t> starts{root};
    while (!starts.empty()) {
      const std::uint32_t start = starts.back();
      starts.pop_back();
      if (start != root) curves_.joints.push_back({place_[sample_of(samples_[start].parent)], next_place()});
      const std::size_t side_branches = starts.size();
      for (std::uint32_t i = start; i != none; i = samples_[i].first_child) {
        place_[i] = next_place();
        curves_.spheres.push_back(samples_[i].sphere);
        curves_.labels.add(samples_[i].id);
        if (samples_[i].first_child == none) continue;
        for (auto side = samples_[samples_[i].first_child].next_sibling; side != none;
             side = samples_[side].next_sibling)
          starts.push_back(side);
      }
      std::reverse(starts.begin() + static_cast<std::ptrdiff_t>(side_branches), starts.end());
      curves_.end_strand();
    }
  }

  std::uint32_t next_place() const { return static_cast<std::uint32_t>(curves_.spheres.size()); }

  // What no root reaches hangs on a cycle: from any such sample, as many steps up as there are samples end on
  // it.
  [[noreturn]] void fail_for_cycle() {
    std::uint32_t on = 0;
    while (place_[on] != none) ++on;
    for (std::size_t step = 0; step < samples_.size(); ++step) on = sample_of(samples_[on].parent);
    lines_.fail_at(line_of(on),
                   fmt::format("sample {} is its own ancestor; a neuron is a tree, so mend its parent",
                               samples_[on].id));
  }

  TextLines lines_;
  std::vector<Sample> samples_;
  Labels line_;                       ///< of each sample
  std::vector<std::uint32_t> by_id_;  ///< samples, in order of their ids
  std::vector<std::uint32_t> roots_, place_;
  std::size_t orphans_ = 0;
  std::uint32_t first_orphan_ = 0;
  CurveFile curves_;
};

const RegisterReader registered{
    {"SWC neuron", {".swc"}, "id type x y z radius parent; branches become strands", "sample id"},
    read_by<Neuron>};

}  // namespace
}  // namespace catena

#include "catena/core/readers/bead_file.h"

#include <fmt/format.h>

#include <algorithm>
#include <numeric>
#include <utility>

#include "catena/core/error.h"
#include "catena/core/readers/curve_graph.h"
#include "catena/core/readers/in_order.h"

namespace catena {
namespace {

std::vector<std::uint32_t> order_of(const std::vector<std::int64_t>& ids) {
  std::vector<std::uint32_t> order(ids.size());
  std::iota(order.begin(), order.end(), 0u);
  std::ranges::stable_sort(order, {}, [&](std::uint32_t k) { return ids[k]; });
  return order;
}

}  // namespace

void BeadFile::add(std::int64_t id, double x, double y, double z, float radius, std::int64_t molecule) {
  if (frames_ > 0 && curves_.later_frames.size() < frames_) curves_.begin_later_frame();
  auto& ids = frames_ == 0 ? ids_ : later_ids_;
  auto& molecules = frames_ == 0 ? molecules_ : later_molecules_;
  ids.push_back(id);
  if (molecule != 0) molecules.resize(ids.size());
  if (!molecules.empty()) molecules.resize(ids.size()), molecules.back() = molecule;
  curves_.add_point(x, y, z, radius);
}

void BeadFile::end_frame() {
  auto& ids = frames_ == 0 ? ids_ : later_ids_;
  auto& molecules = frames_ == 0 ? molecules_ : later_molecules_;
  if (frames_ > 0 && curves_.later_frames.size() < frames_) curves_.begin_later_frame();
  if (!std::ranges::is_sorted(ids)) {
    const auto order = order_of(ids);
    put_in_order(frames_ == 0 ? curves_.spheres : curves_.later_frames.back(), order);
    put_in_order(ids, order);
    if (!molecules.empty()) put_in_order(molecules, order);
  }
  if (const auto twice = std::ranges::adjacent_find(ids); twice != ids.end())
    throw InputError(fmt::format("{}: atom {} comes twice in frame {}", file_, *twice, frames_));
  if (frames_ > 0 && ids != ids_)
    throw InputError(fmt::format("{}: frame {} has not the same atoms as frame 0", file_, frames_));
  if (frames_ > 0 && other_molecules_.empty()) compare_molecules();
  later_ids_.clear(), later_molecules_.clear();
  ++frames_;
}

void BeadFile::compare_molecules() {
  const auto of = [](const std::vector<std::int64_t>& molecules, std::size_t k) {
    return molecules.empty() ? 0 : molecules[k];
  };
  for (std::size_t k = 0; k < ids_.size(); ++k)
    if (const auto here = of(later_molecules_, k), first = of(molecules_, k); here != first) {
      other_molecules_ = fmt::format(
          "{}: atom {} is of molecule {} in frame {}, of {} in frame 0, so molecules tell no strands; "
          "name a file with bonds by --topology, or keep frames of the same molecules",
          file_, ids_[k], here, frames_, first);
      return;
    }
}

std::optional<std::uint32_t> BeadFile::place_of(std::int64_t id) const {
  const auto found = std::ranges::lower_bound(ids_, id);
  if (found == ids_.end() || *found != id) return {};
  return static_cast<std::uint32_t>(found - ids_.begin());
}

std::string BeadFile::tie(std::int64_t a, std::int64_t b) {
  if (a == b) return fmt::format("a bond ties atom {} to itself", a);
  const auto i = place_of(a), j = place_of(b);
  if (!i || !j) return fmt::format("a bond names atom {}, which is not there", i ? b : a);
  bonds_.push_back({*i, *j});
  return "";
}

void BeadFile::reserve(std::size_t beads, std::size_t bonds) {
  curves_.spheres.reserve(beads);
  ids_.reserve(beads);
  bonds_.reserve(bonds);
}

std::vector<Pair> BeadFile::edges_without_bonds() {
  if (!other_molecules_.empty()) throw InputError(other_molecules_);
  std::vector<Pair> edges;
  if (molecules_.empty()) {
    curves_.warnings.emplace_back(
        "neither bonds nor molecules are told; all beads are one strand in the order of their ids");
    for (std::uint32_t k = 1; k < ids_.size(); ++k) edges.push_back({k - 1, k});
    return edges;
  }
  const auto by_molecule = order_of(molecules_);
  for (std::size_t k = 1; k < by_molecule.size(); ++k) {
    const Pair step{by_molecule[k - 1], by_molecule[k]};
    const std::int64_t molecule = molecules_[step.i];
    if (molecule != 0 && molecule == molecules_[step.j]) edges.push_back(step);
  }
  return edges;
}

CurveFile BeadFile::curves() {
  const auto edges = bonds_.empty() ? edges_without_bonds() : std::move(bonds_);
  std::exchange(molecules_, {});
  for (const std::uint32_t bead : arrange_along_edges(curves_, edges, true)) curves_.labels.add(ids_[bead]);
  return std::move(curves_);
}

}  // namespace catena

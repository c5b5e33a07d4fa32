#include "catena/reference/evidence_tree.h"

#include <random>

#include "catena/reference/enclosure.h"

namespace catena::reference {

EvidenceTree::EvidenceTree(const Chain& chain) : leaves_(chain.size()), nodes_(chain.size()) {
  std::random_device device;
  std::mt19937_64 source(std::uint64_t{device()} << 32 | device());
  Fingerprint::Weight all;
  std::uint64_t same = 0;  // of the pairs (i, i)
  for (std::uint32_t i = 0; i < leaves_; ++i) {
    const Sphere& s = chain[i];
    Node& leaf = nodes_[i];
    leaf.bound = {s.x, s.y, s.z, s.radius};
    leaf.known = 1;
    leaf.weight = Fingerprint::random(source);
    all = {Fingerprint::sum(all.row, leaf.weight.row), Fingerprint::sum(all.column, leaf.weight.column)};
    same = Fingerprint::sum(same, Fingerprint::product(leaf.weight.row, leaf.weight.column));
  }
  all_pairs_ = Fingerprint::difference(Fingerprint::product(all.row, all.column), same);
}

void EvidenceTree::sphere(std::uint32_t parent_id, const Sphere64& parent, std::uint32_t child_id,
                          const Sphere64& child) {
  ++report_.bounds;
  report_.unenclosed += !encloses(parent, child);
  const bool placed = show(parent_id, parent) != nullptr && parent_id >= leaves_;
  Node* const node = show(child_id, child);
  if (!placed || node == nullptr || node->parent != no_parent) {
    ++report_.misplaced;
    return;
  }
  node->parent = parent_id;
  ++nodes_[parent_id].open_children;
}

EvidenceTree::Node* EvidenceTree::show(std::uint32_t id, const Sphere64& bound) {
  if (id / 4 >= leaves_) return nullptr;
  if (id >= nodes_.size()) nodes_.resize(std::size_t{id} + 1);
  Node& node = nodes_[id];
  if (!node.known) {
    node.bound = bound;
    node.known = 1;
  } else if (node.bound != bound) {  // NaN bounds differ from themselves: they prove nothing
    ++(id < leaves_ ? report_.foreign_leaves : report_.misplaced);
  }
  return &node;
}

void EvidenceTree::complete() {
  std::vector<std::uint32_t> ready;
  std::uint64_t known = 0, done = 0;
  for (std::uint32_t id = 0; id < nodes_.size(); ++id) {
    known += nodes_[id].known;
    if (nodes_[id].known && nodes_[id].open_children == 0) ready.push_back(id);
  }
  while (!ready.empty()) {
    const Node& node = nodes_[ready.back()];
    ready.pop_back();
    ++done;
    if (node.parent == no_parent) continue;
    Node& parent = nodes_[node.parent];
    parent.weight = {Fingerprint::sum(parent.weight.row, node.weight.row),
                     Fingerprint::sum(parent.weight.column, node.weight.column)};
    if (--parent.open_children == 0) ready.push_back(node.parent);
  }
  report_.misplaced += known - done;  // in a cycle
}

}  // namespace catena::reference

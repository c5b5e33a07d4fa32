#include "catena/reference/evidence_tree.h"

#include <random>

namespace catena::reference {

EvidenceTree::EvidenceTree(const Chain& chain) : tree_(chain), weights_(chain.size()) {
  std::random_device device;
  std::mt19937_64 source(std::uint64_t{device()} << 32 | device());
  Fingerprint::Weight all;
  std::uint64_t same = 0;  // of the pairs (i, i)
  for (Fingerprint::Weight& weight : weights_) {
    weight = Fingerprint::random(source);
    all = {Fingerprint::sum(all.row, weight.row), Fingerprint::sum(all.column, weight.column)};
    same = Fingerprint::sum(same, Fingerprint::product(weight.row, weight.column));
  }
  all_pairs_ = Fingerprint::difference(Fingerprint::product(all.row, all.column), same);
}

void EvidenceTree::complete() {
  tree_.check(nested_);
  weights_.resize(tree_.size());
  const auto add = [&](std::uint32_t id, std::uint32_t parent) {
    Fingerprint::Weight& above = weights_[parent];
    above = {Fingerprint::sum(above.row, weights_[id].row),
             Fingerprint::sum(above.column, weights_[id].column)};
  };
  for (const BoundTree::Further& f : tree_.further()) add(f.sphere, f.parent);
  for (const std::uint32_t id : tree_.upwards())
    if (const auto parent = tree_.parent(id)) add(id, *parent);
}

}  // namespace catena::reference

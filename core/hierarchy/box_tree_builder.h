#pragma once
#include <algorithm>
#include <cstdint>
#include <vector>

#include "catena/core/chain/chain_view.h"
#include "catena/core/hierarchy/box_tree.h"
#include "catena/core/parameters/parameters.h"

namespace catena {

/// Builds box trees from the top down, by whatever rule parts the spheres of a node, and owns them. Keeps its
/// memory, so that building again for n spheres does not allocate.
class BoxTreeBuilder {
 public:
  static ParameterInfo leaf_parameter() { return {"leaf", "4", "spheres of a leaf, at most"}; }

  explicit BoxTreeBuilder(const Parameters& parameters)
      : leaf_(static_cast<std::uint32_t>(parameters.unsigned_integer("leaf", 1, 1024))) {}

  /// The spheres of the chain in chain order, for the caller to arrange until build.
  std::vector<BoxTree::Item>& items(const ChainView& chain) {
    items_.resize(chain.size);
    for (std::uint32_t i = 0; i < chain.size; ++i) items_[i] = {chain.spheres[i], i};
    return items_;
  }

  /// part(begin, end) arranges the items of a node of more than a leaf's, and says where its second part
  /// begins: after begin, before end. Recursion is as deep as the tree is high.
  template <class Part>
  void build(const Part& part) {
    const auto spheres = static_cast<std::uint32_t>(items_.size());
    nodes_.clear();
    nodes_.reserve(2 * items_.size() + 1);
    height_ = 0;
    if (spheres > 0) make_node(0, spheres, 2, part);
    nodes_.push_back({{}, 0, spheres});
  }

  BoxTree tree() const {
    return {nodes_.data(), items_.data(), nodes_.empty() ? 0 : static_cast<std::uint32_t>(nodes_.size() - 1),
            height_};
  }

  std::uint32_t leaf() const { return leaf_; }

 private:
  /// `levels`, from the root to the spheres below this node, were it a leaf.
  template <class Part>
  void make_node(std::uint32_t begin, std::uint32_t end, std::uint32_t levels, const Part& part) {
    const std::size_t at = nodes_.size();
    nodes_.push_back({{}, 0, begin});
    Box box;
    if (end - begin <= leaf_) {
      box = Box::around(items_[begin].sphere);
      for (std::uint32_t k = begin + 1; k < end; ++k) box.join(Box::around(items_[k].sphere));
      height_ = std::max(height_, levels);
    } else {
      const std::uint32_t middle = part(begin, end);
      make_node(begin, middle, levels + 1, part);
      const std::size_t right = nodes_.size();
      make_node(middle, end, levels + 1, part);
      box = nodes_[at + 1].box;
      box.join(nodes_[right].box);
    }
    nodes_[at].box = box;
    nodes_[at].skip = static_cast<std::uint32_t>(nodes_.size());
  }

  std::vector<BoxTree::Item> items_;
  std::vector<BoxTree::Node> nodes_;
  std::uint32_t leaf_, height_ = 0;
};

}  // namespace catena

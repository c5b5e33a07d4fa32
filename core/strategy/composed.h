#pragma once
#include <memory>
#include <stdexcept>
#include <string>

#include "catena/core/error.h"
#include "catena/core/strategy/mover.h"
#include "catena/core/strategy/space.h"
#include "catena/core/strategy/stages.h"
#include "catena/core/strategy/variant.h"

namespace catena {

/// Any construction with any traversal of the same arithmetic. Data moves only where the two stages live in
/// different memory, and each move is timed apart.
template <class Arithmetic>
class Composed final : public Variant {
  using Bound = typename Arithmetic::Bound;

 public:
  Composed(std::unique_ptr<Construction<Bound>> construction, Space build_space,
           std::unique_ptr<Traversal<Bound>> traversal, Space find_space, std::unique_ptr<Mover> mover)
      : construction_(std::move(construction)),
        traversal_(std::move(traversal)),
        mover_(std::move(mover)),
        build_space_(build_space),
        find_space_(find_space) {}

  void build(const Chain& chain) override {
    timings_ = {};
    built_ = chain.size();
    const bool device = build_space_ == Space::device || find_space_ == Space::device;
    const ChainView on_device = device ? upload(chain) : ChainView{};
    const ChainView to_build = build_space_ == Space::device ? on_device : chain.view();
    find_chain_ = on_device;

    const Stopwatch watch;
    construction_->build(to_build);
    timings_.build_ms = construction_->own_ms() >= 0 ? construction_->own_ms() : watch.ms();
    tree_ = construction_->hierarchy();
    require_height(tree_.height);
    build_transfer_ms_ = timings_.transfer_ms;
    if (build_space_ != find_space_) move_tree();
  }

  void find(const Chain& chain, const Request& request, Collisions& result) override {
    require_built(chain);
    timings_.transfer_ms = build_transfer_ms_;
    const Stopwatch watch;
    traversal_->find(find_space_ == Space::device ? find_chain_ : chain.view(), tree_, request, result);
    timings_.find_ms = traversal_->own_ms() >= 0 ? traversal_->own_ms() : watch.ms();
    timings_.transfer_ms += traversal_->own_transfer_ms();
  }

  /// Evidence names nodes by slots of the host's tree, so it is to be had from traversals on the host.
  Accounting evidence() const override {
    return find_space_ == Space::host ? traversal_->evidence() : Accounting::none;
  }

  void find_with_evidence(const Chain& chain, const Request& request, Collisions& result,
                          EvidenceSink& sink) override {
    require_built(chain);
    const Stopwatch watch;
    traversal_->find_with_evidence(chain.view(), tree_, request, result, sink);
    timings_.find_ms = watch.ms();
  }

  Timings timings() const override { return timings_; }

  void visit_bounds(BoundsVisitor& visitor) const override {
    HierarchyView<Bound> tree = construction_->hierarchy();
    if (build_space_ == Space::device) tree = mover_->to_host(tree);
    const auto wide = [&](std::uint32_t slot) {
      const Bound& b = tree.bound[slot];
      return Sphere64{b.x, b.y, b.z, b.radius};
    };
    visitor.levels(tree.height);
    for (std::uint32_t slot = tree.leaves; slot < tree.size(); ++slot) {
      visitor.sphere(slot, wide(slot), tree.links[slot].left, wide(tree.links[slot].left));
      visitor.sphere(slot, wide(slot), tree.links[slot].right, wide(tree.links[slot].right));
    }
  }

 private:
  static void require_height(std::uint32_t levels) {
    if (levels > max_hierarchy_height)
      throw CapacityError("the hierarchy has " + std::to_string(levels) +
                          " levels, and traversals hold at most " + std::to_string(max_hierarchy_height) +
                          "; use a construction that balances, such as aCPU2");
  }
  void require_built(const Chain& chain) const {
    if (chain.size() != built_) throw std::logic_error("find: not the chain of the last build");
  }
  ChainView upload(const Chain& chain) {
    const Stopwatch watch;
    const ChainView view = mover_->to_device(chain.view());
    timings_.transfer_ms += watch.ms();
    return view;
  }
  void move_tree() {
    const Stopwatch watch;
    tree_ = find_space_ == Space::device ? mover_->to_device(tree_) : mover_->to_host(tree_);
    build_transfer_ms_ = timings_.transfer_ms += watch.ms();
  }

  std::unique_ptr<Construction<Bound>> construction_;
  std::unique_ptr<Traversal<Bound>> traversal_;
  std::unique_ptr<Mover> mover_;  // null when everything is on the host
  Space build_space_, find_space_;
  std::uint32_t built_ = 0;
  ChainView find_chain_{};  // on the device, when the traversal is
  HierarchyView<Bound> tree_{};
  Timings timings_;
  double build_transfer_ms_ = 0;
};

}  // namespace catena

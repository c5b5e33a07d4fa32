#pragma once
#include <memory>
#include <optional>
#include <stdexcept>
#include <string>

#include "catena/core/error.h"
#include "catena/core/strategy/device.h"
#include "catena/core/strategy/place.h"
#include "catena/core/strategy/stages.h"
#include "catena/core/strategy/variant.h"

namespace catena {

/// Any construction with any traversal of the same tree and arithmetic. Data moves only where the two stages
/// live in different memory, and each move is timed apart.
template <class Tree>
class Composed final : public Variant, private ResidentSearch {
 public:
  /// `device` is null when everything is on the host. Stages that live apart need a tree that is Movable.
  Composed(std::unique_ptr<Construction<Tree>> construction, Place build_place,
           std::unique_ptr<Traversal<Tree>> traversal, Place find_place, std::unique_ptr<Device> device)
      : construction_(std::move(construction)),
        traversal_(std::move(traversal)),
        device_(std::move(device)),
        build_place_(build_place),
        find_place_(find_place) {}

  void prepare(const Request& request) override {
    construction_->prepare(request);
    traversal_->prepare(request);
  }

  void build(const Chain& chain) override {
    make_tree(chain, {}, [&](const ChainView& view) { construction_->build(view); });
  }

  void update(const Chain& chain, const Moved& moved) override {
    if (built_ != chain.size()) return build(chain);
    make_tree(chain, moved, [&](const ChainView& view) { construction_->update(view, moved); });
  }

  void find(const Chain& chain, const Request& request, Collisions& result) override {
    require_built(chain);
    timings_.transfer_ms = build_transfer_ms_;
    timings_.start_ms = build_start_ms_;
    if (!find_place_.on_device()) {
      const Stopwatch watch;
      traversal_->find(chain.view(), tree_, request, result);
      timings_.find_ms = watch.ms();
      return;
    }
    const auto times = device_->answer(
        chain.size(), request, result,
        [&](const ResidentAnswer& answer, StreamHandle stream) {
          traversal_->enqueue(chain_on_device_, tree_, request, answer, stream);
        },
        [&](const ResidentState& seen) { traversal_->mend(seen); });
    timings_.find_ms = times.work_ms;
    timings_.transfer_ms += times.transfer_ms;
    timings_.start_ms += times.start_ms;
  }

  /// Evidence names nodes of the host's tree, so it is to be had from traversals on the host.
  Accounting evidence() const override {
    return find_place_.on_device() ? Accounting::none : traversal_->evidence();
  }

  void find_with_evidence(const Chain& chain, const Request& request, Collisions& result,
                          EvidenceSink& sink) override {
    require_built(chain);
    const Stopwatch watch;
    traversal_->find_with_evidence(chain.view(), tree_, request, result, sink);
    timings_.find_ms = watch.ms();
  }

  Timings timings() const override { return timings_; }

  Plan plan() const override {
    Plan plan = construction_->plan();
    for (Decision& decision : traversal_->plan()) plan.push_back(std::move(decision));
    return plan;
  }

  void visit_bounds(BoundsVisitor& visitor) const override {
    if (!built_) return;
    Tree tree = construction_->hierarchy();
    if (build_place_.on_device()) {
      if constexpr (Movable<Tree>)
        tree = device_->to_host(tree);
      else
        return;
    }
    show_bounds(tree, visitor);
  }

  ResidentSearch* resident() override {
    return build_place_.on_device() && find_place_.on_device() ? this : nullptr;
  }

 private:
  void enqueue_build(const ChainView& chain, const Request&, StreamHandle stream) override {
    built_.reset();  // this object's own chain is no longer the one of the tree
    construction_->enqueue(chain, stream);
    require_height(construction_->hierarchy().height);
  }
  void enqueue_find(const ChainView& chain, const Request& request, const ResidentAnswer& answer,
                    StreamHandle stream) override {
    device_->clear(answer, chain.size, stream);
    traversal_->enqueue(chain, construction_->hierarchy(), request, answer, stream);
  }
  void mend(const ResidentState& seen) override { traversal_->mend(seen); }

  /// `make` builds on the host; on a device the construction is enqueued. Nothing counts as built until all
  /// of it is.
  template <class Make>
  void make_tree(const Chain& chain, const Moved& moved, const Make& make) {
    timings_ = {};
    built_.reset();
    if (build_place_.on_device() || find_place_.on_device()) upload(chain, moved);
    if (build_place_.on_device()) {
      const auto times =
          device_->run([&](StreamHandle stream) { construction_->enqueue(chain_on_device_, stream); });
      timings_.build_ms = times.work_ms;
      timings_.start_ms = times.start_ms;
    } else {
      const Stopwatch watch;
      make(chain.view());
      timings_.build_ms = watch.ms();
    }
    tree_ = construction_->hierarchy();
    require_height(tree_.height);
    if (build_place_ != find_place_) move_tree();
    build_transfer_ms_ = timings_.transfer_ms;
    build_start_ms_ = timings_.start_ms;
    built_ = chain.size();
  }

  void require_height(std::uint32_t levels) const {
    if (levels > traversal_->most_levels())
      throw CapacityError(
          "the hierarchy has " + std::to_string(levels) + " levels, and traversals hold at most " +
          std::to_string(traversal_->most_levels()) + "; use a construction that balances, such as aCPU2");
  }
  void require_built(const Chain& chain) const {
    if (built_ != chain.size()) throw std::logic_error("find: not the chain of the last build");
  }
  void upload(const Chain& chain, const Moved& moved) {
    const Stopwatch watch;
    chain_on_device_ = device_->to_device(chain.view(), moved);
    timings_.transfer_ms += watch.ms();
  }
  void move_tree() {
    if constexpr (Movable<Tree>) {
      const Stopwatch watch;
      tree_ = find_place_.on_device() ? device_->to_device(tree_) : device_->to_host(tree_);
      timings_.transfer_ms += watch.ms();
    }
  }

  std::unique_ptr<Construction<Tree>> construction_;
  std::unique_ptr<Traversal<Tree>> traversal_;
  std::unique_ptr<Device> device_;
  Place build_place_, find_place_;
  std::optional<std::uint32_t> built_;  ///< spheres of the tree; nothing after a build that threw
  ChainView chain_on_device_{};
  Tree tree_{};  ///< where the traversal is
  Timings timings_;
  double build_transfer_ms_ = 0, build_start_ms_ = 0;
};

}  // namespace catena

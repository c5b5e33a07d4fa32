#include "catena/core/blocks/block_kernels.h"
#include "catena/core/blocks/told_exact.h"
#include "catena/core/blocks/told_rows.h"
#include "catena/core/strategy/register.h"
#include "catena/core/strategy/strand_table.h"

namespace catena {
namespace {

/// ChainTree: blocks of eight consecutive spheres in capsules, sixteen blocks a node,
/// sixteen nodes the next, in boxes along axes of their own. Where the
/// spheres of two blocks follow one another like beads along a direction, they are not compared at all.
template <class Arithmetic>
class ChainTree final : public Variant {
 public:
  explicit ChainTree(const Parameters& parameters) : rows_(skips_rows(parameters)), strands_(parameters) {
    tree_.doubt = doubt_of(parameters);
  }

  void build(const Chain& chain) override {
    const Stopwatch watch;
    built_ = false;
    build_block_tree(strands_.seen(chain.view()), tree_, Team());
    if (!rows_) tree_.forget_rows();
    spheres_ = chain.size();
    built_ = true;
    timings_.build_ms = watch.ms();
  }

  void find(const Chain& chain, const Request& request, Collisions& result) override {
    search(chain, request, result, nullptr);
  }

  Accounting evidence() const override { return Accounting::each_pair; }

  void find_with_evidence(const Chain& chain, const Request& request, Collisions& result,
                          EvidenceSink& sink) override {
    require_built(chain);
    const ChainView view = chain.view();
    const BlockEvidence evidence(view, tree_, sink);
    search(chain, request, result, &evidence);
  }

  void visit_bounds(BoundsVisitor& visitor) const override {
    if (!built_) return;
    ChainView chain{};  // whose spheres may be gone by now: to number nodes takes how many there are
    chain.size = spheres_;
    show_blocks(chain, tree_, visitor);
  }

  Timings timings() const override { return timings_; }

  Plan plan() const override {
    if (!built_ || tree_.blocks == 0) return {};
    return {told_rows(tree_), told_exact(queues_.open_done() - open_before_, tree_.doubt), strands_.told()};
  }

  std::vector<WorkDone> work() const override {
    return {{"block, sixteen blocks", queues_.rows_done() - rows_before_},
            {"eight spheres, eight", queues_.pairs_done() - pairs_before_},
            {"pair of spheres, beyond binary32", queues_.open_done() - open_before_}};
  }

 private:
  void require_built(const Chain& chain) const {
    if (!built_ || chain.size() != spheres_) throw std::logic_error("find: not the chain of the last build");
  }

  void search(const Chain& chain, const Request& request, Collisions& result, const BlockEvidence* evidence) {
    require_built(chain);
    const Stopwatch watch;
    PairCollector collector(spheres_, request, result);
    rows_before_ = queues_.rows_done(), pairs_before_ = queues_.pairs_done();
    open_before_ = queues_.open_done();
    search_blocks(strands_.seen(chain.view()), tree_, queues_, collector.lane(0), evidence);
    collector.finish();
    timings_.find_ms = watch.ms();
  }

  const bool rows_;
  StrandTable strands_;
  BlockTree tree_;
  BlockQueues queues_;
  std::uint64_t rows_before_ = 0, pairs_before_ = 0, open_before_ = 0;  // the last search
  std::uint32_t spheres_ = 0;
  bool built_ = false;
  Timings timings_;
};

const RegisterVariant<ChainTree, Robust> registered{
    {.name = "ChainTree",
     .summary = "capsules of 8 consecutive spheres, 16 a node, SIMD, sequential",
     .parameters = {rows_parameter(), exact_parameter(), strands_parameter()},
     .has_tree = true,
     .rival = [](std::uint32_t n, const Extent&) {
       return n <= 4096 ? 14 : 0;
     }}};  // beyond, a trial may cost too much where order is poor

}  // namespace
}  // namespace catena

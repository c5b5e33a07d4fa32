#include "catena/core/parts/parted_search.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <memory>
#include <new>
#include <span>
#include <stdexcept>
#include <utility>
#include <vector>

#include "catena/core/error.h"
#include "catena/core/input/input.h"
#include "catena/core/parts/part_as_chain.h"
#include "catena/core/strategy/registry.h"
#include "catena/properties/failing_allocations.h"
#include "catena/properties/sorted_pairs.h"
#include "catena/reference/reference.h"

// What a device's memory does to a search by parts: there is less of it than was thought, or less than there
// was.
namespace catena::parts {
namespace {

/// Has room for so many spheres, and says so where a part has more.
class SmallDevice final : public PartSearch {
 public:
  explicit SmallDevice(const std::uint32_t& room) : room_(room) { drop(); }
  LocalChain::Neighbours knows() const override { return LocalChain::Neighbours::in_pieces; }
  void build(const Chain& whole, const LocalChain& part, const Request& request,
             const BoxesWanted&) override {
    expect_room_for(part);
    chain_ = part_as_chain(whole, part);
    variant_->prepare(request);
    variant_->build(chain_);
  }
  void find(const LocalChain& part, const Request& request, Collisions& result,
            std::span<std::uint32_t> count) override {
    if (part.size() != chain_.size()) throw std::logic_error("find: not the part of the last build");
    expect_room_for(part);
    variant_->find(chain_, request, result);
    if (!result.count.empty())
      std::copy_n(result.count.begin() + part.own().begin, count.size(), count.begin());
  }
  void drop() override { variant_ = StrategyRegistry::instance().make("Hybrid"), chain_ = {}; }
  Timings timings() const override { return {}; }

 private:
  void expect_room_for(const LocalChain& part) const {
    if (part.size() > room_) throw CapacityError("no room");
  }
  const std::uint32_t& room_;
  std::unique_ptr<Variant> variant_;
  Chain chain_;
};

TEST(PartedSearch, GoesOnWithLessRoomThanThereWas) {
  const Chain chain = open_input("path1:n=12000").animation->frame(28);
  const reference::Answer right = reference::find(chain);
  const Team team;
  for (std::int64_t given = 0; given < 200; given += 1 + given / 4) {
    std::uint32_t room = 1u << 20;
    std::vector<std::unique_ptr<PartSearch>> searches;
    searches.push_back(std::make_unique<SmallDevice>(room));
    PartedSearch search(std::move(searches),
                        {.partition = {.order = Order::space}, .room = room, .room_is_guessed = true}, team);
    search.build(chain, {});
    Collisions found;
    search.find(chain, {}, found);
    EXPECT_EQ(found.count, right.count) << "in one part";
    room = 5000;
    try {
      const properties::FailingAllocations none(given);
      search.find(chain, {}, found);
    } catch (const std::bad_alloc&) {
    }
    search.find(chain, {}, found);
    properties::sort(found.pairs);
    EXPECT_EQ(found.pairs, right.pairs) << given << " allocations";
    EXPECT_EQ(found.count, right.count) << given << " allocations";
  }
}

}  // namespace
}  // namespace catena::parts

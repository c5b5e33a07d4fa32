#include <memory>
#include <string>

#include "catena/core/parts/group_boxes.h"
#include "catena/core/parts/part_as_chain.h"
#include "catena/core/parts/parted_search.h"
#include "catena/core/strategy/register.h"

namespace catena::parts {
namespace {

/// Searches a part by a variant of the host, as a chain of its own.
class VariantSearch final : public PartSearch {
 public:
  explicit VariantSearch(std::string name)
      : name_(std::move(name)), variant_(StrategyRegistry::instance().make(name_)) {}

  LocalChain::Neighbours knows() const override { return LocalChain::Neighbours::in_pieces; }
  void build(const Chain& whole, const LocalChain& part, const Request& request,
             const BoxesWanted& boxes) override {
    chain_ = part_as_chain(whole, part);
    if (boxes.boxes != nullptr) enclose_groups(chain_.spheres(), boxes.group, boxes.boxes);
    variant_->prepare(request);
    variant_->build(chain_);
  }
  void find(const LocalChain& part, const Request& request, Collisions& result,
            std::span<std::uint32_t> count) override {
    variant_->find(chain_, request, result);
    if (!result.count.empty())
      std::copy_n(result.count.begin() + part.own().begin, count.size(), count.begin());
  }
  void drop() override { variant_ = StrategyRegistry::instance().make(name_), chain_ = {}; }
  Timings timings() const override { return variant_->timings(); }

 private:
  const std::string name_;
  std::unique_ptr<Variant> variant_;
  Chain chain_;
};

/// Parts: what DeviceParts does with devices, by searches of the host, so that how a chain is parted is
/// tested without one.
template <class Arithmetic>
class Parts final : public Variant {
 public:
  explicit Parts(const Parameters& parameters)
      : search_(searches_of(parameters), options_of(parameters), team_) {}

  void prepare(const Request& request) override { request_ = request; }
  void build(const Chain& chain) override { search_.build(chain, request_); }
  void find(const Chain& chain, const Request& request, Collisions& result) override {
    search_.find(chain, request, result);
  }
  Timings timings() const override { return search_.timings(); }
  Plan plan() const override { return search_.plan(); }
  std::vector<WorkDone> work() const override { return search_.work(); }

 private:
  static std::vector<std::unique_ptr<PartSearch>> searches_of(const Parameters& parameters) {
    std::vector<std::unique_ptr<PartSearch>> searches;
    for (std::uint64_t k = 0; k < parameters.unsigned_integer("searches", 1, 64); ++k)
      searches.push_back(std::make_unique<VariantSearch>("Hybrid"));
    return searches;
  }
  static PartedSearch::Options options_of(const Parameters& parameters) {
    return {.partition = partition_options(parameters),
            .parts = static_cast<std::uint32_t>(parameters.unsigned_integer("parts", 1, 1u << 20)),
            .room = parameters.unsigned_integer("room", 1, 1u << 31)};
  }

  const Team team_;
  Request request_;
  PartedSearch search_;
};

/// Hidden from the lists: of use only to the tests.
struct RegisterParts {
  RegisterParts() {
    StrategyRegistry::instance().add_variant(
        {.name = "Parts",
         .summary = "the chain part after part, as DeviceParts has them on devices",
         .parameters = {{"parts", "3", "at least so many, of a chain with as many groups"},
                        {"room", "2147483648", "most spheres of a part and those that may touch it"},
                        {"searches", "2", "at a time"},
                        {"group", "32", "consecutive spheres that stay together"},
                        {"order", "measured", "parts by measured order, in chain order or by space"}}},
        arithmetic_info<Robust>(), make_strategy<Parts<Robust>, Variant>, true);
  }
};
const RegisterParts registered;

}  // namespace
}  // namespace catena::parts

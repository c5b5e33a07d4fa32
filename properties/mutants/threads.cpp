#include <cstdint>
#include <vector>

#include "catena/properties/mutants/mutant.h"

// Bugs that one thread does not show. The threads are played one after the other, in an order that real ones
// could take, so that what a race does sometimes is done every time. All default to one thread, as their
// authors ran them.
namespace catena::properties {
namespace {

class Threaded : public FaultyTree {
 public:
  explicit Threaded(const Parameters& parameters)
      : threads_(static_cast<std::uint32_t>(parameters.unsigned_integer("threads", 1, 1024))) {}
  static std::vector<ParameterInfo> parameters() { return {{"threads", "1", "threads that are played"}}; }

 protected:
  std::uint32_t threads() const { return threads_; }

 private:
  std::uint32_t threads_;
};

/// Every thread reads where the list of pairs ends, appends what its sphere found, and moves the end: one
/// that reads before another has moved it overwrites the other's pairs.
class SharedCursor final : public Threaded {
 public:
  using Threaded::Threaded;

 private:
  void find(const Chain& chain, const Request& request, Collisions& result) override {
    start(chain, request);
    std::vector<Pair> kept;
    for (std::uint32_t first = 0; first < chain.size(); first += threads()) {
      const std::size_t cursor = kept.size();  // as all threads read it
      for (std::uint32_t i = first; i < chain.size() && i - first < threads(); ++i) {
        pairs().clear();
        search(chain.view(), i);
        for (std::size_t k = 0; k < pairs().size(); ++k) {
          if (cursor + k == kept.size()) kept.emplace_back();
          kept[cursor + k] = pairs()[k];
        }
      }
    }
    pairs() = kept;
    answer(request, result);
  }
};
const RegisterMutant<SharedCursor> cursor{"shared-cursor-without-atomic",
                                          "scalable-ccd, but for its atomic: two threads append at one place",
                                          Threaded::parameters()};

/// n / threads spheres for each thread, and nobody takes the rest.
class RestForNobody final : public Threaded {
 public:
  using Threaded::Threaded;

 private:
  void search(const ChainView& chain, std::uint32_t i) override {
    if (i < chain.size / threads() * threads()) Threaded::search(chain, i);
  }
};
const RegisterMutant<RestForNobody> rest{"rest-of-a-division-for-nobody",
                                         "n / threads spheres for each thread", Threaded::parameters()};

}  // namespace
}  // namespace catena::properties

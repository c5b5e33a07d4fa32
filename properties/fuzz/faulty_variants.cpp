#include <chrono>
#include <csignal>
#include <new>
#include <thread>

#include "catena/core/strategy/register.h"
#include "catena/properties/mutants/faulty_tree.h"

// What would take a test program with it, and so is in no museum: for tests of the program, which must
// outlive it.
namespace catena::properties {
namespace {

class Crashes final : public FaultyTree {
  void find(const Chain& chain, const Request& request, Collisions& result) override {
    if (chain.size() > 8) {
      std::signal(SIGSEGV, SIG_DFL);  // a sanitizer would make an exit code of it
      std::raise(SIGSEGV);
    }
    FaultyTree::find(chain, request, result);
  }
};

class CrashesAfterALongerChain final : public FaultyTree {
  void find(const Chain& chain, const Request& request, Collisions& result) override {
    // Not on three spheres, which the property "same answer again" shows of itself.
    if (met_a_long_one_ && chain.size() > 3 && chain.size() < 8) {
      std::signal(SIGSEGV, SIG_DFL);
      std::raise(SIGSEGV);
    }
    met_a_long_one_ |= chain.size() > 20;
    FaultyTree::find(chain, request, result);
  }
  bool met_a_long_one_ = false;
};

class Hangs final : public FaultyTree {
  void find(const Chain& chain, const Request& request, Collisions& result) override {
    while (chain.size() > 8) std::this_thread::sleep_for(std::chrono::seconds(1));
    FaultyTree::find(chain, request, result);
  }
};

class HasNoMemory final : public FaultyTree {
  void find(const Chain& chain, const Request& request, Collisions& result) override {
    if (chain.size() > 8) throw std::bad_alloc();
    FaultyTree::find(chain, request, result);
  }
};

template <class Faulty>
struct RegisterFaulty {
  RegisterFaulty(const std::string& name, const std::string& summary) {
    StrategyRegistry::instance().add_variant({.name = name, .summary = summary, .has_tree = true},
                                             arithmetic_info<Robust>(), make_strategy<Faulty, Variant>, true);
  }
};
const RegisterFaulty<Crashes> crashes{"fault:crashes-past-8-spheres", "a stack that overflows"};
const RegisterFaulty<CrashesAfterALongerChain> crashes_later{"fault:crashes-after-a-longer-chain",
                                                             "a buffer that a longer chain left"};
const RegisterFaulty<Hangs> hangs{"fault:hangs-past-8-spheres", "a search that comes to no end"};
const RegisterFaulty<HasNoMemory> has_no_memory{"fault:has-no-memory-past-8-spheres",
                                                "a machine that is too small"};

}  // namespace
}  // namespace catena::properties

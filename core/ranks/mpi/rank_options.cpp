#include "catena/core/ranks/mpi/rank_options.h"

#include "catena/core/commands/command_line.h"
#include "catena/core/strategy/registry.h"

namespace catena::ranks {

void SearchOptions::add_to(OptionParser& app) {
  app.add_option("--variant", variant_, "How each rank finds the pairs of its part; exact; see catena list")
      .capture_default_str();
  app.add_option("--order", order_, "How spheres are shared out: in chain order, by space, or as measured")
      .one_of(parts::order_names())
      .capture_default_str();
}

void SearchOptions::add_input_to(OptionParser& app) { add_input_options(app, input_); }

RankOptions SearchOptions::of(Request request) const {
  if (!StrategyRegistry::instance().describe(variant_).exact)
    throw InputError("ranks decide exactly; name a variant that is exact, not " + variant_);
  return {.variant = variant_, .order = parts::order_named(order_), .request = request};
}

}  // namespace catena::ranks

#include "catena/reports/host_variants.h"

namespace catena::reports {
namespace {

/// How often the searches that count their steps took each, on the first chain of each input.
nlohmann::ordered_json steps(const Profile& profile) {
  auto rows = nlohmann::ordered_json::array();
  for_each_host_variant(profile,
                        [&](const bench::Workload& work, const Chain& chain, const VariantInfo& info) {
                          const auto variant = work.make(info.name);
                          if (variant->work().empty()) return;
                          Collisions found;
                          variant->build(chain);
                          variant->find(chain, {.want = Request::Want::counts}, found);
                          auto taken = nlohmann::ordered_json::array();
                          for (const WorkDone& done : variant->work())
                            taken.push_back({{"step", done.step}, {"times", done.times}});
                          rows.push_back({{"input", work.label},
                                          {"variant", info.name},
                                          {"pairs", found.pair_count},
                                          {"steps", std::move(taken)}});
                        });
  return rows;
}

const RegisterSection registered{"steps", steps};

}  // namespace
}  // namespace catena::reports

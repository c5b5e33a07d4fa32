#include "catena/reference/compare.h"
#include "catena/reports/host_variants.h"

namespace catena::reports {
namespace {

/// Milliseconds of a few searches of the chain that is built, as all inputs are timed; none where the answer
/// is wrong.
nlohmann::ordered_json times(Variant& variant, const bench::Workload& work, const Chain& chain) {
  constexpr int repetitions = 7;
  auto ms = nlohmann::ordered_json::array();
  Collisions found;
  variant.find(chain, {}, found);
  if (!reference::compare(chain, work.exact.front(), found).right()) return ms;
  for (int k = 0; k < repetitions; ++k) {
    variant.find(chain, {}, found);
    ms.push_back(variant.timings().find_ms);
  }
  return ms;
}

/// How often the searches that count their steps took each, on the first chain of each input. Of the long
/// ones also what a search takes, as nothing else times it.
nlohmann::ordered_json steps(const Profile& profile) {
  auto rows = nlohmann::ordered_json::array();
  const auto count = [&](bool timed) {
    return [&rows, timed](const bench::Workload& work, const Chain& chain, const VariantInfo& info) {
      const auto variant = work.make(info.name);
      if (variant->work().empty()) return;
      Collisions found;
      variant->build(chain);
      variant->find(chain, {.want = Request::Want::counts}, found);
      auto taken = nlohmann::ordered_json::array();
      for (const WorkDone& done : variant->work())
        taken.push_back({{"step", done.step}, {"times", done.times}});
      nlohmann::ordered_json row{{"input", work.label},
                                 {"variant", info.name},
                                 {"pairs", found.pair_count},
                                 {"steps", std::move(taken)}};
      if (auto ms = timed ? times(*variant, work, chain) : nlohmann::ordered_json(); !ms.empty())
        row["find_ms"] = std::move(ms);
      rows.push_back(std::move(row));
    };
  };
  for_each_host_variant(profile, count(false));
  for_each_host_variant(profile, profile.long_inputs, count(true));
  return rows;
}

const RegisterSection registered{"steps", steps};

}  // namespace
}  // namespace catena::reports

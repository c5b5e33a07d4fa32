#include "catena/bench/tube/errors_line.h"

#include "catena/core/commands/report_text.h"

namespace catena::bench {

TubeErrors errors_of(const Tube& tube, const std::vector<Approach>& all, std::uint32_t n, double offset) {
  constexpr double finest_stored = 0.049;  // in radii
  constexpr std::uint32_t most_stored = 200'000;
  TubeErrors errors{tube.name, offset, tube_error(tube, all, n), {}};
  if (errors.tube.spacing >= finest_stored * tube.radius && n <= most_stored)
    errors.storage = storage_error(tube, n, offset);
  return errors;
}

nlohmann::ordered_json to_json(const TubeErrors& errors) {
  const TubeError& e = errors.tube;
  const auto& s = errors.storage;
  nlohmann::ordered_json line{{"tube", errors.name},
                              {"n", e.n},
                              {"spacing", e.spacing},
                              {"gap", e.gap},
                              {"volume_deficit", e.volume_deficit},
                              {"covering_radius", e.covering_radius},
                              {"contacts", e.contacts},
                              {"missed", e.missed},
                              {"invented", e.invented},
                              {"missed_by_covering", e.missed_by_covering},
                              {"depth_error", e.depth_error},
                              {"covering_depth_error", e.covering_depth_error}};
  if (s) {
    nlohmann::ordered_json stored{{"offset", errors.offset}, {"pairs", s->pairs}, {"flips", s->flips}};
    stored["least_margin"] = finite_or_word(s->least_margin);  // infinite: no pair is near
    stored["condition_number"] = finite_or_word(1 / s->least_margin);
    stored["margin_decades"] = s->decades;
    line["stored"] = stored;
  }
  return line;
}

}  // namespace catena::bench

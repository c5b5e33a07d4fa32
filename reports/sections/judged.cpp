#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <string>

#include "catena/bench/closed_form/lattice_box.h"
#include "catena/bench/enumerate/judge.h"
#include "catena/bench/growth/growth.h"
#include "catena/bench/knots/judge_knot.h"
#include "catena/bench/knots/known_knots.h"
#include "catena/bench/pivot/end_to_end.h"
#include "catena/core/input/input.h"
#include "catena/core/shell_word.h"
#include "catena/reports/faults.h"
#include "catena/reports/section.h"

namespace catena::reports {
namespace {

constexpr auto judged_variant = "Hybrid";
constexpr std::uint64_t most_walks = 2'000'000;  ///< on a lattice whose symmetries are not used

nlohmann::ordered_json row(const std::string& source, const std::string& what, const std::string& published,
                           const std::string& found, bool agrees, const std::string& command) {
  return {{"source", source}, {"what", what},     {"published", published},
          {"found", found},   {"agrees", agrees}, {"command", command}};
}

/// The longest walks of each published table, or the first length that differs.
void add_walks(nlohmann::ordered_json& rows, int steps) {
  const auto variant = StrategyRegistry::instance().make(judged_variant);
  const auto add = [&](const bench::WalkQuestion& question) {
    for (const bench::WalkVerdict& v : bench::judge_walks(*variant, question)) {
      if (!v.published || (v.steps < question.steps && !v.differs())) continue;
      rows.push_back(row("https://oeis.org/" + v.sequence,
                         fmt::format("{} of {} steps, {} lattice", v.counts, v.steps, v.lattice),
                         fmt::format("{}", *v.published), fmt::format("{}", v.found), !v.differs(),
                         fmt::format("catena enumerate --walks {} --lattice {}", question.steps, v.lattice)));
    }
  };
  for (const int dimensions : {3, 2})
    for (const float radius : {std::nextafter(0.5f, 0.0f), 0.5f})
      add({dimensions, radius, radius < 0.5f, steps});
  for (const bench::OtherLattice& lattice : bench::other_lattices()) {
    auto longest = std::min(static_cast<std::size_t>(steps), lattice.table.terms.size() - 1);
    while (lattice.table.terms[longest] > most_walks) --longest;
    add({.radius = std::nextafter(0.5f, 0.0f), .steps = static_cast<int>(longest), .other = &lattice});
  }
}

void add_closed_form(nlohmann::ordered_json& rows, const bench::LatticeBox& box, const std::string& options) {
  const auto variant = StrategyRegistry::instance().make(judged_variant);
  const Chain chain = open_input(box.scene()).animation->frame(0);
  const Request counts{.want = Request::Want::counts};
  Collisions found;
  variant->prepare(counts);
  variant->build(chain);
  variant->find(chain, counts, found);
  rows.push_back(row("closed form",
                     fmt::format("pairs of {}, {} of them exact ties", box.scene(), box.ties()),
                     fmt::format("{}", box.pairs()), fmt::format("{}", found.pair_count),
                     bench::fault(box, found, false).empty(),
                     fmt::format("catena closed-form --side {} --reach {}{}", box.side, box.reach, options)));
}

void add_growth(nlohmann::ordered_json& rows, std::uint32_t most) {
  for (const char* scene : {"yarn", "path1", "lattice"})
    for (const char* variant : {"Necklace", "Necklace(balls=nested)", "aCPU2+Dual"}) {
      const auto growth = bench::measure_growth(scene, StrategyRegistry::instance().describe(variant), most);
      const auto law = growth.law(), plain = growth.plain_power();
      const bool open =
          law.high - law.low > 1;  // an interval that would hold a linear and a quadratic law, too
      rows.push_back(
          row("Agarwal, Guibas, Nguyen, Russel and Zhang (2004)",
              fmt::format("pairs of nodes of {} on {}, from 1000 to {} spheres", variant, scene,
                          growth.points.back().n),
              "O(n^(4/3))",
              fmt::format(
                  "n^{:.3f} [{:.3f}, {:.3f}] beside a surface's share n^(-1/3); without it n^{:.3f} [{:.3f}, "
                  "{:.3f}]; {:.1f} a sphere at last",
                  law.exponent, law.low, law.high, plain.exponent, plain.low, plain.high,
                  static_cast<double>(growth.points.back().node_pairs) / growth.points.back().n),
              growth.within_four_thirds(),
              fmt::format("catena growth {} --n {} --variant {}", scene, most, shell_word(variant))));
      if (open) rows.back()["open"] = true;
    }
}

template <class Walk>
void add_exponent(nlohmann::ordered_json& rows, std::uint64_t moves, const std::string& of,
                  const std::string& options) {
  constexpr std::uint32_t most = 4096;
  std::vector<bench::EndToEnd> lengths;
  Random random(1);
  for (std::uint32_t n = most / 32; n <= most; n *= 2) {
    Walk walk(n);
    lengths.push_back(bench::measure_end_to_end(walk, moves, random));
  }
  const auto exponent = bench::fit_exponent(lengths);
  rows.push_back(row("Clisby and Dünweg (2016)",
                     fmt::format("exponent nu of {}, {} to {} points under pivots", of, most / 32, most),
                     fmt::format("{:.8f} ± {:.8f}", exponent.published, exponent.published_error),
                     fmt::format("{:.4f} ± {:.4f}", exponent.nu, exponent.half_width), exponent.agrees(),
                     fmt::format("catena pivot --exponent --n {} --moves {}{}", most, moves, options)));
}

void add_knots(nlohmann::ordered_json& rows, std::uint32_t points) {
  const auto variant = StrategyRegistry::instance().make(judged_variant);
  for (const bench::KnownKnot& knot : bench::carried_knots(points)) {
    const auto v = bench::judge_knot(*variant, knot.published, knot.centres, knot.blur);
    const bool of_type = knot.published.of == bench::PublishedKnot::Of::type;
    rows.push_back(
        row(knot.published.source,
            fmt::format("ropelength of {}: {}, {} vertices", knot.published.what, knot.input, v.vertices),
            fmt::format("{}{:.9g}", of_type ? "at least " : "", v.bounds.ropelength),
            fmt::format("{:.9g}; its edges explain {}", v.ropelength(),
                        of_type ? fmt::format("{:.9g} and more", v.shape.length / v.bounds.most)
                                : fmt::format("{:.9g} to {:.9g}", v.shape.length / v.bounds.most,
                                              v.shape.length / v.bounds.least)),
            v.within(), fmt::format("catena knots --n {}", points)));
  }
}

/// What others published, or a formula knows, against what catena finds.
nlohmann::ordered_json judged(const Profile& profile) {
  auto rows = nlohmann::ordered_json::array();
  if (profile.judged_steps == 0) return rows;
  attempt(judged_variant, [&] {
    add_walks(rows, profile.judged_steps);
    add_closed_form(rows, {.side = profile.judged_side, .reach = 3}, "");
    add_closed_form(rows, {.side = profile.judged_side, .reach = 4, .face_centred = true}, " --face-centred");
    add_closed_form(rows, {.side = profile.judged_side, .reach = 3, .rods = true}, " --rods");
    add_knots(rows, 8 * profile.judged_side);
  });
  add_growth(rows, profile.judged_n);
  add_exponent<bench::PivotWalk>(rows, profile.judged_moves, "self-avoiding walks", "");
  add_exponent<bench::RotatedChain<>>(
      rows, profile.judged_moves, "spheres that touch along a chain, by any rotation", " --rotations any");
  return rows;
}

const RegisterSection registered{"judged", judged};

}  // namespace
}  // namespace catena::reports

#include <fmt/format.h>

#include <cmath>
#include <optional>
#include <string>
#include <vector>

#include "catena/bench/knots/judge_knot.h"
#include "catena/bench/knots/known_knots.h"
#include "catena/core/commands/command.h"
#include "catena/core/commands/json_line.h"
#include "catena/core/commands/show_warnings.h"
#include "catena/core/counted.h"
#include "catena/core/error.h"
#include "catena/core/input/input.h"
#include "catena/core/input/naming.h"
#include "catena/core/one_line.h"
#include "catena/core/strategy/registry.h"
#include "catena/core/thrown.h"

namespace catena::bench {
namespace {

/// `catena knots`: tight knots and links, against the ropelengths that were published of them.
class KnotsCommand final : public Command {
 public:
  void configure(OptionParser& app) override {
    app.add_option("INPUT", inputs_,
                   "Closed polygons: files (3_1_328.vect) or scenes; none: the links that are carried");
    const auto knot =
        app.add_option("--knot", knot_, "What was published of them: a name; see below").type_name("NAME");
    const auto rope =
        app.add_option(
               "--ropelength", ropelength_,
               "Or a ropelength that was published of these polygons: length over thickness, a radius")
            .type_name("R")
            .positive();
    const auto thick = app.add_option("--thickness", thickness_, "Or a thickness, in units of the file")
                           .type_name("T")
                           .positive();
    knot.excludes(rope).excludes(thick);
    rope.excludes(thick);
    app.add_option("--n", points_, "Vertices of each circle of the links that are carried (default: 256)")
        .whole_number(16);
    app.add_flag("--closed", options_.closed, "Every strand is closed, where the file cannot say so");
    app.add_option("--format", options_.reading.format, "Read files as those of this extension")
        .type_name("EXTENSION");
    app.add_option("--variant", variant_, "Who finds the contacts; see catena list").capture_default_str();
    app.add_flag("--json", json_, "One JSON object a line for each polygon");
    std::string names;
    for (const PublishedKnot& k : published_knots()) names += "\n  " + k.name + ": " + k.what;
    app.footer("Published of (bench/knots/published_knots.cpp has the sources):" + names +
               "\nExit code 1 when what is found lies outside of what the polygon's edges explain.");
  }

  int run() override {
    if (points_ && !inputs_.empty())
      throw InputError("--n is of the links that are carried; an input has vertices of its own");
    if (points_ > 1u << 20) throw InputError("--n must be at most 2^20");
    const auto variant = blaming(variant_, [&] { return StrategyRegistry::instance().make(variant_); });
    bool faulty = false;
    for (const KnownKnot& knot : knots()) {
      const KnotVerdict v = naming(knot.input, [&] {
        return blaming(variant_,
                       [&] { return judge_knot(*variant, knot.published, knot.centres, knot.blur); });
      });
      faulty |= !v.within();
      json_ ? print_json(knot.input, v) : print(knot.input, v);
    }
    return faulty ? 1 : 0;
  }

 private:
  std::vector<KnownKnot> knots() const {
    if (inputs_.empty()) {
      if (!knot_.empty() || ropelength_ || thickness_)
        throw InputError("a published number needs the polygon that it is of; name a file or a scene");
      return carried_knots(static_cast<std::uint32_t>(points_.value_or(256)));
    }
    std::vector<KnownKnot> knots;
    for (const std::string& spec : inputs_) {
      InputOptions options = options_;
      options.centres_only = true;
      const Input input = open_input(spec, options);
      show_warnings(input);
      knots.push_back({spec, told(), input.animation->frame(0), std::sqrt(3.0) * input.rounding});
    }
    return knots;
  }

  PublishedKnot told() const {
    if (!knot_.empty()) return published_knot(knot_);
    if (!ropelength_ && !thickness_)
      throw InputError("say what was published of it: --knot NAME, --ropelength R or --thickness T");
    return {.name = "told",
            .what = "as told",
            .ropelength = ropelength_.value_or(0),
            .thickness = thickness_.value_or(0),
            .source = "the caller"};
  }

  void print_json(const std::string& input, const KnotVerdict& v) const {
    nlohmann::ordered_json line{{"input", input}, {"variant", variant_}};
    line.update(to_json(v));
    fmt::print("{}\n", json_line(line));
  }

  void print(const std::string& input, const KnotVerdict& v) const {
    fmt::print("{}: {}, {}\n", one_line(input), v.published.what, fmt::format("{} vertices", v.vertices));
    fmt::print("  published  ropelength {:.9g}, so thickness {:.9g}{}\n", v.bounds.ropelength,
               v.bounds.thickness,
               v.published.struts > 0 ? fmt::format(", {} struts", v.published.struts) : "");
    fmt::print("  found      ropelength {:.9g}, first contact at {}, tightest bend {:.6g}\n", v.ropelength(),
               v.contact ? fmt::format("radius {:.9g} of {} and {}", v.contact->radius, v.contact->pair.i,
                                       v.contact->pair.j)
                         : fmt::format("no radius up to {:.9g}", v.searched_to),
               v.shape.tightest_bend);
    fmt::print(
        "  explained  thickness {:.9g} to {:.9g}, by edges up to {:.6g} long; {} at the published one, {} "
        "where every strut shows\n",
        v.bounds.least, v.bounds.most, v.shape.longest_edge, counted(v.contacts, "contact"),
        v.contacts_at_most);
    if (!v.published.struts_of.empty())
      fmt::print("  struts     are of {}: no more is asked than that as many fit in\n",
                 v.published.struts_of);
    fmt::print("  {}\n", v.within() ? "within" : "NOT WITHIN: " + v.fault());
  }

  std::vector<std::string> inputs_;
  std::string knot_, variant_ = "Hybrid";
  std::optional<double> ropelength_, thickness_;
  std::optional<std::uint64_t> points_;
  InputOptions options_;
  bool json_ = false;
};

const RegisterCommand<KnotsCommand> registered{
    "knots", "Tight knots and links, against the ropelengths published of them"};

}  // namespace
}  // namespace catena::bench

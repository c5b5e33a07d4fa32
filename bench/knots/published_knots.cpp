#include "catena/bench/knots/published_knots.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <numbers>
#include <string>
#include <vector>

#include "catena/core/error.h"
#include "catena/core/parameters/nearest_name.h"

namespace catena::bench {
namespace {

using Of = PublishedKnot::Of;

constexpr auto ridgerunner =
    "README of Ridgerunner (github.com/designbynumbers/ridgerunner at 4ee3199), whose test/3_1_328.vect it "
    "is; GPL-3.0. The struts are those after its 100 steps, which shorten the rope by less than 1e-5";
constexpr auto plcurve =
    "the program ropelength of plCurve, as measured in github.com/Njakasoa/tight-knots-ropelength, report of "
    "its independent validation; ";
constexpr auto sharp =
    "Cantarella, Kusner and Sullivan, On the minimum ropelength of knots and links, Inventiones mathematicae "
    "150 (2002), where it is proved to be the least";

}  // namespace

std::span<const PublishedKnot> published_knots() {
  constexpr double pi = std::numbers::pi;
  static const std::vector<PublishedKnot> knots{
      {.name = "3_1_328",
       .what = "a tight trefoil of 328 vertices",
       .thickness = 0.499985,
       .error = 5e-7,
       .struts = 375,
       .strut_tolerance = 1e-4,
       .struts_of = "its shape 100 steps of tightening later, which was not published",
       .source = ridgerunner},
      {.name = "kl_3_1_I",
       .what = "a tight trefoil of 400 vertices",
       .ropelength = 32.74902840544252,
       .error = 1e-13,
       .source = std::string(plcurve) + "data/kl_3_1_I.vect of github.com/designbynumbers/plcurve, GPL-2.0"},
      {.name = "3.1",
       .what = "a loose trefoil of 47 vertices",
       .ropelength = 36.66704093664804,
       .error = 1e-13,
       .source = std::string(plcurve) + "data/3.1.vect of github.com/designbynumbers/ridgerunner, GPL-3.0"},
      {.name = "atlas-3_1",
       .what = "a tight trefoil of 2400 vertices",
       .ropelength = 32.74366549969402,
       .error = 1e-13,
       .source =
           std::string(plcurve) +
           "knots/prime/3-10/3_1.tsv of github.com/designbynumbers/ropelength-minimizing-knots, CC0-1.0"},
      {.name = "atlas-4_1",
       .what = "a tight figure of eight of 400 vertices",
       .ropelength = 42.09702880992264,
       .error = 1e-13,
       .source =
           std::string(plcurve) +
           "knots/prime/3-10/4_1.tsv of github.com/designbynumbers/ropelength-minimizing-knots, CC0-1.0"},
      {.name = "atlas-5_1",
       .what = "a tight cinquefoil of 392 vertices",
       .ropelength = 47.21488738316189,
       .error = 1e-13,
       .source =
           std::string(plcurve) +
           "knots/prime/3-10/5_1.tsv of github.com/designbynumbers/ropelength-minimizing-knots, CC0-1.0"},
      {.name = "atlas-2_2_1",
       .what = "a tight Hopf link of 101 and 101 vertices",
       .ropelength = 25.14141773337161,
       .error = 1e-13,
       .source =
           std::string(plcurve) +
           "links/prime/2-9/2_2_1.tsv of github.com/designbynumbers/ropelength-minimizing-knots, CC0-1.0"},
      {.name = "hopf",
       .what = "the tight Hopf link, two circles through each other's centres",
       .of = Of::curve,
       .ropelength = 8 * pi,
       .error = 1e-14,
       .source = sharp},
      {.name = "chain-of-three",
       .what = "the tight chain of three links, two circles through a stadium",
       .of = Of::curve,
       .ropelength = 12 * pi + 4,
       .error = 1e-14,
       .source = sharp},
      {.name = "3_1",
       .what = "any trefoil: none shorter is known",
       .of = Of::type,
       .ropelength = 32.742934477,
       .error = 1e-9,
       .source =
           "Przybyl, Discontinuities and singularities in the structure of the most tight trefoil knot (a "
           "poster, studylib.net/doc/5716836): 32.742934477 +- 1e-9, from 200,640 vertices"},
      {.name = "knotted",
       .what = "any knot but the unknot: none is shorter",
       .of = Of::type,
       .ropelength = 31.32,
       .source = "Denne, Diao and Sullivan, Quadrisecants give new lower bounds for the ropelength of a "
                 "knot, Geometry "
                 "& Topology 10 (2006): at least 15.66 diameters"}};
  return knots;
}

const PublishedKnot& published_knot(const std::string& name) {
  const auto knots = published_knots();
  const auto found = std::ranges::find(knots, name, &PublishedKnot::name);
  if (found != knots.end()) return *found;
  std::vector<std::string> names;
  for (const PublishedKnot& knot : knots) names.push_back(knot.name);
  throw InputError(fmt::format("nothing published is carried of a knot '{}'; there are {}{}", name,
                               fmt::join(names, ", "), did_you_mean(name, names)));
}

}  // namespace catena::bench

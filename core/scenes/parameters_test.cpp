#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <sstream>
#include <string>
#include <vector>

#include "catena/core/error.h"
#include "catena/core/input/input.h"
#include "catena/core/scenes/scene.h"

/// Every parameter of every scene, set to values that make no sense: each is refused when the scene is
/// opened, with a line that names it, or gives a chain that is valid.
namespace catena {
namespace {

class SceneParameters : public testing::TestWithParam<SceneInfo> {};
INSTANTIATE_TEST_SUITE_P(Every, SceneParameters, testing::ValuesIn(SceneRegistry::instance().scenes()),
                         [](const auto& test) { return test.param.name; });

/// Empty when it opens; else why not.
std::string refusal(const std::string& spec) {
  try {
    const Input input = open_input(spec);
    const Chain chain = input.animation->frame(input.animation->frames() > 1);  // a frame that moved, if any does
    for (const Sphere& s : chain.spheres())
      EXPECT_TRUE(std::isfinite(s.x) && std::isfinite(s.y) && std::isfinite(s.z) && std::isfinite(s.radius) &&
                  s.radius >= 0)
          << spec;
    return "";
  } catch (const InputError& why) {
    return why.what();
  }
}

TEST_P(SceneParameters, AreRefusedWhenTheyAreNoNumberAndOtherwiseGiveAValidChain) {
  const SceneInfo& scene = GetParam();
  for (const ParameterInfo& parameter : scene.parameters) {
    const std::string size = parameter.name == "n" ? "" : "n=64,";
    const auto with = [&](const std::string& value) {
      return scene.name + ":" + size + parameter.name + "=" + value;
    };
    for (const char* value : {"nan", "-nan", "inf", "-inf", "1e999", "", " ", "x", "0x10", "1,5"}) {
      const std::string why = refusal(with(value));
      EXPECT_NE(why, "") << with(value);
      EXPECT_EQ(why.find('\n'), std::string::npos) << why;
      EXPECT_NE(why.find(scene.name), std::string::npos) << why;
    }
    for (const char* value :
         {"-1", "0", "1", "-1e300", "1e300", "1e-300", "1e38", "-1e38", "99999999999999999999999"})
      refusal(with(value));
  }
}

/// What a parameter may be besides a number, as the scene says it.
std::vector<std::string> choices_of(const SceneInfo& scene, const std::string& parameter) {
  const std::string why = refusal(scene.name + ":" + parameter + "=?"), before = "must be one of: ";
  std::vector<std::string> choices;
  if (const auto at = why.find(before); at != std::string::npos) {
    std::istringstream names(why.substr(at + before.size()));
    for (std::string name; std::getline(names >> std::ws, name, ',');) choices.push_back(name);
  }
  return choices;
}

/// Also with fewer spheres than it has parts.
TEST_P(SceneParameters, HoldOfTheShortestChains) {
  const SceneInfo& scene = GetParam();
  for (const ParameterInfo& parameter : scene.parameters) {
    if (parameter.name == "variant") continue;  // some are made to crash, and others are not built here
    std::vector<std::string> values = choices_of(scene, parameter.name);
    if (parameter.name == "n") values = {"0"};  // as it is by itself
    for (const std::string& value : values)
      for (const int n : {0, 1, 2, 3}) {
        const std::string spec = fmt::format("{}:n={}{}", scene.name, n,
                                             parameter.name == "n" ? "" : "," + parameter.name + "=" + value);
        const std::string why = refusal(spec);
        EXPECT_TRUE(why.empty() || why.starts_with("scene " + scene.name)) << spec << ": " << why;
      }
  }
}

/// Other values of a parameter, near its default; a number may be twice as large, or be refused.
std::vector<std::string> others_than(const std::string& value) {
  if (value == "general" || value == "axes") return {value == "axes" ? "general" : "axes"};
  if (value == "cubic") return {"face-centred"};
  if (value == "one") return {"rods"};
  const double number = std::stod(value);
  std::vector<std::string> others;
  for (const double other : {number == 0 ? 3 : 2 * number, number + 2, number / 2})
    others.push_back(fmt::format("{:.17g}", other));
  return others;
}

/// None is read and forgotten: another value gives another chain, unless it is said that it does not.
TEST_P(SceneParameters, MatterEachOfThem) {
  const SceneInfo& scene = GetParam();
  const auto frame = [&](const std::string& more) {
    const auto animation = SceneRegistry::instance().open(scene.name + ":n=300" + more);
    return animation->frame(animation->frames() > 1);
  };
  for (const ParameterInfo& parameter : scene.parameters) {
    if (parameter.name == "n" || parameter.name == "variant" || parameter.meaning.starts_with("not used"))
      continue;
    const std::string moves = scene.name == "lattice" && parameter.name == "seed" ? ",ulps=1" : "",
                      more = moves + "," + parameter.name + "=";
    const Chain plain = frame(moves);
    const Chain same = frame(more + parameter.default_value);
    EXPECT_TRUE(std::ranges::equal(same.spheres(), plain.spheres())) << "the default of " << parameter.name;
    bool differs = false;
    for (const std::string& value : others_than(parameter.default_value))
      try {
        const Chain other = frame(more + value);
        differs = !std::ranges::equal(other.spheres(), plain.spheres()) ||
                  other.strand_count() != plain.strand_count();
        break;
      } catch (const InputError&) {  // out of its range
      }
    EXPECT_TRUE(differs) << parameter.name;
  }
}

TEST_P(SceneParameters, RefuseAbsurdNumbersOfSpheres) {
  for (const char* n : {"2147483648", "4294967296", "18446744073709551616", "-1", "1.5", "1e10"})
    EXPECT_NE(refusal(GetParam().name + ":n=" + n), "") << n;
  for (const char* n : {"0", "1", "2", "3", "1e1"}) EXPECT_EQ(refusal(GetParam().name + ":n=" + n), "") << n;
}

struct Range {
  const char *scene, *key;
  std::vector<const char*> outside;
};

/// Just past either end of what makes sense: refused by a line that has the value as it was written.
TEST(SceneParameters, HaveEndsPastWhichTheyAreRefused) {
  const std::vector<Range> ranges{{"rod", "spacing", {"0.049", "101"}},
                                  {"rod", "radius", {"0", "1e301"}},
                                  {"cluster", "shells", {"0", "1001"}},
                                  {"coil", "width", {"0.09", "1.1e9"}},
                                  {"coil", "pitch", {"-1e-9", "1.1e9"}},
                                  {"coincident", "together", {"0", "2147483649"}},
                                  {"far", "exponent", {"121"}},
                                  {"grazing", "margin", {"-1.1", "0.51"}},
                                  {"grazing", "turn", {"7", "1048577"}},
                                  {"hair", "strands", {"0", "1048577"}},
                                  {"hair", "gap", {"-1e-9", "1.1e9"}},
                                  {"lattice", "ulps", {"1001"}},
                                  {"lattice_moved", "ulps", {"1001"}},
                                  {"mixed_radii", "decades", {"-1e-9", "75.1"}},
                                  {"mixed_radii", "jump", {"0.9", "1.1e30"}},
                                  {"nested", "together", {"0", "1048577"}},
                                  {"points", "share", {"-1e-9", "1.1"}},
                                  {"rope", "rope", {"0", "1000001"}},
                                  {"rope", "frames", {"0", "1000001"}},
                                  {"rope", "stiffness", {"0.9", "1.1e12"}},
                                  {"rope", "step", {"9e-7", "1.1e6"}},
                                  {"rope", "duration", {"9e-7", "1.1e6"}},
                                  {"serpentine", "side", {"1291"}},
                                  {"serpentine", "reach", {"1048577"}},
                                  {"slender", "slenderness", {"9e-4", "1.1e12"}},
                                  {"stretched", "octaves", {"-1e-9", "60.1"}},
                                  {"tight_knot", "p", {"1", "1001"}},  // 0: as many as fit
                                  {"tight_knot", "margin", {"-1.1", "0.51"}},
                                  {"torus_knot", "p", {"0", "1001"}},
                                  {"torus_knot", "q", {"0", "1001"}},
                                  {"walk", "persistence", {"0.09", "1.1e9"}},
                                  {"winding", "width", {"0.9", "1.1e9"}},
                                  {"winding", "contacts", {"0.9", "1.1e6"}}};
  for (const auto& [scene, key, outside] : ranges)
    for (const char* value : outside) {
      const std::string why = refusal(fmt::format("{}:n=2,{}={}", scene, key, value));
      EXPECT_NE(why.find(fmt::format("{}={}", key, value)), std::string::npos) << scene << ": " << why;
    }
}

/// Where no coordinate is far from 0 the radius alone overflows, and what made it so is named.
TEST(SceneParameters, RefuseARadiusThatOverflowsByItself) {
  for (const char* n : {"0", "1"}) {
    const std::string rod = std::string("rod:n=") + n;
    EXPECT_NE(refusal(rod + ",radius=1e39").find("the radius overflows binary32"), std::string::npos);
    EXPECT_NE(refusal(rod + ",radius=1e-46")
                  .find("the radius 1e-46 underflows binary32 (at least 1.4013e-45); raise radius"),
              std::string::npos);
    EXPECT_NE(refusal(rod + ",scale=1e-46").find("underflows binary32 (at least 1.4013e-45); raise scale"),
              std::string::npos);
    EXPECT_NE(refusal(rod + ",radius=1e39").find("lower radius"), std::string::npos);
    EXPECT_NE(refusal(rod + ",scale=1e39").find("lower scale"), std::string::npos);
    EXPECT_EQ(refusal(rod + ",radius=1e39,scale=1e-3"), "");
  }
}

}  // namespace
}  // namespace catena

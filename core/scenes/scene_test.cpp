#include "catena/core/scenes/scene.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <initializer_list>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "catena/core/error.h"

namespace catena {
namespace {

std::unique_ptr<Animation> open(const std::string& spec) { return SceneRegistry::instance().open(spec); }

std::string refusal(const std::string& spec) {
  try {
    open(spec)->frame(0);
  } catch (const InputError& error) {
    return error.what();
  }
  return "accepted";
}

testing::AssertionResult mentions(const std::string& text, std::initializer_list<const char*> words) {
  for (const char* word : words)
    if (text.find(word) == std::string::npos)
      return testing::AssertionFailure() << '"' << text << "\" lacks " << word;
  return testing::AssertionSuccess();
}

bool same_bits(const Chain& a, const Chain& b) {
  return a.size() == b.size() &&
         std::ranges::equal(a.spheres(), b.spheres(), [](const Sphere& s, const Sphere& t) {
           return std::bit_cast<std::array<std::uint32_t, 4>>(s) ==
                  std::bit_cast<std::array<std::uint32_t, 4>>(t);
         });
}

using Which = bool (*)(const SceneInfo&);
bool any(const SceneInfo&) { return true; }
bool ordinary(const SceneInfo& info) { return info.strains.empty(); }
bool straining(const SceneInfo& info) { return !ordinary(info); }
bool ordinary_and_still(const SceneInfo& info) {
  return ordinary(info) && open(info.name + ":n=0")->frames() == 1;
}

std::vector<std::string> scene_names(Which which) {
  std::vector<std::string> names;
  for (const SceneInfo& info : SceneRegistry::instance().scenes())
    if (which(info)) names.push_back(info.name);
  return names;
}

class EveryScene : public testing::TestWithParam<std::string> {};
INSTANTIATE_TEST_SUITE_P(Registry, EveryScene, testing::ValuesIn(scene_names(any)),
                         [](const auto& test) { return test.param; });

/// Those that strain nothing keep the conventions of SceneSetup.
class EveryOrdinaryScene : public testing::TestWithParam<std::string> {};
INSTANTIATE_TEST_SUITE_P(Registry, EveryOrdinaryScene, testing::ValuesIn(scene_names(ordinary)),
                         [](const auto& test) { return test.param; });

class EveryStrainingScene : public testing::TestWithParam<std::string> {};
INSTANTIATE_TEST_SUITE_P(Registry, EveryStrainingScene, testing::ValuesIn(scene_names(straining)),
                         [](const auto& test) { return test.param; });

/// Those that do not move. A snake fits its crossings to the stored coordinates, so it differs when placed
/// anew.
class EveryStillScene : public testing::TestWithParam<std::string> {};
INSTANTIATE_TEST_SUITE_P(Registry, EveryStillScene, testing::ValuesIn(scene_names(ordinary_and_still)),
                         [](const auto& test) { return test.param; });

TEST_P(EveryScene, HasExactlyNSpheresInEveryFrame) {
  for (const std::uint32_t n : {0, 1, 2, 3, 7, 10, 100, 1000}) {
    const auto scene = open(GetParam() + ":n=" + std::to_string(n));
    ASSERT_GE(scene->frames(), 1u);
    for (const std::uint32_t f : {0u, scene->frames() / 2, scene->frames() - 1})
      EXPECT_EQ(scene->frame(f).size(), n);
  }
}

TEST_P(EveryScene, MovesAlongItselfAsItSays) {
  for (const std::uint32_t n : {1, 2, 10, 1000}) {
    const auto scene = open(GetParam() + ":n=" + std::to_string(n));
    Chain before = scene->frame(0);
    for (std::uint32_t f = 1; f < scene->frames(); ++f) {
      Chain chain = scene->frame(f);
      if (const std::int64_t s = scene->shift(f); s != 0) {
        for (std::int64_t i = std::max<std::int64_t>(0, -s); i < n && i + s < n; ++i)
          ASSERT_EQ(chain[static_cast<std::uint32_t>(i)], before[static_cast<std::uint32_t>(i + s)])
              << "frame " << f << ", sphere " << i;
      }
      before = std::move(chain);
    }
  }
}

TEST_P(EveryScene, IsTheSameBitsEveryTime) {
  const auto first = open(GetParam() + ":n=2000"), second = open(GetParam() + ":n=2000");
  const std::uint32_t last = first->frames() - 1;
  EXPECT_TRUE(same_bits(first->frame(last), second->frame(last)));
  EXPECT_TRUE(same_bits(first->frame(last), first->frame(last)));
}

TEST_P(EveryOrdinaryScene, IsCentredNearTheOriginAndHasTheRadiusAsked) {
  const Chain chain = open(GetParam() + ":n=1000,radius=0.5")->frame(0);
  for (const Sphere& s : chain.spheres()) {
    EXPECT_EQ(s.radius, 0.5f);
    EXPECT_LE(std::hypot(s.x, s.y, s.z), 1000.0);  // no farther than the tube is long
  }
}

TEST_P(EveryStillScene, IsTurnedMovedAndScaledInThatOrder) {
  // Powers of two, so that binary32 rounds alike.
  const Chain plain = open(GetParam() + ":n=50")->frame(0);
  const Chain tiny = open(GetParam() + ":n=50,scale=8.271806125530277e-25")->frame(0);  // 2^-80
  const Chain moved = open(GetParam() + ":n=50,offset=1024,scale=0.5")->frame(0);
  for (std::uint32_t i = 0; i < plain.size(); ++i) {
    EXPECT_EQ(tiny[i].x, plain[i].x * 0x1p-80f);
    EXPECT_EQ(tiny[i].radius, 0x1p-80f);
    EXPECT_NEAR(moved[i].y, (plain[i].y + 1024) / 2, 1e-4);
    EXPECT_EQ(moved[i].radius, 0.5f);
  }
}

TEST_P(EveryStillScene, IsTurnedByARotation) {
  const Chain general = open(GetParam() + ":n=300")->frame(0),
              aligned = open(GetParam() + ":n=300,align=axes")->frame(0);
  for (std::uint32_t i = 0; i < general.size(); ++i) {
    const Sphere &a = general[i], &b = aligned[i];
    EXPECT_NEAR(std::hypot(a.x, a.y, a.z), std::hypot(b.x, b.y, b.z), 1e-3);
  }
}

TEST_P(EveryOrdinaryScene, RefusesWhatOverflowsBinary32AndNamesTheParameter) {
  EXPECT_TRUE(mentions(refusal(GetParam() + ":n=100,offset=1e39"), {"lower offset"}));
  EXPECT_TRUE(mentions(refusal(GetParam() + ":n=100,offset=-1e300"), {"lower offset"}));
  EXPECT_TRUE(mentions(refusal(GetParam() + ":n=100,scale=1e38"), {"lower scale"}));
  EXPECT_TRUE(mentions(refusal(GetParam() + ":n=100,scale=1e300"), {"lower scale"}));
  EXPECT_TRUE(mentions(refusal(GetParam() + ":n=100,radius=1e38"), {"lower radius"}));
  EXPECT_TRUE(mentions(refusal(GetParam() + ":n=100,radius=1e300,scale=1e300"), {"lower radius"}));
}

TEST_P(EveryStrainingScene, IsAValidChainInEverySettingOrAnInputError) {
  for (const SceneInfo& info : SceneRegistry::instance().scenes()) {
    if (info.name != GetParam()) continue;
    for (const std::string& setting : info.settings)
      EXPECT_EQ(open(GetParam() + ":n=500," + setting)->frame(0).size(), 500u) << setting;
  }
  for (const char* extreme : {"offset=1e39", "scale=1e300", "radius=1e38", "scale=1e-300", "radius=1e-300"})
    try {
      EXPECT_EQ(open(GetParam() + ":n=100," + extreme)->frame(0).size(), 100u);  // throws when not finite
    } catch (const InputError& error) {
      EXPECT_TRUE(mentions(error.what(), {"overflows", "lower"}) ||
                  mentions(error.what(), {"underflows", "raise"}))
          << extreme << ": " << error.what();
    }
}

TEST_P(EveryStrainingScene, FollowsItsScale) {
  const Chain plain = open(GetParam() + ":n=200,scale=0.5")->frame(0);
  const Chain half = open(GetParam() + ":n=200,scale=0.25")->frame(0);
  const auto normal = [](float v) { return v == 0 || std::abs(v) > 0x1p-124f; };
  for (std::uint32_t i = 0; i < plain.size(); ++i) {
    EXPECT_TRUE(!normal(plain[i].x) || half[i].x == plain[i].x / 2) << i;
    EXPECT_TRUE(!normal(plain[i].radius) || half[i].radius == plain[i].radius / 2) << i;
  }
}

/// FNV-1a over the stored bits of a frame.
std::uint64_t fingerprint(const Chain& chain) {
  std::uint64_t hash = 0xcbf29ce484222325;
  for (const Sphere& s : chain.spheres())
    for (const std::uint32_t word : std::bit_cast<std::array<std::uint32_t, 4>>(s))
      hash = (hash ^ word) * 0x100000001b3;
  return hash;
}

TEST(Scenes, HaveTheSameBitsOnEveryMachine) {
  // A number changes only with a deliberate change of its scene: results of other days refer to it.
  const std::pair<const char*, std::uint64_t> expected[] = {
      {"coil", 0x80341332e38c7063},        {"hair", 0xf2462fcbc4b3d217},
      {"path1", 0x84509b2e3d13f287},       {"path2", 0xd76331a061b02116},
      {"rod", 0xe02ffc474400aa01},         {"torus_knot", 0x30381e8757d11444},
      {"cluster", 0x8fad6a15c0ad4768},     {"coincident", 0x464c170025314845},
      {"collinear", 0xc55ac2c8190bcda5},   {"far", 0xd154e2f632bb9029},
      {"grazing", 0xd4a070a23fe72cae},     {"largest", 0x9e0d694663c0f3b7},
      {"lattice", 0x31f62ed1d1c20da5},     {"lattice_moved", 0xd46f8fc9a1a5eb54},
      {"mixed_radii", 0x71638bc8231c701d}, {"nested", 0x9424720374700da5},
      {"points", 0x31e42cfdb7120da5},      {"slender", 0x56dc128d5300aa01},
      {"smallest", 0x8c40e9c212499676},    {"stretched", 0x10a94ff6f49f62b4},
      {"subnormal", 0xbe5488603d4254bf},   {"tight_knot", 0xbf042c5c07eb5be7},
      {"winding", 0x3b2ca21289bbac25},     {"walk", 0xed30e1b93341b472},
      {"yarn", 0x0959551baa2bfcc0}};
  for (const auto& [name, hash] : expected) {
    const auto scene = open(std::string(name) + ":n=5000");
    EXPECT_EQ(fingerprint(scene->frame(scene->frames() / 2)), hash) << name;
  }
}

TEST(Scenes, SayWhatThereIsWhenAskedForWhatThereIsNot) {
  EXPECT_TRUE(mentions(refusal("path3"), {"'path3'", "path1", "yarn"}));
  EXPECT_TRUE(mentions(refusal(""), {"path1"}));
  EXPECT_TRUE(mentions(refusal("yarn:colour=red"), {"yarn", "'colour'", "seed"}));
  EXPECT_TRUE(mentions(refusal("yarn:n"), {"key=value"}));
  EXPECT_TRUE(mentions(refusal("yarn:n=-1"), {"n=-1"}));
  EXPECT_TRUE(mentions(refusal("yarn:n=2147483648"), {"2147483647"}));
  EXPECT_TRUE(mentions(refusal("yarn:n=ten"), {"n=ten"}));
  EXPECT_TRUE(mentions(refusal("path1:align=sideways"), {"general, axes"}));
  EXPECT_TRUE(mentions(refusal("path1:spacing=0"), {"spacing=0"}));
  EXPECT_TRUE(mentions(refusal("path1:radius=nan"), {"radius=nan"}));
  EXPECT_TRUE(mentions(refusal("path1:radius=0"), {"radius=0"}));
  EXPECT_TRUE(mentions(refusal("path1:n=1,n=2"), {"twice"}));
}

/// Along one axis alone, or a radius alone.
TEST(Scenes, RefuseWhatOverflowsInOnePlaceAlone) {
  EXPECT_TRUE(
      mentions(refusal("hair:n=100,strands=1,align=axes,radius=5e36"), {"overflows", "lower radius"}));
  EXPECT_TRUE(mentions(refusal("rod:n=100,align=axes,radius=1e37"), {"overflows", "lower radius"}));
  EXPECT_TRUE(
      mentions(refusal("serpentine:side=2,reach=1048576,radius=1e33"), {"overflows", "lower radius"}));
  EXPECT_EQ(refusal("serpentine:side=2,reach=1048576,radius=1e32"), "accepted");
}

TEST(Scenes, AreListedWithTheParametersTheyHave) {
  std::vector<std::string> names;
  for (const SceneInfo& info : SceneRegistry::instance().scenes()) {
    names.push_back(info.name);
    EXPECT_FALSE(info.summary.empty());
    EXPECT_TRUE(SceneRegistry::instance().contains(info.name));
    std::vector<std::string> parameters;
    for (const ParameterInfo& parameter : info.parameters) {
      parameters.push_back(parameter.name);
      EXPECT_FALSE(parameter.default_value.empty() || parameter.meaning.empty())
          << info.name << ' ' << parameter.name;
    }
    for (const char* common : {"n", "radius", "spacing", "align", "offset", "scale"})
      EXPECT_EQ(std::ranges::count(parameters, common), 1) << info.name << ' ' << common;
  }
  EXPECT_TRUE(std::ranges::is_sorted(names));
  for (const char* name : {"coil", "hair", "path1", "path2", "rod", "torus_knot", "walk", "yarn"})
    EXPECT_EQ(std::ranges::count(names, name), 1) << name;
  EXPECT_FALSE(SceneRegistry::instance().contains("path3"));
}

/// Which frames there are open_scene knows.
TEST(Scenes, AreOpenedWithAllTheirFrames) {
  EXPECT_THROW(SceneRegistry::instance().open("path1:n=20,frame=1"), InputError);
  EXPECT_GT(SceneRegistry::instance().open("path1:n=20")->frames(), 1u);
}

TEST(Scenes, MayOverrideACommonDefaultButNotAName) {
  SceneRegistry registry;
  registry.add({"small", "", {{"n", "3", "few"}}}, [](const Parameters& parameters) {
    EXPECT_EQ(parameters.unsigned_integer("n", 0, 10), 3u);
    return std::unique_ptr<Animation>();
  });
  registry.open("small");
  EXPECT_THROW(registry.add({"small", "", {}}, {}), std::logic_error);
}

}  // namespace
}  // namespace catena

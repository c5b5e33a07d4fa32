#include "catena/bench/timing/cases.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <set>

#include "catena/core/commands/input_options.h"
#include "catena/core/error.h"
#include "catena/core/input/input.h"
#include "catena/core/readers/test_file.h"
#include "catena/core/scenes/scene.h"

namespace catena::bench {
namespace {

std::vector<VariantInfo> named(const std::set<std::string>& names) {
  auto all = StrategyRegistry::instance().variants();
  std::erase_if(all, [&](const VariantInfo& v) { return !names.contains(v.name); });
  return all;
}

std::set<std::string> names_of(const std::vector<Case>& cases) {
  std::set<std::string> names;
  for (const Case& c : cases) names.insert(c.name());
  return names;
}

TEST(Cases, AreNamedByInputVariantAndStage) {
  EXPECT_EQ(label_of({"path1:n=10"}), "path1/n:10");
  EXPECT_EQ(label_of({"far:exponent=22,n=30,radius=2"}), "far:exponent=22,radius=2/n:30");
  EXPECT_EQ(label_of({"path1", true}), "path1:frames=all/n:10000");
  EXPECT_EQ(label_of({CATENA_SOURCE_DIR "/core/readers/examples/rings.chain"}), "rings.chain/n:11");
  EXPECT_EQ(names_of(cases({{"path1:n=100"}}, named({"CPU1", "aCPU2+CPU2"}))),
            (std::set<std::string>{"path1/n:100/CPU1/find", "path1/n:100/CPU1/whole",
                                   "path1/n:100/aCPU2+CPU2/build", "path1/n:100/aCPU2+CPU2/find",
                                   "path1/n:100/aCPU2+CPU2/update", "path1/n:100/aCPU2+CPU2/whole"}));
}

/// A time over n would be drawn where the chain has another number of spheres.
TEST(Cases, AreOfNoOtherNumberOfSpheresThanTheirNameSays) {
  EXPECT_EQ(label_of({"serpentine:side=6"}), "serpentine:side=6/n:216");
  EXPECT_EQ(facts_of({"serpentine:side=6,n=216"}).n, 216u);
  for (const auto& look :
       {+[](const WorkloadSpec& spec) { facts_of(spec); }, +[](const WorkloadSpec& spec) { workload(spec); }})
    try {
      look({"serpentine:side=5,n=1e3"});
      ADD_FAILURE() << "accepted";
    } catch (const InputError& why) {
      EXPECT_STREQ(why.what(), "serpentine:side=5,n=1e3 has 125 spheres, whatever n is; leave out n");
    }
}

const std::string examples = CATENA_SOURCE_DIR "/core/readers/examples/";

WorkloadSpec in_box(const std::string& input, const std::vector<std::string>& arguments) {
  WorkloadSpec spec{input};
  read_input_options(arguments, spec.options);
  return spec;
}

/// Nor would an interrupted run find the file again.
TEST(Cases, AreOfNoNameThatARunFileCannotHold) {
  const auto refusal = [](const WorkloadSpec& spec) {
    try {
      cases({spec}, {});
    } catch (const InputError& why) {
      return std::string(why.what());
    }
    return std::string();
  };
  const std::string why = ": this name is not UTF-8, which a run file needs; rename it, or give a link to it";
  for (const std::string name : {"none\xFF.xyz", "none\xC3/a.xyz"}) EXPECT_EQ(refusal({name}), name + why);
  EXPECT_EQ(refusal(in_box(examples + "melt.dump", {"--topology", "a\xFF.data"})), "a\xFF.data" + why);
  EXPECT_EQ(refusal({"Å.xyz"}), "Å.xyz: there is no such file");
}

/// The samples of two chains would be those of one.
TEST(Cases, AreOfNoTwoFilesOfOneName) {
  namespace fs = std::filesystem;
  const fs::path base = testing::TempDir() + "catena_cases_" + std::to_string(getpid());
  for (const char* folder : {"a", "b"}) {
    fs::create_directories(base / folder);
    std::ofstream(base / folder / "x.xyz") << "0 0 0\n4 0 0\n";
  }
  const auto of = [](const std::vector<fs::path>& files) {
    std::vector<WorkloadSpec> specs;
    for (const fs::path& file : files) specs.push_back(in_box(file, {"--radius", "1"}));
    return names_of(cases(specs, named({"CPU1"})));
  };
  const fs::path a = base / "a" / "x.xyz", b = base / "b" / "x.xyz";
  EXPECT_EQ(of({a, base / "b" / ".." / "a" / "x.xyz"}).size(), 2u) << "one file";
  try {
    of({examples + "9_47-cubiclattice.txt", a, b});
    ADD_FAILURE() << "accepted";
  } catch (const InputError& why) {
    EXPECT_EQ(std::string(why.what()).find(a.string() + " and " + b.string() + " have one name"), 0u)
        << why.what();
  }
  fs::create_symlink(b, base / "y.xyz");
  EXPECT_EQ(of({a, base / "y.xyz"}).size(), 4u);
  fs::remove_all(base);
}

TEST(Cases, AreNamedWithTheBoxInWhichSpaceRepeats) {
  const std::vector<std::string> half{"--radius", "0.5"};
  EXPECT_EQ(label_of(in_box(examples + "melt.data", half)), "melt.data:radius=0.5/n:8");
  EXPECT_EQ(label_of(in_box(examples + "melt.data", {"--radius", "0.5", "--box", "file"})),
            "melt.data:radius=0.5,box=8x8x8/n:8");
  EXPECT_EQ(label_of(in_box(examples + "melt.dump", half)), "melt.dump:radius=0.5,box=8x8x8/n:4");
  EXPECT_EQ(label_of(in_box("yarn:n=20", {"--box", "900,0,800.5,1,0,-2", "--window", "3"})),
            "yarn:window=3,box=900x0x800.5x1x0x-2/n:20");
  EXPECT_THROW(facts_of(in_box(examples + "melt.dump", {"--radius", "0.5", "--box", "1.5,8,8"})), InputError);
  EXPECT_THROW(facts_of(in_box("yarn:n=20", {"--box", "0.001,0,0"})), InputError);
}

TEST(Cases, HaveAnUpdateWhereTheInputMoves) {
  const auto updates = [](const WorkloadSpec& input) {
    return filtered(cases({input}, named({"aCPU2+CPU2"})), "/update").size();
  };
  EXPECT_EQ(updates({"path1:n=100"}), 1u);
  EXPECT_EQ(updates({"path1:n=100", true}), 1u);
  EXPECT_EQ(updates({"path1:n=100,frame=3"}), 0u);
  EXPECT_EQ(updates({"yarn:n=100"}), 0u);
  EXPECT_EQ(updates({CATENA_SOURCE_DIR "/core/readers/examples/rings.chain"}), 0u);
}

TEST(Cases, HaveAnUpdateFromTwoFramesOnAndNoResidentSearchInABox) {
  const std::string frame = "2\n\nC 0 0 0\nC 5 0 0\n";
  const TestFile one("a.xyz", frame), two("a.xyz", frame + frame);
  VariantInfo stays = named({"aCPU2+CPU2"}).front();
  stays.resident = true;
  const auto stages = [&](const TestFile& file, const std::vector<std::string>& options) {
    std::set<Stage> found;
    for (const Case& c : cases({in_box(file.path().string(), options)}, {stays})) found.insert(c.stage);
    return found;
  };
  const std::vector<std::string> radius{"--radius", "0.5"}, box{"--radius", "0.5", "--box", "9,9,9"};
  using enum Stage;
  EXPECT_EQ(stages(one, radius), (std::set<Stage>{build, find, whole, resident}));
  EXPECT_EQ(stages(two, radius), (std::set<Stage>{build, update, find, whole, resident}));
  EXPECT_EQ(stages(two, box), (std::set<Stage>{build, update, find, whole}));
}

TEST(Cases, OpenAFileOnceAndNotForTheirNames) {
  const std::string file = testing::TempDir() + "catena_cases.chain";
  std::filesystem::copy_file(CATENA_SOURCE_DIR "/core/readers/examples/rings.chain", file,
                             std::filesystem::copy_options::overwrite_existing);
  const auto all = cases({{file}}, named({"aCPU2+CPU2"}));
  std::filesystem::remove(file);
  EXPECT_EQ(names_of(all), (std::set<std::string>{"catena_cases.chain/n:11/aCPU2+CPU2/build",
                                                  "catena_cases.chain/n:11/aCPU2+CPU2/find",
                                                  "catena_cases.chain/n:11/aCPU2+CPU2/whole"}));
  EXPECT_EQ(filtered(all, "/find").size(), 1u);
}

TEST(Cases, OfAFileKnowItsSpheres) {
  const WorkloadSpec rings{CATENA_SOURCE_DIR "/core/readers/examples/rings.chain"};
  EXPECT_EQ(facts_of(rings).n, 11u);
  EXPECT_EQ(cases({rings}, named({"CPU1"}), 11).size(), 2u);
  EXPECT_EQ(cases({rings}, named({"CPU1"}), 10).size(), 0u);
}

/// So that a scene need not be opened at ten million spheres to know whether it moves.
TEST(Cases, AScenesFramesAreAsManyAtEveryN) {
  for (const auto& info : SceneRegistry::instance().scenes()) {
    const auto frames = [&](int n) {
      return open_input(info.name + ":n=" + std::to_string(n)).animation->frames();
    };
    EXPECT_EQ(frames(500), frames(1000)) << info.name;
    EXPECT_EQ(facts_of({info.name + ":n=1000"}).frames, frames(500)) << info.name;
  }
}

TEST(Cases, AreFilteredAsByGoogleBenchmark) {
  const auto all =
      cases({{"path1:n=300"}, {"yarn:n=200"}}, named({"CPU1", "CPU1/literal", "aCPU2+CPU2", "aCPU2+Dual"}));
  EXPECT_EQ(filtered(all, "").size(), all.size());
  EXPECT_EQ(filtered(all, "CPU1/find").size(), 2u);
  EXPECT_EQ(filtered(all, "path1").size() + filtered(all, "-path1").size(), all.size());
  EXPECT_TRUE(filtered(all, "nothing").empty());
  EXPECT_THROW(filtered(all, "("), InputError);
}

TEST(Cases, LeaveOutWhatIsNotAvailable) {
  auto variants = named({"CPU1", "aCPU2+CPU2"});
  variants[0].unavailable = "it is not here";
  for (const Case& c : cases({{"path1:n=100"}}, variants)) EXPECT_EQ(c.variant.name, variants[1].name);
  variants[1].unavailable = "nor this";
  EXPECT_TRUE(cases({{"path1:n=100"}}, variants).empty());
}

TEST(Cases, LeaveOutAllPairsOnLongChains) {
  const auto variants = named({"CPU1", "aCPU2+CPU2"});
  EXPECT_EQ(cases({{"path1:n=20000"}}, variants).size(), 6u);  // CPU1 has no build and no update
  EXPECT_EQ(cases({{"path1:n=20001"}}, variants).size(), 4u);
  EXPECT_EQ(cases({{"path1:n=101"}}, variants, 100).size(), 4u);
}

}  // namespace
}  // namespace catena::bench

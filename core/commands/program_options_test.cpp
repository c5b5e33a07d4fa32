// What each option of the program does to what it says, and what it refuses.
#include <algorithm>
#include <nlohmann/json.hpp>
#include <string>

#include "catena/core/commands/test_program.h"
#include "catena/core/readers/reader.h"
#include "catena/core/scenes/scene.h"
#include "catena/core/scenes/setup.h"
#include "catena/core/strategy/registry.h"
#include "catena/core/writers/writer.h"

namespace catena {
namespace {

using Json = nlohmann::json;

TEST_F(Program, TellsOneCollisionFromNone) {
  EXPECT_EQ(Json::parse(run("detect coincident:n=3 --json").output)["collides"], true);
  EXPECT_EQ(Json::parse(run("detect rod:n=60 --json").output)["collides"], false);
  const Json any = Json::parse(run("detect coincident:n=3 --any --json").output);
  EXPECT_EQ(any["collides"], true);
  EXPECT_FALSE(any.contains("max_count"));
}

/// All pairs build nothing: what is told of a find is not of a build.
TEST_F(Program, TellsWhatItTookStageByStage) {
  const Json line = Json::parse(run("detect path1:n=5000 --variant CPU1 --json").output);
  EXPECT_LT(line["build_ms"], line["find_ms"]);
  EXPECT_EQ(line["transfer_ms"], 0) << "nothing leaves the host";
  EXPECT_FALSE(line.contains("start_ms")) << "of a device, and none was started";
  EXPECT_FALSE(line.contains("answered_by"));
  EXPECT_FALSE(line.contains("plan")) << "not asked for";
  EXPECT_EQ(Json::parse(run("detect path1:n=20 --json").output)["answered_by"], "CPU1");
}

TEST_F(Program, ShowsThePlanOfWhatItDetects) {
  expect_says("detect path1:n=20 --plan", 0, {"step", "\n  hierarchy", "left out", "20 spheres"});
  const std::string plain = run("detect path1:n=5000 --variant CPU1").output;
  EXPECT_EQ(plain.find("left out"), std::string::npos);
  const auto ms = [&](const std::string& stage) {
    return std::stod(plain.substr(plain.find(stage) + stage.size()));
  };
  EXPECT_LT(ms("build "), ms("find ")) << plain;
}

/// Of a chain alone as of one, and of frames that follow one another as of these.
TEST_F(Program, ChoosesWhatItsPlanSays) {
  for (const std::string frames : {"--frame 3", "--frame all"}) {
    const auto choice = [&](const std::string& command) {
      const std::string said = run(command + " path1:n=5000 --counts-only --json " + frames).output;
      return Json::parse(lines_of(said).front())["plan"][0]["reason"];
    };
    EXPECT_EQ(choice("detect --plan"), choice("plan --run")) << frames;
  }
}

TEST_F(Program, ListsWhatEachNameMeans) {
  const std::string told = run("list").output;
  const auto expect_line = [&](const std::string& words) {
    EXPECT_NE(told.find(" " + words + "\n"), std::string::npos) << words;
  };
  for (const auto& reader : ReaderRegistry::instance().readers())
    expect_line(reader.name + ": " + reader.summary + "; labels: " + reader.label);
  for (const WriterInfo& writer : WriterRegistry::instance().writers())
    expect_line(writer.name + ": " + writer.summary);
  for (const SceneInfo& scene : SceneRegistry::instance().scenes()) expect_line(scene.summary);
}

TEST_F(Program, TellsWhatThinningHasCost) {
  const std::string said =
      run("detect path1:n=5000,spacing=0.2,frame=3 --tolerance 0.1 --arc-window pi/2 --json").output;
  const Json thinned = Json::parse(said.substr(0, said.find('\n')))["thinned"];
  EXPECT_EQ(thinned["of"], 5000);
  EXPECT_LE(thinned["lost"], 0.1);
  EXPECT_LT(thinned["own"], thinned["lost"]) << "the dips that were there are a part of it";
}

TEST_F(Program, LooksAtEveryInputBeforeItWorksOnTheFirst) {
  for (const char* command : {"verify", "margins", "examine", "stability", "regret"})
    expect_refused(std::string(command) + " rod:n=60 nowhere", "no scene is named 'nowhere'");
  expect_refused("stability nowhere", "no scene is named 'nowhere'");
  expect_refused("growth rod nowhere", "no scene is named 'nowhere'");
  expect_refused("growth rod --variant CPU1 --variant Nobody", "'Nobody'");
}

TEST_F(Program, RefusesColumnsWithoutTheirTable) {
  for (const std::string column : {"--depth", "--margin"})
    expect_refused("detect path1:n=10 " + column, "--depth and --margin are columns of --pairs");
  for (const std::string table : {"--pairs", "--counts"})
    expect_refused("detect path1:n=10 --any " + table + " '" + file("t.csv") + "'",
                   "--any finds neither counts nor pairs");
  EXPECT_FALSE(std::filesystem::exists(file("t.csv")));
}

// A format says whether it holds what was found: then it does, and else nobody is told that it was written.
TEST_F(Program, ExportsContactsToWhatHoldsThem) {
  const std::string three = write("three.csv", "x,y,z,r\n0,0,0,1\n9,0,0,1\n1,0,0,1\n");
  std::size_t hold = 0, others = 0;
  for (const WriterInfo& writer : WriterRegistry::instance().writers())
    for (const std::string& extension : writer.extensions) {
      const std::string without = file("a" + extension), with = file("b" + extension);
      const std::string to_both = "export " + three + " '" + with + "' --contacts";
      if (!writer.contacts) {
        expect_refused(to_both, writer.name + " holds no contacts");
        EXPECT_FALSE(std::filesystem::exists(with));
        ++others;
        continue;
      }
      expect_says("export " + three + " '" + without + "'", 0, {});
      expect_says(to_both, 0, {});
      EXPECT_NE(text_of(with), text_of(without)) << extension;
      ++hold;
    }
  EXPECT_GT(hold, 0u);
  EXPECT_GT(others, 0u);
}

TEST_F(Program, ExportsWhatIsAskedFor) {
  expect_refused("export path1:n=10 '" + file("a.csv") + "' --contacts", "CSV table holds no contacts");
  EXPECT_FALSE(std::filesystem::exists(file("a.csv")));
  expect_says("export path1:n=100,frame=3 '" + file("a.vtp") + "' --contacts --box 1,0,0", 2,
              {"frame 3: the box is 1 wide along x"});
  const std::string moving =
      write("m.xyz", "2\nt\nC 0 0 0\nC 5 0 0\n2\nt\nC 1 0 0\nC 6 0 0\n") + " --radius 1";
  expect_says("export " + moving + " '" + file("one.xyz") + "' --frame 1", 0, {"1 frame of 2 spheres"});
  expect_says("export " + moving + " '" + file("all.xyz") + "' --frame all", 0, {"2 frames of 2 spheres"});
  const std::string orphan = write("orphan.swc", "1 1 0 0 0 1 -1\n2 1 5 0 0 1 9\n");
  const std::string warning = run("detect " + orphan).output,
                    said = run("export " + orphan + " '" + file("o.chain") + "'").output;
  const std::string line = warning.substr(warning.find("catena: "));
  EXPECT_NE(said.find(line), std::string::npos) << said << "lacks" << line;
}

TEST_F(Program, CountsTheFramesOfAFile) {
  const std::string one = write("one.xyz", "1\nt\nC 0 0 0\n"),
                    two = write("two.xyz", "1\nt\nC 0 0 0\n1\nt\nC 1 0 0\n");
  expect_refused("detect " + one + " --radius 1 --frame 1", "has 1 frame, from 0; there is no frame 1");
  expect_refused("detect " + two + " --radius 1 --frame 2", "has 2 frames, from 0; there is no frame 2");
}

TEST_F(Program, ListsWhatEachThingIs) {
  const Json list = Json::parse(run("list --json").output);
  const std::string text = run("list").output;
  const auto& registry = StrategyRegistry::instance();
  std::size_t evident = 0;
  for (const Json& variant : list["variants"]) {
    const VariantInfo info = registry.describe(variant["name"].get<std::string>());
    const bool evidence =
        info.exact && !info.unavailable && registry.make(info.name)->evidence() != Accounting::none;
    EXPECT_EQ(variant["evidence"], evidence) << info.name;
    evident += evidence;
    EXPECT_EQ(variant["unavailable"], info.unavailable ? Json(*info.unavailable) : Json()) << info.name;
  }
  EXPECT_GT(evident, 0u);
  EXPECT_LT(evident, list["variants"].size());
  for (const Json& scene : list["scenes"]) {
    const std::string name = scene["name"];
    const auto scenes = SceneRegistry::instance().scenes();
    const auto& info = *std::ranges::find(scenes, name, &SceneInfo::name);
    EXPECT_EQ(scene["strains"], info.strains);
    EXPECT_EQ(scene["settings"], info.settings);
    if (!info.strains.empty()) {
      EXPECT_NE(text.find("      hard because " + info.strains + "\n"), std::string::npos) << name;
    }
    ASSERT_EQ(scene["parameters"].size(), info.parameters.size());
    for (std::size_t k = 0; k < info.parameters.size(); ++k) {
      const ParameterInfo& known = info.parameters[k];
      EXPECT_EQ(scene["parameters"][k],
                (Json{{"name", known.name}, {"default", known.default_value}, {"meaning", known.meaning}}));
      // One that is common to all scenes is listed where its default is another.
      const auto& common = SceneSetup::declared();
      const auto usual = std::ranges::find(common, known.name, &ParameterInfo::name);
      if (usual == common.end() || usual->default_value == known.default_value) continue;
      EXPECT_NE(text.find("      " + known.name + "=" + known.default_value + "  " + known.meaning),
                std::string::npos)
          << name;
    }
  }
}

TEST_F(Program, ListsTheFormatsThatItReadsAndWrites) {
  const Json list = Json::parse(run("list --json").output);
  Json readers = Json::array(), writers = Json::array();
  for (const ReaderInfo& r : ReaderRegistry::instance().readers())
    readers.push_back({{"name", r.name},
                       {"extensions", r.extensions},
                       {"summary", r.summary},
                       {"label", r.label},
                       {"options", r.options}});
  for (const WriterInfo& w : WriterRegistry::instance().writers())
    writers.push_back({{"name", w.name}, {"extensions", w.extensions}, {"summary", w.summary}});
  EXPECT_EQ(list["readers"], readers);
  EXPECT_EQ(list["writers"], writers);
}

TEST_F(Program, PlansEveryFrameAndSaysWhatItAssumes) {
  const std::string moving = write("m.xyz", "2\nt\nC 0 0 0\nC 5 0 0\n2\nt\nC 1 0 0\nC 6 0 0\n"),
                    orphan = write("orphan.swc", "1 1 0 0 0 1 -1\n2 1 5 0 0 1 9\n");
  expect_says("plan " + moving + " --radius 1 --frame all --json", 0, {"\"frame\":0,", "\"frame\":1,"});
  const std::string said = run("detect " + orphan).output;
  expect_says("plan " + orphan, 0, {said.substr(said.find("catena: "))});
}

}  // namespace
}  // namespace catena

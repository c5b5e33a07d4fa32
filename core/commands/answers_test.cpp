#include <fmt/format.h>

#include <algorithm>
#include <fstream>
#include <map>
#include <nlohmann/json.hpp>
#include <sstream>

#include "catena/core/commands/test_program.h"

namespace catena {
namespace {

/// Answers that can be traced to the user's own file, and what is said of a file that would be misread.
class Answers : public Program {
 protected:
  std::vector<nlohmann::json> lines_of(const std::string& name) const {
    std::vector<nlohmann::json> rows;
    std::istringstream text(text_of(file(name)));
    for (std::string line; std::getline(text, line);) rows.push_back(nlohmann::json::parse(line));
    return rows;
  }
};

// The tree is laid out depth first: the two tips are samples 3 and 5 of the file, but spheres 3 and 4.
TEST_F(Answers, NameTheSamplesOfANeuron) {
  const std::string swc = write(
      "n.swc", "1 1 0 0 0 0.1 -1\n2 3 1 0 0 0.1 1\n3 3 5 0 0 0.6 2\n4 3 0 1 0 0.1 1\n5 3 5 1 0 0.6 4\n");
  expect_says("detect " + swc + " --pairs '" + file("p.csv") + "' --counts '" + file("c.csv") + "'", 0,
              {"1 pair,"});
  EXPECT_EQ(text_of(file("p.csv")),
            "frame,i,j,label_i,label_j,strand_i,strand_j,index_i,index_j\n0,2,4,3,5,0,1,2,1\n");
  EXPECT_TRUE(text_of(file("c.csv")).ends_with("0,3,0,4,1,0\n0,4,1,5,1,1\n")) << text_of(file("c.csv"));
}

// 0.5 of the one end and 9.25 of the other are 1.25 apart across the face.
TEST_F(Answers, TellDepthsAcrossAFaceOfABox) {
  const std::string csv = write("b.csv", "id,x,y,z,r\nl,0.5,0,0,1\nm,5,5,5,0.1\nr,9.25,0,0,1\n");
  run("detect " + csv + " --box 10,0,0 --depth --margin --pairs '" + file("p.csv") + "'");
  EXPECT_TRUE(text_of(file("p.csv")).ends_with("index_j,depth,margin\n0,0,2,l,r,0,0,0,2,0.75,0.609375\n"))
      << text_of(file("p.csv"));
  run("detect " + csv + " --depth --pairs '" + file("p.csv") + "'");
  EXPECT_TRUE(text_of(file("p.csv")).ends_with("depth\n"));
  const std::string said = run("export " + csv + " '" + file("b.vtp") + "' --contacts --box 10,0,0").output;
  EXPECT_NE(said.find("holds no labels, nor names of strands; export to .csv"), std::string::npos) << said;
  const std::string text = text_of(file("b.vtp"));
  EXPECT_NE(text.find("Name=\"collisions\" format=\"ascii\">\n1\n0\n1\n"), std::string::npos) << text;
  EXPECT_NE(text.find("Name=\"contact\" format=\"ascii\">\n2\n-1\n0\n"), std::string::npos) << text;
  EXPECT_NE(text.find("Name=\"depth\" format=\"ascii\">\n0.75\n0\n0.75\n"), std::string::npos) << text;
}

// The dump's second frame has a box of its own, of which the first one's is no part.
TEST_F(Answers, TellDepthsInTheBoxOfEachFrame) {
  const auto frame = [](int step, int box, float far) {
    return fmt::format(
        "ITEM: TIMESTEP\n{}\nITEM: NUMBER OF ATOMS\n3\nITEM: BOX BOUNDS pp pp pp\n0 {}\n0 {}\n0 {}\n"
        "ITEM: ATOMS id mol xu yu zu\n1 1 0.5 0 0\n2 1 4 4 4\n3 1 {} 0 0\n",
        step, box, box, box, far);
  };
  const std::string dump = write("d.dump", frame(0, 10, 9.5f) + frame(1, 25, 24.25f));
  for (const std::string wrong : {"2", "1x", "-1"})
    expect_refused("detect " + dump + " --radius 1 --frame=" + wrong,
                   wrong == "2" ? "no frame 2" : "--frame");
  run("detect " + dump + " --radius 1 --frame all --depth --pairs '" + file("p.csv") + "'");
  EXPECT_TRUE(text_of(file("p.csv")).ends_with("depth\n0,0,2,1,3,0,0,0,2,1\n1,0,2,1,3,0,0,0,2,0.75\n"))
      << text_of(file("p.csv"));
  run("export " + dump + " '" + file("d.vtp") + "' --radius 1 --frame all --contacts");
  EXPECT_NE(text_of(file("d_1.vtp")).find("Name=\"depth\" format=\"ascii\">\n0.75\n0\n0.75\n"),
            std::string::npos);
}

// A name may hold what no line of text may, and no JSON.
TEST_F(Answers, TakeNamesOfAnyBytes) {
  const std::string csv = write("a\n\xff.csv", "x,y,z,r\n0,0,0,1\n1,0,0,1\n2,0,0,1\n");
  for (const std::string command : {"detect ", "plan --run ", "margins ", "scaling "}) {
    const ProgramOutcome json = run(command + csv + " --json");
    EXPECT_EQ(json.code, 0) << json.output;
    EXPECT_TRUE(nlohmann::json::accept(json.output.substr(0, json.output.find('\n')))) << json.output;
    if (command == "scaling ") continue;
    const ProgramOutcome text = run(command + csv);
    EXPECT_NE(text.output.find("a ?.csv frame 0:"), std::string::npos) << text.output;
  }
}

// Of a real neuron, every pair of samples that is named overlaps by the file's own numbers.
TEST_F(Answers, NameSamplesThatOverlapInTheFile) {
  const std::string swc = CATENA_SOURCE_DIR "/core/readers/examples/Neuron.swc";
  run("detect " + swc + " --pairs '" + file("p.jsonl") + "' --depth --margin");
  std::map<std::string, std::array<double, 4>> samples;
  std::ifstream in(swc);
  for (std::string line; std::getline(in, line);) {
    std::istringstream fields(line);
    std::string id, type;
    std::array<double, 4> s{};
    if (fields >> id >> type >> s[0] >> s[1] >> s[2] >> s[3] && id != "#") samples[id] = s;
  }
  ASSERT_EQ(samples.size(), 847u);
  const auto rows = lines_of("p.jsonl");
  ASSERT_GT(rows.size(), 10u);
  const auto pair_of = [](const nlohmann::json& row) {
    return std::pair(row["i"].get<int>(), row["j"].get<int>());
  };
  EXPECT_TRUE(std::ranges::is_sorted(rows, {}, pair_of));
  for (const auto& row : rows) {
    const auto &a = samples.at(row["label_i"]), &b = samples.at(row["label_j"]);
    const double depth = a[3] + b[3] - std::hypot(a[0] - b[0], a[1] - b[1], a[2] - b[2]);
    EXPECT_NEAR(row["depth"], depth, 1e-5) << row;
    EXPECT_GE(row["depth"], 0) << row;
    EXPECT_GE(row["margin"], 0) << row;
  }
}

TEST_F(Answers, NameStrandsAndRows) {
  const std::string csv =
      write("t.csv", "chain,x,y,z,r,id\n\"a,1\",0,0,0,1,p\nb,1,0,0,1,q\nb,50,0,0,1,\"s\"\n");
  expect_says("detect " + csv + " --pairs '" + file("p.csv") + "'", 0, {"1 pair,"});
  EXPECT_TRUE(text_of(file("p.csv")).ends_with("\n0,0,1,p,q,\"a,1\",b,0,0\n")) << text_of(file("p.csv"));
  run("detect " + csv + " --pairs '" + file("p.jsonl") + "' --depth");
  const nlohmann::json row = lines_of("p.jsonl").at(0);
  EXPECT_EQ(row, nlohmann::json::parse(R"({"frame":0,"i":0,"j":1,"label_i":"p","label_j":"q","strand_i":"a,1",
                                           "strand_j":"b","index_i":0,"index_j":0,"depth":1.0})"));
  expect_refused("detect " + csv + " --depth", "--pairs");
  // Both in the second strand, where numbers and places in the strand differ.
  const std::string second =
      write("second.csv", "chain,x,y,z,r\na,90,0,0,1\nb,0,0,0,1\nb,50,0,0,1\nb,1,0,0,1\n");
  run("detect " + second + " --pairs '" + file("s.csv") + "'");
  EXPECT_TRUE(text_of(file("s.csv")).ends_with("\n0,1,3,3,5,b,b,0,2\n")) << text_of(file("s.csv"));
  // A label in no Unicode is shown as far as JSON can.
  const std::string latin = write("latin.csv", "id,x,y,z,r\nM\xFCller,0,0,0,1\nq,9,0,0,1\np,1,0,0,1\n");
  run("detect " + latin + " --pairs '" + file("l.jsonl") + "'");
  EXPECT_EQ(lines_of("l.jsonl").at(0)["label_i"], "M\xEF\xBF\xBDller");
}

TEST_F(Answers, SayWhatRoundingHasCost) {
  std::string table = "x,y,z,r\n";
  for (int i = 0; i < 20; ++i) table += std::to_string(100'000'000 + i) + ",0,0,0.3\n";
  const std::string far = write("far.csv", table),
                    near = write("near.csv", "x,y,z,r\n100.1,0,0,1\n102,0,0,1\n");
  expect_says("detect " + far, 0, {"binary32 rounds coordinates by up to 4, 13.3 of a radius", "--recentre"});
  expect_says("detect " + far + " --recentre", 0, {"the origin 100000000,0,0 is taken off", " 0 pairs"});
  expect_says("detect " + far + " --origin 1e8,0,0", 0, {" 0 pairs"});
  EXPECT_EQ(run("detect " + far + " --recentre").output.find("binary32"), std::string::npos);
  EXPECT_EQ(run("detect " + near).output.find("binary32"), std::string::npos);
  expect_refused("detect " + far + " --origin 1e8,0", "an origin is X,Y,Z");
  expect_refused("detect path1:n=10 --recentre", "are for files");
  expect_says("detect '" + write("no.csv", "x,y,z\n100000000.3,0,0\n").substr(1) + " --radius 0.5", 0,
              {"binary32 rounds coordinates by up to 0.3, 0.6 of a radius"});
}

TEST_F(Answers, AreOfNumbersThatBinary32Has) {
  expect_refused("detect " + write("wide.csv", "x,y,z\n3e38,0,0\n-3e38,0,0\n") + " --recentre --radius 1",
                 "sphere 1 lies further than binary32 reaches from the origin that is taken off");
  const std::string points = write("points.csv", "x,y,z\n0,0,0\n1.4e-45,0,0\n2.8e-45,0,0\n");
  expect_refused("detect " + points + " --radius half-spacing", "half the median step is 7");
  expect_refused("detect " + points + " --radius 1e-50", "--radius 1e-50: is no 0, but binary32 has no radius so small");
  expect_says("detect " + points + " --radius +0.5", 0, {"1 pair"});
}

TEST_F(Answers, NameEveryFileOnceAndInOneLine) {
  const std::string bad = write("bad.xyz", "0 0 \x1B[31m" + std::string(100'000, 'O') + "\n1 0 0\n");
  const ProgramOutcome r = run("detect " + bad + " --radius 1");
  EXPECT_EQ(r.code, 2);
  EXPECT_LT(r.output.size(), 400u);
  EXPECT_EQ(r.output.find('\x1B'), std::string::npos);
  EXPECT_NE(r.output.find("bad.xyz:1: z '?[31mOOO"), std::string::npos) << r.output;
  const std::string hair = write("warned.swc", "1 1 0 0 0 1 -1\n2 1 5 0 0 1 9\n");
  const std::string said = run("detect " + hair + " --counts-only").output;
  const std::string warning = said.substr(said.find("catena: "));
  ASSERT_NE(warning.find("warned.swc"), std::string::npos) << said;
  EXPECT_EQ(warning.find("warned.swc"), warning.rfind("warned.swc")) << said;
  expect_refused("detect path1:n=10 --variant '" + std::string(5000, 'q') + "'", "...");
  expect_refused("detect $'a\\x1b[1m.swc'", "there is no such file");
}

TEST_F(Answers, TakeAnArcWindowAsItIsWritten) {
  const std::string rod = "detect rod:n=60 --json --arc-window ";
  const auto pairs = [&](const std::string& window) {
    return nlohmann::json::parse(run(rod + window).output)["pairs"].get<int>();
  };
  EXPECT_EQ(pairs("pi/2"), pairs("1.5707963267948966"));
  EXPECT_EQ(pairs("pi"), pairs("3.141592653589793"));
  for (const char* wrong : {"pie", "pi/0", "pi/-2", "0", "nan", "pi/"})
    expect_refused("detect rod:n=60 --arc-window " + std::string(wrong), "must be a finite number above 0");
}

TEST_F(Answers, RefuseToCloseATree) {
  const std::string swc = write("t.swc", "1 1 0 0 0 1 -1\n2 3 5 0 0 1 1\n");
  expect_refused("detect " + swc + " --closed",
                 "a tree of branches has no closed strands; leave out --closed");
}

TEST_F(Answers, AreOfEveryFrameOfAFile) {
  const std::string xyz =
      write("m.xyz", "3\nt\nC 0 0 0\nC 5 0 0\nC 9 0 0\n3\nt\nC 0 0 0\nC 5 0 0\nC 1 0 0\n");
  expect_says("detect " + xyz + " --radius 1 --frame all --pairs '" + file("p.csv") + "'", 0,
              {"frame 0: 3 spheres, 0 pairs", "frame 1: 3 spheres, 1 pair,"});
  EXPECT_TRUE(text_of(file("p.csv")).ends_with("1,0,2,C1,C3,0,0,0,2\n")) << text_of(file("p.csv"));
}

TEST_F(Answers, CountFilesOfOneNameApart) {
  std::filesystem::create_directories(file("a"));
  std::filesystem::create_directories(file("b"));
  const std::string one = write("a/same.csv", "x,y,z,r\n0,0,0,1\n9,0,0,1\n1,0,0,1\n"),
                    two = write("b/same.csv", "x,y,z,r\n0,0,0,1\n9,0,0,1\n5,0,0,1\n");
  const std::string said = run("verify " + one + " " + two + " --variant CPU1").output;
  EXPECT_NE(said.find("on 2 inputs"), std::string::npos) << said;
  EXPECT_NE(said.find("b/same.csv"), std::string::npos) << said;
}

}  // namespace
}  // namespace catena

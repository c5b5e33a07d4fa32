#include <gtest/gtest.h>
#include <sys/stat.h>

#include <algorithm>
#include <filesystem>
#include <string>
#include <vector>

#include "catena/core/commands/test_program.h"
#include "catena/properties/testing/device_file.h"

/// What the program writes: tables, exports, what it prints, and what is left of them when that fails.
namespace catena {
namespace {

/// Whatever a format cannot hold is said, each in a line of its own, and nothing where nothing is lost.
// What is read is not written over, by whatever name, and no table over another.
TEST_F(Program, LosesNoFileToAnother) {
  const std::string text = "x,y,z,r\n0,0,0,1\n3,0,0,1\n1,1,0,1\n", in = write("in.csv", text);
  std::filesystem::create_symlink("in.csv", file("link.csv"));
  const std::string beside = "'" + file("./in.csv") + "'", link = "'" + file("link.csv") + "'";
  for (const std::string& out : {in, beside, link}) {
    for (const char* option : {" --pairs ", " --counts "})
      expect_refused("detect " + in + option + out, "is read, and would be lost; name another file to write");
    expect_refused("export " + in + " " + out, "is read, and would be lost");
    EXPECT_EQ(text_of(file("in.csv")), text);
  }
  expect_refused("detect " + link + " --pairs " + in, "is read, and would be lost");
  expect_refused("detect yarn:n=50 --topology " + in + " --counts " + in, "is read, and would be lost");
  EXPECT_EQ(text_of(file("in.csv")), text);
  const std::string table = "'" + file("t.csv") + "'",
                    same = "'" + file("../") +
                           std::filesystem::path(file("t.csv")).parent_path().filename().string() + "/t.csv'";
  for (int time = 0; time < 2; ++time) {  // of a file that is there, too
    expect_refused("detect " + in + " --pairs " + table + " --counts " + same,
                   "is to be written twice; name another file");
    EXPECT_EQ(text_of(file("t.csv")), time == 0 ? "" : "kept");
    write("t.csv", "kept");
  }
  expect_refused("detect " + in + " --pairs -", "/dev/stdout is the output");
  if (const auto null = properties::DeviceFile::null(file("null")))
    expect_says("detect " + in + " --pairs '" + *null + "' --counts '" + *null + "'", 0,
                {"3 spheres, 1 pair"});
  write("g_1.csv", "1\nt\n0 0 0\n1\nt\n1 0 0\n");
  expect_refused(
      "export '" + file("g_1.csv") + "' '" + file("g.csv") + "' --format xyz --radius 1 --frame all",
      "g_1.csv: is read, and would be lost");
  EXPECT_FALSE(std::filesystem::exists(file("g_0.csv")));
}

/// What is said beside an answer is no part of it.
TEST_F(Program, AnswersWhereStandardErrorTakesNothing) {
  const std::string warns =
      write("a.lammpstrj",
            "ITEM: TIMESTEP\n0\nITEM: NUMBER OF ATOMS\n2\nITEM: BOX BOUNDS ff ff ff\n0 1\n0 1\n"
            "0 1\nITEM: ATOMS id x y z\n1 0 0 0\n2 1 0 0\n") +
      " --radius 1";
  expect_says("detect " + warns, 0, {"all beads are one strand"});
  std::filesystem::create_directory(file("catena"));
  write("catena/calibration.txt", "damaged");
  std::vector<std::string> nowhere{"2>&-"};
  if (const auto full = properties::DeviceFile::full(file("full"))) nowhere.push_back("2> '" + *full + "'");
  for (const std::string& error : nowhere) {
    for (const std::string& command : Texts{"detect " + warns, "plan path1:n=100",
                                            "export path1:n=100 --window 2 '" + file("o.obj") + "'"}) {
      const ProgramOutcome r =
          shell("XDG_CACHE_HOME='" + file("") + "' catena " + command + " > '" + file("out") + "' " + error);
      EXPECT_EQ(r.code, 0) << command << error;
      EXPECT_NE(r.output.find("spheres"), std::string::npos) << command << error;
    }
    EXPECT_EQ(shell("catena detect nowhere " + error).code, 2);
  }
}

TEST_F(Program, SaysThatItsFolderIsGone) {
  const ProgramOutcome r = shell("mkdir '" + file("gone") + "' && cd '" + file("gone") + "' && rmdir '" +
                                 file("gone") + "' && catena fuzz --cases 1");
  EXPECT_EQ(r.code, 2);
  EXPECT_TRUE(r.output.ends_with(": the working folder is not to be found (No such file or directory)\n"))
      << r.output;
}

TEST_F(Program, SaysWhatAnExportLoses) {
  const std::string neuron =
      write("neuron.swc", "1 1 0 0 0 1 -1\n2 3 3 0 0 1 1\n3 3 6 0 0 1 2\n4 3 3 3 0 1 2\n");
  struct Lost {
    const char *input, *out;
    std::vector<std::string> lines;
  };
  const std::string rule = "exclusion rule; give it with --window or --arc-window",
                    joints = "neighbours across joints; .chain does",
                    others =
                        "joints, across which another --window or --arc-window finds neighbours; .chain does",
                    radii = "radii; give them with --radius";
  for (const auto& [options, out, lines] :
       {Lost{"", "a.chain", {}}, Lost{" --window 3", "a.chain", {}}, Lost{"", "a.csv", {joints}},
        Lost{" --window 2", "a.csv", {rule, joints}}, Lost{" --arc-window pi/2", "a.csv", {rule, joints}},
        Lost{"", "a.obj", {radii, joints}}, Lost{" --window 3", "a.catena", {others}}}) {
    const ProgramOutcome r = run("export " + neuron + " '" + file(out) + "'" + options);
    EXPECT_EQ(r.code, 0) << r.output;
    for (const std::string& line : lines)
      EXPECT_NE(r.output.find("holds no " + line), std::string::npos) << r.output;
    EXPECT_EQ(std::ranges::count(r.output, '\n'), 1 + static_cast<std::ptrdiff_t>(lines.size()))
        << options << out << r.output;
  }
  // Lines between points tell a strand by its ends: a ring before an open strand comes behind it, and two
  // spheres are no ring.
  const std::string ring = "strand closed 3\n0 0 0 1\n2 0 0 1\n1 2 0 1\n",
                    line = "strand open 2\n9 0 0 1\n9 2 0 1\n",
                    two_closed = "strand closed 2\n9 0 0 1\n9 2 0 1\n";
  const auto kept = [&](const std::string& strands, const char* out) {
    const std::string from = write("strands.chain", "catena-chain 1\nwindow 1\n" + strands + "end\n");
    const std::string said = run("export " + from + " '" + file(out) + "'").output;
    return std::pair(said.find("holds no order of strands") == std::string::npos,
                     said.find("holds no closed strand of one or two spheres") == std::string::npos);
  };
  for (const char* const out : {"a.vtp", "a.obj"}) {
    EXPECT_EQ(kept(line + ring, out), std::pair(true, true)) << out;
    EXPECT_EQ(kept(ring + line, out), std::pair(false, true)) << out;
    EXPECT_EQ(kept(two_closed, out), std::pair(true, false)) << out;
    EXPECT_EQ(kept("strand closed 0\n" + line + ring + "strand open 0\n", out), std::pair(true, true))
        << "strands without spheres have no place";
  }
  EXPECT_EQ(kept(two_closed + line, "a.csv"), std::pair(true, true));
  // A chain keeps the arc lengths of frame 0, by which spheres of a frame that shrank are no neighbours.
  std::string frames;
  for (const double step : {1.0, 0.5}) {
    frames += "9\nframe\n";
    for (int k = 0; k < 9; ++k) frames += "C " + std::to_string(step * k) + " 0 0\n";
  }
  const std::string two = write("two.xyz", frames) + " --radius 0.6 --arc-window 1";
  for (const char* const out : {"a.csv", "a.vtp", "a.obj", "a.xyz"})
    for (const char* const frame : {"0", "1", "all"}) {
      const ProgramOutcome r = run("export " + two + " --frame " + frame + " '" + file(out) + "'");
      EXPECT_EQ(r.code, 0) << r.output;
      // Frames in one file keep those of its first again when they are read.
      const bool lost = *frame == '1' || (*frame == 'a' && std::string_view(out) != "a.xyz");
      EXPECT_EQ(r.output.find("holds no arc lengths of another frame") != std::string::npos, lost)
          << out << " of " << frame << ": " << r.output;
    }
  for (const char* const out : {"a.csv", "a.vtp", "a.obj", "a.xyz", "a.chain", "a.catena"})
    expect_says("export path1:n=2000,spacing=0.1 --arc-window pi/2 --tolerance 0.05 '" + file(out) + "'", 0,
                {"holds no arc lengths of another frame, nor of spheres left out"});
  for (const char* const out : {"a.chain", "a.catena"})
    for (const int frame : {0, 1}) {
      const std::string of = " --frame " + std::to_string(frame);
      const ProgramOutcome r = run("export " + two + of + " '" + file(out) + "'");
      EXPECT_EQ(r.code, 0) << r.output;
      const auto pairs = [&](const std::string& input) {
        const ProgramOutcome found = run("detect " + input + " --json");
        const std::size_t at = found.output.find("\"pairs\":");
        return found.output.substr(at, found.output.find(',', at) - at);
      };
      EXPECT_EQ(r.output.find("holds no arc lengths of another frame") == std::string::npos, frame == 0)
          << r.output;
      EXPECT_EQ(pairs(two + of) == pairs("'" + file(out) + "'"), frame == 0) << out;
      EXPECT_EQ(std::ranges::count(r.output, '\n'), 2 + frame) << r.output;  // its elements are lost, too
    }
}

/// All files of a series, or none of them that was not there.
TEST_F(Program, ExportsASeriesWholeOrNotAtAll) {
  const std::string out = "export path1:n=10 '" + file("o.csv") + "' --frame all";
  expect_says(out, 0, {file("o_0.csv") + " ... " + file("o_55.csv") + ": 56 frames of 10 spheres"});
  for (int f = 1; f < 56; ++f) std::filesystem::remove(file("o_" + std::to_string(f) + ".csv"));
  std::filesystem::create_directory(file("o_5.csv"));
  expect_refused(out, "cannot write " + file("o_5.csv") + ": Is a directory");
  EXPECT_TRUE(std::filesystem::exists(file("o_0.csv"))) << "it was there";
  EXPECT_FALSE(std::filesystem::exists(file("o_1.csv")));
  std::filesystem::remove(file("o_5.csv"));
  std::string moving;  // its second file is the longer one, and is cut
  for (const char* at : {" 5", " 5.1234567"}) {
    moving += "20\nt\n";
    for (int i = 0; i < 20; ++i) moving += std::string("C") + at + at + at + '\n';
  }
  const std::string too_long = "ulimit -f 1; catena export --frame all --radius 1 " + write("m.xyz", moving) +
                               " '" + file("m.csv") + "'";
  write("m_0.csv", "of an earlier series");
  EXPECT_EQ(shell(too_long).code, 2);
  EXPECT_TRUE(std::filesystem::exists(file("m_0.csv"))) << "it was there";
  std::filesystem::remove(file("m_0.csv"));
  std::filesystem::create_symlink(file("elsewhere.csv"), file("m_0.csv"));
  const ProgramOutcome cut = shell(too_long);
  EXPECT_EQ(cut.code, 2);
  EXPECT_NE(cut.output.find("cannot write " + file("m_1.csv") + ": File too large"), std::string::npos)
      << cut.output;
  EXPECT_FALSE(std::filesystem::exists(file("m_0.csv")));
  EXPECT_TRUE(std::filesystem::is_symlink(file("m_0.csv"))) << "it was there";
}

/// A file's name may hold what drives a terminal, and bytes that are no text.
TEST_F(Program, PrintsNoNameRaw) {
  const std::string name = "bad\x1b[31m\xff.csv", text = "x,y,z,r\n0,0,0,1\n3,0,0,1\n1,2,0,1\n";
  const std::string input = write(name, text);
  for (const std::string command :
       {"examine ", "scaling --ranks 2 ", "stability --cells --variant CPU1 ", "stability --variant CPU1 ",
        "verify --variant CPU1 ", "regret --seconds 0.01 --rounds 2 --variant aCPU2+CPU2 ",
        "knots --closed --thickness 1 "}) {
    const ProgramOutcome r = run(command + input);
    EXPECT_NE(r.output.find("bad?[31m?.csv"), std::string::npos) << command << r.output;
    EXPECT_EQ(r.output.find('\x1b'), std::string::npos) << command;
  }
  const ProgramOutcome told = shell("XDG_CACHE_HOME='" + file("bad\xff") + "' catena calibrate --json");
  EXPECT_EQ(told.code, 0) << told.output;
}

TEST_F(Program, WritesPairsAndCounts) {
  const std::string pairs = file("pairs.csv"), counts = file("counts.csv");
  expect_says("detect coincident:n=60 --pairs '" + pairs + "' --counts '" + counts + "'", 0, {"812 pairs"});
  const std::string pair_text = text_of(pairs), count_text = text_of(counts);
  EXPECT_TRUE(pair_text.starts_with(
      "frame,i,j,label_i,label_j,strand_i,strand_j,index_i,index_j\n0,0,2,0,2,0,0,0,2\n"))
      << pair_text.substr(0, 40);
  EXPECT_EQ(std::ranges::count(pair_text, '\n'), 813);
  EXPECT_TRUE(count_text.starts_with("frame,sphere,count,label,strand,index\n0,0,"))
      << count_text.substr(0, 40);
  EXPECT_EQ(std::ranges::count(count_text, '\n'), 61);
}

/// Of a name that is not a regular file, the thing stays, and gets the text.
TEST_F(Program, WritesThroughWhatIsNoRegularFile) {
  const std::string csv = "frame,sphere,count,label,strand,index\n0,0,1,0,0,0\n0,1,0,1,0,1\n0,2,1,2,0,2\n",
                    scene = "detect coincident:n=3 --counts ";
  const ProgramOutcome both = run(scene + "/dev/stdout --any");
  EXPECT_EQ(both.code, 2) << "--any counts nothing";
  const ProgramOutcome printed = run(scene + "/dev/stdout");
  EXPECT_EQ(printed.code, 0);
  EXPECT_NE(printed.output.find(csv), std::string::npos) << printed.output;
  EXPECT_NE(printed.output.find("1 pair, at most 1 a sphere"), std::string::npos) << printed.output;

  const std::string fifo = file("fifo"), read = file("read"), link = file("link");
  ASSERT_EQ(mkfifo(fifo.c_str(), 0600), 0);
  EXPECT_EQ(shell("cat '" + fifo + "' > '" + read + "' & catena " + scene + "'" + fifo + "'; wait").code, 0);
  EXPECT_TRUE(std::filesystem::is_fifo(fifo));
  expect_refused("detect '" + fifo + "' --format csv",
                 "is not a regular file; what comes through a pipe is read from standard input");
  EXPECT_EQ(text_of(read), csv);

  std::filesystem::create_symlink("read", link);
  expect_says(scene + "'" + link + "' --window 2", 0, {"0 pairs"});
  EXPECT_TRUE(std::filesystem::is_symlink(link));
  EXPECT_EQ(text_of(read), "frame,sphere,count,label,strand,index\n0,0,0,0,0,0\n0,1,0,1,0,1\n0,2,0,2,0,2\n");

  const auto full = properties::DeviceFile::full(file("full device"));
  if (!full) GTEST_SKIP() << "no device can be made here, and /dev can be written";
  std::filesystem::create_symlink(*full, file("full"));
  expect_says(scene + "'" + file("full") + "'", 2,
              {"cannot write " + file("full") + ": No space left on device"});
  EXPECT_TRUE(std::filesystem::is_symlink(file("full")));
}

TEST_F(Program, SaysWhenItsOutputIsNotWritten) {
  for (const std::string& command : std::initializer_list<std::string>{
           "list", "list --json", "--help", "--version", "detect path1:n=10",
           "detect path1:n=10 --frame all --json", "verify path1:n=10 --variant CPU1", "fuzz --cases 3",
           "margins path1:n=10", "enumerate --walks 3", "closed-form --side 3 --reach 1",
           "scaling path1:n=300", "pivot --n 50 --moves 64", "knots --n 16", "plan path1:n=10 --json",
           "export path1:n=10 '" + file("x.csv") + "'", "examine --help", "growth --help"}) {
    const ProgramOutcome full =
        shell("XDG_CACHE_HOME='" + file("cache") + "' catena " + command + " > /dev/full");
    EXPECT_EQ(full.code, 2) << command;
    EXPECT_EQ(full.output, "catena: cannot write the output: No space left on device\n") << command;
  }
  const ProgramOutcome closed = shell("catena detect coincident:n=60 --pairs '" + file("p.csv") + "' >&-");
  EXPECT_EQ(closed.code, 2);
  EXPECT_EQ(closed.output, "catena: cannot write the output: standard output is closed\n");
  EXPECT_EQ(std::ranges::count(text_of(file("p.csv")), '\n'), 813) << "what is printed got into the table";
  // What is printed, more than is buffered, goes into no file that takes the number of a closed stream.
  const std::string frames = "detect path1:n=20 --frame all --counts '" + file("c.csv") + "'";
  EXPECT_GT(run(frames).output.size(), 4096u);
  const std::string counts = text_of(file("c.csv"));
  EXPECT_EQ(std::ranges::count(counts, '\n'), 1 + 56 * 20);
  for (const char* closing : {" >&-", " <&- >&-", " >&- 2>&-"}) {
    std::filesystem::remove(file("c.csv"));
    EXPECT_EQ(shell("catena " + frames + closing).code, 2) << closing;
    EXPECT_FALSE(std::filesystem::exists(file("c.csv"))) << closing;
  }
}

TEST_F(Program, EndsQuietlyWhenNobodyReadsOn) {
  const ProgramOutcome left =
      shell("{ sleep 0.5; catena detect path1:n=3000 --frame all --json; echo $? >&2; } | true > '" +
            file("out") + "'");  // whoever read has gone for certain: a pipe would hold all of it
  EXPECT_EQ(left.output, "2\n");
}

TEST_F(Program, LeavesNothingBehindWhenAFileCannotBeWrittenToItsEnd) {
  const std::string folder = file("tables");
  std::filesystem::create_directories(folder);
  const ProgramOutcome cut =
      shell("cd '" + folder + "'; ulimit -f 1; catena detect coincident:n=100 --pairs p --counts c");
  EXPECT_EQ(cut.code, 2);
  EXPECT_TRUE(cut.output.ends_with("catena: cannot write p: File too large\n")) << cut.output;
  EXPECT_TRUE(std::filesystem::is_empty(folder));
}

}  // namespace
}  // namespace catena

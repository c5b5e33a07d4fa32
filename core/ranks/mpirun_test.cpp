#include <fmt/format.h>
#include <sys/mount.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <set>
#include <sstream>
#include <string>
#include <vector>

#include "catena/bench/closed_form/lattice_box.h"
#include "catena/core/commands/test_program.h"
#include "catena/core/input/input.h"
#include "catena/core/ranks/rank_search.h"
#include "catena/core/ranks/thread_ranks.h"
#include "catena/properties/testing/device_file.h"

/// The program under mpirun, three processes on whatever cores there are.
namespace catena {
namespace {

class Mpirun : public Program {
 protected:
  void SetUp() override {
    if (std::string_view(CATENA_MPIRUN).empty()) GTEST_SKIP() << "built without MPI";
    if (!std::filesystem::exists(CATENA_MPIRUN)) GTEST_SKIP() << "there is no " << CATENA_MPIRUN;
  }

  /// `before` are settings of the environment, `limit` seconds. --quiet, as mpirun tells of every exit code
  /// by many lines of its own; and it does not wait a second before it kills what another rank's failure left
  /// running.
  ProgramOutcome run_ranks(const std::string& arguments, unsigned ranks = 3, const std::string& before = "",
                           unsigned limit = 120) const {
    const char* const as_root = geteuid() == 0 ? "--allow-run-as-root" : "";
    return shell(
        fmt::format("{} OMPI_MCA_odls_base_sigkill_timeout=0 ASAN_OPTIONS=detect_leaks=0 timeout {} '{}' "
                    "--quiet --oversubscribe {} -n {} '{}' {} > '{}'",
                    before, limit, CATENA_MPIRUN, as_root, ranks, CATENA_PROGRAM, arguments, file("out")));
  }
  void expect_one_line(const ProgramOutcome& r, const std::string& because) const {
    EXPECT_EQ(r.code, 2) << r.output;
    EXPECT_EQ(std::ranges::count(r.output, '\n'), 1) << r.output;
    EXPECT_TRUE(r.output.starts_with("catena: ")) << r.output;
    EXPECT_NE(r.output.find(because), std::string::npos) << r.output;
  }
};

/// Each number under its own name: what they are to one another.
void expect_work_of_ranks(const nlohmann::json& line) {
  std::set<double> ms, kib;
  for (const auto& phase : line["phases_ms"]) ms.insert(phase.get<double>());
  for (const auto& phase : line["phases_peak_kib"]) kib.insert(phase.get<double>());
  EXPECT_GT(ms.size(), 1u) << line;
  EXPECT_GT(kib.size(), 1u) << line;
  EXPECT_LT(*ms.rbegin(), line["whole_ms"]) << line;
  std::uint64_t asked = 0, touching = 0, most_kib = 0;
  for (const auto& rank : line["of_ranks"]) {
    asked += rank["blocks_asked"].get<std::uint64_t>();
    touching += rank["blocks_touching"].get<std::uint64_t>();
    most_kib = std::max(most_kib, rank["peak_kib"].get<std::uint64_t>());
    EXPECT_LT(rank["rounds"], rank["messages"]) << line;
    EXPECT_LT(rank["messages"], rank["bytes"]) << line;
  }
  EXPECT_GT(touching, 0u) << line;
  EXPECT_LT(touching, asked) << line;
  EXPECT_LE(*kib.rbegin(), most_kib) << line;
}

struct RankDid {
  ranks::RankWork work;
  ranks::Traffic sent;
};
/// What each of so many does that counts in chain order, as a thread of this process.
std::vector<RankDid> in_threads(const char* input, unsigned size) {
  const Chain chain = open_input(input).animation->frame(0);
  const ranks::RankOptions options{.order = ranks::Order::chain, .request = {.want = Request::Want::counts}};
  std::vector<RankDid> did(size);
  ranks::run_in_threads(size, [&](ranks::Communicator& c) {
    search(c, ranks::even_part_of(chain, size, c.rank()), options, did[c.rank()].work);
    did[c.rank()].sent = c.traffic();
  });
  return did;
}

/// Of a search in chain order, which takes something in each phase but for that in which spheres change
/// ranks.
void expect_phases_in_chain_order(const nlohmann::json& phases) {
  EXPECT_EQ(phases.size(), 7u) << phases;
  for (const auto& [phase, took] : phases.items()) EXPECT_EQ(took == 0, phase == "repartition") << phases;
}

TEST_F(Mpirun, WritesTheTablesOfOneProcess) {
  std::filesystem::create_symlink("linked.csv", file("ranks.csv"));  // to nothing, yet
  for (const std::string input :
       {"coincident:n=60", "yarn:n=3000,seed=5 --arc-window pi/2", "hair:n=900 --window 3",
        "path1:n=2000,frame=5", CATENA_SOURCE_DIR "/core/readers/examples/1A8O.pdb --radius 3"}) {
    for (const char* order : {"chain", "space"})
      for (const char* kind : {"csv", "jsonl"}) {
        const auto tables = [&](const char* of) {
          return fmt::format(" --pairs '{0}.{1}' --counts '{0}.counts.{1}' --depth --margin", file(of), kind);
        };
        const ProgramOutcome alone = run("detect " + input + tables("alone"));
        ASSERT_EQ(alone.code, 0) << alone.output;
        const ProgramOutcome ranks = run_ranks("detect " + input + tables("ranks") + " --order " + order);
        ASSERT_EQ(ranks.code, 0) << ranks.output;
        for (const std::string& end : {std::string(kind), std::string("counts.") + kind}) {
          EXPECT_GT(text_of(file("alone." + end)).size(), 100u);
          EXPECT_EQ(text_of(file("alone." + end)), text_of(file("ranks." + end))) << input << " " << order;
        }
      }
  }
  EXPECT_TRUE(std::filesystem::is_symlink(file("ranks.csv")));
}

/// Ranks read their own parts of a .catena file, and not where options change what it says.
TEST_F(Mpirun, HeedsOptionsBesideAFileThatRanksReadInParts) {
  const std::string input = file("c.catena");
  ASSERT_EQ(run("export coincident:n=60 '" + input + "'").code, 0);
  std::set<std::string> answers;
  for (const char* options : {" --window 25", " --arc-window pi/2"}) {
    const auto table = [&](const char* of) { return fmt::format("{} --pairs '{}'", options, file(of)); };
    ASSERT_EQ(run("detect '" + input + "'" + table("alone.csv")).code, 0) << options;
    const ProgramOutcome ranks = run_ranks("detect '" + input + "'" + table("ranks.csv"));
    ASSERT_EQ(ranks.code, 0) << ranks.output;
    EXPECT_EQ(text_of(file("alone.csv")), text_of(file("ranks.csv"))) << options;
    const auto own = std::filesystem::perms::owner_read | std::filesystem::perms::owner_write;
    if (!answers.empty()) {
      EXPECT_EQ(std::filesystem::status(file("ranks.csv")).permissions(), own) << "as it was";
    }
    std::filesystem::permissions(file("ranks.csv"), own);
    answers.insert(text_of(file("alone.csv")));
  }
  EXPECT_EQ(answers.size(), 2u) << "each option matters";
}

/// Rank 0 has it, and needs it again for the reference.
TEST_F(Mpirun, TakesStandardInputWhereverItTakesAFile) {
  const std::string chain = file("c.chain");
  ASSERT_EQ(run("export yarn:n=60 '" + chain + "'").code, 0);
  for (const char* command : {"detect", "verify", "bench --json"}) {
    const ProgramOutcome r = run_ranks(fmt::format("{} - --format chain < '{}'", command, chain), 2);
    EXPECT_EQ(r.code, 0) << command << r.output;
  }
}

TEST_F(Mpirun, WritesTheTablesOfOneProcessInABox) {
  const std::string examples = CATENA_SOURCE_DIR "/core/readers/examples/";
  std::string frame = text_of(examples + "melt.dump"), wider;
  frame.resize(frame.find("ITEM: TIMESTEP", 1));
  wider = frame;
  wider.replace(wider.find("0 8\n"), 3, "0 12");  // in which nothing touches through a face
  const std::string changing = write("changing.dump", frame + wider + frame);
  for (const std::string& input : std::vector<std::string>{
           changing + " --radius 0.5", "yarn:n=3000,seed=5 --box 30,0,25",
           "hair:n=900 --window 3 --box 20,20,20,3,-2,1", "yarn:n=500 --arc-window pi/2 --box 300,300,300"}) {
    for (const char* order : {"chain", "space"}) {
      const bool all = order == std::string("chain");
      const char* const frames = !input.starts_with(changing) ? "" : all ? " --frame all" : " --frame 2";
      const auto tables = [&](const char* of) {
        return fmt::format("{0} --pairs '{1}.csv' --counts '{1}.counts.csv'{2} --margin", frames, file(of),
                           all ? " --depth" : "");
      };
      const ProgramOutcome alone = run("detect " + input + tables("alone"));
      ASSERT_EQ(alone.code, 0) << alone.output;
      const ProgramOutcome ranks = run_ranks("detect " + input + tables("ranks") + " --order " + order);
      ASSERT_EQ(ranks.code, 0) << ranks.output;
      for (const std::string end : {".csv", ".counts.csv"}) {
        EXPECT_GT(std::ranges::count(text_of(file("alone" + end)), '\n'), 1) << input;
        EXPECT_EQ(text_of(file("alone" + end)), text_of(file("ranks" + end))) << input << " " << order;
      }
    }
  }
  const ProgramOutcome verified = run_ranks("verify yarn:n=2000 --box 30,30,30");
  EXPECT_EQ(verified.code, 0) << verified.output;
  const ProgramOutcome limit = run_ranks("detect yarn:n=3000,seed=5 --box 30,0,25 --pair-limit 5");
  expect_one_line(limit, "more than the limit of 5");
  const ProgramOutcome timed = run_ranks("bench yarn:n=2000 --box 30,30,30 --repetitions 1");
  ASSERT_EQ(timed.code, 0) << timed.output;
  const auto line = nlohmann::json::parse(timed.output);
  EXPECT_EQ(line["box"], "30,30,30");
  EXPECT_EQ(line["n"], 2000);
  EXPECT_EQ(line["repetitions"], 1);
  const std::string pairs = fmt::format(" {} pairs", line["pairs"].get<std::uint64_t>());
  EXPECT_NE(verified.output.find(pairs), std::string::npos) << timed.output;
  expect_work_of_ranks(line);
}

TEST_F(Mpirun, SaysWhatAllFoundOnce) {
  const ProgramOutcome r = run_ranks("detect coincident:n=60 --json --order chain", 4);
  ASSERT_EQ(r.code, 0) << r.output;
  const auto line = nlohmann::json::parse(r.output);
  EXPECT_EQ(line["pairs"], 812);
  EXPECT_EQ(line["n"], 60);
  EXPECT_EQ(line["ranks"], 4);
  EXPECT_EQ(line["max_count"], 28);
  EXPECT_EQ(line["order"], "chain");
  EXPECT_EQ(line["most_spheres"], 60 / 4);
  EXPECT_LT(line["most_blocks_asked"], line["most_bytes_sent"]);
  expect_phases_in_chain_order(line["phases_ms"]);
  // Pairs that nobody reads are none of the work, nor is a limit on them.
  const ProgramOutcome counts =
      run_ranks("detect coincident:n=60 --json --order chain --counts-only --pair-limit 5", 4);
  ASSERT_EQ(counts.code, 0) << counts.output;
  for (const char* same : {"pairs", "max_count", "most_blocks_asked", "most_bytes_sent"})
    EXPECT_EQ(nlohmann::json::parse(counts.output)[same], line[same]) << same;
  std::uint64_t asked = 0, bytes = 0;
  for (const RankDid& rank : in_threads("coincident:n=60", 4)) {
    asked = std::max(asked, rank.work.across.blocks_asked);
    bytes = std::max(bytes, rank.sent.bytes);
  }
  EXPECT_EQ(line["most_blocks_asked"], asked);
  EXPECT_EQ(line["most_bytes_sent"], bytes);
  const ProgramOutcome frames = run_ranks("detect path1:n=100 --frame all --json");
  EXPECT_EQ(frames.code, 0);
  std::vector<std::uint64_t> sent;
  std::istringstream lines(frames.output);
  for (std::string own; std::getline(lines, own);) {
    const auto frame = nlohmann::json::parse(own);
    EXPECT_EQ(frame["frame"], sent.size());
    sent.push_back(frame["most_bytes_sent"]);
  }
  ASSERT_GT(sent.size(), 10u);
  EXPECT_GT(sent.front(), 0u);
  EXPECT_LT(sent.back(), 2 * sent.front()) << "of a frame, not of all so far";
  const auto says = [&](const std::string& what, const std::string& words) {
    const std::string told = run_ranks("detect " + what).output;
    EXPECT_NE(told.find(words), std::string::npos) << told;
  };
  says("rope:n=60,frames=3,duration=2,frame=1 --any --order chain",
       "frame 1: 60 spheres, does not collide; 3 ranks in chain order");
  says("coincident:n=60 --pair-limit 812", "60 spheres, 812 pairs, at most 28 a sphere; 3 ranks ");
  says("coincident:n=60 --any --order space", "60 spheres, collides; 3 ranks by space");
}

/// Of a chain that each rank makes its part of: what one process tells, and of a wrong answer that it is.
TEST_F(Mpirun, EndsWith1WhereAFormulaKnowsBetter) {
  const bench::LatticeBox box{.side = 5, .reach = 2};
  const ProgramOutcome told =
      run_ranks("closed-form --side 5 --reach 2 --variant mutant:less-for-less-equal --order chain --json");
  EXPECT_EQ(told.code, 1) << told.output;
  const auto line = nlohmann::json::parse(told.output);
  EXPECT_EQ(line["n"], box.spheres());
  EXPECT_EQ(line["closed_form"], box.pairs());
  EXPECT_EQ(line["ties"], box.ties());
  EXPECT_LT(line["pairs"], box.pairs());
  EXPECT_EQ(line["fault"],
            fmt::format("{} pairs instead of {}", line["pairs"].get<std::uint64_t>(), box.pairs()));
  EXPECT_EQ(line["order"], "chain");
  expect_phases_in_chain_order(line["phases_peak_kib"]);
  const ProgramOutcome in_words =
      run_ranks("closed-form --side 5 --reach 2 --variant mutant:less-for-less-equal --order space");
  EXPECT_EQ(in_words.code, 1);
  for (const std::string& words :
       {fmt::format("closed form {} pairs, {} of them exact ties\n", box.pairs(), box.ties()),
        std::string("3 ranks, shared out by space: "), std::string(" pairs, WRONG: ")})
    EXPECT_NE(in_words.output.find(words), std::string::npos) << words << in_words.output;

  // So does the exact reference, of the first input, where each touches the next but one: of these pairs only
  // those that cross a border of ranks, two at each, are not found by the variant. The last input is right.
  const ProgramOutcome verified =
      run_ranks("verify collinear:n=60 rod:n=60 --variant mutant:less-for-less-equal --json");
  EXPECT_EQ(verified.code, 1) << verified.output;
  std::istringstream lines(verified.output);
  for (const bool wrong : {true, false})
    for (const char* order : {"chain", "space"}) {
      std::string own;
      std::getline(lines, own);
      const int crossing = wrong ? 2 * 2 : 0;
      EXPECT_EQ(nlohmann::json::parse(own), nlohmann::json({{"input", wrong ? "collinear:n=60" : "rod:n=60"},
                                                            {"n", 60},
                                                            {"ranks", 3},
                                                            {"order", order},
                                                            {"pairs", crossing},
                                                            {"verdict", wrong ? "wrong" : "exact"},
                                                            {"missing", wrong ? 60 - 2 - crossing : 0},
                                                            {"invented", 0},
                                                            {"repeated", 0},
                                                            {"wrong_counts", wrong ? 60 : 0}}));
    }
}

/// Not a thread a core on each.
TEST_F(Mpirun, SharesTheCoresOfAMachine) {
  const ProgramOutcome alone =
      run_ranks("bench rod:n=60 --repetitions 1", 1, "OMPI_MCA_hwloc_base_binding_policy=none");
  ASSERT_EQ(alone.code, 0) << alone.output;
  const std::size_t all = nlohmann::json::parse(alone.output)["of_ranks"][0]["cores"];
  for (const unsigned size : {2u, 3u}) {
    const ProgramOutcome r = run_ranks("bench coincident:n=61 --repetitions 3 --order chain", size,
                                       "OMPI_MCA_hwloc_base_binding_policy=none");
    ASSERT_EQ(r.code, 0) << r.output;
    const auto line = nlohmann::json::parse(r.output);
    expect_phases_in_chain_order(line["phases_ms"]);
    expect_phases_in_chain_order(line["phases_peak_kib"]);
    EXPECT_EQ(line["order"], "chain");
    ASSERT_EQ(line["of_ranks"].size(), size);
    const std::vector<RankDid> did = in_threads("coincident:n=61", size);
    for (std::size_t k = 0; k < size; ++k) {  // of one repetition
      nlohmann::json rank = line["of_ranks"][k];
      EXPECT_GT(rank["peak_kib"], 0);
      rank.erase("peak_kib");
      const ranks::AcrossWork& across = did[k].work.across;
      EXPECT_EQ(rank, nlohmann::json({{"cores", std::max<std::size_t>(1, all / size)},
                                      {"spheres", did[k].work.spheres},
                                      {"blocks_asked", across.blocks_asked},
                                      {"blocks_touching", across.blocks_touching},
                                      {"rounds", across.rounds},
                                      {"bytes", did[k].sent.bytes},
                                      {"messages", did[k].sent.messages}}));
    }
  }
}

/// A rank that made all of a scene would hold 60 MiB more.
TEST_F(Mpirun, MakesNoMoreOfASceneThanItsPart) {
  for (const char* scene : {"rod:n=5000000", "path2:n=5000000,frame=3 --window 2"}) {
    const ProgramOutcome r = run_ranks(fmt::format("bench {} --repetitions 1", scene), 4);
    ASSERT_EQ(r.code, 0) << r.output;
    const auto ranks = nlohmann::json::parse(r.output)["of_ranks"];
    std::uint64_t least = ranks[0]["peak_kib"], most = 0;
    for (const auto& rank : ranks) {
      least = std::min<std::uint64_t>(least, rank["peak_kib"]);
      most = std::max<std::uint64_t>(most, rank["peak_kib"]);
    }
    EXPECT_GT(least, 0u);
    EXPECT_LT(most - least, 40u << 10) << scene;
  }
}

TEST_F(Mpirun, EndsWithOneLineWhenTheInputIsWrong) {
  expect_one_line(run_ranks("detect /nowhere.chain"), "there is no such file");
  expect_one_line(run_ranks("detect coincident:n=60 --pair-limit 5"), "found 812 colliding pairs");
  expect_one_line(run_ranks("detect coincident:n=60 --pairs /nowhere/p.csv"), "cannot write /nowhere/p.csv");
  if (const auto full = properties::DeviceFile::full(file("full")))
    expect_one_line(run_ranks("detect coincident:n=60 --pairs '" + *full + "'"), "cannot write " + *full);
  // Where one rank alone refuses, and the other waits for it already.
  expect_one_line(
      run_ranks("detect rod:n=60 : -n 1 '" CATENA_PROGRAM "' detect rod:n=60 --variant Fastest", 1, "", 30),
      "catena: rank 1 of 2: there is no strategy 'Fastest'");
  expect_one_line(run_ranks("detect coincident:n=60 --variant CPU1/literal"), "ranks decide exactly");
  expect_one_line(run_ranks("detect path1:n=60,frame=3 --box 0.1,9,9"),
                  "path1:n=60,frame=3 frame 3: the box is 0.1 wide along x, less than twice the reach");
  const std::string table = "x,y,z,r\n0,0,0,1\n9,0,0,1\n1,0,0,1\n", in = write("in.csv", table);
  expect_one_line(run_ranks("detect " + in + " --pairs " + in), "is read, and would be lost");
  expect_one_line(run_ranks("detect yarn:n=50 --topology " + in + " --counts " + in),
                  "is read, and would be lost");
  EXPECT_EQ(text_of(file("in.csv")), table);
  expect_one_line(run_ranks("detect coincident:n=60 --depth"), "--depth and --margin are columns of --pairs");
  expect_one_line(run_ranks("list"), "ranks do not share the command 'list'");
  for (const char* const option : {"--tolerance 0.1", "--plan", "--no-omit exact"})
    expect_one_line(run_ranks("detect coincident:n=60 " + std::string(option)), "; leave out mpirun");
  expect_one_line(run_ranks("bench coincident:n=60 --plan"),
                  "there is no option --plan here; see mpirun -n 2 catena bench --help");
  // On a disk of few pages.
  const std::string disk = file("disk");
  std::filesystem::create_directories(disk);
  if (mount("none", disk.c_str(), "tmpfs", 0, "size=16k") == 0) {
    const ProgramOutcome full = run_ranks("detect coincident:n=200 --pairs '" + disk + "/p.csv'");
    EXPECT_EQ(full.code, 2);
    EXPECT_NE(full.output.find(": cannot write " + disk + "/p.csv: No space left on device\n"),
              std::string::npos)
        << full.output;
    EXPECT_TRUE(std::filesystem::is_empty(disk));
    EXPECT_EQ(umount(disk.c_str()), 0);
  }
}

/// Whatever goes wrong on one rank, wherever: all end within seconds, with its words, and leave no file.
TEST_F(Mpirun, EndsAllRanksWhenOneFails) {
  std::filesystem::create_directories(file("tables"));
  // At every phase an error of one rank and too little memory of another; the two change places in turn.
  unsigned errs = 0;
  for (const std::string phase :
       {"read", "take_part", "order", "repartition", "build", "within", "across", "answers", "write"}) {
    for (const std::string kind : {"error", "memory"}) {
      const unsigned rank = kind == "error" ? errs : 2 - errs;
      const auto began = std::chrono::steady_clock::now();
      const ProgramOutcome r =
          run_ranks("detect yarn:n=2000 --order space --pairs '" + file("tables/p.csv") + "'", 3,
                    fmt::format("CATENA_RANK_FAULT={}:{}:{}", phase, rank, kind));
      EXPECT_EQ(r.code, 2) << phase << ' ' << rank << ' ' << kind << ": " << r.output;
      const std::string words =
          fmt::format("catena: rank {} of 3: {}", rank, kind == "error" ? "a fault" : "out of memory");
      EXPECT_NE(r.output.find(words), std::string::npos) << phase << ": " << r.output;
      EXPECT_EQ(r.output.find("catena:"), r.output.rfind("catena:")) << r.output;
      EXPECT_TRUE(std::filesystem::is_empty(file("tables"))) << phase;
      EXPECT_LT(std::chrono::steady_clock::now() - began, std::chrono::seconds(60));
    }
    errs = 2 - errs;
  }
  // While rank 0 is deep in a search, and does not hear of it.
  const ProgramOutcome busy =
      run_ranks("detect rod:n=200 --pairs '" + file("tables/p.csv") + "'", 3,
                "CATENA_RANK_PATIENCE=100 CATENA_RANK_FAULT=build:0:busy,build:1:error,build:2:memory", 30);
  EXPECT_EQ(busy.code, 2) << busy.output;
  EXPECT_NE(busy.output.find("catena: rank 1 of 3: a fault"), std::string::npos) << busy.output;
  EXPECT_EQ(busy.output.find("catena:"), busy.output.rfind("catena:")) << busy.output;
  EXPECT_TRUE(std::filesystem::is_empty(file("tables")));
  const ProgramOutcome killed = run_ranks("detect yarn:n=2000", 3, "CATENA_RANK_FAULT=within:1:end");
  EXPECT_NE(killed.code, 0);
}

}  // namespace
}  // namespace catena

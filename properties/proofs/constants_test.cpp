#include <fmt/format.h>
#include <gtest/gtest.h>

#include <array>
#include <cctype>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <initializer_list>
#include <map>
#include <regex>
#include <sstream>
#include <string>

namespace catena {
namespace {

std::string text_of(const std::string& file) {
  std::ifstream in(std::string(CATENA_SOURCE_DIR "/") + file);
  std::ostringstream text;
  text << in.rdbuf();
  EXPECT_FALSE(text.str().empty()) << file;
  return text.str();
}

/// A constant as core/ declares it, and the same number as a proof has it in its formulas.
struct Proved {
  std::string declared, script, formula;
};

/// A script without its comments and blanks.
std::string statement_of(const std::string& script) {
  std::istringstream lines(text_of("properties/proofs/" + script));
  std::string statement;
  for (std::string line; std::getline(lines, line);)
    for (const char c : line.substr(0, line.find('#')))
      if (!std::isspace(static_cast<unsigned char>(c))) statement += c;
  return statement;
}

/// gappa proves whatever it is given: with roundings assumed half as large, a factor twice as slack or a
/// claim left out it still agrees. So what is proved is stated here a second time, as a hash (FNV-1a); who
/// changes a script reads its comment again, and stores the new one.
TEST(Proofs, ProveWhatTheyWereReadToProve) {
  const std::map<std::string, std::string> read{
      {"axis_box_binary32.g", "4ecdaaef2fd93e56"},
      {"block_capsule_binary32.g", "cba820f6cde23848"},
      {"box_around_binary32.g", "d1238664227dce82"},
      {"capsule_binary32.g", "f129f88737b29ec9"},
      {"capsule_rows.g", "91608bf45fce4200"},
      {"cell_rows.g", "4f247407c14b81cc"},
      {"dot_binary32.g", "58b32e0a1f9400d2"},
      {"excess_binary32.g", "bada2670aa5c189a"},
      {"grid_cells.g", "a2cafa1a7b93ec3d"},
      {"open_pairs.g", "831855ff8736944e"},
      {"oriented_box_binary32.g", "f4f66b6c4c73db15"},
      {"overlap_binary32.g", "115c10c506635d20"},
      {"overlap_binary64.g", "d45b391f94e8c5ed"},
      {"parent_binary32.g", "5717fde13972b4cd"},
      {"parent_binary64.g", "91aded3b4008b0c4"},
      {"rotation_binary64.g", "6acf2baf73d3fabd"},
      {"told_block_binary32.g", "cbddfbf61d7f926a"},
      {"told_block_binary64.g", "f56dbdba7729c5d0"},
      {"underflow_binary32.g", "c60547d64fdc4bf2"},
      {"within_binary32.g", "95bb706993e7ad31"},
  };
  std::map<std::string, std::string> found;
  for (const auto& file : std::filesystem::directory_iterator(CATENA_SOURCE_DIR "/properties/proofs"))
    if (file.path().extension() == ".g") {
      std::uint64_t hash = 0xcbf29ce484222325;
      for (const char c : statement_of(file.path().filename().string()))
        hash = (hash ^ static_cast<unsigned char>(c)) * 0x100000001b3;
      found[file.path().filename().string()] = fmt::format("{:016x}", hash);
    }
  EXPECT_EQ(found, read);
}

/// What a script assumes of the errors of sums, another proves: no less is assumed.
TEST(Proofs, AssumeNoLessThanOthersProve) {
  struct Link {
    std::string script, assumed, by, proved;
  };
  for (const auto& [script, assumed, by, proved] :
       {Link{"overlap_binary32.g", "|eq|<=", "overlap_binary32.g", "|q-/Q|<="},
        Link{"overlap_binary32.g", "|eq|<=", "overlap_binary32.g", "|q_fused-/Q|<="},
        Link{"overlap_binary32.g", "|et|<=", "overlap_binary32.g", "|t-/T|<="},
        Link{"excess_binary32.g", "|et|<=", "overlap_binary32.g", "|t-/T|<="},
        Link{"overlap_binary64.g", "|eq|<=", "overlap_binary64.g", "|q-/Q|<="},
        Link{"overlap_binary64.g", "|eq|<=", "overlap_binary64.g", "|q_fused-/Q|<="},
        Link{"overlap_binary64.g", "|et|<=", "overlap_binary64.g", "|t-/T|<="},
        Link{"within_binary32.g", "|eq|<=", "overlap_binary32.g", "|q-/Q|<="},
        Link{"within_binary32.g", "|eq|<=", "overlap_binary32.g", "|q_fused-/Q|<="},
        Link{"within_binary32.g", "|et|<=", "overlap_binary32.g", "|t-/T|<="},
        Link{"parent_binary32.g", "|eq|<=", "overlap_binary32.g", "|q-/Q|<="},
        Link{"parent_binary64.g", "|eq|<=", "overlap_binary64.g", "|q-/Q|<="},
        Link{"capsule_binary32.g", "|d1|<=", "dot_binary32.g", "|q-/Q|<="},
        Link{"capsule_binary32.g", "|d2|<=", "dot_binary32.g", "|q_fused-/Q|<="},
        Link{"block_capsule_binary32.g", "|d1|<=", "dot_binary32.g", "|q-/Q|<="}}) {
    const auto bound = [](const std::string& of, const std::string& name) {
      const std::string text = statement_of(of);
      const auto at = text.find(name);
      EXPECT_NE(at, std::string::npos) << of << " has no " << name;
      return at == std::string::npos ? 0.0 : std::stod(text.substr(at + name.size()));
    };
    EXPECT_GT(bound(by, proved), 0) << by;
    EXPECT_GE(bound(script, assumed), bound(by, proved))
        << script << ": " << assumed << ", " << by << ": " << proved;
  }
}

TEST(Proofs, AreAboutTheConstantsOfTheCode) {
  const std::string code = text_of("core/arithmetic/robust.h");
  for (const Proved& p :
       {Proved{"binary32_slack = 1 + 12 * 0x1p-24f;", "overlap_binary32.g", "(1 + 12b-24)"},
        Proved{"binary32_slack = 1 + 12 * 0x1p-24f;", "excess_binary32.g", "(1 + 12b-24)"},
        Proved{"underflow_floor = 0x1p-120f;", "overlap_binary32.g", "1b-120"},
        Proved{"binary64_slack = 1 + 10 * 0x1p-53;", "overlap_binary64.g", "(1 + 10b-53)"},
        Proved{"contained_slack = 1 + 6 * 0x1p-24f;", "parent_binary32.g", "(1 + 6b-24)"},
        Proved{"parent_slack = 1 + 32 * 0x1p-24f;", "parent_binary32.g", "(1 + 32b-24)"},
        Proved{"parent_binary64_slack = 1 + 0x1p-48;", "parent_binary64.g", "(1 + 1b-48)"}}) {
    EXPECT_NE(code.find(p.declared), std::string::npos) << "robust.h no longer says " << p.declared;
    EXPECT_NE(text_of("properties/proofs/" + p.script).find(p.formula), std::string::npos) << p.script;
  }
  for (const char* range : {"safe_square_min = 0x1p-90f", "safe_square_max = 0x1p120f",
                            "safe_radius_min = 0x1p-45f", "safe_radius_max = 0x1p60f"})
    EXPECT_NE(code.find(range), std::string::npos) << range;
  for (const char* script : {"overlap_binary32.g", "excess_binary32.g", "parent_binary32.g"})
    for (const char* range : {"safe_square_min = 2^-90", "safe_square_max = 2^120"})
      EXPECT_NE(text_of(std::string("properties/proofs/") + script).find(range), std::string::npos) << script;
}

/// Of each: as a file of the code declares it, as the proof says that it covers it, and as its formulas have
/// it.
void expect_covered(const std::string& file, const std::string& script,
                    std::initializer_list<std::array<const char*, 3>> constants) {
  const std::string code = text_of(file), proof = text_of("properties/proofs/" + script);
  for (const auto& [declared, covered, formula] : constants) {
    EXPECT_NE(code.find(declared), std::string::npos) << file << " no longer says " << declared;
    EXPECT_NE(proof.find(covered), std::string::npos) << covered;
    EXPECT_NE(proof.find(formula), std::string::npos) << formula;
  }
}

TEST(Proofs, AreAboutTheConstantsOfTheLanes) {
  expect_covered(
      "core/blocks/exact_lanes-inl.h", "overlap_binary64.g",
      {{"slack = hn::Set(D(), Robust::binary64_slack);", "binary64_slack = 1 + 10u", "(1 + 10b-53)"}});
}

TEST(Proofs, AreAboutTheConstantsOfTheGrid) {
  expect_covered("core/grid/bucket_map.h", "grid_cells.g",
                 {{"cell_slack = 0x1p-16;", "cell_slack = 2^-16", "(1 - 1b-16)"},
                  {"far_cell = 0x1p25;", "far_cell = 2^25", "|V| <= 33554433"}});
  for (const auto& [file, declared] :
       {std::array{"search_grid-inl.h", "(double{box.radius} + level.greatest) * (1 + 0x1p-40)"},
        {"around_lanes-inl.h", "hn::Mul(sum, hn::Set(wide, 1 + 0x1p-40))"}})
    expect_covered(std::string("core/grid/") + file, "grid_cells.g",
                   {{declared, "1 + 2^-40", "(1 + 1b-40)"}});
}

TEST(Proofs, AreAboutTheConstantsOfToldBlocks) {
  expect_covered("core/ranks/told_block.cpp", "told_block_binary64.g",
                 {{"slack = 0x1p-40", "2^-40 (|A|1 + |T|1)", "1b-40 * sides"}});
  expect_covered("core/ranks/told_lanes-inl.h", "told_block_binary32.g",
                 {{"slack = 0x1p-16f;", "2^-16 of slack", "1b-16 * sides"},
                  {"Lanes8::all(0x1p-50f)", "2^-50 on top", "-4000"}});
  expect_covered("core/blocks/lanes-inl.h", "told_block_binary32.g",
                 {{"least_product = 0x1p-110f;", "2^-110 on top", "-4000"}});
}

TEST(Proofs, AreAboutTheConstantsOfKeptLists) {
  expect_covered("core/frames/near_pairs.cpp", "open_pairs.g",
                 {{"reach_slack = 0x1p-20f;", "reach_slack = 2^-20", "1b-20"}});
  expect_covered("core/frames/within.h", "within_binary32.g",
                 {{"within_slack = 1 + 0x1p-20f", "within_slack = 1 + 16u", "(1 + 16b-24)"},
                  {"within_least = 0x1p-60f", "within_least = 2^-60", "1b-60"},
                  {"within_greatest = 0x1p60f", "within_greatest = 2^60", ""},
                  {"(q * within_slack <= m * m)", "q * within_slack", "r * (1 + et)"}});
}

TEST(Proofs, AreAboutTheConstantsOfBoxes) {
  for (const auto& [file, declared] :
       {std::array{"core/hierarchy/box.h", "low - std::fabs(low) * 0x1p-23f"},
        {"core/hierarchy/box.h", "high + std::fabs(high) * 0x1p-23f"},
        {"core/hierarchy/box_around.h", "low - magnitude(low) * 0x1p-23f"},
        {"core/hierarchy/box_around.h", "high + magnitude(high) * 0x1p-23f"},
        {"core/sphere_tree/build_sphere_tree-inl.h", "outward = Lanes16::all(0x1p-23f);"},
        {"core/frames/search_runs.cpp", "step = hn::Set(d, 0x1p-23f);"}})
    expect_covered(file, "box_around_binary32.g", {{declared, "Covers: 0x1p-23f", "p * 1b-23"}});
}

TEST(Proofs, AreAboutTheConstantsOfTheCells) {
  struct Covered {
    std::string file, declared, script, covered;  ///< as above, of core/cells/
  };
  for (const Covered& c :
       {Covered{"search_cells.h", "limit = reach * reach + 0x1p-20f;", "cell_rows.g",
                "limit = reach * reach + 2^-20"},
        Covered{"fit_block.h", "length * far * BlockTree::slack", "block_capsule_binary32.g", "slack = 32u"},
        Covered{"block_capsule.h", "mul_add(reach, BlockTree::slack, radius)", "block_capsule_binary32.g",
                "slack = 32u"},
        Covered{"block_capsule.h", "return dot(t, t) > reach * reach;", "block_capsule_binary32.g",
                "the bare radius's 16u"},
        Covered{"capsule_blocks.h", "2 * reach * (1 + 0x1p-16f)", "block_capsule_binary32.g", "1 + 2^-16"},
        Covered{"capsule_blocks.h", "(0.5f + 0x1p-12f)", "capsule_rows.g", "0.5f + 0x1p-12f"},
        Covered{"node_box.h", "centre_slack = 0x1p-20f;  // 16 u", "capsule_binary32.g",
                "centre_slack = 16u"},
        Covered{"node_box.h", "c.radius * (1 + BlockTree::axes_slack)", "capsule_binary32.g",
                "axes_slack = 128u"},
        Covered{"node_box.h", "mul_add(b.sides(), BlockTree::axes_slack,", "oriented_box_binary32.g",
                "axes_slack = 128u"},
        Covered{"node_box.h", "(std::fabs(dot(axis[i], axis[(i + 1) % 3])) < BlockTree::axes_error)",
                "oriented_box_binary32.g", "axes_error = 16u"}}) {
    EXPECT_NE(text_of("core/cells/" + c.file).find(c.declared), std::string::npos)
        << c.file << " no longer says " << c.declared;
    EXPECT_NE(text_of("properties/proofs/" + c.script).find(c.covered), std::string::npos)
        << c.script << " does not cover " << c.covered;
  }
}

TEST(Proofs, AreAboutTheConstantsOfTheOrderOfSpace) {
  expect_covered("core/space_tree/axis_boxes-inl.h", "axis_box_binary32.g",
                 {{"mul_add(abs(at) + spheres.radius[k], Lanes16::all(BlockTree::slack), spheres.radius[k])",
                   "slack = 32u", "reach_d = 32b-24"}});
  expect_covered("core/space_tree/space_tree.h", "axis_box_binary32.g",
                 {{"tiny = 0x1p-28f;", "tiny = 2^-28", "left = 1b-28"}});
  expect_covered("core/space_tree/space_evidence.cpp", "axis_box_binary32.g",
                 {{"slack = SpaceTree::tiny / 2;", "h = tiny / 2", "d(O + d(F + 1b-29))"}});
}

TEST(Proofs, AreAboutWhatOutweighsUnderflow) {
  const char* const script = "underflow_binary32.g";
  expect_covered("core/blocks/block_tree.h", script,
                 {{"tiny = 0x1p-120f;", "tiny = 2^-120", "linear = 1b-120"}});
  expect_covered("core/blocks/capsules-inl.h", script,
                 {{"least_square = 0x1p-80f", "least_square = 2^-80", "whole = 1b-80"}});
  expect_covered("core/blocks/lanes-inl.h", script,
                 {{"least_product = 0x1p-110f;", "least_product = 2^-110", "3b-24 * 1b-110"}});
  expect_covered("core/blocks/tests-inl.h", script,
                 {{"least = L::all(0x1p-98f)", "`least` is 2^-98", "idle = 1b-98"},
                  {"no_gap = L::all(0x1p-50f)", "no_gap = 2^-50", "1b-50 * 1b-50"}});
  expect_covered("core/cells/block_capsule.h", script,
                 {{"own_units ? BlockTree::tiny : 0x1p-28f", "`tiny` of a radius is 2^-28", "2 * (1b-28"},
                  {"least_square = 0x1p-60f;", "squares below 2^-60", "fitted = 1b-28"},
                  {"square > 0x1p-60f", "the computed |w|^2 is above 2^-60", "w_least = 1b-30"}});
  expect_covered("core/cells/fit_block.h", script,
                 {{"length * far * BlockTree::slack + 0x1p-60f", "2^-60: wrong by 6u", "climbed = 1b-60"}});
  EXPECT_NE(text_of("properties/proofs/capsule_binary32.g").find("(1 + 1b-45)"), std::string::npos)
      << "two gaps, each wrong by 2^-47";
}

TEST(Proofs, CoverEverySlackOfTheCode) {
  const std::string code = text_of("core/arithmetic/robust.h");
  const std::regex slack("constexpr (float|double) \\w*slack =");
  EXPECT_EQ(std::distance(std::sregex_iterator(code.begin(), code.end(), slack), std::sregex_iterator()), 5)
      << "a new slack needs a proof, and a line in the test above";
}

TEST(Proofs, AreAboutTheConstantsOfTheBlocks) {
  struct Covered {
    std::string file, declared, script, covered;  ///< as above, of core/blocks/
  };
  for (const Covered& c :
       {Covered{"block_tree.h", "slack = 0x1p-19f;  // 32 u", "capsule_binary32.g", "slack = 32u"},
        Covered{"block_tree.h", "axes_error = 0x1p-20f;  // 16 u", "oriented_box_binary32.g",
                "axes_error = 16u"},
        Covered{"block_tree.h", "axes_slack = 0x1p-17f;  // 128 u", "oriented_box_binary32.g",
                "axes_slack = 128u"},
        Covered{"block_evidence.cpp", "bare = 0x1p-20;  // 16 u", "capsule_binary32.g",
                "the bare radius's 16u"},
        Covered{"oriented_boxes-inl.h", "centre_slack = 0x1p-20f;  // 16 u", "capsule_binary32.g",
                "centre_slack = 16u"},
        // Stages of Robust, many spheres at a time, by its own constants.
        Covered{"tests-inl.h",
                "not_less(mul_add(s.t, Lanes8::all(Robust::binary32_slack), "
                "Lanes8::all(Robust::underflow_floor)),",
                "overlap_binary32.g", "binary32_slack = 1 + 12u"},
        Covered{
            "tests-inl.h",
            "mul_add(s.q, Lanes8::all(Robust::binary32_slack), Lanes8::all(Robust::underflow_floor)) < s.t;",
            "overlap_binary32.g", "underflow_floor = 2^-120"},
        Covered{"sphere_tiles-inl.h",
                "all_slack = hn::Set(tag, slack), floor = hn::Set(tag, Robust::underflow_floor);",
                "overlap_binary32.g", "underflow_floor = 2^-120"},
        Covered{"block_run-inl.h",
                "all_slack = Lanes16::all(slack), floor = Lanes16::all(Robust::underflow_floor);",
                "overlap_binary32.g", "underflow_floor = 2^-120"},
        Covered{"leaf_pairs-inl.h", "slack_ = Robust::binary32_slack * tree_.doubt;", "overlap_binary32.g",
                "binary32_slack = 1 + 12u"},
        Covered{"overlap_test-inl.h", "slack_(Robust::binary32_slack * doubt)", "overlap_binary32.g",
                "binary32_slack = 1 + 12u"},
        Covered{"overlap_test-inl.h", "floor = hn::Set(tag, Robust::underflow_floor);", "overlap_binary32.g",
                "underflow_floor = 2^-120"}}) {
    EXPECT_NE(text_of("core/blocks/" + c.file).find(c.declared), std::string::npos)
        << c.file << " no longer says " << c.declared;
    EXPECT_NE(text_of("properties/proofs/" + c.script).find(c.covered), std::string::npos)
        << c.script << " does not cover " << c.covered;
  }
}

TEST(Proofs, AreAboutTheConstantsOfRotations) {
  expect_covered("bench/pivot/rotated_chain.h", "rotation_binary64.g",
                 {{"return 0x1p-22 * extent;", "rounding = 2^-22 of", "written <= 1b-22"},
                  {"return 0x1p-33 * extent;", "drift = 2^-33 of", "moved <= 1b-33"}});
  EXPECT_NE(text_of("bench/pivot/pivot_heap.h").find("most_levels = 32;"), std::string::npos)
      << "31 levels below the root are proved";
}

}  // namespace
}  // namespace catena

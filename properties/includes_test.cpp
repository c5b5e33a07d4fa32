#include <fmt/format.h>
#include <fmt/ranges.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <map>
#include <set>
#include <sstream>
#include <string>
#include <string_view>
#include <vector>

namespace catena::properties {
namespace {

namespace fs = std::filesystem;

/// Which parts include which: a part is a folder below core/, or a single file there (a .cpp with its
/// header).
using Graph = std::map<std::string, std::set<std::string>>;

/// "chain/chain.cpp" is of "chain", "error.h" of "error".
std::string part_of(const std::string& path) {
  return path.find('/') != std::string::npos ? path.substr(0, path.find('/'))
                                             : fs::path(path).stem().string();
}

/// The part named by a line `#include "catena/core/..."`; empty for other lines.
std::string included_part(std::string_view line) {
  constexpr std::string_view start = "#include \"catena/core/";
  if (!line.starts_with(start)) return "";
  line.remove_prefix(start.size());
  return part_of(std::string(line.substr(0, line.find('"'))));
}

/// Tests may include what they like, and so may what only they include.
bool is_test(const fs::path& file) {
  return file.stem().string().ends_with("_test") || file.filename().string().starts_with("test_");
}

Graph includes_below(const fs::path& core) {
  Graph graph;
  for (const auto& entry : fs::recursive_directory_iterator(core)) {
    const auto extension = entry.path().extension();
    if ((extension != ".h" && extension != ".cpp") || is_test(entry.path())) continue;
    const std::string part = part_of(entry.path().lexically_relative(core).generic_string());
    auto& targets = graph[part];
    std::ifstream file(entry.path());
    for (std::string line; std::getline(file, line);)
      if (const std::string target = included_part(line); !target.empty() && target != part)
        targets.insert(target);
  }
  return graph;
}

/// A way from `part` back to itself, both ends named; empty when there is none.
std::vector<std::string> circle_from(const std::string& part, const Graph& graph,
                                     std::vector<std::string>& way, std::set<std::string>& finished) {
  if (const auto begin = std::ranges::find(way, part); begin != way.end()) {
    std::vector<std::string> circle(begin, way.end());
    circle.push_back(part);
    return circle;
  }
  if (finished.contains(part)) return {};
  way.push_back(part);
  if (const auto found = graph.find(part); found != graph.end())
    for (const std::string& target : found->second)
      if (auto circle = circle_from(target, graph, way, finished); !circle.empty()) return circle;
  way.pop_back();
  finished.insert(part);
  return {};
}

std::vector<std::string> circle_in(const Graph& graph) {
  std::vector<std::string> way;
  std::set<std::string> finished;
  for (const auto& [part, targets] : graph)
    if (auto circle = circle_from(part, graph, way, finished); !circle.empty()) return circle;
  return {};
}

/// All that a part includes, directly or not, itself too.
std::set<std::string> reach_of(const std::string& part, const Graph& graph) {
  std::set<std::string> reached;
  std::vector<std::string> open{part};
  while (!open.empty()) {
    const std::string next = open.back();
    open.pop_back();
    if (!reached.insert(next).second) continue;
    if (const auto found = graph.find(next); found != graph.end())
      open.insert(open.end(), found->second.begin(), found->second.end());
  }
  return reached;
}

TEST(Includes, FoldersOfCoreHaveNoCircle) {
  const Graph graph = includes_below(CATENA_SOURCE_DIR "/core");
  ASSERT_GE(graph.size(), 15u);
  EXPECT_TRUE(graph.at("arithmetic").contains("chain"));
  EXPECT_EQ(fmt::format("{}", fmt::join(circle_in(graph), " -> ")), "");
}

/// What a library's folder includes would have to be installed and linked with it.
TEST(Includes, TheLibraryNeedsNothingOfTheProgram) {
  const Graph graph = includes_below(CATENA_SOURCE_DIR "/core");
  std::istringstream folders(CATENA_LIBRARY_FOLDERS);
  for (std::string part; folders >> part;)
    for (const char* program : {"commands", "environment", "input", "main", "motion", "readers", "scenes"})
      EXPECT_FALSE(reach_of(part, graph).contains(program)) << part << " needs " << program;
}

TEST(Includes, ACircleIsFound) {
  EXPECT_EQ(circle_in({{"a", {"b", "d"}}, {"b", {"c"}}, {"c", {"b"}}}),
            (std::vector<std::string>{"b", "c", "b"}));
  EXPECT_EQ(circle_in({{"a", {"b", "c"}}, {"b", {"d"}}, {"c", {"d"}}, {"d", {"missing"}}}),
            std::vector<std::string>{});
  EXPECT_EQ(included_part("#include \"catena/core/chain/chain.h\""), "chain");
  EXPECT_EQ(included_part("#include \"catena/core/error.h\"  // why"), "error");
  EXPECT_EQ(included_part("#include \"catena/reference/compare.h\""), "");
}

}  // namespace
}  // namespace catena::properties

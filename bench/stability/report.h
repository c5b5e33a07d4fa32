#pragma once
#include <cstdint>
#include <map>
#include <nlohmann/json_fwd.hpp>
#include <set>
#include <string>
#include <vector>

#include "catena/bench/stability/cell.h"

namespace catena::bench {

/// Prints the stability matrix as it is measured. The table has a line for each scene and a column for each
/// arithmetic, in which the worst of its variants stands; `cells` has a line for each variant; `json` one
/// object a line for each cell.
class StabilityReport {
 public:
  enum class Form { table, cells, json };
  StabilityReport(Form form, const std::vector<std::string>& scenes,
                  const std::vector<std::string>& variants, std::vector<std::string> arithmetics);

  /// The cells of one scene, in the order of the variants.
  void scene(const std::vector<Cell>& cells);
  /// The summary, what was left out or refused and why, and each defect once more. Nothing for JSON.
  void finish() const;
  bool any_defect() const { return !defects_.empty(); }

 private:
  void table_line(const std::vector<Cell>& cells) const;
  void cell_line(const Cell& cell) const;

  Form form_;
  std::size_t scene_width_, variant_width_;
  std::vector<std::string> arithmetics_;
  std::map<std::string, std::map<Outcome, std::uint64_t>> outcomes_;  // by arithmetic
  struct LeftOut {
    std::set<std::string> variants, scenes;
  };
  std::map<std::string, LeftOut> left_out_;  // by reason
  std::vector<Cell> defects_;
};

/// What a cell holds, as one JSON object: a line of `catena stability --json`.
nlohmann::ordered_json to_json(const Cell& cell);

}  // namespace catena::bench

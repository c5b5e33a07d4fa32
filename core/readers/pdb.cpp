#include <fmt/format.h>

#include <cmath>
#include <optional>
#include <set>
#include <string>

#include "catena/core/readers/reader.h"
#include "catena/core/readers/text_lines.h"

/// Proteins of the PDB format, by columns: the trace of the C-alpha atoms of the first model, in Angstrom,
/// without radii. Of alternate locations, the blank one and A count.
namespace catena {
namespace {

/// Longer steps than this between C-alphas (3.8 when bonded) are residues that the experiment did not see.
constexpr double longest_step = 4.5;

/// Columns counted from 1, both included, as in the format's own tables; what a short line lacks is empty.
std::string_view columns(std::string_view line, std::size_t first, std::size_t last) {
  return first > line.size() ? std::string_view{} : line.substr(first - 1, last - first + 1);
}

double distance(const Sphere& a, const Sphere& b) {
  return std::hypot(double{a.x} - b.x, double{a.y} - b.y, double{a.z} - b.z);
}

class Protein {
 public:
  Protein(const std::filesystem::path& file, const ReadOptions& options) : lines_(file), curves_(options) {}

  CurveFile curves() {
    while (lines_.next() && !first_model_is_over()) {
      const std::string_view record = trimmed(columns(lines_.line(), 1, 6));
      if (record == "SEQRES") read_sequence();
      if (record == "MODRES") polymer_residues_.emplace(trimmed(columns(lines_.line(), 13, 15)));
      if (record == "TER") end_chain();
      if (record == "ATOM" || record == "HETATM") read_atom(record == "HETATM");
    }
    curves_.end_strand();
    if (curves_.spheres.empty())
      lines_.fail("the file ends without a C-alpha atom (' CA ' in columns 13 to 16)");
    return std::move(curves_);
  }

 private:
  bool first_model_is_over() {
    const std::string_view record = trimmed(columns(lines_.line(), 1, 6));
    if (record == "MODEL") return ++models_ > 1;
    return record == "ENDMDL" || (record == "END" && !curves_.spheres.empty());
  }

  void read_sequence() {
    for (std::size_t column = 20; column <= 68; column += 4)
      polymer_residues_.emplace(trimmed(columns(lines_.line(), column, column + 2)));
  }

  void end_chain() {
    curves_.end_strand();
    if (chain_) ended_.insert(*chain_);
    chain_.reset();
  }

  void read_atom(bool hetero) {
    const std::string_view line = lines_.line();
    if (columns(line, 13, 16) != " CA ") return;  // "CA  " is calcium
    const std::string_view alternate = columns(line, 17, 17);
    if (alternate != " " && alternate != "A") return;
    const std::string_view id = columns(line, 22, 22);
    const char chain = id.empty() ? ' ' : id[0];
    if (hetero && !is_residue(chain, trimmed(columns(line, 18, 20)))) return;
    ended_.erase(chain);
    if (line.size() < 54)
      lines_.fail(fmt::format("the C-alpha's coordinates end at column 54, the line at {}", line.size()));
    const double x = lines_.coordinate(trimmed(columns(line, 31, 38)), "x"),
                 y = lines_.coordinate(trimmed(columns(line, 39, 46)), "y"),
                 z = lines_.coordinate(trimmed(columns(line, 47, 54)), "z");
    const Sphere point = curves_.rounding.round(x, y, z, 0);
    const bool gap = chain_ && distance(curves_.spheres.back(), point) > longest_step;
    if (chain != chain_ || gap) curves_.end_strand();
    chain_ = chain;
    curves_.spheres.push_back(point);
  }

  // Modified residues (selenomethionine above all) are HETATM, but so are ligands, which follow the chain's
  // TER.
  bool is_residue(char chain, std::string_view name) const {
    return !ended_.contains(chain) && (name == "MSE" || polymer_residues_.contains(name));
  }

  TextLines lines_;
  int models_ = 0;
  std::optional<char> chain_;  ///< of the last C-alpha, unless TER came after it
  std::set<char> ended_;       ///< chains that a TER has ended
  std::set<std::string, std::less<>> polymer_residues_;
  CurveFile curves_;
};

const RegisterReader registered{
    {"PDB protein", {".pdb", ".ent"}, "C-alpha trace of the first model; no radii", "point number from 0"},
    read_by<Protein>};

}  // namespace
}  // namespace catena

#include <algorithm>
#include <iterator>
#include <ostream>
#include <string>
#include <vector>

#include "catena/core/chain/joints.h"
#include "catena/core/error.h"
#include "catena/core/output_file.h"
#include "catena/core/readers/chain_format.h"
#include "catena/core/readers/number_text.h"

namespace catena {
namespace {

template <class Number, class... More>
void append_line(std::string& line, Number first, More... more) {
  append_shortest(line, first);
  ((line += ' ', append_shortest(line, more)), ...);
  line += '\n';
}

void append_pairs(std::string& text, const char* word, std::span<const Pair> pairs) {
  if (pairs.empty()) return;
  text += word;
  append_line(text, pairs.size());
  for (const Pair& pair : pairs) append_line(text, pair.i, pair.j);
}

/// Hands the text to `write`, strand by strand.
template <class Write>
void write_text(const Chain& chain, std::span<const Pair> joints, const Write& write) {
  const Exclusion& exclusion = chain.exclusion();
  std::string text = "catena-chain 1\n";
  const bool by_index = exclusion.rule == Exclusion::Rule::index_window;
  text += by_index ? "window " : "arc_window ";
  by_index ? append_line(text, exclusion.window) : append_line(text, exclusion.factor);

  const Strands& strands = chain.strands();
  for (std::uint32_t s = 0; s < chain.strand_count(); ++s) {
    text += strands.closed[s] ? "strand closed " : "strand open ";
    append_line(text, strands.first[s + 1] - strands.first[s]);
    for (std::uint32_t i = strands.first[s]; i < strands.first[s + 1]; ++i)
      append_line(text, chain[i].x, chain[i].y, chain[i].z, chain[i].radius);
    write(text);
    text.clear();
  }
  std::vector<Pair> own;
  std::ranges::set_difference(exclusion.extra_pairs, pairs_across_joints(chain.spheres(), strands, joints, exclusion),
                              std::back_inserter(own));
  append_pairs(text, "pairs ", own);
  append_pairs(text, "joints ", joints);
  write(text += "end\n");
}

}  // namespace

void write_chain(std::ostream& out, const Chain& chain, std::span<const Pair> joints) {
  write_text(chain, joints, [&](const std::string& text) { out << text; });
  if (!out) throw InputError("a chain cannot be written: the output does not take it all");
}

void write_chain(const std::filesystem::path& name, const Chain& chain, std::span<const Pair> joints) {
  OutputFile file(name);
  write_text(chain, joints, [&](const std::string& text) { file.write(text); });
  file.close();
}

}  // namespace catena

#include "catena/core/commands/answer_files.h"

#include <algorithm>
#include <string>

namespace catena {

AnswerFiles::AnswerFiles(const AnswerTables& tables, const Labels& labels) : tables_(tables), labels_(labels) {
  if (!tables.pairs.empty()) pairs_.emplace(tables.pairs, tables.pair_columns());
  if (!tables.counts.empty()) counts_.emplace(tables.counts, AnswerTables::count_columns());
}

NamedSphere AnswerFiles::named(const Strands& strands, std::uint32_t i) const {
  const auto strand = static_cast<std::uint32_t>(std::ranges::upper_bound(strands.first, i) - strands.first.begin()) - 1;
  return {i, labels_.of(i), labels_.strand_names.empty() ? std::to_string(strand) : labels_.strand_names[strand],
          i - strands.first[strand]};
}

void AnswerFiles::write(std::uint32_t frame, const Chain& chain, Collisions& found, const PeriodicBox* box) {
  const Strands& strands = chain.strands();
  if (pairs_) {
    std::ranges::sort(found.pairs);
    for (const Pair& p : found.pairs) {
      put_pair_cells(pairs_->row(), tables_, frame, named(strands, p.i), named(strands, p.j), chain[p.i], chain[p.j],
                     box);
      pairs_->end_row();
    }
  }
  if (!counts_) return;
  for (std::uint32_t i = 0; i < found.count.size(); ++i) {
    put_count_cells(counts_->row(), frame, named(strands, i), found.count[i]);
    counts_->end_row();
  }
}

void AnswerFiles::close() {
  if (pairs_) pairs_->close();
  if (counts_) counts_->close();
}

}  // namespace catena

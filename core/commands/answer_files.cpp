#include "catena/core/commands/answer_files.h"

#include <algorithm>

#include "catena/core/overlap.h"

namespace catena {
namespace {

std::vector<std::string> pair_columns(const AnswerFiles::Names& names) {
  std::vector<std::string> columns{"frame",    "i",        "j",       "label_i", "label_j",
                                   "strand_i", "strand_j", "index_i", "index_j"};
  if (names.depth) columns.push_back("depth");
  if (names.margin) columns.push_back("margin");
  return columns;
}

std::uint32_t strand_of(const Strands& strands, std::uint32_t i) {
  return static_cast<std::uint32_t>(std::ranges::upper_bound(strands.first, i) - strands.first.begin()) - 1;
}

}  // namespace

AnswerFiles::AnswerFiles(const Names& names, const Labels& labels) : names_(names), labels_(labels) {
  if (!names.pairs.empty()) pairs_.emplace(names.pairs, pair_columns(names));
  if (!names.counts.empty())
    counts_.emplace(names.counts,
                    std::vector<std::string>{"frame", "sphere", "count", "label", "strand", "index"});
}

std::string AnswerFiles::strand_name(std::uint32_t strand) const {
  return labels_.strand_names.empty() ? std::to_string(strand) : labels_.strand_names[strand];
}

void AnswerFiles::write(std::uint32_t frame, const Chain& chain, Collisions& found) {
  const Strands& strands = chain.strands();
  if (pairs_) {
    std::ranges::sort(found.pairs);
    for (const Pair& p : found.pairs) {
      const std::uint32_t si = strand_of(strands, p.i), sj = strand_of(strands, p.j);
      pairs_->number(frame).number(p.i).number(p.j);
      pairs_->text(labels_.of(p.i)).text(labels_.of(p.j)).text(strand_name(si)).text(strand_name(sj));
      pairs_->number(p.i - strands.first[si]).number(p.j - strands.first[sj]);
      if (names_.depth) pairs_->real(overlap_of(chain[p.i], chain[p.j]).depth);
      if (names_.margin) pairs_->real(overlap_of(chain[p.i], chain[p.j]).margin);
      pairs_->end_row();
    }
  }
  if (!counts_) return;
  for (std::uint32_t i = 0; i < found.count.size(); ++i) {
    const std::uint32_t strand = strand_of(strands, i);
    counts_->number(frame).number(i).number(found.count[i]).text(labels_.of(i)).text(strand_name(strand));
    counts_->number(i - strands.first[strand]).end_row();
  }
}

void AnswerFiles::close() {
  if (pairs_) pairs_->close();
  if (counts_) counts_->close();
}

}  // namespace catena

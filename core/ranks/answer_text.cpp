#include "catena/core/ranks/answer_text.h"

namespace catena::ranks {

std::string pair_rows(Communicator& ranks, const AnswerTables& tables, std::uint32_t frame,
                      const Directory& directory, const RankAnswer& answer,
                      const PeriodicBox* box) {
  std::vector<SphereId> others;
  for (const IdPair& pair : answer.pairs) others.push_back(pair.j);
  const std::vector<Described> partners = directory.of(ranks, answer.starts, std::move(others));
  RowText row(tables.pairs, tables.pair_columns());
  for (std::size_t k = 0; k < answer.pairs.size(); ++k) {
    const Described i = directory.at(answer.pairs[k].i);
    put_pair_cells(row, tables, frame, i.named, partners[k].named, i.sphere, partners[k].sphere, box);
    row.end_row();
  }
  return row.take();
}

std::string count_rows(const AnswerTables& tables, std::uint32_t frame, const Directory& directory,
                       const RankAnswer& answer) {
  RowText row(tables.counts, AnswerTables::count_columns());
  for (std::size_t k = 0; k < answer.count.size(); ++k) {
    put_count_cells(row, frame, directory.at(answer.first + k).named, answer.count[k]);
    row.end_row();
  }
  return row.take();
}

}  // namespace catena::ranks

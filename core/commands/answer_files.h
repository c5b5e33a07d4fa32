#pragma once
#include <cstdint>
#include <optional>

#include "catena/core/chain/chain.h"
#include "catena/core/commands/answer_rows.h"
#include "catena/core/commands/row_file.h"
#include "catena/core/readers/labels.h"
#include "catena/core/strategy/request.h"

namespace catena {

/// The files of --pairs and --counts: see AnswerTables.
class AnswerFiles {
 public:
  /// The labels must outlive this object. Throws as RowFile does.
  AnswerFiles(const AnswerTables& tables, const Labels& labels);

  /// Sorts the pairs of `found`, which was found in the box, or in open space where it is null.
  void write(std::uint32_t frame, const Chain& chain, Collisions& found, const PeriodicBox* box = nullptr);
  void close();

 private:
  NamedSphere named(const Strands& strands, std::uint32_t i) const;

  AnswerTables tables_;
  const Labels& labels_;
  std::optional<RowFile> pairs_, counts_;
};

}  // namespace catena

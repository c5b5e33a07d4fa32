#pragma once
#include <string>

#include "catena/core/commands/answer_rows.h"
#include "catena/core/ranks/named_part.h"
#include "catena/core/ranks/rank_search.h"

namespace catena::ranks {

/// The rows of --pairs about pairs of which i is of this rank; those of all ranks, in their order, are the
/// table that one process writes. All ranks call it.
std::string pair_rows(Communicator& ranks, const AnswerTables& tables, std::uint32_t frame, const Directory& directory,
                      const RankAnswer& answer, const PeriodicBox* box);
/// The rows of --counts about the spheres of this rank.
std::string count_rows(const AnswerTables& tables, std::uint32_t frame, const Directory& directory,
                       const RankAnswer& answer);

}  // namespace catena::ranks

#include "catena/bench/enumerate/judge.h"

#include "catena/core/strategy/timings.h"

namespace catena::bench {
namespace {

std::string words(const std::optional<WalkTable>& table) {
  if (!table) return "walks without a collision";
  switch (*table) {
    case WalkTable::self_avoiding:
      return "self-avoiding walks";
    case WalkTable::contact_free:
      return "walks without contacts";
    case WalkTable::contacts:
      return "contacts of self-avoiding walks";
  }
  return "";
}

WalkVerdict verdict(const WalkQuestion& question, int steps, const std::optional<WalkTable>& counts,
                    std::uint64_t found, double ms) {
  WalkVerdict v{lattice_name(question), question.radius, steps, words(counts), found, {}, {}, ms};
  const PublishedTable* table = !counts          ? nullptr
                                : question.other ? &question.other->table
                                                 : published_table(question.dimensions, *counts);
  if (table && static_cast<std::size_t>(steps) < table->terms.size()) {
    v.sequence = table->sequence;
    v.published = table->terms[static_cast<std::size_t>(steps)];
  }
  return v;
}

}  // namespace

std::vector<WalkVerdict> judge_walks(Variant& variant, const WalkQuestion& question) {
  const Stopwatch watch;
  const auto counts = enumerate_walks(variant, question);
  const double ms = watch.ms();
  std::vector<WalkVerdict> verdicts;
  for (const WalkCount& c : counts)
    verdicts.push_back(verdict(question, c.steps, question.table(), c.walks, ms));
  if (question.contacts)
    for (const WalkCount& c : counts)
      verdicts.push_back(verdict(question, c.steps, WalkTable::contacts, c.contacts, ms));
  return verdicts;
}

nlohmann::ordered_json to_json(const WalkVerdict& verdict) {
  nlohmann::ordered_json line{{"lattice", verdict.lattice},
                              {"radius", verdict.radius},
                              {"steps", verdict.steps},
                              {"counts", verdict.counts},
                              {"found", verdict.found}};
  if (verdict.published) {
    line["sequence"] = verdict.sequence;
    line["published"] = *verdict.published;
    line["agrees"] = !verdict.differs();
  }
  return line;
}

std::string lattice_name(const WalkQuestion& question) {
  if (question.other) return question.other->name;
  return question.dimensions == 2 ? "square" : "cubic";
}

}  // namespace catena::bench

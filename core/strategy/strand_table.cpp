#include "catena/core/strategy/strand_table.h"

#include "catena/core/counted.h"
#include "catena/core/strategy/step_names.h"

namespace catena {
namespace {

constexpr std::uint8_t is_open = 0;

}  // namespace

ParameterInfo strands_parameter() {
  return {"strands", "known",
          "the strand of a sphere is known where there is one open one, or read from a table all the same"};
}

StrandTable::StrandTable(const Parameters& parameters)
    : kept_(parameters.choice("strands", {"known", "read"}) == "read") {}

/// Numbers on the strand (ExclusionView::id) need no table, and stay.
ChainView StrandTable::with_table(const ChainView& chain) {
  strand_of_.resize(chain.size, 0);
  first_ = {0, chain.size};
  loop_length_ = {0};
  ChainView view = chain;
  ExclusionView& rule = view.exclusion;
  rule.one_open_strand = rule.window_alone = false;
  rule.strand_of = strand_of_.data(), rule.strand_first = first_.data();
  rule.strand_closed = &is_open, rule.loop_length = loop_length_.data();
  return view;
}

Decision StrandTable::told() const {
  return {strand_table_step, one_open_ && !kept_,
          one_open_       ? std::string("one open strand") + (kept_ ? "; its table is read all the same" : "")
          : strands_ == 1 ? "one strand, which is closed"
                          : counted(strands_, "strand")};
}

}  // namespace catena

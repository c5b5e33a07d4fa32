#include "catena/properties/mutants/faulty_ranks.h"

#include <algorithm>
#include <limits>
#include <stdexcept>

#include "catena/core/ranks/bytes.h"
#include "catena/core/ranks/thread_ranks.h"
#include "catena/properties/mutants/asked_of_all.h"

namespace catena::properties {
namespace {

using ranks::Bytes;
using ranks::Communicator;
using ranks::Message;
using ranks::Phase;

/// Tells what another communicator tells, spoilt.
class Spoiler final : public Communicator {
 public:
  Spoiler(Communicator& ranks, const FaultyRanks& fault) : ranks_(ranks), fault_(fault) {}

  void enter(Phase phase) { phase_ = phase, gathers_ = exchanges_ = 0; }
  unsigned rank() const override { return ranks_.rank(); }
  unsigned size() const override { return ranks_.size(); }
  void vote() override { ranks_.vote(); }
  std::string fail(const std::string& what) override { return ranks_.fail(what); }

 private:
  ranks::Gathered gather(Bytes own) override {
    fault_.spoil_gathered(phase_, ++gathers_, own);
    return ranks_.all_gather(std::move(own));
  }
  std::vector<Message> deliver(std::vector<Message> out) override {
    const bool question = ++exchanges_ % 2 == 1;  // they and answers take turns
    for (Message& message : out)
      if (message.rank != rank() && phase_ == Phase::across && question) spoil_question(message.bytes);
    return ranks_.exchange(std::move(out));
  }
  void transfer(std::span<const ranks::Outgoing> out, const ranks::Destination& to) override {
    std::vector<std::span<std::byte>> arrived;
    ranks_.exchange_in_place(out, [&](unsigned rank, std::size_t bytes) {
      arrived.emplace_back(to(rank, bytes), bytes);
      return arrived.back().data();
    });
    for (const auto& bytes : arrived) fault_.spoil_arrived(phase_, bytes);
  }

  /// How many blocks are taken at most, and the blocks that are wanted.
  void spoil_question(Bytes& bytes) const {
    ranks::ByteReader in(bytes);
    const auto most = in.get<std::uint32_t>();
    auto wanted = in.get_list<std::uint32_t>();
    if (!wanted.empty()) fault_.spoil_question(wanted);
    bytes = ranks::ByteWriter().put(most).put_list(wanted).take();
  }

  Communicator& ranks_;
  const FaultyRanks& fault_;
  Phase phase_ = Phase::take_part;
  unsigned gathers_ = 0, exchanges_ = 0;
};

}  // namespace

void FaultyRanks::find(const Chain& chain, const Request& request, Collisions& result) {
  if (built_ != chain.size()) throw std::logic_error("find: not the chain of the last build");
  constexpr unsigned size = 2;
  std::vector<ranks::RankAnswer> answers(size);
  ranks::run_in_threads(size, [&](Communicator& inner) {
    Spoiler spoiler(inner, *this);
    const unsigned rank = inner.rank();
    ranks::RankOptions options{.variant = "Hybrid", .order = parts::Order::space};
    options.request.pair_limit = std::numeric_limits<std::uint64_t>::max();
    options.entering = [&](Phase phase) { spoiler.enter(phase); };
    ranks::RankWork work;
    answers[rank] = ranks::search(spoiler, ranks::even_part_of(chain, size, rank), options, work);
  });
  result = {};
  for (const ranks::RankAnswer& answer : answers) {
    for (const auto& [i, j] : answer.pairs)
      result.pairs.push_back({static_cast<std::uint32_t>(i), static_cast<std::uint32_t>(j)});
    for (const std::uint64_t count : answer.count) result.count.push_back(static_cast<std::uint32_t>(count));
  }
  leave_what_was_asked(request, result);
}

}  // namespace catena::properties

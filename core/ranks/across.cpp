#include "catena/core/ranks/across.h"

#include <algorithm>
#include <map>

#include "catena/core/ranks/block_comparison.h"
#include "catena/core/ranks/meet_border.h"

namespace catena::ranks {
namespace {

/// What a round brings of one that has so much left, of what all have: at least one.
std::uint32_t share_of(std::uint32_t at_once, std::uint64_t left, std::uint64_t of_all) {
  return of_all == 0 ? 1 : std::max(1u, static_cast<std::uint32_t>(at_once * left / of_all));
}

/// What a rank says to those that ask it.
class Source {
 public:
  Source(const HeldPart& part, const Border& border) : part_(part), border_(border) {}

  /// To each question, telling of no more blocks in all than `at_once`, but one to each.
  std::vector<Message> answer(std::vector<Message> questions, std::uint32_t at_once) {
    std::uint64_t left = 0;
    for (const Message& question : questions) left += left_for(question.rank);
    for (Message& message : questions)
      message.bytes = answer(message.rank, message.bytes, share_of(at_once, left_for(message.rank), left));
    return questions;
  }

 private:
  std::uint32_t left_for(unsigned asker) {
    return static_cast<std::uint32_t>(border_.told(asker).size() - next_[asker]);
  }

  /// The blocks that were asked for, then the next to be told of, at most `allowance`; before them how many
  /// are left then.
  Bytes answer(unsigned asker, const Bytes& question, std::uint32_t allowance) {
    ByteReader in(question);
    const std::uint32_t most = std::min(in.get<std::uint32_t>(), allowance);
    std::vector<Block> blocks;
    for (const auto block : in.get_list<std::uint32_t>()) blocks.push_back(border_.blocks()[block]);
    ByteWriter out;
    put_blocks(out, part_, blocks);
    const std::span<const std::uint32_t> told = border_.told(asker);
    std::size_t& next = next_[asker];
    const std::size_t now = std::min<std::size_t>(most, told.size() - next);
    std::vector<ToldBlock> more;
    more.reserve(now);
    tell_of_border(border_, told.subspan(next, now), more);
    next += now;
    out.put(left_for(asker)).put_list(more);
    return out.take();
  }

  const HeldPart& part_;
  const Border& border_;
  std::map<unsigned, std::size_t> next_;  // [asker]: the first of its blocks that it was not told of
};

/// What a rank asks of one other.
struct Question {
  unsigned rank;
  std::uint32_t compared;               ///< of the asker's own blocks: see Border::compared
  std::uint64_t left;                   ///< blocks to be told of; at first a guess, not 0
  std::vector<std::uint32_t> wanted{};  ///< blocks of it

  bool open() const { return left > 0 || !wanted.empty(); }
};

class Asker {
 public:
  Asker(Communicator& ranks, const Border& border, BlockComparison& comparison)
      : border_(border), comparison_(comparison) {
    for (unsigned other = 0; other < ranks.size(); ++other)
      if (other != ranks.rank() && border.near(other))
        questions_.push_back({other, border.compared(other), border.expected(other)});
    work_.partners = questions_.size();
    work_.border = border.blocks().size();
  }

  bool open() const { return !questions_.empty(); }

  std::vector<Message> questions(std::uint32_t blocks_at_once) const {
    std::vector<Message> messages;
    std::uint64_t left = 0;
    for (const Question& question : questions_) left += question.left;
    for (const Question& question : questions_) {
      const std::uint32_t share = share_of(blocks_at_once, question.left, left);
      messages.push_back({question.rank, ByteWriter().put(share).put_list(question.wanted).take()});
    }
    return messages;
  }

  /// What was asked for, of all that were asked, and what to ask for next.
  void take(const std::vector<Message>& answers) {
    std::vector<ByteReader> in;
    const auto question_of = [&](const Message& answer) -> Question& {
      return *std::ranges::lower_bound(questions_, answer.rank, {}, &Question::rank);
    };
    for (const Message& answer : answers) {
      in.emplace_back(answer.bytes);
      comparison_.take(in.back(), question_of(answer).compared);
    }
    work_.blocks_touching += comparison_.compare();
    for (std::size_t k = 0; k < answers.size(); ++k) {
      Question& question = question_of(answers[k]);
      work_.blocks_asked += question.wanted.size();
      question.wanted.clear();
      question.left = in[k].get<std::uint32_t>();
      const auto told = in[k].get_list<ToldBlock>();
      work_.blocks_told += told.size();
      may_touch_border(border_, told, question.compared, question.wanted);
    }
  }

  void forget_answered() {
    std::erase_if(questions_, [](const Question& question) { return !question.open(); });
  }

  AcrossWork& work() { return work_; }

 private:
  const Border& border_;
  BlockComparison& comparison_;
  std::vector<Question> questions_;
  AcrossWork work_;
};

struct State {
  std::uint32_t open, found;
};

}  // namespace

AcrossWork search_across(Communicator& ranks, const HeldPart& part, const AcrossOptions& options,
                         std::vector<Counted>& counted, KeptPairs& kept) {
  constexpr std::uint64_t fewest = 1u << 16, most = 1u << 26;  // far from what a chain holds
  const std::uint32_t at_once =
      options.blocks_at_once > 0
          ? options.blocks_at_once
          : static_cast<std::uint32_t>(std::clamp(blocks_of(part.pieces()) / 4, fewest, most));
  const Border border(ranks, part);
  BlockComparison comparison(part, border, options.meetings, counted, kept);
  Source source(part, border);
  Asker asker(ranks, border, comparison);
  for (;;) {
    const auto states = all_gather_value(ranks, State{asker.open(), kept.found() > 0});
    if (std::ranges::none_of(states, &State::open)) break;
    if (options.stop_at_first && std::ranges::any_of(states, &State::found)) break;
    ++asker.work().rounds;
    asker.take(ranks.exchange(source.answer(ranks.exchange(asker.questions(at_once)), at_once)));
    asker.forget_answered();
  }
  return asker.work();
}

}  // namespace catena::ranks

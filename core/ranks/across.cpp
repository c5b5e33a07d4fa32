#include "catena/core/ranks/across.h"

#include <algorithm>
#include <array>
#include <map>

#include "catena/core/arithmetic/robust.h"
#include "catena/core/ranks/block_message.h"

namespace catena::ranks {
namespace {

struct BlockBox {
  std::uint32_t block;
  Box box;
};

/// What a rank says to those that ask it.
class Source {
 public:
  Source(const HeldPart& part, const Tops& tops) : part_(part), tops_(tops) {}

  /// The blocks that were asked for, then boxes of the next that touch the asker's top, at most `allowance`.
  Bytes answer(unsigned asker, const Bytes& question, std::uint32_t allowance) {
    ByteReader in(question);
    const std::uint32_t most = std::min(in.get<std::uint32_t>(), allowance);
    ByteWriter out;
    for (const auto block : in.get_list<std::uint32_t>())
      put_block(out, part_, part_.blocks()[block], ExtraPairs::left_out);
    const auto& [boxes, last] = next_boxes(asker, most);
    out.put(std::uint32_t{last}).put_list(boxes);
    return out.take();
  }

 private:
  struct Asker {
    WideBoxTree top;
    std::uint32_t next = 0;  ///< block that was not looked at yet
  };

  std::pair<std::vector<BlockBox>, bool> next_boxes(unsigned asker, std::uint32_t most) {
    auto [found, first_time] = askers_.try_emplace(asker);
    Asker& state = found->second;
    if (first_time) state.top = tops_.tree(asker);
    const auto blocks = static_cast<std::uint32_t>(part_.blocks().size());
    std::vector<BlockBox> boxes;
    for (; state.next < blocks && boxes.size() < most; ++state.next) {
      const Box box = part_.boxes().box(state.next);
      bool meets = false;
      state.top.for_each_meeting(box, [&](std::uint32_t) { meets = true; });
      if (meets) boxes.push_back({state.next, box});
    }
    return {std::move(boxes), state.next == blocks};
  }

  const HeldPart& part_;
  const Tops& tops_;
  std::map<unsigned, Asker> askers_;
};

/// Compares blocks of others with those of the part.
class BlockComparison {
 public:
  BlockComparison(const HeldPart& part, std::vector<std::uint64_t>& count, std::vector<Counted>& far,
                  KeptPairs& kept)
      : part_(part), count_(count), far_(far), kept_(kept) {}

  /// True when a sphere of the block touches one of the part's, neighbours too.
  bool compare(const FarBlock& block) {
    std::array<std::uint64_t, Block::most> collisions{};
    bool touching = false;
    const Box around = box_around(std::span(block.spheres).first(block.size));
    part_.boxes().for_each_meeting(around, [&](std::uint32_t b) {
      const Block& own = part_.blocks()[b];
      for (std::uint32_t i = own.begin; i < own.begin + own.size; ++i) {
        const Sphere& sphere = part_.chain()[i];
        if (!Box::around(sphere).meets(around)) continue;
        for (std::uint32_t k = 0; k < block.size; ++k) {
          if (!Robust::overlap(sphere, block.spheres[k])) continue;
          touching = true;
          const Place here = part_.place(i), there = block.place(k);
          if (part_.neighbours(here, there)) continue;
          ++count_[i], ++collisions[k];
          kept_.add(here.id, there.id);
        }
      }
    });
    for (std::uint32_t k = 0; k < block.size; ++k)
      if (collisions[k] > 0) far_.push_back({block.first + k, collisions[k]});
    return touching;
  }

 private:
  const HeldPart& part_;
  std::vector<std::uint64_t>& count_;
  std::vector<Counted>& far_;
  KeptPairs& kept_;
};

/// What a rank asks of one other.
struct Question {
  unsigned rank;
  std::vector<std::uint32_t> wanted{};  ///< blocks of it
  bool all_boxes_seen = false;

  bool open() const { return !all_boxes_seen || !wanted.empty(); }
};

class Asker {
 public:
  Asker(Communicator& ranks, const HeldPart& part, const Tops& tops, BlockComparison comparison)
      : part_(part), comparison_(comparison) {
    for (unsigned other = 0; other < ranks.size(); ++other)
      if (other != ranks.rank() && asks(ranks.rank(), other) && tops.meet(ranks.rank(), other))
        questions_.push_back({other});
    work_.partners = questions_.size();
  }

  bool open() const { return !questions_.empty(); }

  std::vector<Message> questions(std::uint32_t blocks_at_once) const {
    std::vector<Message> messages;
    const auto share =
        std::max(1u, blocks_at_once / std::max(1u, static_cast<std::uint32_t>(questions_.size())));
    for (const Question& question : questions_)
      messages.push_back({question.rank, ByteWriter().put(share).put_list(question.wanted).take()});
    return messages;
  }

  void take(const Message& answer) {
    Question& question = *std::ranges::find(questions_, answer.rank, &Question::rank);
    ByteReader in(answer.bytes);
    for (std::size_t k = 0; k < question.wanted.size(); ++k)
      work_.blocks_touching += comparison_.compare(get_block(in, part_.rule()));
    work_.blocks_asked += question.wanted.size();
    question.wanted.clear();
    question.all_boxes_seen = in.get<std::uint32_t>() != 0;
    const auto boxes = in.get_list<BlockBox>();
    work_.boxes_seen += boxes.size();
    for (const auto& [block, box] : boxes) {
      bool meets = false;
      part_.boxes().for_each_meeting(box, [&](std::uint32_t) { meets = true; });
      if (meets) question.wanted.push_back(block);
    }
  }

  void forget_answered() {
    std::erase_if(questions_, [](const Question& question) { return !question.open(); });
  }

  AcrossWork& work() { return work_; }

 private:
  const HeldPart& part_;
  BlockComparison comparison_;
  std::vector<Question> questions_;
  AcrossWork work_;
};

struct State {
  std::uint32_t open, found;
};

}  // namespace

AcrossWork search_across(Communicator& ranks, const HeldPart& part, const Tops& tops,
                         const AcrossOptions& options, std::vector<std::uint64_t>& count,
                         std::vector<Counted>& far, KeptPairs& kept) {
  const auto own = static_cast<std::uint32_t>(part.blocks().size());
  const std::uint32_t at_once =
      options.blocks_at_once > 0 ? options.blocks_at_once : std::max(1u << 14, own / 4);
  Source source(part, tops);
  Asker asker(ranks, part, tops, BlockComparison(part, count, far, kept));
  for (;;) {
    const auto states = all_gather_value(ranks, State{asker.open(), kept.found() > 0});
    if (std::ranges::none_of(states, &State::open)) break;
    if (options.stop_at_first && std::ranges::any_of(states, &State::found)) break;
    ++asker.work().rounds;
    std::vector<Message> answers;
    for (Message& question : ranks.exchange(asker.questions(at_once))) answers.push_back(std::move(question));
    const auto allowance = std::max(1u, at_once / std::max(1u, static_cast<std::uint32_t>(answers.size())));
    for (Message& message : answers) message.bytes = source.answer(message.rank, message.bytes, allowance);
    for (const Message& answer : ranks.exchange(std::move(answers))) asker.take(answer);
    asker.forget_answered();
  }
  return asker.work();
}

}  // namespace catena::ranks

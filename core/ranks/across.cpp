#include "catena/core/ranks/across.h"

#include <algorithm>
#include <array>
#include <bit>
#include <map>

#include "catena/core/arithmetic/robust.h"
#include "catena/core/ranks/block_message.h"
#include "catena/core/ranks/border.h"

namespace catena::ranks {
namespace {

struct BlockBox {
  std::uint32_t block;
  Box box;
};

/// What a rank says to those that ask it.
class Source {
 public:
  Source(const HeldPart& part, const Border& border) : part_(part), border_(border) {}

  /// The blocks that were asked for, then boxes of the next that touch the asker's top, at most `allowance`.
  Bytes answer(unsigned asker, const Bytes& question, std::uint32_t allowance) {
    ByteReader in(question);
    const std::uint32_t most = std::min(in.get<std::uint32_t>(), allowance);
    std::vector<Block> blocks;
    for (const auto block : in.get_list<std::uint32_t>()) blocks.push_back(border_.blocks()[block]);
    ByteWriter out;
    put_blocks(out, part_, blocks);
    const std::span<const std::uint32_t> near = border_.near(asker);
    std::size_t& next = next_[asker];
    std::vector<BlockBox> boxes;
    for (; next < near.size() && boxes.size() < most; ++next)
      boxes.push_back({near[next], border_.boxes().box(near[next])});
    out.put(std::uint32_t{next == near.size()}).put_list(boxes);
    return out.take();
  }

 private:
  const HeldPart& part_;
  const Border& border_;
  std::map<unsigned, std::size_t> next_;  // [asker]: of the blocks near it, the first that it was not told of
};

/// Spheres of a block of another rank, by coordinates, for a test of one sphere against all at once.
class FarLanes {
 public:
  explicit FarLanes(const FarBlock& block) {
    for (std::uint32_t k = 0; k < Block::most; ++k) {
      const Sphere& s = block.spheres[std::min(k, block.size - 1)];
      x_[k] = s.x, y_[k] = s.y, z_[k] = s.z, radius_[k] = s.radius;
    }
    all_ = (1u << block.size) - 1;
  }
  /// Bits of those that are not separate for certain.
  std::uint32_t near(const Sphere& s) const {
    std::array<std::uint32_t, Block::most> apart;
    for (std::uint32_t k = 0; k < Block::most; ++k)
      apart[k] = Robust::separate(s, Sphere{x_[k], y_[k], z_[k], radius_[k]});
    std::uint32_t bits = 0;
    for (std::uint32_t k = 0; k < Block::most; ++k) bits |= (apart[k] ^ 1u) << k;
    return bits & all_;
  }

 private:
  std::array<float, Block::most> x_, y_, z_, radius_;
  std::uint32_t all_;
};

/// Compares blocks of others with those of the border.
class BlockComparison {
 public:
  BlockComparison(const HeldPart& part, const Border& border, std::vector<Counted>& counted, KeptPairs& kept)
      : part_(part), border_(border), counted_(counted), kept_(kept), own_(border.blocks().size()) {}

  /// True when a sphere of the block touches one of the part's, neighbours too.
  bool compare(const FarBlock& block) {
    Collisions collisions{};
    bool touching = false;
    const FarLanes lanes(block);
    const Box around = box_around(std::span(block.spheres).first(block.size));
    border_.boxes().for_each_meeting(around, [&](std::uint32_t b) {
      const Block& own = border_.blocks()[b];
      for (std::uint32_t o = 0; o < own.size; ++o) {
        const Sphere& sphere = part_.chain()[own.begin + o];
        for (std::uint32_t near = lanes.near(sphere); near != 0; near &= near - 1) {
          const auto k = static_cast<std::uint32_t>(std::countr_zero(near));
          if (!Robust::overlap(sphere, block.spheres[k])) continue;
          touching = true;
          const Place here = part_.place(own.begin + o), there = block.place(k);
          if (part_.neighbours(here, there)) continue;
          ++own_[b][o], ++collisions[k];
          kept_.add(here.id, there.id);
        }
      }
    });
    count(block.first, collisions);
    return touching;
  }

  /// What was found of the part's own spheres.
  void count_own() {
    for (std::size_t b = 0; b < own_.size(); ++b) count(part_.id(border_.blocks()[b]), own_[b]);
    own_.clear();
  }

 private:
  using Collisions = std::array<std::uint64_t, Block::most>;  // of the spheres of a block

  void count(SphereId first, const Collisions& collisions) {
    for (std::uint32_t k = 0; k < Block::most; ++k)
      if (collisions[k] > 0) counted_.push_back({first + k, collisions[k]});
  }

  const HeldPart& part_;
  const Border& border_;
  std::vector<Counted>& counted_;
  KeptPairs& kept_;
  std::vector<Collisions> own_;  // [block of the border]
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
  Asker(Communicator& ranks, const HeldPart& part, const Border& border, BlockComparison& comparison)
      : part_(part), border_(border), comparison_(comparison) {
    for (unsigned other = 0; other < ranks.size(); ++other)
      if (other != ranks.rank() && asks(ranks.rank(), other) && !border.near(other).empty())
        questions_.push_back({other});
    work_.partners = questions_.size();
    work_.border = border.blocks().size();
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
    FarBlocks blocks(in, part_.rule());
    for (std::size_t k = 0; k < blocks.size(); ++k)
      work_.blocks_touching += comparison_.compare(blocks.next());
    work_.blocks_asked += question.wanted.size();
    question.wanted.clear();
    question.all_boxes_seen = in.get<std::uint32_t>() != 0;
    const auto boxes = in.get_list<BlockBox>();
    work_.boxes_seen += boxes.size();
    for (const auto& [block, box] : boxes) {
      bool meets = false;
      border_.boxes().for_each_meeting(box, [&](std::uint32_t) { meets = true; });
      if (meets) question.wanted.push_back(block);
    }
  }

  void forget_answered() {
    std::erase_if(questions_, [](const Question& question) { return !question.open(); });
  }

  AcrossWork& work() { return work_; }

 private:
  const HeldPart& part_;
  const Border& border_;
  BlockComparison& comparison_;
  std::vector<Question> questions_;
  AcrossWork work_;
};

struct State {
  std::uint32_t open, found;
};

}  // namespace

AcrossWork search_across(Communicator& ranks, const HeldPart& part, const Tops& tops,
                         const AcrossOptions& options, std::vector<Counted>& counted, KeptPairs& kept) {
  const auto own = static_cast<std::uint32_t>(blocks_of(part.pieces()));
  const std::uint32_t at_once =
      options.blocks_at_once > 0 ? options.blocks_at_once : std::max(1u << 14, own / 4);
  const Border border(part, tops, ranks.size(), ranks.rank());
  BlockComparison comparison(part, border, counted, kept);
  Source source(part, border);
  Asker asker(ranks, part, border, comparison);
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
  comparison.count_own();
  return asker.work();
}

}  // namespace catena::ranks

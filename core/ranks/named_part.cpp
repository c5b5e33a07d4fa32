#include "catena/core/ranks/named_part.h"

#include <algorithm>

#include "catena/core/ranks/bytes.h"

namespace catena::ranks {
namespace {

void put_text(ByteWriter& out, const std::string& text) {
  out.put(std::uint64_t{text.size()}).put_all(std::span(text.data(), text.size()));
}
std::string get_text(ByteReader& in) {
  const std::vector<char> text = in.get_list<char>();
  return {text.begin(), text.end()};
}
void put_texts(ByteWriter& out, const std::vector<std::string>& texts) {
  out.put(std::uint64_t{texts.size()});
  for (const std::string& text : texts) put_text(out, text);
}
std::vector<std::string> get_texts(ByteReader& in) {
  std::vector<std::string> texts;
  for (auto left = in.get<std::uint64_t>(); left > 0; --left) texts.push_back(get_text(in));
  return texts;
}

/// All but the spheres.
Bytes packed(const NamedPart& named) {
  ByteWriter out;
  out.put(named.part.rule).put_list(named.part.pieces);
  out.put_list(named.part.arcs).put_list(named.part.extra);
  put_texts(out, named.names.labels);
  put_texts(out, named.names.strands);
  return out.take();
}

NamedPart unpacked(const Bytes& bytes) {
  ByteReader in(bytes);
  NamedPart named;
  named.part.rule = in.get<Rule>();
  named.part.pieces = in.get_list<Piece>();
  named.part.arcs = in.get_list<double>();
  named.part.extra = in.get_list<IdPair>();
  named.names.labels = get_texts(in);
  named.names.strands = get_texts(in);
  return named;
}

Bytes packed(const Described& sphere) {
  ByteWriter out;
  out.put(sphere.sphere).put(sphere.named.number).put(sphere.named.index);
  put_text(out, sphere.named.label);
  put_text(out, sphere.named.strand);
  return out.take();
}

Described described(ByteReader& in) {
  Described sphere;
  sphere.sphere = in.get<Sphere>();
  sphere.named.number = in.get<SphereId>();
  sphere.named.index = in.get<std::uint64_t>();
  sphere.named.label = get_text(in);
  sphere.named.strand = get_text(in);
  return sphere;
}

}  // namespace

NamedPart named_part_of(const Chain& chain, const Labels& labels, std::uint32_t first, std::uint32_t end) {
  NamedPart named{part_of(chain, first, end), {}};
  if (labels.size() > 0)
    for (std::uint32_t i = first; i < end; ++i) named.names.labels.push_back(labels.of(i));
  if (!labels.strand_names.empty())
    for (const Piece& piece : named.part.pieces)
      named.names.strands.push_back(labels.strand_names[piece.strand.number]);
  return named;
}

NamedPart scatter(Communicator& ranks, const std::function<NamedPart(unsigned rank)>& cut) {
  constexpr std::uint64_t at_once = 1 << 20;  // spheres
  NamedPart own;
  for (unsigned rank = 1; rank < ranks.size(); ++rank) {
    NamedPart theirs;
    std::vector<Message> out;
    if (ranks.rank() == 0) {
      theirs = cut(rank);
      out.push_back({rank, packed(theirs)});
    }
    for (const Message& message : ranks.exchange(std::move(out))) own = unpacked(message.bytes);
    const std::uint64_t size = all_gather_value(ranks, std::uint64_t{theirs.part.spheres.size()}).front();
    if (ranks.rank() == rank) resize_large(own.part.spheres, size);
    for (std::uint64_t done = 0; done < size; done += at_once) {
      const std::uint64_t now = std::min(at_once, size - done);
      out.clear();
      if (ranks.rank() == 0)
        out.push_back(
            {rank,
             ByteWriter().put_all(std::span<const Sphere>(theirs.part.spheres).subspan(done, now)).take()});
      for (const Message& message : ranks.exchange(std::move(out)))
        ByteReader(message.bytes).get_all(std::span(own.part.spheres).subspan(done, now));
    }
  }
  if (ranks.rank() == 0) own = cut(0);
  return own;
}

Directory::Directory(const NamedPart& part, bool with_spheres)
    : spheres_(with_spheres ? part.part.spheres : std::vector<Sphere>()),
      pieces_(part.part.pieces),
      names_(part.names) {}

Described Directory::at(SphereId id) const {
  const auto piece = std::ranges::upper_bound(pieces_, id, {}, &Piece::first) - 1;
  const std::uint64_t k = piece->begin + (id - piece->first);
  const auto p = static_cast<std::size_t>(piece - pieces_.begin());
  return {{id, names_.labels.empty() ? std::to_string(id) : names_.labels[k],
           names_.strands.empty() ? std::to_string(piece->strand.number) : names_.strands[p],
           id - piece->strand.first},
          spheres_.empty() ? Sphere{} : spheres_[k]};
}

std::vector<Described> Directory::of(Communicator& ranks, const std::vector<SphereId>& starts,
                                     std::vector<SphereId> ids) const {
  std::vector<SphereId> asked = ids;
  std::ranges::sort(asked);
  asked.erase(std::unique(asked.begin(), asked.end()), asked.end());
  std::vector<Message> questions;
  for (unsigned rank = 0; rank < ranks.size(); ++rank) {
    const auto begin = std::ranges::lower_bound(asked, starts[rank]),
               end = std::ranges::lower_bound(asked, starts[rank + 1]);
    if (begin != end)
      questions.push_back({rank, ByteWriter().put_list(std::vector<SphereId>(begin, end)).take()});
  }
  std::vector<Message> answers = ranks.exchange(std::move(questions));
  for (Message& message : answers) {
    ByteWriter out;
    for (const SphereId id : ByteReader(message.bytes).get_list<SphereId>())
      out.put_all(std::span<const std::byte>(packed(at(id))));
    message.bytes = out.take();
  }
  std::vector<Described> found;  // by rising rank, and so by rising id
  for (const Message& message : ranks.exchange(std::move(answers)))
    for (ByteReader in(message.bytes); !in.empty();) found.push_back(described(in));
  std::vector<Described> in_order;
  for (const SphereId id : ids)
    in_order.push_back(found[static_cast<std::size_t>(std::ranges::lower_bound(asked, id) - asked.begin())]);
  return in_order;
}

}  // namespace catena::ranks

#include "catena/core/ranks/rank_input.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <cstring>
#include <functional>
#include <mutex>

#include "catena/core/commands/command_line.h"
#include "catena/core/commands/show_warnings.h"
#include "catena/core/error.h"
#include "catena/core/periodic/periodic.h"
#include "catena/core/ranks/thread_ranks.h"
#include "catena/core/readers/file_bytes.h"
#include "catena/core/readers/test_file.h"
#include "catena/core/writers/writer.h"

namespace catena::ranks {
namespace {

/// What an input is: its spheres, rule and box, or why it is refused.
struct Opened {
  std::string refusal;
  std::vector<Sphere> spheres;
  std::vector<std::uint64_t> closed;  ///< of each sphere's strand
  Exclusion::Rule rule{};
  std::uint32_t window = 0, frames = 0;
  double factor = 0;
  std::optional<PeriodicBox> box;
  bool operator==(const Opened&) const = default;
};

Opened by_one(const std::string& spec, const InputOptions& options) {
  Opened opened;
  try {
    const Input input = open_input(spec, options);
    const Chain chain = input.animation->frame(0);
    opened.spheres.assign(chain.spheres().begin(), chain.spheres().end());
    for (std::uint32_t s = 0; s < chain.strand_count(); ++s)
      opened.closed.resize(chain.strands().first[s + 1], chain.strands().closed[s]);
    const Exclusion& exclusion = chain.exclusion();
    opened.rule = exclusion.rule, opened.window = exclusion.window, opened.factor = exclusion.factor;
    if (!input.boxes.empty()) opened.box = input.boxes[0];
    opened.frames = input.animation->frames();
  } catch (const InputError& error) {
    opened.refusal = error.what();
  }
  return opened;
}

/// A file in memory.
BinaryChain in_memory(const std::string& name) {
  const auto bytes = std::make_shared<const std::string>(read_bytes(name));
  return {name, bytes->size(), [bytes](std::uint64_t at, std::span<std::byte> part) {
            std::memcpy(part.data(), bytes->data() + at, part.size());
          }};
}

Opened by_ranks(unsigned ranks, const std::string& spec, const InputOptions& options) {
  Opened all;
  std::vector<Part> parts(ranks);
  try {
    run_in_threads(ranks, [&](Communicator& c) {
      together(c, [&] {
        const RankInput input(c, spec, options, in_memory);
        const auto [first, last] = input.frames({});
        const auto box = input.box(first);
        parts[c.rank()] = input.part(first).part;
        if (c.rank() == 0) all.box = box, all.frames = last - first;
      });
    });
  } catch (const RankFailed& error) {
    const std::string words = error.what(),
                      before = ranks == 1 ? "" : "rank 0 of " + std::to_string(ranks) + ": ";
    EXPECT_TRUE(words.starts_with(before)) << words;
    all.refusal = words.substr(std::min(before.size(), words.size()));
    return all;
  }
  for (const Part& part : parts) {
    all.spheres.insert(all.spheres.end(), part.spheres.begin(), part.spheres.end());
    for (const Piece& piece : part.pieces) all.closed.resize(all.closed.size() + piece.size, piece.strand.closed);
  }
  all.rule = parts[0].rule.kind, all.window = parts[0].rule.window, all.factor = parts[0].rule.factor;
  return all;
}

/// Whatever is said of a file, ranks make of it what one process does: where they read its parts, too.
TEST(RankInput, HeedsEveryOptionAsOneProcessDoes) {
  const TestFile file("knot.catena", "");
  const Labels none;
  const Chain hair = open_input("hair:n=50,strands=5").animation->frame(0);
  WriterRegistry::instance().of(file.path()).write(
      file.path(), {0, 1, [&](std::uint32_t) { return ExportedFrame{hair}; }, none});
  const std::pair<const char*, std::function<void(InputOptions&)>> said[] = {
      {"nothing", [](InputOptions&) {}},
      {"--radius", [](InputOptions& o) { o.radius = 2; }},
      {"--radius half-spacing", [](InputOptions& o) { o.radius_half_spacing = true; }},
      {"--closed", [](InputOptions& o) { o.closed = true; }},
      {"--window", [](InputOptions& o) { o.window = 7; }},
      {"--arc-window", [](InputOptions& o) { o.arc_window = 1.25; }},
      {"--box X,Y,Z", [](InputOptions& o) { o.box_from = BoxFrom::options, o.box = {{90, 80, 0}}; }},
      {"--box file", [](InputOptions& o) { o.box_from = BoxFrom::file; }},
      {"--box none", [](InputOptions& o) { o.box_from = BoxFrom::none; }},
      {"--format", [](InputOptions& o) { o.reading.format = "catena"; }},
      {"--format of another", [](InputOptions& o) { o.reading.format = "swc"; }},
      {"--columns", [](InputOptions& o) { o.reading.columns = {"x", "y", "z"}; }},
      {"--atom", [](InputOptions& o) { o.reading.atom = "CB"; }},
      {"--array", [](InputOptions& o) { o.reading.array = "r"; }},
      {"--topology", [](InputOptions& o) { o.reading.topology = "a.top"; }},
      {"--recentre", [](InputOptions& o) { o.reading.recentre = true; }},
      {"--origin", [](InputOptions& o) { o.reading.recentre = true, o.reading.origin = {{3, 4, 5}}; }}};
  int refused = 0;
  for (const std::string& spec : {file.path().string(), std::string("hair:n=50,strands=5"), std::string("nowhere.catena")})
    for (const auto& [option, say] : said) {
      InputOptions options{.takes_box = true};
      say(options);
      const Opened one = by_one(spec, options);
      for (const unsigned ranks : {1u, 3u}) {
        const Opened several = by_ranks(ranks, spec, options);
        EXPECT_EQ(several.refusal, one.refusal) << spec << ' ' << option;
        EXPECT_TRUE(several == one) << spec << ' ' << option << ", ranks " << ranks;
      }
      refused += !one.refusal.empty() && spec == file.path().string();
    }
  EXPECT_GE(refused, 7) << "some options mean nothing for such a file";
}

/// What is said of --frame, and of which input, is what one process says.
TEST(RankInput, KnowsTheFramesThatOneProcessKnows) {
  const TestFile file("a.catena", "");
  const Labels none;
  const Chain hair = open_input("hair:n=50,strands=5").animation->frame(0);
  WriterRegistry::instance().of(file.path()).write(
      file.path(), {0, 1, [&](std::uint32_t) { return ExportedFrame{hair}; }, none});
  using Frames = std::pair<std::uint32_t, std::uint32_t>;
  int refused = 0;
  for (const std::string& spec : {file.path().string(), std::string("path1:n=50")})
    for (const char* said : {"0", "1", "3", "all", "x"}) {
      FrameOption option;
      parse_options({"--frame", said}, [&](OptionParser& parser) { option.add_to(parser); });
      const auto told = [&](const std::function<Frames()>& frames) {
        try {
          const auto [first, last] = frames();
          return std::to_string(first) + " to " + std::to_string(last);
        } catch (const std::exception& error) {
          const std::string words = error.what(), before = "rank 0 of 3: ";
          ++refused;
          return words.starts_with(before) ? words.substr(before.size()) : words;
        }
      };
      const std::string one = told([&] { return option.of(open_input(spec)); });
      Frames frames;
      const std::string several = told([&] {
        run_in_threads(3, [&](Communicator& c) {
          together(c, [&] {
            const Frames mine = RankInput(c, spec, {}, in_memory).frames(option);
            if (c.rank() == 2) frames = mine;
          });
        });
        return frames;
      });
      EXPECT_EQ(several, one) << spec << ' ' << said;
    }
  EXPECT_EQ(refused, 2 * (3 + 1));
}

/// Of some frames, in boxes of their own: a file that the ranks do not read.
std::string moving_dump() {
  std::string text;
  for (int f = 0; f < 3; ++f) {
    text += fmt::format(
        "ITEM: TIMESTEP\n{}\nITEM: NUMBER OF ATOMS\n11\nITEM: BOX BOUNDS pp pp pp\n0 {}\n0 30\n0 30\n"
        "ITEM: ATOMS id type x y z\n",
        f, 40 - 18 * f);
    for (int i = 0; i < 11; ++i) text += fmt::format("{} 1 {} {} {}\n", i + 1, i, f, i * f % 5);
  }
  return text;
}

using Fields = std::vector<std::array<double, 8>>;
Fields fields(const std::vector<Piece>& pieces) {
  Fields all;
  for (const auto& [first, begin, size, strand] : pieces)
    all.push_back({double(first), double(begin), double(size), double(strand.first), double(strand.size),
                   strand.loop_length, double(strand.closed), double(strand.number)});
  return all;
}

/// Each frame's spheres, strands and box, and what is wrong with that frame, are what one process has.
TEST(RankInput, HasOfEveryFrameWhatOneProcessHas) {
  const TestFile dump("a.lammpstrj", moving_dump());
  InputOptions options{.takes_box = true};
  options.radius = 2;
  for (const std::string& spec :
       {dump.path().string(), std::string("path1:n=50"), std::string("hair:n=40,strands=4")})
    for (const std::uint32_t f : {0u, 1u, 2u}) {
      const bool file = spec == dump.path();
      const InputOptions& said = file ? options : InputOptions{};
      const Input input = open_input(spec, said);
      if (f >= input.animation->frames()) continue;
      const Chain chain = input.animation->frame(f);
      const PeriodicBox* const box = box_of(input.boxes, f);
      EXPECT_EQ(box != nullptr, file);
      std::string refusal;
      try {
        run_in_threads(3, [&](Communicator& c) {
          together(c, [&] {
            const RankInput by_ranks(c, spec, said, in_memory);
            Part part = by_ranks.part(f).part;
            const Part right = even_part_of(chain, 3, c.rank());
            EXPECT_EQ(part.spheres, right.spheres) << spec << ' ' << f;
            EXPECT_EQ(fields(part.pieces), fields(right.pieces)) << spec << ' ' << f;
            const auto told = by_ranks.box(f);
            EXPECT_EQ(told, box != nullptr ? std::optional(*box) : std::nullopt);
            const auto whole = by_ranks.whole(f);
            EXPECT_EQ(whole.has_value(), c.rank() == 0);
            if (whole) {
              EXPECT_TRUE(std::ranges::equal(whole->spheres(), chain.spheres()));
            }
            RankWork work;
            search_frame(c, by_ranks, f, told, std::move(part), {}, work);
          });
        });
      } catch (const RankFailed& error) {
        refusal = error.what();
      }
      const bool narrow = file && f == 2;  // 4 wide, as a sphere is
      EXPECT_EQ(refusal.find(spec + " frame 2: ") != std::string::npos, narrow)
          << spec << ' ' << f << refusal;
    }
}

TEST(RankInput, SaysOnceWhatHadToBeAssumed) {
  const TestFile dump("a.lammpstrj", moving_dump());
  InputOptions options;
  options.radius = 0.25f, options.box_from = BoxFrom::none;
  const auto shown = [](const std::function<void()>& run) {
    testing::internal::CaptureStderr();
    run();
    return testing::internal::GetCapturedStderr();
  };
  const std::string spec = dump.path().string();
  const std::string one = shown([&] { show_warnings(open_input(spec, options)); });
  EXPECT_NE(one, "");
  EXPECT_EQ(
      shown([&] { run_in_threads(3, [&](Communicator& c) { RankInput(c, spec, options, in_memory); }); }),
      one);
}

/// As one process does: no file has such a name, and none is looked for in vain.
TEST(RankInput, SaysOfANameThatIsTooLongWhatOneProcessDoes) {
  const std::string spec = std::string(300, 'x') + ".catena";
  std::string one;
  try {
    open_input(spec);
  } catch (const InputError& error) {
    one = error.what();
  }
  EXPECT_NE(one, "");
  EXPECT_EQ(by_ranks(2, spec, {}).refusal, one);
}

TEST(RankInput, ReadsPartsOfAFileWhateverTheCaseOfItsName) {
  const TestFile file("ROD.CATENA", "");
  const Labels none;
  const Chain rod = open_input("rod:n=50").animation->frame(0);
  WriterRegistry::instance()
      .of(file.path())
      .write(file.path(), {0, 1, [&](std::uint32_t) { return ExportedFrame{rod}; }, none});
  std::atomic<unsigned> opened = 0;
  run_in_threads(2, [&](Communicator& c) {
    RankInput(c, file.path().string(), {}, [&](const std::string& spec) {
      ++opened;
      return in_memory(spec);
    });
  });
  EXPECT_EQ(opened, 2u);
}

}  // namespace
}  // namespace catena::ranks

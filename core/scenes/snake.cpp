#include "catena/core/scenes/snake.h"

#include <fmt/format.h>

#include <algorithm>
#include <stdexcept>

#include "catena/core/error.h"
#include "catena/core/made_once.h"

namespace catena {
namespace {

class Snake final : public Animation {
 public:
  Snake(Row row, std::uint32_t n, std::uint32_t frames) : row_(std::move(row)), n_(n), frames_(frames) {}

  std::uint32_t frames() const override { return frames_; }

  Chain frame(std::uint32_t f) const override {
    const auto tail = tail_of(f);
    const std::vector<Sphere>& laid = laid_.by([&] { return row_.spheres(0, row_.size()); });
    return Chain(std::vector<Sphere>(laid.begin() + tail, laid.begin() + tail + n_));
  }

  std::optional<ChainByStretches> in_stretches(std::uint32_t f) const override {
    const auto tail = static_cast<std::uint32_t>(tail_of(f));
    return ChainByStretches{n_, {}, {}, [row = row_, tail](std::uint32_t first, std::uint32_t end) {
                              return row.spheres(tail + first, tail + end);
                            }};
  }

  std::int64_t shift(std::uint32_t f) const override { return tail_of(f) - tail_of(f - 1); }

 private:
  /// Where the snake lies in the row.
  std::int64_t tail_of(std::uint32_t f) const {
    if (f >= frames_) throw std::out_of_range(fmt::format("frame {} of {}", f, frames_));
    const std::uint64_t slide = row_.size() - n_, last = frames_ - 1;
    return static_cast<std::int64_t>((f * slide + last / 2) / last);
  }

  Row row_;
  std::uint32_t n_, frames_;
  MadeOnce<std::vector<Sphere>> laid_;  // the whole row, for all frames
};

}  // namespace

std::unique_ptr<Animation> open_snake(const SnakePath& path, const SceneSetup& setup, std::uint32_t frames) {
  const std::uint64_t n = setup.n();
  const std::uint64_t row = n == 0 ? 0 : n + std::max<std::uint64_t>(n * 7 / 20, frames - 1);
  if (row >= std::uint64_t{1} << 31)
    throw InputError(
        fmt::format("scene {}: n={} is too large; the snake and its way may have 2^31 - 1 spheres together",
                    setup.scene(), n));
  return std::make_unique<Snake>(snake_row(path, setup, static_cast<std::uint32_t>(row)), setup.n(), frames);
}

}  // namespace catena

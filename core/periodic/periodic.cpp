#include "catena/core/periodic/periodic.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "catena/core/counted.h"
#include "catena/core/error.h"
#include "catena/core/plan/omissions.h"

namespace catena {
namespace {

constexpr Shift nowhere{0, 0, 0};

/// Fractions of an edge that cover the rounding of where a sphere is.
constexpr double slack = 1e-6;

Shift sum(const Shift& a, const Shift& b, std::int32_t sign) {
  return {a[0] + sign * b[0], a[1] + sign * b[1], a[2] + sign * b[2]};
}

std::array<double, 3> centre(const Sphere& s) { return {s.x, s.y, s.z}; }

/// For certain no sphere is so many boxes away that it is refused: of a centre c the box is at most |c| /
/// width, and |c| at most sqrt(3) times a coordinate.
bool all_near(const Extent& extent, const std::array<double, 3>& widths) {
  return std::ranges::all_of(
      widths, [&](double width) { return width == 0 || 4.0 * extent.greatest_coordinate < 0x1p19 * width; });
}

/// The one of each two opposite shifts that is taken.
bool is_forward(const Shift& shift) { return shift > nowhere; }

}  // namespace

Periodic* put_into_boxes(std::unique_ptr<Variant>& variant, std::span<const PeriodicBox> boxes) {
  if (boxes.empty()) return nullptr;
  auto periodic = std::make_unique<Periodic>(std::move(variant), boxes[0]);
  Periodic* const seen = periodic.get();
  variant = std::move(periodic);
  return seen;
}

void go_to_frame(Periodic* periodic, std::span<const PeriodicBox> boxes, std::uint32_t frame) {
  if (periodic != nullptr) periodic->set_box(*box_of(boxes, frame));
}

void Periodic::build(const Chain& chain) {
  const Stopwatch watch;
  built_.reset();
  asked_ = prepared_, box_ = next_box_;
  follows_ = images_built_ = false;
  const double reach = 2 * double{chain.view().extent.greatest_radius};
  check_box(box_, reach);
  const auto widths = box_.widths();
  tight_ = false;
  for (const double width : widths) tight_ = tight_ || (width > 0 && width < 2 * reach * (1 + slack));
  home_.clear(), ghosts_.clear();
  if (asked_.want != Request::Want::any || !all_near(chain.view().extent, widths)) put_into_box(chain);
  known_ = asked_.want == Request::Want::any ? known_as_stored(chain) : std::nullopt;
  if (!known_) build_images(chain);
  timings_ = variant_->timings();
  timings_.build_ms = watch.ms();
  built_ = chain.size();
}

/// Two that collide where they are stored do, whatever repeats; no others do where no image reaches another.
std::optional<bool> Periodic::known_as_stored(const Chain& chain) {
  const Request request{.want = Request::Want::any, .queries = asked_.queries};
  variant_->prepare(request);
  variant_->build(chain);
  variant_->find(chain, request, candidates_);
  if (candidates_.found) return true;
  if (home_.empty()) put_into_box(chain);
  return apart_ ? std::optional(false) : std::nullopt;
}

void Periodic::build_images(const Chain& chain) {
  if (home_.empty()) put_into_box(chain);
  ghosts_.clear();
  if (!apart_) add_ghosts(chain);
  images_ = chain_of_images(chain);
  Request wanted;
  wanted.queries = {0, chain.size()};
  variant_->prepare(wanted);
  try {
    variant_->build(images_);
  } catch (const CapacityError& why) {  // its number of spheres is none that the caller knows
    if (ghosts_.empty()) throw;
    throw CapacityError(fmt::format("{}; {}", why.what(), images_in_words()));
  }
  images_built_ = true;
}

std::string Periodic::images_in_words() const {
  return fmt::format("in a box {} are searched, of which {} at its faces", counted(images_.size(), "sphere"),
                     ghosts_.size() == 1 ? "1 is an image" : fmt::format("{} are images", ghosts_.size()));
}

bool Periodic::knows(const Request& request) const {
  return known_ && request.want == Request::Want::any && request.queries == asked_.queries;
}

Plan Periodic::plan() const {
  Plan steps = variant_->plan();
  if (steps.empty()) return steps;
  for (Decision& step : steps)
    if (images_built_ && step.step == info_of(Omission::pair_list).step)
      step.reason = "in a box pairs are searched for, and decided again";
  const bool added = images_built_ && !ghosts_.empty(), known = !images_built_ && known_ == true;
  steps.insert(steps.begin(), {"images at the faces of the box", !added,
                               added   ? images_in_words()
                               : known ? "what collides as it is stored is the answer"
                                       : "no image of the chain reaches another"});
  if (follows_) steps.push_back({"search of the whole frame", false, "in a box each is searched for itself"});
  return steps;
}

// The box begins at the least sphere where one box holds them all, so that none of them is moved.
void Periodic::put_into_box(const Chain& chain) {
  std::vector<std::array<double, 3>> place(chain.size());
  std::array<double, 3> least, greatest;
  least.fill(std::numeric_limits<double>::infinity());
  greatest.fill(-std::numeric_limits<double>::infinity());
  for (std::uint32_t i = 0; i < chain.size(); ++i) {
    place[i] = box_.in_edges(centre(chain[i]));
    for (std::size_t edge = 0; edge < 3; ++edge) {
      least[edge] = std::min(least[edge], place[i][edge]);
      greatest[edge] = std::max(greatest[edge], place[i][edge]);
    }
  }
  const auto margin = margins(chain);
  apart_ = true;
  for (std::size_t edge = 0; edge < 3; ++edge) {
    const double span = greatest[edge] - least[edge];
    origin_[edge] = span < 1 ? least[edge] : 0;
    apart_ = apart_ && (box_.length[edge] == 0 || span < 1 - margin[edge] - slack);
  }
  std::vector<Shift> home = std::move(home_);  // nobody has one until all have
  home_.clear();
  home.assign(chain.size(), nowhere);
  spheres_.clear();
  for (std::uint32_t i = 0; i < chain.size(); ++i) {
    for (std::size_t edge = 0; edge < 3; ++edge) {
      const double boxes = box_.length[edge] > 0 ? std::floor(place[i][edge] - origin_[edge]) : 0;
      if (std::abs(boxes) > 0x1p20)
        throw InputError(fmt::format("sphere {} lies {} boxes away along the box's {} edge, more than 2^20",
                                     i, boxes, std::array{"first", "second", "third"}[edge]));
      home[i][edge] = -static_cast<std::int32_t>(boxes);
    }
    spheres_.push_back(image(chain[i], home[i]));
  }
  home_ = std::move(home);
}

/// Fractions of the edges that two spheres reach over at most.
std::array<double, 3> Periodic::margins(const Chain& chain) const {
  const double reach = 2 * double{chain.view().extent.greatest_radius};
  const auto widths = box_.widths();
  std::array<double, 3> margin{};
  for (std::size_t edge = 0; edge < 3; ++edge)
    if (widths[edge] > 0) margin[edge] = reach / widths[edge] + slack;
  return margin;
}

void Periodic::add_ghosts(const Chain& chain) {
  spheres_.resize(chain.size());
  const auto margin = margins(chain);
  for (std::uint32_t i = 0; i < chain.size(); ++i) {
    const auto place = box_.in_edges(centre(chain[i]));
    const auto reaches = [&](std::size_t edge, std::int32_t step) {
      const double there = place[edge] + home_[i][edge] + step - origin_[edge];
      return step == 0 || (box_.length[edge] > 0 && there >= -margin[edge] && there <= 1 + margin[edge]);
    };
    for (std::int32_t a = 0; a <= 1; ++a)
      for (std::int32_t b = -1; b <= 1 && reaches(0, a); ++b)
        for (std::int32_t c = -1; c <= 1 && reaches(1, b); ++c) {
          const Shift step{a, b, c};
          if (!is_forward(step) || !reaches(2, c)) continue;
          const Shift shift = sum(home_[i], step, 1);
          ghosts_.push_back({i, shift});
          spheres_.push_back(image(chain[i], shift));
        }
  }
}

// The radius grows by more than the distance between the rounded centre and the true one.
Sphere Periodic::image(const Sphere& sphere, const Shift& shift) const {
  if (shift == nowhere) return sphere;
  const auto moved = box_.along({double(shift[0]), double(shift[1]), double(shift[2])});
  const double x = sphere.x + moved[0], y = sphere.y + moved[1], z = sphere.z + moved[2];
  double most =
      std::max({std::abs(double{sphere.x}), std::abs(double{sphere.y}), std::abs(double{sphere.z})});
  for (std::size_t edge = 0; edge < 3; ++edge)
    most = std::max(most, std::abs(shift[edge] * box_.length[edge]));
  most = std::max(
      {most, std::abs(shift[1] * box_.xy), std::abs(shift[2] * box_.xz), std::abs(shift[2] * box_.yz)});
  const double rounded = std::max({std::abs(x), std::abs(y), std::abs(z)});
  // Half a unit in the last place of binary32 an axis, the rounding of x, y, z in binary64, and denormals.
  const double off = 2 * (0x1p-24 * rounded + 0x1p-48 * most + 0x1p-149);
  const double radius = (sphere.radius + off) * (1 + 0x1p-22);
  return {static_cast<float>(x), static_cast<float>(y), static_cast<float>(z), static_cast<float>(radius)};
}

// An arc window of enlarged spheres would take neighbours for others, so every sphere is a strand of its own
// there, and neighbours are told apart afterwards.
Chain Periodic::chain_of_images(const Chain& chain) const {
  const auto all = static_cast<std::uint32_t>(spheres_.size());
  Strands strands;
  Exclusion exclusion = Exclusion::index(1);
  if (chain.exclusion().rule == Exclusion::Rule::index_window) {
    strands = chain.strands();
    exclusion = chain.exclusion();
  } else {
    for (std::uint32_t i = 0; i <= chain.size(); ++i) strands.first.push_back(i);
    strands.closed.assign(chain.size(), 0);
  }
  if (!ghosts_.empty()) strands.first.push_back(all), strands.closed.push_back(0);
  return Chain(spheres_, std::move(strands), std::move(exclusion));
}

void Periodic::find(const Chain& chain, const Request& request, Collisions& result) {
  if (built_ != chain.size()) throw std::logic_error("find: not the chain of the last build");
  const Stopwatch watch;
  result.found = false;
  result.pair_count = 0;
  result.count.assign(request.want == Request::Want::any ? 0 : chain.size(), 0);
  result.pairs.clear();
  if (knows(request)) {
    result.found = *known_;
  } else {
    if (!images_built_) build_images(chain);
    search({chain, request, result}, {0, chain.size()});
  }
  if (request.want == Request::Want::any) result.pair_count = 0;
  timings_.find_ms = watch.ms();
  if (request.want == Request::Want::pairs && result.pair_count > request.pair_limit) {
    result.pairs.clear();
    throw PairLimitExceeded(result.pair_count, request.pair_limit);
  }
}

void Periodic::search(const Search& search, SphereRange queries) {
  const auto enough = [&] { return search.request.want == Request::Want::any && search.result.found; };
  if (queries.size() == 0 || enough()) return;
  Request candidates;
  candidates.queries = queries;
  candidates.pair_limit = std::max<std::uint64_t>(std::uint64_t{1} << 24, images_.size());
  try {
    variant_->find(images_, candidates, candidates_);
  } catch (const PairLimitExceeded&) {
    const std::uint32_t middle = queries.begin + queries.size() / 2;
    this->search(search, {queries.begin, middle});
    this->search(search, {middle, queries.end});
    return;
  }
  for (const Pair& candidate : candidates_.pairs) {
    if (enough()) return;
    meet(search, candidate);
  }
}

void Periodic::meet(const Search& search, const Pair& candidate) const {
  const Chain& chain = search.chain;
  const std::uint32_t i = candidate.i, n = chain.size();
  const bool ghost = candidate.j >= n;
  const std::uint32_t j = ghost ? ghosts_[candidate.j - n].sphere : candidate.j;
  if (i == j || chain.neighbours(i, j)) return;
  const Shift& there = ghost ? ghosts_[candidate.j - n].shift : home_[j];
  const bool as_stored = home_[i] == nowhere && there == nowhere;
  if (!as_stored && !image_overlaps(chain[i], chain[j], sum(there, home_[i], -1), box_)) return;
  if (tight_ && !collide(chain, i, j, sum(there, home_[i], -1))) return;

  const Pair pair{std::min(i, j), std::max(i, j)};
  const SphereRange queries = search.request.queries;
  Collisions& result = search.result;
  if (search.request.want != Request::Want::any)
    for (const std::uint32_t sphere : {pair.i, pair.j}) result.count[sphere] += queries.contains(sphere);
  if (!queries.contains(pair.i)) return;
  result.found = true;
  ++result.pair_count;
  if (search.request.want == Request::Want::pairs && result.pair_count <= search.request.pair_limit)
    result.pairs.push_back(pair);
}

/// Whether no image before this one overlaps too: two that touch at once are one pair.
bool Periodic::collide(const Chain& chain, std::uint32_t i, std::uint32_t j, const Shift& shift) const {
  // As seen from the lower id, so that both sides choose the same.
  const std::int32_t sign = i < j ? 1 : -1;
  const Sphere &a = chain[std::min(i, j)], &b = chain[std::max(i, j)];
  const Shift seen = sum(nowhere, shift, sign);
  for (std::int32_t x = -1; x <= 1; ++x)
    for (std::int32_t y = -1; y <= 1; ++y)
      for (std::int32_t z = -1; z <= 1; ++z) {
        const Shift step{x, y, z};
        const bool repeats = (x == 0 || box_.length[0] > 0) && (y == 0 || box_.length[1] > 0) &&
                             (z == 0 || box_.length[2] > 0);
        if (!is_forward(step) && step != nowhere && repeats && image_overlaps(a, b, sum(seen, step, 1), box_))
          return false;
      }
  return true;
}

}  // namespace catena

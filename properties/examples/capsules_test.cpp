#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "catena/core/executor/pair_collector.h"
#include "catena/core/strategy/register.h"
#include "catena/properties/testing/certified.h"

// A variant complete in itself with bounds of its own in one file: every 8 consecutive spheres lie in a
// capsule about the chord from the first to the last. Registered in the test program, so that every property
// meets it.
namespace catena {
namespace example {

struct Vector {
  double x, y, z;
  friend Vector operator-(const Vector& a, const Vector& b) { return {a.x - b.x, a.y - b.y, a.z - b.z}; }
  friend Vector operator+(const Vector& a, const Vector& b) { return {a.x + b.x, a.y + b.y, a.z + b.z}; }
  friend Vector operator*(double t, const Vector& a) { return {t * a.x, t * a.y, t * a.z}; }
  friend double dot(const Vector& a, const Vector& b) { return a.x * b.x + a.y * b.y + a.z * b.z; }
  friend double length(const Vector& a) { return std::sqrt(dot(a, a)); }
};

struct Capsule {
  Sphere first, last;  ///< the segment joins their centres
  float radius;
};

Vector centre(const Sphere& s) { return {s.x, s.y, s.z}; }

/// Outweighs the rounding of a dozen operations in binary64, of numbers up to `scale`.
double slack(double scale) { return 1e-12 * scale; }

float round_up(double value) {
  const float nearest = static_cast<float>(value);
  return nearest >= value ? nearest : std::nextafter(nearest, std::numeric_limits<float>::infinity());
}

/// The part of the way from a to a + d at which it is next to p; 0 for a segment of no length.
double along(const Vector& p, const Vector& a, const Vector& d) {
  const double square = dot(d, d);
  return square > 0 ? std::clamp(dot(p - a, d) / square, 0.0, 1.0) : 0;
}

Capsule around(const Sphere* spheres, std::uint32_t count) {
  Capsule capsule{spheres[0], spheres[count - 1], 0};
  const Vector a = centre(capsule.first), d = centre(capsule.last) - a;
  for (std::uint32_t k = 0; k < count; ++k) {
    const Vector p = centre(spheres[k]) - a;
    const double reach = length(p - along(p, {0, 0, 0}, d) * d) + spheres[k].radius;
    capsule.radius = std::max(capsule.radius, round_up(reach + slack(reach + length(p) + length(d))));
  }
  return capsule;
}

/// True only when a plane parts the capsules for certain: one across the way between two near points of the
/// segments, found by going to and fro. How near they are is a matter of speed; that the plane parts is
/// checked.
bool apart(const Capsule& p, const Capsule& q) {
  const Vector origin = centre(p.first), a = centre(p.last) - origin;
  const Vector b = centre(q.first) - origin, e = centre(q.last) - centre(q.first);
  Vector on_p{0, 0, 0}, on_q = b;
  for (int k = 0; k < 4; ++k) {
    on_q = b + along(on_p, b, e) * e;
    on_p = along(on_q, {0, 0, 0}, a) * a;
  }
  const Vector w = on_q - on_p;
  const double reach = double{p.radius} + q.radius, scale = length(a) + length(b) + length(e) + reach;
  const double gap = std::min(dot(w, b), dot(w, b + e)) - std::max(0.0, dot(w, a));
  return gap > length(w) * (reach + slack(scale));
}

template <class Arithmetic>
class Capsules final : public Variant {
  static constexpr std::uint32_t block = 8;

 public:
  void build(const Chain& chain) override {
    const Stopwatch watch;
    spheres_ = 0, capsules_.clear();  // nothing is built where memory ends
    capsules_.resize((chain.size() + block - 1) / block);
    spheres_ = chain.size();
    for (std::uint32_t k = 0; k < capsules_.size(); ++k)
      capsules_[k] = around(chain.spheres().data() + k * block, std::min(block, spheres_ - k * block));
    timings_.build_ms = watch.ms();
  }

  void find(const Chain& chain, const Request& request, Collisions& result) override {
    search(chain, request, result, nullptr);
  }
  Accounting evidence() const override { return Accounting::each_pair; }
  void find_with_evidence(const Chain& chain, const Request& request, Collisions& result,
                          EvidenceSink& sink) override {
    search(chain, request, result, &sink);
  }

  void visit_bounds(BoundsVisitor& visitor) const override {
    const auto root = static_cast<std::uint32_t>(spheres_ + capsules_.size());
    visitor.tree({.levels = spheres_ > 0 ? 3u : 0u});
    for (std::uint32_t k = 0; k < capsules_.size(); ++k) {
      const Sphere &a = capsules_[k].first, &b = capsules_[k].last;
      const Capsule64 shown{{a.x, a.y, a.z}, {b.x, b.y, b.z}, capsules_[k].radius};
      visitor.edge(root, Everything{}, spheres_ + k, shown);
      for (std::uint32_t i = k * block; i < std::min(spheres_, (k + 1) * block); ++i)
        visitor.edge(spheres_ + k, shown, i, Everything{});
    }
  }

  Timings timings() const override { return timings_; }

 private:
  void search(const Chain& chain, const Request& request, Collisions& result, EvidenceSink* sink) {
    if (chain.size() != spheres_) throw std::logic_error("find: not the chain of the last build");
    const Stopwatch watch;
    const ChainView view = chain.view();
    PairCollector collector(spheres_, request, result);
    PairCollector::Lane& lane = collector.lane(0);
    for (std::uint32_t p = 0; p < capsules_.size() && !lane.satisfied(); ++p)
      for (std::uint32_t q = p; q < capsules_.size(); ++q) {
        if (p != q && apart(capsules_[p], capsules_[q])) {
          if (sink != nullptr) sink->discarded(spheres_ + p, spheres_ + q);
          continue;
        }
        for (std::uint32_t i = p * block; i < std::min(spheres_, (p + 1) * block); ++i)
          for (std::uint32_t j = std::max(i + 1, q * block); j < std::min(spheres_, (q + 1) * block); ++j) {
            const bool neighbours = view.neighbours(i, j);
            if (sink != nullptr) neighbours ? sink->excluded(i, j) : sink->tested(i, j);
            if (!neighbours && Arithmetic::overlap(view.spheres[i], view.spheres[j])) lane.collide(i, j);
          }
      }
    collector.finish();
    timings_.find_ms = watch.ms();
  }

  std::vector<Capsule> capsules_;
  std::uint32_t spheres_ = 0;
  Timings timings_;
};

const RegisterVariant<Capsules, Robust> capsules{{.name = "Capsules",
                                                  .summary = "capsules of eight, all against all",
                                                  .all_pairs = true,
                                                  .has_tree = true,
                                                  .promises = {.same_bits = true}}};

TEST(CapsulesExample, IsCertified) { properties::expect_certified("Capsules"); }

}  // namespace example
}  // namespace catena

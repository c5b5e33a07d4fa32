#include <gtest/gtest.h>

#include <cmath>
#include <memory>
#include <random>
#include <vector>

#include "catena/core/periodic/periodic.h"
#include "catena/core/strategy/registry.h"
#include "catena/properties/rational_image.h"

// What a search in a box gives to its variant: spheres in the box and their images at its faces, rounded.
namespace catena {
namespace {

using properties::image_squared;
using properties::Rational;

/// Keeps the chain that it is to search.
class Recorder final : public Variant {
 public:
  explicit Recorder(std::vector<Sphere>& seen) : seen_(seen) {}
  void build(const Chain& chain) override { seen_.assign(chain.spheres().begin(), chain.spheres().end()); }
  void find(const Chain&, const Request&, Collisions& found) override { found = {}; }
  Timings timings() const override { return {}; }

 private:
  std::vector<Sphere>& seen_;
};

std::vector<Sphere> images_of(const std::vector<Sphere>& spheres, const PeriodicBox& box) {
  std::vector<Sphere> seen;
  Periodic periodic(std::make_unique<Recorder>(seen), box);
  periodic.build(Chain(spheres));
  return seen;
}

/// Whether it encloses some image of the sphere, in exact arithmetic: that beside it, or one next to that.
bool encloses_an_image(const Sphere& image, const Sphere& sphere, const PeriodicBox& box) {
  if (image.radius < sphere.radius) return false;
  const auto away =
      box.in_edges({double{image.x} - sphere.x, double{image.y} - sphere.y, double{image.z} - sphere.z});
  const Rational room = Rational(image.radius) - Rational(sphere.radius);
  const auto beside = [&](std::size_t edge) { return box.length[edge] > 0 ? 1 : 0; };
  for (int x = -beside(0); x <= beside(0); ++x)
    for (int y = -beside(1); y <= beside(1); ++y)
      for (int z = -beside(2); z <= beside(2); ++z) {
        const std::array<int, 3> shift{static_cast<int>(std::round(away[0])) + x,
                                       static_cast<int>(std::round(away[1])) + y,
                                       static_cast<int>(std::round(away[2])) + z};
        if (image_squared(image, sphere, shift, box) <= room * room) return true;
      }
  return false;
}

void expect_enclosed(const std::vector<Sphere>& spheres, const PeriodicBox& box) {
  const std::vector<Sphere> images = images_of(spheres, box);
  for (std::size_t k = 0; k < images.size(); ++k) {
    bool encloses = false;
    if (k < spheres.size())
      encloses = encloses_an_image(images[k], spheres[k], box);
    else
      for (const Sphere& s : spheres) encloses = encloses || encloses_an_image(images[k], s, box);
    EXPECT_TRUE(encloses) << k << " of " << spheres.size() << " at " << images[k].x << ' ' << images[k].y
                          << ' ' << images[k].z << ", " << images[k].radius << ", box " << written(box);
  }
}

TEST(Images, EncloseWhatTheyAreImagesOf) {
  std::mt19937 dice(1);
  const auto number = [&](double low, double high) {
    return std::uniform_real_distribution<double>(low, high)(dice);
  };
  for (int k = 0; k < 200; ++k) {
    const double scale = std::ldexp(1., static_cast<int>(number(-60, 60)));
    PeriodicBox box{{scale * number(1, 3), scale * number(1, 3), scale * number(1, 3)}};
    if (k % 3 == 0) box.length[k % 9 / 3] = 0;
    if (k % 2 == 0 && k % 3 != 0)
      box.xy = scale * number(-.3, .3), box.xz = scale * number(-.3, .3), box.yz = scale * number(-.3, .3);
    const double radius = scale * (k % 5 == 0 ? 0 : std::pow(2, -number(4, 40)));
    // Just above a power of two a rounding is largest beside what is rounded.
    const double at = k % 4 == 0 ? 0 : std::ldexp(scale, static_cast<int>(number(0, 4)));
    std::vector<Sphere> spheres;
    for (int s = 0; s < 6; ++s) {
      const auto coordinate = [&] { return static_cast<float>(at + scale * number(-.2, 1.2)); };
      spheres.push_back({coordinate(), coordinate(), coordinate(), static_cast<float>(radius)});
    }
    expect_enclosed(spheres, box);
  }
}

/// Two edges and a tilt that take nearly all of each other off: what is left is far below their rounding.
TEST(Images, EncloseWhatTheyAreImagesOfWhereAnEdgeAndATiltCancel) {
  std::mt19937 dice(2);
  const auto number = [&](double low, double high) {
    return std::uniform_real_distribution<double>(low, high)(dice);
  };
  std::size_t near_the_origin = 0;
  for (int k = 0; k < 300; ++k) {
    PeriodicBox box{{number(3, 4), 2, 0}, number(.01, .3)};
    const float x = -static_cast<float>(box.length[0] + box.xy);
    box.length[0] -=
        (box.length[0] + box.xy + x) - number(0, 0x1p-36);  // the corner's image is at the origin
    const float radius =
        k % 2 ? 0 : 0.4f;  // of which the rounding of the centre is no share that it has digits for
    const std::vector<Sphere> spheres{{x, -2, 0, radius}, {x + 1.5f, -1, 0, radius}, {x + 1, 0, 0, radius}};
    for (const Sphere& s : images_of(spheres, box)) near_the_origin += std::abs(s.x) < 0x1p-30f && s.y == 0;
    expect_enclosed(spheres, box);
  }
  EXPECT_GT(near_the_origin, 250u);
}

std::vector<Pair> pairs_in(const std::vector<Sphere>& spheres, const PeriodicBox& box) {
  Periodic periodic(StrategyRegistry::instance().make("CPU1"), box);
  const Chain chain(spheres);
  Collisions found;
  periodic.build(chain);
  periodic.find(chain, {}, found);
  return found.pairs;
}

/// Only a sphere that is moved is enlarged, and decided again: none is where one box holds them all.
TEST(Images, AreOfNoSphereThatOneBoxHoldsWhereverItBegins) {
  for (const float at : {-7.0f, 0.0f, 3.0f, 9.0f}) {
    const std::vector<Sphere> spheres{{at, 0, at, 1}, {at + 4, 5, at + 8, 1}, {at + 6, at, at + 2, 1}};
    const std::vector<Sphere> images = images_of(spheres, {{10, 20, 10}});
    ASSERT_GE(images.size(), spheres.size());
    EXPECT_TRUE(std::equal(spheres.begin(), spheres.end(), images.begin())) << at;
  }
}

/// An image is looked for as far as the reach from a face, and a share of an edge more, as places are
/// rounded: here a sphere lies at the reach exactly, and its partner on the other face.
TEST(Images, AreThereAtTheReachFromAFaceWhateverIsRounded) {
  std::mt19937 dice(3);
  const auto number = [&](double low, double high) {
    return static_cast<float>(std::uniform_real_distribution<double>(low, high)(dice));
  };
  std::size_t tries = 0;
  while (tries < 2000) {
    const float least = number(-100, 100), greatest = least + number(1, 50);
    const double length = double{greatest} - least;
    const float other = least + static_cast<float>(length) * number(.02, .2);
    const auto radius = static_cast<float>((double{other} - least) / 2);
    if (2 * double{radius} != double{other} - least || length < 4 * double{radius}) continue;
    ++tries;
    const float middle = least + static_cast<float>(length / 2);
    const std::vector<Sphere> spheres{{other, 0, 0, radius},
                                      {middle, 999, 0, 0},
                                      {greatest, 0, 0, radius},
                                      {middle, 999, 9, 0},
                                      {least, 99, 0, 0}};
    ASSERT_EQ(pairs_in(spheres, {{length, 0, 0}}), (std::vector<Pair>{{0, 2}}))
        << least << ' ' << other << ' ' << greatest;
  }
}

/// Images are enlarged, and what is near them is decided again, whichever of the two was moved.
TEST(Images, AreNoCollisionsByWhatTheyAreEnlargedBy) {
  for (const float radius : {1.0f, std::nextafter(1.0f, 0.0f)})
    for (const int boxes : {-3, 0, 2, 5})
      for (const bool first : {false, true}) {
        const Sphere moved{0.25f + 10 * static_cast<float>(boxes), 0, 0, 1}, stays{2.25f, 0, 0, radius};
        const std::vector<Sphere> spheres{
            first ? moved : stays, {5, 5, 5, 0}, first ? stays : moved, {0, 5, 5, 0}};
        EXPECT_EQ(pairs_in(spheres, {{10, 10, 10}}).size(), radius == 1 ? 1u : 0u) << boxes << ' ' << first;
      }
}

}  // namespace
}  // namespace catena

#include "catena/core/motion/rod.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "catena/core/motion/contact.h"
#include "catena/core/motion/newton.h"
#include "catena/core/scenes/random.h"

namespace catena::motion {
namespace {

/// Two rods of 6 and 5 nodes, bent and strained at random.
Coordinates crumpled(std::uint64_t seed) {
  Random random(seed);
  Coordinates x(33);
  for (std::uint32_t i = 0; i < 11; ++i) {
    const Vec3 p = Vec3{1.0 * i, 0, 0} + 0.4 * random.cube();
    node(x, i) = Eigen::Vector3d(p.x, p.y, p.z);
  }
  return x;
}

Eigen::MatrixXd full(const Derivatives& d) {
  Eigen::SparseMatrix<double> lower(d.gradient.size(), d.gradient.size());
  lower.setFromTriplets(d.hessian.begin(), d.hessian.end());
  const Eigen::MatrixXd dense = lower;
  return dense.selfadjointView<Eigen::Lower>();
}

/// The derivatives that add(x, out) gives are those of energy(x), by central differences.
template <class Energy, class Add>
void expect_derivatives(const Coordinates& x, const Energy& energy, const Add& add) {
  constexpr double h = 1e-5;
  const auto at = [&](const Coordinates& where) {
    Derivatives d;
    d.reset(where.size());
    add(where, d);
    return d;
  };
  const Derivatives here = at(x);
  const Eigen::MatrixXd hessian = full(here);
  for (Eigen::Index k = 0; k < x.size(); ++k) {
    Coordinates more = x, less = x;
    more[k] += h, less[k] -= h;
    EXPECT_NEAR(here.gradient[k], (energy(more) - energy(less)) / (2 * h), 1e-6) << k;
    const Coordinates column = (at(more).gradient - at(less).gradient) / (2 * h);
    EXPECT_LT((hessian.col(k) - column).lpNorm<Eigen::Infinity>(), 1e-5) << k;
  }
}

TEST(Rods, HaveTheDerivativesOfTheirEnergies) {
  for (std::uint64_t seed = 1; seed <= 5; ++seed) {
    const Rods rods({30, 2, seed % 2 == 0 ? 1 : 0.7}, {0, 6, 11});
    expect_derivatives(
        crumpled(seed),
        [&](const Coordinates& x) { return rods.stretching_energy(x) + rods.bending_energy(x); },
        [&](const Coordinates& x, Derivatives& out) { rods.add_derivatives(x, out); });
  }
}

TEST(ContactResponse, HasTheDerivativesOfItsEnergy) {
  const std::vector<Pair> pairs{{0, 2}, {1, 3}, {4, 6}, {0, 9}};
  const ContactResponse response{7, 2.5};
  for (std::uint64_t seed = 1; seed <= 5; ++seed)
    expect_derivatives(
        crumpled(seed), [&](const Coordinates& x) { return response.energy(x, pairs); },
        [&](const Coordinates& x, Derivatives& out) { response.add_derivatives(x, pairs, out); });
}

TEST(ContactResponse, IsNothingForPairsThatAreApartOrInOnePlace) {
  Coordinates x = Coordinates::Zero(9);
  node(x, 2)[0] = 2.001;
  Derivatives out;
  out.reset(9);
  const ContactResponse response{7, 2};
  const std::vector<Pair> apart{{0, 2}, {1, 2}}, one_place{{0, 1}};
  response.add_derivatives(x, apart, out);
  EXPECT_EQ(response.energy(x, apart), 0);
  response.add_derivatives(x, one_place, out);
  EXPECT_TRUE(out.gradient.isZero(0));
  EXPECT_TRUE(out.hessian.empty());
}

/// A rod along a circle, its nodes `spacing` apart.
Coordinates arc(std::uint32_t n, double radius, double spacing) {
  Coordinates x(3 * n);
  const double turn = 2 * std::asin(spacing / 2 / radius);
  for (std::uint32_t i = 0; i < n; ++i)
    node(x, i) = radius * Eigen::Vector3d(std::cos(turn * i), std::sin(turn * i), 0);
  return x;
}

TEST(Rods, BendLikeAnElasticaToSecondOrder) {
  constexpr double bending = 3, radius = 10;
  double before = 0;
  for (const std::uint32_t n : {51u, 101u, 201u}) {
    const double spacing = 50.0 / (n - 1),
                 bent = spacing * (n - 2);  // the two end edges are straight to the end
    const Rods rod({1e3, bending, spacing}, {0, n});
    const double energy = rod.bending_energy(arc(n, radius, spacing));
    const double error = energy / (bending / 2 / (radius * radius) * bent) - 1;
    EXPECT_NEAR(rod.stretching_energy(arc(n, radius, spacing)), 0, 1e-20);
    if (before != 0) {
      EXPECT_NEAR(before / error, 4, 0.05);
    }
    before = error;
  }
  EXPECT_LT(std::abs(before), 1e-3);
}

TEST(Rods, DoNotFeelARigidMotionAndResistAFoldWithoutBound) {
  const Rods rods({30, 2, 1}, {0, 6, 11});
  const Coordinates x = crumpled(3);
  Coordinates moved = x;
  const Eigen::Matrix3d turn = Eigen::AngleAxisd(1, Eigen::Vector3d(1, 2, 3).normalized()).toRotationMatrix();
  for (std::uint32_t i = 0; i < 11; ++i) node(moved, i) = turn * node(x, i) + Eigen::Vector3d(5, -7, 9);
  EXPECT_NEAR(rods.bending_energy(moved), rods.bending_energy(x), 1e-12);
  EXPECT_NEAR(rods.stretching_energy(moved), rods.stretching_energy(x), 1e-12);

  const Rods three({30, 2, 1}, {0, 3});
  Coordinates fold = Coordinates::Zero(9);
  fold << 1, 0, 0, 0, 0, 0, 1, 1e-3, 0;
  EXPECT_GT(three.bending_energy(fold), 1e6);
}

TEST(Rods, AreStrainedByWhatTheyAreLongerOrShorterBy) {
  const Rods rods({30, 2, 2}, {0, 3, 4});
  Coordinates x = Coordinates::Zero(12);
  EXPECT_EQ(Rods({30, 2, 2}, {0, 1}).greatest_strain(x), 0) << "no edge";
  node(x, 1)[0] = 2.25, node(x, 2)[0] = 4;
  EXPECT_DOUBLE_EQ(rods.greatest_strain(x), 0.125);
  node(x, 2)[0] = 3.75;
  EXPECT_DOUBLE_EQ(rods.greatest_strain(x), 0.25);
}

/// log cosh, from where Newton's full steps fly off.
struct Valley final : Objective {
  double value(const Coordinates& x) const override { return std::log(std::cosh(x[0])); }
  void derivatives(const Coordinates& x, Derivatives& out) const override {
    out.reset(1);
    out.gradient[0] = std::tanh(x[0]);
    out.hessian.emplace_back(0, 0, 1 - out.gradient[0] * out.gradient[0]);
  }
};

/// A saddle at the origin, minima at +-1.
struct TwoWells final : Objective {
  double value(const Coordinates& x) const override { return std::pow(x[0] * x[0] - 1, 2); }
  void derivatives(const Coordinates& x, Derivatives& out) const override {
    out.reset(1);
    out.gradient[0] = 4 * x[0] * (x[0] * x[0] - 1);
    out.hessian.emplace_back(0, 0, 12 * x[0] * x[0] - 4);
  }
};

struct Bottomless final : Objective {
  double value(const Coordinates& x) const override { return x[0]; }
  void derivatives(const Coordinates&, Derivatives& out) const override {
    out.reset(1);
    out.gradient[0] = 1;
    out.hessian.emplace_back(0, 0, 0.0);
  }
};

/// A kink, at which each way leads up, though its derivatives say otherwise: by so much.
struct Kink final : Objective {
  double lowest, slope;
  explicit Kink(double at_least = 0, double told = 1) : lowest(at_least), slope(told) {}
  double value(const Coordinates& x) const override { return lowest + std::abs(x[0]); }
  void derivatives(const Coordinates&, Derivatives& out) const override {
    out.reset(1);
    out.gradient[0] = slope;
    out.hessian.emplace_back(0, 0, 1.0);
  }
};

/// A wall, at whose foot no way is told.
struct Wall final : Objective {
  double value(const Coordinates&) const override { return 1; }
  void derivatives(const Coordinates&, Derivatives& out) const override {
    out.reset(1);
    out.gradient[0] = std::numeric_limits<double>::infinity();
    out.hessian.emplace_back(0, 0, 1.0);
  }
};

TEST(Newton, FindsAMinimumFromWhereFullStepsDoNotAndSaysWhenThereIsNone) {
  Newton newton;
  Coordinates x = Coordinates::Constant(1, 3.0);
  EXPECT_TRUE(newton.minimise(Valley{}, x, 1e-9));
  EXPECT_NEAR(x[0], 0, 1e-9);
  x[0] = 0.1;
  EXPECT_TRUE(newton.minimise(TwoWells{}, x, 1e-9));
  EXPECT_NEAR(std::abs(x[0]), 1, 1e-9);
  x[0] = 0;
  EXPECT_FALSE(newton.minimise(Bottomless{}, x, 1e-9));
  for (const double at : {0.0, 1e-10}) {
    x[0] = at;
    EXPECT_FALSE(newton.minimise(Kink{}, x, 1e-9)) << at;
  }
  x[0] = 0;
  EXPECT_FALSE(newton.minimise(Wall{}, x, 1e-9));
  EXPECT_EQ(x[0], 0);
  EXPECT_FALSE(newton.minimise(Kink(1), x, 1e-9)) << "there is much to gain, as it is told";
  EXPECT_TRUE(newton.minimise(Kink(1, 1e-6), x, 1e-9)) << "less than the rounding of the value";
  EXPECT_FALSE(newton.minimise(Kink(-std::numeric_limits<double>::infinity()), x, 1e-9));
}

/// Each step leaves two thirds of the way to the minimum of x^4: the last one is no longer than the
/// tolerance.
TEST(Newton, GoesOnUntilAStepIsWithinTheTolerance) {
  struct Flat final : Objective {
    double value(const Coordinates& x) const override { return std::pow(x[0], 4); }
    void derivatives(const Coordinates& x, Derivatives& out) const override {
      out.reset(1);
      out.gradient[0] = 4 * std::pow(x[0], 3);
      out.hessian.emplace_back(0, 0, 12 * x[0] * x[0]);
    }
  };
  for (const double tolerance : {1e-2, 1e-5}) {
    Coordinates x = Coordinates::Constant(1, 1.0);
    EXPECT_TRUE(Newton().minimise(Flat{}, x, tolerance));
    EXPECT_LE(x[0], 2.001 * tolerance);
    EXPECT_GT(x[0], tolerance) << "and no further";
  }
}

/// Where full steps do not converge, no step after them leads up.
TEST(Newton, Descends) {
  struct Watched final : Objective {
    mutable std::vector<double> passed;
    double value(const Coordinates& x) const override { return Valley{}.value(x); }
    void derivatives(const Coordinates& x, Derivatives& out) const override {
      passed.push_back(value(x));
      Valley{}.derivatives(x, out);
    }
  };
  for (const double start : {2.0, 2.5, 4.0}) {
    Coordinates x = Coordinates::Constant(1, start);
    const Watched valley;
    EXPECT_TRUE(Newton().minimise(valley, x, 1e-9));
    const auto& passed = valley.passed;
    const auto again = std::find(passed.rbegin(), passed.rend(), passed.front());
    EXPECT_LT(passed.rend() - again, std::ssize(passed)) << "it began again";
    EXPECT_TRUE(std::is_sorted(passed.rbegin(), again)) << start;
  }
}

}  // namespace
}  // namespace catena::motion

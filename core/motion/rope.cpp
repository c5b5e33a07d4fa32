#include "catena/core/motion/rope.h"

#include <algorithm>
#include <numbers>

#include "catena/core/error.h"
#include "catena/core/motion/contact.h"
#include "catena/core/motion/newton.h"
#include "catena/core/motion/rod.h"

namespace catena::motion {
namespace {

constexpr double tolerance = 1e-9;  // of a coordinate, in radii; the step after it is exact to rounding

Coordinates flat(const std::vector<Vec3>& points) {
  Coordinates x(3 * static_cast<Eigen::Index>(points.size()));
  for (std::size_t i = 0; i < points.size(); ++i)
    node(x, static_cast<std::uint32_t>(i)) = Eigen::Vector3d(points[i].x, points[i].y, points[i].z);
  return x;
}

std::vector<Vec3> points(const Coordinates& x) {
  std::vector<Vec3> out(static_cast<std::size_t>(x.size() / 3));
  for (std::size_t i = 0; i < out.size(); ++i) {
    const auto p = node(x, static_cast<std::uint32_t>(i));
    out[i] = {p[0], p[1], p[2]};
  }
  return out;
}

/// What a step minimises: a quadratic form about where inertia leads, the elastic energies, and the load.
struct StepObjective final : Objective {
  const Rods& rods;
  const ContactResponse& response;
  std::span<const Pair> pairs;
  const Coordinates &load, &weight;  // weight of the quadratic form, by coordinate
  Coordinates centre{};

  StepObjective(const Rods& r, const ContactResponse& c, std::span<const Pair> p, const Coordinates& l,
                const Coordinates& w)
      : rods(r), response(c), pairs(p), load(l), weight(w) {}

  double value(const Coordinates& x) const override {
    const Coordinates away = x - centre;
    return away.dot(weight.cwiseProduct(away)) / 2 - load.dot(away) + rods.stretching_energy(x) +
           rods.bending_energy(x) + response.energy(x, pairs);
  }
  void derivatives(const Coordinates& x, Derivatives& out) const override {
    out.reset(x.size());
    out.gradient = weight.cwiseProduct(x - centre) - load;
    for (Eigen::Index k = 0; k < x.size(); ++k)
      out.hessian.emplace_back(static_cast<int>(k), static_cast<int>(k), weight[k]);
    rods.add_derivatives(x, out);
    response.add_derivatives(x, pairs, out);
  }
};

}  // namespace

Exclusion rope_neighbours(double spacing) {
  return Exclusion::index(std::max(1u, static_cast<std::uint32_t>(std::numbers::pi / spacing)));
}

struct RopeMotion::State {
  RopeSettings settings;
  Rods rods;
  ContactResponse response;
  Place place;
  std::unique_ptr<Variant> variant;
  Coordinates mass, load, x, v, x_before, v_before, weight;
  double dt = 0;  // of the last step; 0: there is none
  Chain chain;
  std::vector<Pair> pairs;
  Collisions found;
  EnergyBalance balance;
  double find_ms = 0;
  Newton newton;

  State(const RopeSettings& s, const Start& start, Place p, std::unique_ptr<Variant> found_by)
      : settings(s),
        rods({s.stretching, s.bending, s.spacing}, start.first),
        response{s.contact * s.spacing * s.spacing, 2},
        place(std::move(p)),
        variant(std::move(found_by)),
        x(flat(start.position)),
        v(flat(start.velocity)) {
    mass.setConstant(x.size(), s.spacing);
    load.setZero(x.size());
    for (std::size_t k = 0; k + 1 < start.first.size(); ++k) {
      if (start.first[k] == start.first[k + 1]) continue;
      const std::uint32_t head = start.first[k], tail = start.first[k + 1] - 1;
      node(load, head)[0] -= s.pull, node(load, tail)[0] += s.pull;
      if (head != tail) node(mass, head) /= 2, node(mass, tail) /= 2;
    }
    chain = Chain(stored(x), {start.first, {}}, rope_neighbours(s.spacing));
    const Stopwatch watch;
    variant->build(chain);
    find();
    find_ms = watch.ms();
    tally();
    balance.initial = balance.error();
  }

  std::vector<Sphere> stored(const Coordinates& at) const {
    std::vector<Sphere> spheres;
    for (const Vec3& p : points(at)) spheres.push_back(place(p));
    return spheres;
  }

  void find() {
    variant->find(chain, {}, found);
    pairs = found.pairs;
    std::ranges::sort(pairs);  // so that the order of a sum, too, is the same for every variant
  }

  void tally() {
    balance.kinetic = v.dot(mass.cwiseProduct(v)) / 2;
    balance.stretching = rods.stretching_energy(x);
    balance.bending = rods.bending_energy(x);
    balance.contact = response.energy(x, pairs);
  }

  bool step(double h) {
    const bool again = h == dt;
    const double beta = again ? 2 * h / 3 : h;
    const Coordinates a = again ? Coordinates((4 * x - x_before) / 3) : x;
    const Coordinates b = again ? Coordinates((4 * v - v_before) / 3) : v;
    // m ((x - a) / beta - b) / beta + drag (x - a) / beta = force(x), as the gradient of a quadratic form.
    const double inertia = 1 / (beta * beta), friction = settings.drag / beta;
    weight = (inertia + friction) * mass;
    StepObjective objective(rods, response, pairs, load, weight);
    objective.centre = a + inertia / (inertia + friction) * beta * b;
    Coordinates next = objective.centre;
    if (!newton.minimise(objective, next, tolerance)) return false;
    try {
      chain = chain.moved(stored(next));
    } catch (const InputError&) {
      return false;
    }
    Coordinates next_v = (next - a) / beta;
    balance.work += load.dot(next - x);
    balance.dissipated +=
        h * settings.drag * (v.dot(mass.cwiseProduct(v)) + next_v.dot(mass.cwiseProduct(next_v))) / 2;
    x_before.swap(x), v_before.swap(v);
    x.swap(next), v.swap(next_v);
    dt = h;
    const Stopwatch watch;
    variant->update(chain);
    find();
    find_ms += watch.ms();
    tally();
    return true;
  }
};

RopeMotion::RopeMotion(const RopeSettings& settings, const Start& start, Place place,
                       std::unique_ptr<Variant> variant)
    : state_(std::make_unique<State>(settings, start, std::move(place), std::move(variant))) {}
RopeMotion::~RopeMotion() = default;
RopeMotion::RopeMotion(RopeMotion&&) noexcept = default;
RopeMotion& RopeMotion::operator=(RopeMotion&&) noexcept = default;

bool RopeMotion::step(double dt) { return state_->step(dt); }
const Chain& RopeMotion::chain() const { return state_->chain; }
std::span<const Pair> RopeMotion::contacts() const { return state_->pairs; }
std::vector<Vec3> RopeMotion::positions() const { return points(state_->x); }
std::vector<Vec3> RopeMotion::velocities() const { return points(state_->v); }
EnergyBalance RopeMotion::energy() const { return state_->balance; }
double RopeMotion::greatest_strain() const { return state_->rods.greatest_strain(state_->x); }
double RopeMotion::find_ms() const { return state_->find_ms; }

double RopeMotion::deepest_penetration() const {
  const Coordinates& x = state_->x;
  const Chain& chain = state_->chain;
  double deepest = 0;
  for (std::uint32_t i = 0; i < chain.size(); ++i)
    for (std::uint32_t j = i + 1; j < chain.size(); ++j) {
      const double depth = state_->response.reach - (node(x, j) - node(x, i)).norm();
      if (depth > deepest && !chain.neighbours(i, j)) deepest = depth;
    }
  return deepest;
}

}  // namespace catena::motion

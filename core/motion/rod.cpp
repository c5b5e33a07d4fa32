#include "catena/core/motion/rod.h"

#include <algorithm>
#include <cmath>

namespace catena::motion {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;

/// The cosine of the angle between two edges, with its derivatives by both.
struct Cosine {
  Vector3d t1, t2;  // directions of the edges
  double l1, l2, value;

  Cosine(const Vector3d& e1, const Vector3d& e2)
      : t1(e1.normalized()), t2(e2.normalized()), l1(e1.norm()), l2(e2.norm()), value(t1.dot(t2)) {}
  Vector3d by_first() const { return (t2 - value * t1) / l1; }
  Vector3d by_second() const { return (t1 - value * t2) / l2; }
  Matrix3d by_first_twice() const { return twice(t1, t2, l1); }
  Matrix3d by_second_twice() const { return twice(t2, t1, l2); }
  Matrix3d by_both() const {
    const Matrix3d one = Matrix3d::Identity();
    return (one - t1 * t1.transpose()) * (one - t2 * t2.transpose()) / (l1 * l2);
  }

 private:
  Matrix3d twice(const Vector3d& own, const Vector3d& other, double length) const {
    return (3 * value * own * own.transpose() - own * other.transpose() - other * own.transpose() -
            value * Matrix3d::Identity()) /
           (length * length);
  }
};

}  // namespace

template <class Visit>
void Rods::each_edge(const Visit& visit) const {
  for (std::size_t k = 0; k + 1 < first_.size(); ++k)
    for (std::uint32_t i = first_[k]; i + 1 < first_[k + 1]; ++i) visit(i);
}

template <class Visit>
void Rods::each_bend(const Visit& visit) const {
  for (std::size_t k = 0; k + 1 < first_.size(); ++k)
    for (std::uint32_t i = first_[k] + 1; i + 1 < first_[k + 1]; ++i) visit(i);
}

double Rods::stretching_energy(const Coordinates& x) const {
  double sum = 0;
  each_edge([&](std::uint32_t i) {
    const double longer = (node(x, i + 1) - node(x, i)).norm() - material_.spacing;
    sum += longer * longer;
  });
  return material_.stretching / (2 * material_.spacing) * sum;
}

double Rods::bending_energy(const Coordinates& x) const {
  double sum = 0;
  each_bend([&](std::uint32_t i) {
    const Cosine c(node(x, i) - node(x, i - 1), node(x, i + 1) - node(x, i));
    // 1 - cosine, without cancellation; |curvature|^2 spacing^2 = 4 tan^2(angle / 2).
    sum += 2 * (c.t1 - c.t2).squaredNorm() / (1 + c.value);
  });
  return material_.bending / (2 * material_.spacing) * sum;
}

double Rods::greatest_strain(const Coordinates& x) const {
  double greatest = 0;
  each_edge([&](std::uint32_t i) {
    const double length = (node(x, i + 1) - node(x, i)).norm();
    greatest = std::max(greatest, std::abs(length / material_.spacing - 1));
  });
  return greatest;
}

void Rods::add_derivatives(const Coordinates& x, Derivatives& out) const {
  const Matrix3d one = Matrix3d::Identity();
  each_edge([&](std::uint32_t i) {
    const Vector3d e = node(x, i + 1) - node(x, i);
    const double length = e.norm(), stiffness = material_.stretching / material_.spacing;
    const Vector3d t = e / length;
    const Vector3d tension = stiffness * (length - material_.spacing) * t;
    const Matrix3d h = stiffness * (one - material_.spacing / length * (one - t * t.transpose()));
    out.add_gradient(i, -tension), out.add_gradient(i + 1, tension);
    out.add_block(i, i, h), out.add_block(i + 1, i + 1, h), out.add_block(i + 1, i, -h);
  });
  each_bend([&](std::uint32_t i) {
    // The energy is a function of the cosine alone: 2 B / spacing * (1 - c) / (1 + c).
    const Cosine c(node(x, i) - node(x, i - 1), node(x, i + 1) - node(x, i));
    const double stiffness = material_.bending / material_.spacing, up = 1 + c.value;
    const double first = -4 * stiffness / (up * up), second = 8 * stiffness / (up * up * up);
    const Vector3d g1 = c.by_first(), g2 = c.by_second();
    const Matrix3d h11 = second * g1 * g1.transpose() + first * c.by_first_twice(),
                   h22 = second * g2 * g2.transpose() + first * c.by_second_twice(),
                   h12 = second * g1 * g2.transpose() + first * c.by_both();
    const Matrix3d h21 = h12.transpose();
    // Edge 1 is x(i) - x(i - 1), edge 2 is x(i + 1) - x(i).
    out.add_gradient(i - 1, -first * g1), out.add_gradient(i, first * (g1 - g2));
    out.add_gradient(i + 1, first * g2);
    out.add_block(i - 1, i - 1, h11), out.add_block(i, i, h11 - h12 - h21 + h22);
    out.add_block(i + 1, i + 1, h22), out.add_block(i, i - 1, h21 - h11);
    out.add_block(i + 1, i, h21 - h22), out.add_block(i + 1, i - 1, -h21);
  });
}

}  // namespace catena::motion

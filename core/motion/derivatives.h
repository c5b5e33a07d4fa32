#pragma once
#include <Eigen/Dense>
#include <Eigen/SparseCore>
#include <cstdint>
#include <vector>

namespace catena::motion {

/// Coordinates (x, y, z) of node i at 3i, 3i + 1, 3i + 2, binary64. Also velocities and forces.
using Coordinates = Eigen::VectorXd;

/// The x, y, z of node i, i < x.size() / 3: a view into x.
inline auto node(const Coordinates& x, std::uint32_t i) { return x.segment<3>(3 * Eigen::Index{i}); }
/// The same, to be written to.
inline auto node(Coordinates& x, std::uint32_t i) { return x.segment<3>(3 * Eigen::Index{i}); }

/// Gradient and Hessian of an energy, added up term by term. Of the symmetric Hessian the lower triangle is
/// kept.
struct Derivatives {
  Coordinates gradient;
  std::vector<Eigen::Triplet<double>> hessian;

  void reset(Eigen::Index size) {
    gradient.setZero(size);
    hessian.clear();
  }
  void add_gradient(std::uint32_t i, const Eigen::Vector3d& g) { node(gradient, i) += g; }
  /// The block of rows of node i and columns of node j; for i != j the transposed block is meant too.
  void add_block(std::uint32_t i, std::uint32_t j, const Eigen::Matrix3d& h) {
    for (int r = 0; r < 3; ++r)
      for (int c = 0; c < 3; ++c) {
        if (i == j && c > r) continue;
        const int row = static_cast<int>(3 * i) + r, column = static_cast<int>(3 * j) + c;
        hessian.emplace_back(std::max(row, column), std::min(row, column), h(r, c));
      }
  }
};

}  // namespace catena::motion

#include "catena/bench/fit/least_squares.h"

#include <Eigen/Dense>
#include <cstddef>
#include <stdexcept>

namespace catena::bench {

LeastSquares least_squares(const std::vector<std::vector<double>>& terms, const std::vector<double>& values) {
  const std::size_t unknown = terms.empty() ? 0 : terms.front().size();
  if (unknown == 0 || terms.size() < unknown || terms.size() != values.size())
    throw std::logic_error("least_squares: needs a row for each value, and no fewer than coefficients");
  const auto rows = static_cast<Eigen::Index>(terms.size()), columns = static_cast<Eigen::Index>(unknown);
  Eigen::MatrixXd matrix(rows, columns);
  for (Eigen::Index row = 0; row < rows; ++row) {
    const std::vector<double>& of_row = terms[static_cast<std::size_t>(row)];
    if (of_row.size() != unknown) throw std::logic_error("least_squares: rows of several lengths");
    matrix.row(row) = Eigen::Map<const Eigen::RowVectorXd>(of_row.data(), columns);
  }
  const Eigen::Map<const Eigen::VectorXd> right(values.data(), rows);
  const Eigen::MatrixXd inverse = (matrix.transpose() * matrix).inverse();
  const Eigen::VectorXd best = inverse * matrix.transpose() * right, variance = inverse.diagonal();
  return {
      {best.begin(), best.end()}, {variance.begin(), variance.end()}, (right - matrix * best).squaredNorm()};
}

}  // namespace catena::bench

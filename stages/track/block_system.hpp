#pragma once

#include <Eigen/Core>
#include <Eigen/SparseCholesky>
#include <memory>
#include <utility>
#include <vector>

namespace sediment::track {

using Block = Eigen::Matrix<double, 6, 6>;
using Vector6 = Eigen::Matrix<double, 6, 1>;

/// The structure of a symmetric matrix of 6 x 6 blocks, and its solution. Values are kept outside, one block
/// for each pair (row <= column) that may differ from zero, so that several threads can fill their own.
class BlockSystem {
 public:
  /// `pairs` may repeat and need no order; all pairs on the diagonal are added.
  BlockSystem(int rows, std::vector<std::pair<int, int>> pairs);

  int rows() const { return rows_; }
  std::size_t blocks() const { return pairs_.size(); }
  /// Where the block of a pair is kept, row <= column.
  int position(int row, int column) const {
    return positions_[static_cast<std::size_t>(row) * rows_ + column];
  }
  int diagonal(int row) const { return position(row, row); }

  /// x of matrix * x = right by Cholesky's method, dense or sparse, whichever has less to do; empty if the
  /// matrix is not positive definite.
  std::vector<Vector6> solve(const std::vector<Block>& values, const std::vector<Vector6>& right);

 private:
  Eigen::VectorXd solve_dense(const std::vector<Block>& values, const Eigen::VectorXd& right) const;
  Eigen::VectorXd solve_sparse(const std::vector<Block>& values, const Eigen::VectorXd& right);

  int rows_;
  std::vector<std::pair<int, int>> pairs_;
  std::vector<int> positions_;
  std::unique_ptr<Eigen::SimplicialLLT<Eigen::SparseMatrix<double>, Eigen::Upper>> sparse_;
};

}  // namespace sediment::track

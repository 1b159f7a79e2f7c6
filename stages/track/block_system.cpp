#include "stages/track/block_system.hpp"

#include <Eigen/Cholesky>
#include <algorithm>

namespace sediment::track {

BlockSystem::BlockSystem(int rows, std::vector<std::pair<int, int>> pairs)
    : rows_(rows), pairs_(std::move(pairs)), positions_(static_cast<std::size_t>(rows) * rows, -1) {
  for (int row = 0; row < rows; ++row) pairs_.emplace_back(row, row);
  std::sort(pairs_.begin(), pairs_.end());
  pairs_.erase(std::unique(pairs_.begin(), pairs_.end()), pairs_.end());
  for (std::size_t i = 0; i < pairs_.size(); ++i)
    positions_[static_cast<std::size_t>(pairs_[i].first) * rows + pairs_[i].second] = static_cast<int>(i);
}

Eigen::VectorXd BlockSystem::solve_dense(const std::vector<Block>& values,
                                         const Eigen::VectorXd& right) const {
  Eigen::MatrixXd matrix = Eigen::MatrixXd::Zero(6 * rows_, 6 * rows_);
  for (std::size_t i = 0; i < pairs_.size(); ++i)
    matrix.block<6, 6>(6 * pairs_[i].second, 6 * pairs_[i].first) = values[i].transpose();
  const Eigen::LLT<Eigen::Ref<Eigen::MatrixXd>> cholesky(matrix);
  if (cholesky.info() != Eigen::Success) return {};
  return cholesky.solve(right);
}

Eigen::VectorXd BlockSystem::solve_sparse(const std::vector<Block>& values, const Eigen::VectorXd& right) {
  std::vector<Eigen::Triplet<double>> entries;
  entries.reserve(36 * pairs_.size());
  for (std::size_t i = 0; i < pairs_.size(); ++i)
    for (int column = 0; column < 6; ++column)
      for (int row = 0; row < 6; ++row)
        if (pairs_[i].first != pairs_[i].second || row <= column)
          entries.emplace_back(6 * pairs_[i].first + row, 6 * pairs_[i].second + column,
                               values[i](row, column));
  Eigen::SparseMatrix<double> matrix(6 * rows_, 6 * rows_);
  matrix.setFromTriplets(entries.begin(), entries.end());
  if (!sparse_) {
    sparse_ = std::make_unique<Eigen::SimplicialLLT<Eigen::SparseMatrix<double>, Eigen::Upper>>();
    sparse_->analyzePattern(matrix);
  }
  sparse_->factorize(matrix);
  if (sparse_->info() != Eigen::Success) return {};
  return sparse_->solve(right);
}

std::vector<Vector6> BlockSystem::solve(const std::vector<Block>& values, const std::vector<Vector6>& right) {
  // A sparse factor fills up, and its arithmetic is several times slower.
  constexpr int kSmall = 40;
  constexpr double kDenseShare = 0.3;
  if (rows_ == 0) return {};
  const Eigen::Map<const Eigen::VectorXd> flat(right.front().data(), 6 * rows_);
  const double share = 2.0 * static_cast<double>(pairs_.size()) / (static_cast<double>(rows_) * (rows_ + 1));
  const Eigen::VectorXd x =
      rows_ <= kSmall || share > kDenseShare ? solve_dense(values, flat) : solve_sparse(values, flat);
  std::vector<Vector6> result;
  if (x.size() == 0 || !x.allFinite()) return result;
  for (int row = 0; row < rows_; ++row) result.push_back(x.segment<6>(6 * row));
  return result;
}

}  // namespace sediment::track

#include "dem/statics/incomplete_factor.h"

#include <Eigen/LU>

namespace dem
{
  bool IncompleteFactor::compute(const BlockMatrix &matrix, const Eigen::VectorXd &on_diagonal)
  {
    factor.assign(1, matrix);
    inverse.resize(static_cast<std::size_t>(matrix.rows()));
    std::vector<int> place_of_column(inverse.size(), -1);
    for (int row = 0; row < matrix.rows(); ++row)
      {
        factor[0].block(matrix.diagonal(row)).diagonal() += on_diagonal.segment<motions>(motions * row);
        eliminate(row, place_of_column);
        Block &pivot = inverse[static_cast<std::size_t>(row)];
        pivot        = factor[0].block(matrix.diagonal(row)).inverse();
        if (!pivot.allFinite())
          return false;
      }
    return true;
  }

  void IncompleteFactor::eliminate(const int row, std::vector<int> &place_of_column)
  {
    BlockMatrix &f  = factor[0];
    const auto   at = [&](const int column) -> int   &{ return place_of_column[static_cast<std::size_t>(column)]; };
    for (int k = f.begin(row); k < f.begin(row + 1); ++k)
      at(f.column(k)) = k;
    for (int k = f.begin(row); k < f.diagonal(row); ++k)
      {
        const int   above = f.column(k);
        const Block share = f.block(k) * inverse[static_cast<std::size_t>(above)];
        f.block(k)        = share;
        for (int q = f.diagonal(above) + 1; q < f.begin(above + 1); ++q)
          if (const int target = at(f.column(q)); target >= 0)
            f.block(target).noalias() -= share * f.block(q);
      }
    for (int k = f.begin(row); k < f.begin(row + 1); ++k)
      at(f.column(k)) = -1;
  }

  void IncompleteFactor::apply(const Eigen::VectorXd &r, Eigen::VectorXd &z) const
  {
    using Row            = Eigen::Matrix<double, motions, 1>;
    const BlockMatrix &f = factor[0];
    for (int row = 0; row < f.rows(); ++row)
      {
        Row sum = r.segment<motions>(motions * row);
        for (int k = f.begin(row); k < f.diagonal(row); ++k)
          sum.noalias() -= f.block(k) * z.segment<motions>(motions * f.column(k));
        z.segment<motions>(motions * row) = sum;
      }
    for (int row = f.rows() - 1; row >= 0; --row)
      {
        Row sum = z.segment<motions>(motions * row);
        for (int k = f.diagonal(row) + 1; k < f.begin(row + 1); ++k)
          sum.noalias() -= f.block(k) * z.segment<motions>(motions * f.column(k));
        z.segment<motions>(motions * row).noalias() = inverse[static_cast<std::size_t>(row)] * sum;
      }
  }
} // namespace dem

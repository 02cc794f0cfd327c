#include "dem/linear/block_matrix.h"

#include <algorithm>

namespace dem
{
  BlockPattern::BlockPattern(const int rows, const std::vector<std::pair<int, int>> &joined)
    : begin_{0}
  {
    std::vector<std::vector<int>> neighbours(static_cast<std::size_t>(rows));
    for (int row = 0; row < rows; ++row)
      neighbours[static_cast<std::size_t>(row)].push_back(row);
    for (const auto &[a, b] : joined)
      {
        neighbours.at(static_cast<std::size_t>(a)).push_back(b);
        neighbours.at(static_cast<std::size_t>(b)).push_back(a);
      }
    for (std::vector<int> &of_row : neighbours)
      {
        std::sort(of_row.begin(), of_row.end());
        of_row.erase(std::unique(of_row.begin(), of_row.end()), of_row.end());
        const auto row = static_cast<int>(diagonal_.size());
        const auto own = std::lower_bound(of_row.begin(), of_row.end(), row) - of_row.begin();
        diagonal_.push_back(begin_.back() + static_cast<int>(own));
        columns.insert(columns.end(), of_row.begin(), of_row.end());
        begin_.push_back(static_cast<int>(columns.size()));
      }
  }

  int BlockPattern::place(const int row, const int column) const
  {
    const auto first = columns.begin() + begin(row), last = columns.begin() + begin(row + 1);
    return static_cast<int>(std::lower_bound(first, last, column) - columns.begin());
  }

  BlockMatrix::BlockMatrix(const int rows, const std::vector<std::pair<int, int>> &joined)
    : of(std::make_shared<BlockPattern>(rows, joined))
    , wide(static_cast<std::size_t>(of->blocks()), WideBlock<double>::Zero())
  {
  }

  BlockMatrix::BlockMatrix(std::shared_ptr<const BlockPattern> pattern)
    : of(std::move(pattern))
    , wide(static_cast<std::size_t>(of->blocks()), WideBlock<double>::Zero())
  {
  }

  void BlockMatrix::set_zero()
  {
    for (WideBlock<double> &b : wide)
      b.setZero();
  }

  void BlockMatrix::hold(const int row, const HeldMotions held, const double unit)
  {
    for (int k = begin(row); held != 0 && k < begin(row + 1); ++k)
      for (int c = 0; c < motions; ++c)
        if (held >> c & 1)
          {
            block(k).row(c).setZero();
            block(place(column(k), row)).col(c).setZero();
          }
    for (int c = 0; c < motions; ++c)
      if (held >> c & 1)
        block(diagonal(row))(c, c) = unit;
  }

  template <int n>
  void BlockMatrix::multiply_row(const int            row,
                                 const double *const  x,
                                 const std::ptrdiff_t x_apart,
                                 double *const        y,
                                 const std::ptrdiff_t y_apart) const
  {
    alignas(64) double out[pack_size];
    Pack               sum[n];
    for (Pack &s : sum)
      s = 0.0;
    for (int k = begin(row); k < begin(row + 1); ++k)
      {
        const double *const block = wide[static_cast<std::size_t>(k)].data();
        const double *const from  = x + static_cast<std::ptrdiff_t>(motions) * column(k);
        for (int c = 0; c < motions; ++c)
          {
            const Pack of_block = load(block + pack_size * c);
            for (int i = 0; i < n; ++i)
              sum[i] = multiply_add(of_block, Pack(from[i * x_apart + c]), sum[i]);
          }
      }
    for (int i = 0; i < n; ++i)
      {
        store(sum[i], out);
        std::copy_n(out, motions, y + i * y_apart);
      }
  }

  template <int n>
  void BlockMatrix::multiply(const Columns<n> &x, Columns<n> &y) const
  {
    for (int row = 0; row < rows(); ++row)
      multiply_row<n>(row, x.data(), x.rows(), y.data() + motions * row, y.rows());
  }

  void BlockMatrix::multiply(const double *const x, const int first, const int end, double *const y) const
  {
#pragma omp parallel for schedule(static)
    for (int row = first; row < end; ++row)
      multiply_row<1>(row, x, 0, y + static_cast<std::ptrdiff_t>(motions) * (row - first), 0);
  }

  template void BlockMatrix::multiply(const Columns<1> &, Columns<1> &) const;
  template void BlockMatrix::multiply(const Columns<motions> &, Columns<motions> &) const;
} // namespace dem

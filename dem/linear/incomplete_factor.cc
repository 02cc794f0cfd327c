#include "dem/linear/incomplete_factor.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace dem
{
  namespace
  {
    template <typename Number>
    using Wide = PackOf<Number, pack_size>;

    template <typename Number>
    BRECCIA_KERNEL Wide<Number> column_of(const WideBlock<Number> &block, const int c)
    {
      return Wide<Number>::load_unaligned(block.data() + pack_size * c);
    }

    template <typename Number>
    BRECCIA_KERNEL void put(const Wide<Number> &column, WideBlock<Number> &block, const int c)
    {
      column.store_unaligned(block.data() + pack_size * c);
    }

    template <typename Number>
    WideBlock<Number> product(const WideBlock<Number> &a, const WideBlock<Number> &b)
    {
      WideBlock<Number> all;
      for (int j = 0; j < motions; ++j)
        {
          Wide<Number> sum = column_of(a, 0) * Wide<Number>(b(0, j));
          for (int k = 1; k < motions; ++k)
            sum += column_of(a, k) * Wide<Number>(b(k, j));
          put<Number>(sum, all, j);
        }
      return all;
    }

    /** c -= a b */
    template <typename Number>
    void subtract_product(const WideBlock<Number> &a, const WideBlock<Number> &b, WideBlock<Number> &c)
    {
      for (int j = 0; j < motions; ++j)
        {
          Wide<Number> sum = column_of(c, j);
          for (int k = 0; k < motions; ++k)
            sum -= column_of(a, k) * Wide<Number>(b(k, j));
          put<Number>(sum, c, j);
        }
    }

    /** By Gauss-Jordan elimination of columns, with the largest entry of each row as pivot; not finite if it is singular. */
    WideBlock<double> inverse_of(WideBlock<double> a)
    {
      WideBlock<double> inverse                     = WideBlock<double>::Zero();
      inverse.topRows<motions>().diagonal().array() = 1;
      for (int p = 0; p < motions; ++p)
        {
          int largest = p;
          for (int j = p + 1; j < motions; ++j)
            if (std::fabs(a(p, j)) > std::fabs(a(p, largest)))
              largest = j;
          a.col(p).swap(a.col(largest));
          inverse.col(p).swap(inverse.col(largest));
          const Pack scale(1 / a(p, p)), pivot = column_of(a, p) * scale, made = column_of(inverse, p) * scale;
          put<double>(pivot, a, p);
          put<double>(made, inverse, p);
          for (int j = 0; j < motions; ++j)
            if (j != p)
              {
                const Pack much(a(p, j));
                put<double>(column_of(a, j) - much * pivot, a, j);
                put<double>(column_of(inverse, j) - much * made, inverse, j);
              }
        }
      return inverse;
    }
  } // namespace

  template <typename Number>
  bool IncompleteFactor<Number>::compute(const BlockMatrix &matrix, const Eigen::VectorXd &on_diagonal)
  {
    pattern = matrix.pattern();
    factor.resize(static_cast<std::size_t>(pattern->blocks()));
    inverse.resize(static_cast<std::size_t>(pattern->rows()));
    place_of_column.assign(inverse.size(), -1);
    for (int k = 0; k < pattern->blocks(); ++k)
      {
        WideBlock<Number> &f          = factor[static_cast<std::size_t>(k)];
        f.template topRows<motions>() = matrix.block(k).template cast<Number>();
        f.template bottomRows<pack_size - motions>().setZero();
      }
    for (int row = 0; row < pattern->rows(); ++row)
      {
        WideBlock<Number> &own = factor[static_cast<std::size_t>(pattern->diagonal(row))];
        own.template topRows<motions>().diagonal() +=
          on_diagonal.segment<motions>(motions * row).template cast<Number>();
        eliminate(row);
        const WideBlock<double> pivot = inverse_of(own.template cast<double>());
        if (!pivot.allFinite())
          return false;
        inverse[static_cast<std::size_t>(row)] = pivot.template cast<Number>();
      }
    return true;
  }

  template <typename Number>
  void IncompleteFactor<Number>::eliminate(const int row)
  {
    const BlockPattern &p = *pattern;
    const auto at = [&](const int column) -> int & { return place_of_column[static_cast<std::size_t>(column)]; };
    const auto f  = [&](const int k) -> WideBlock<Number>  &{ return factor[static_cast<std::size_t>(k)]; };
    for (int k = p.begin(row); k < p.begin(row + 1); ++k)
      at(p.column(k)) = k;
    for (int k = p.begin(row); k < p.diagonal(row); ++k)
      {
        const int               above = p.column(k);
        const WideBlock<Number> share = product(f(k), inverse[static_cast<std::size_t>(above)]);
        f(k)                          = share;
        for (int q = p.diagonal(above) + 1; q < p.begin(above + 1); ++q)
          if (const int target = at(p.column(q)); target >= 0)
            subtract_product(share, f(q), f(target));
      }
    for (int k = p.begin(row); k < p.begin(row + 1); ++k)
      at(p.column(k)) = -1;
  }

  template <typename Number>
  template <int n>
  void IncompleteFactor<Number>::apply(const std::array<const double *, n> &r, const std::array<Number *, n> &z)
  {
    using Column               = Wide<Number>;
    const BlockPattern &p      = *pattern;
    constexpr int       of_row = n * pack_size;
    work.resize(static_cast<std::size_t>(of_row * p.rows()));
    const auto at       = [this](const int row) { return work.data() + of_row * row; };
    const auto subtract = [&](const int first, const int end, Column(&sum)[n]) {
      for (int k = first; k < end; ++k)
        {
          const WideBlock<Number> &block = factor[static_cast<std::size_t>(k)];
          const Number *const      from  = at(p.column(k));
          for (int c = 0; c < motions; ++c)
            {
              const Column column = column_of(block, c);
              for (int i = 0; i < n; ++i)
                sum[i] -= column * Column(from[pack_size * i + c]);
            }
        }
    };
    Column sum[n];
    for (int row = 0; row < p.rows(); ++row)
      {
        Number *const own = at(row);
        for (int i = 0; i < n; ++i)
          {
            for (int c = 0; c < motions; ++c)
              own[pack_size * i + c] = static_cast<Number>(r[static_cast<std::size_t>(i)][motions * row + c]);
            std::fill_n(own + pack_size * i + motions, pack_size - motions, Number(0));
            sum[i] = Column::load_unaligned(own + pack_size * i);
          }
        subtract(p.begin(row), p.diagonal(row), sum);
        for (int i = 0; i < n; ++i)
          sum[i].store_unaligned(own + pack_size * i);
      }
    for (int row = p.rows() - 1; row >= 0; --row)
      {
        Number *const own = at(row);
        for (int i = 0; i < n; ++i)
          sum[i] = Column::load_unaligned(own + pack_size * i);
        subtract(p.diagonal(row) + 1, p.begin(row + 1), sum);
        for (int i = 0; i < n; ++i)
          {
            sum[i].store_unaligned(own + pack_size * i);
            Column solved(Number(0));
            for (int c = 0; c < motions; ++c)
              solved += column_of(inverse[static_cast<std::size_t>(row)], c) * Column(own[pack_size * i + c]);
            solved.store_unaligned(own + pack_size * i);
            std::copy_n(own + pack_size * i, motions, z[static_cast<std::size_t>(i)] + motions * row);
          }
      }
  }

  template class IncompleteFactor<float>;
  template class IncompleteFactor<double>;
  template void IncompleteFactor<float>::apply<1>(const std::array<const double *, 1> &,
                                                  const std::array<float *, 1> &);
  template void IncompleteFactor<float>::apply<motions>(const std::array<const double *, motions> &,
                                                        const std::array<float *, motions> &);
  template void IncompleteFactor<double>::apply<1>(const std::array<const double *, 1> &,
                                                   const std::array<double *, 1> &);
} // namespace dem

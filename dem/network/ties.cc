#include "dem/network/ties.h"

#include "base/errors.h"

#include <Eigen/OrderingMethods>
#include <Eigen/SparseQR>

#include <algorithm>
#include <cmath>

namespace dem
{
  namespace
  {
    using Sparse = Eigen::SparseMatrix<double>;

    /** Rows of unit length, without those that are empty. */
    Sparse rows_of(const std::vector<Tie> &ties, const std::vector<HeldMotions> &held, const double scale)
    {
      std::vector<Eigen::Triplet<double>> entries;
      int                                 row = 0;
      for (const Tie &tie : ties)
        {
          double squares = 0;
          Tie    free;
          for (TieTerm term : tie)
            if (!(held.at(term.carrier) >> term.motion & 1) && term.weight != 0)
              {
                term.weight /= term.motion < 3 ? 1 : scale;
                squares += term.weight * term.weight;
                free.push_back(term);
              }
          for (const TieTerm &term : free)
            entries.emplace_back(row, static_cast<int>(motions * term.carrier) + term.motion,
                                 term.weight / std::sqrt(squares));
          row += !free.empty();
        }
      Sparse rows(row, static_cast<Eigen::Index>(motions * held.size()));
      rows.setFromTriplets(entries.begin(), entries.end());
      return rows;
    }

    /** Of each row the motion that no other has; empty where one has none that weighs enough. */
    std::vector<Eigen::Index> motions_of_their_own(const Sparse &rows)
    {
      constexpr double                                   enough = 0.1; // of a row's length
      const Eigen::SparseMatrix<double, Eigen::RowMajor> by_row = rows;
      std::vector<Eigen::Index>                          own;
      for (Eigen::Index row = 0; row < rows.rows(); ++row)
        {
          Eigen::Index best = -1;
          double       most = enough;
          for (Eigen::SparseMatrix<double, Eigen::RowMajor>::InnerIterator entry(by_row, row); entry; ++entry)
            if (rows.col(entry.col()).nonZeros() == 1 && std::fabs(entry.value()) > most)
              {
                best = entry.col();
                most = std::fabs(entry.value());
              }
          if (best < 0)
            return {};
          own.push_back(best);
        }
      return own;
    }

    /** As many rows as are independent of each other. */
    Sparse independent(const Sparse &rows)
    {
      if (rows.rows() == 0 || !motions_of_their_own(rows).empty())
        return rows;
      constexpr double rounding = 1e-8;
      Sparse           columns  = rows.transpose();
      columns.makeCompressed();
      Eigen::SparseQR<Sparse, Eigen::COLAMDOrdering<int>> qr;
      qr.setPivotThreshold(rounding);
      qr.compute(columns);
      if (qr.info() != Eigen::Success)
        throw base::NumericalError("ties: the conditions cannot be distinguished.");
      std::vector<Eigen::Triplet<double>> kept;
      for (Eigen::Index k = 0; k < qr.rank(); ++k)
        for (Sparse::InnerIterator entry(columns, qr.colsPermutation().indices()[k]); entry; ++entry)
          kept.emplace_back(static_cast<int>(k), static_cast<int>(entry.row()), entry.value());
      Sparse result(qr.rank(), rows.cols());
      result.setFromTriplets(kept.begin(), kept.end());
      return result;
    }

    Sparse leading(const Sparse &rows, const std::vector<Eigen::Index> &own)
    {
      if (own.empty())
        return Sparse(rows.cols(), 0);
      std::vector<Eigen::Index> driven_by(static_cast<std::size_t>(rows.cols()), -1); // the row
      for (std::size_t row = 0; row < own.size(); ++row)
        driven_by[static_cast<std::size_t>(own[row])] = static_cast<Eigen::Index>(row);
      std::vector<Eigen::Triplet<double>> entries;
      for (Eigen::Index column = 0; column < rows.cols(); ++column)
        {
          if (driven_by[static_cast<std::size_t>(column)] >= 0)
            continue;
          entries.emplace_back(column, column, 1.0);
          for (Sparse::InnerIterator entry(rows, column); entry; ++entry)
            {
              const Eigen::Index driven = own[static_cast<std::size_t>(entry.row())];
              entries.emplace_back(driven, column, -entry.value() / rows.coeff(entry.row(), driven));
            }
        }
      Sparse result(rows.cols(), rows.cols());
      result.setFromTriplets(entries.begin(), entries.end());
      return result;
    }
    Sparse led_by(const Sparse &rows) { return leading(rows, motions_of_their_own(rows)); }

    /** Columns of leaders that lead others. */
    Sparse of_many(const Sparse &leaders)
    {
      std::vector<Eigen::Triplet<double>> entries;
      int                                 column = 0;
      for (Eigen::Index leader = 0; leader < leaders.cols(); ++leader)
        {
          if (leaders.col(leader).nonZeros() < 2)
            continue;
          for (Sparse::InnerIterator entry(leaders, leader); entry; ++entry)
            entries.emplace_back(static_cast<int>(entry.row()), column, entry.value());
          ++column;
        }
      Sparse columns(leaders.rows(), column);
      columns.setFromTriplets(entries.begin(), entries.end());
      return columns;
    }
  } // namespace

  TieFactor::TieFactor(const Sparse &rows, const Eigen::VectorXd &weights, const std::vector<Eigen::Index> &own)
  {
    if (std::any_of(own.begin(), own.end(), [&](const Eigen::Index motion) { return weights[motion] == 0; }) ||
        own.empty())
      {
        factor.compute(Sparse(rows * weights.asDiagonal() * rows.transpose()));
        return;
      }
    inverse_own.resize(rows.rows());
    std::vector<bool> is_own(static_cast<std::size_t>(rows.cols()), false);
    for (Eigen::Index row = 0; row < rows.rows(); ++row)
      {
        const Eigen::Index motion                = own[static_cast<std::size_t>(row)];
        const double       d                     = rows.coeff(row, motion);
        inverse_own[row]                         = 1 / (d * weights[motion] * d);
        is_own[static_cast<std::size_t>(motion)] = true;
      }
    std::vector<Eigen::Triplet<double>> entries;
    std::vector<double>                 inverse_weights;
    for (Eigen::Index column = 0; column < rows.cols(); ++column)
      if (!is_own[static_cast<std::size_t>(column)] && weights[column] != 0 && rows.col(column).nonZeros() > 0)
        {
          for (Sparse::InnerIterator entry(rows, column); entry; ++entry)
            entries.emplace_back(static_cast<int>(entry.row()), static_cast<int>(inverse_weights.size()),
                                 entry.value());
          inverse_weights.push_back(1 / weights[column]);
        }
    const auto n = static_cast<Eigen::Index>(inverse_weights.size());
    others.resize(rows.rows(), n);
    others.setFromTriplets(entries.begin(), entries.end());
    Sparse inner = others.transpose() * inverse_own.asDiagonal() * others;
    for (Eigen::Index column = 0; column < n; ++column)
      inner.coeffRef(column, column) += inverse_weights[static_cast<std::size_t>(column)];
    if (n > 0)
      factor.compute(inner);
  }

  Eigen::VectorXd TieFactor::solve(const Eigen::VectorXd &b) const
  {
    if (inverse_own.size() == 0)
      return factor.solve(b);
    const Eigen::VectorXd first = inverse_own.cwiseProduct(b);
    if (others.cols() == 0)
      return first;
    return first - inverse_own.cwiseProduct(others * factor.solve(others.transpose() * first));
  }

  Ties::Ties(const std::vector<Tie>         &ties,
             const std::vector<HeldMotions> &held,
             const double                    length,
             const std::vector<Tie>         &smooth)
    : scale(length)
    , conditions(independent(rows_of(ties, held, length)))
    , own(motions_of_their_own(conditions))
    , leaders(leading(conditions, own))
    , common(of_many(smooth.empty() ? leaders : led_by(rows_of(smooth, held, length))))
    , factor(conditions, Eigen::VectorXd::Ones(conditions.cols()), own)
  {
  }

  Eigen::VectorXd Ties::lengths_of(const CarrierMotions &motion, const double factor_of_rotations) const
  {
    CarrierMotions lengths = motion;
    lengths.bottomRows<3>() *= factor_of_rotations;
    return lengths.reshaped();
  }

  void Ties::release(CarrierMotions &forces) const
  {
    const Eigen::VectorXd borne = conditions.transpose() * factor.solve(conditions * lengths_of(forces, 1 / scale));
    CarrierMotions        taken = borne.reshaped(motions, forces.cols());
    taken.bottomRows<3>() *= scale;
    forces -= taken;
  }

  Ties::Keeper::Keeper(const Ties &kept, const CarrierMotions &inverse)
    : ties(&kept)
    , inverse_mass(kept.lengths_of(inverse, kept.scale * kept.scale))
    , factor(kept.conditions, inverse_mass, kept.own)
  {
  }

  void Ties::Keeper::correct(CarrierMotions &velocity) const
  {
    const Eigen::VectorXd impulse =
      ties->conditions.transpose() * factor.solve(ties->conditions * ties->lengths_of(velocity, ties->scale));
    CarrierMotions change = inverse_mass.cwiseProduct(impulse).reshaped(motions, velocity.cols());
    change.bottomRows<3>() /= ties->scale;
    velocity -= change;
  }
} // namespace dem

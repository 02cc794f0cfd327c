#include "dem/statics/ties.h"

#include "base/errors.h"

#include <Eigen/OrderingMethods>
#include <Eigen/SparseQR>

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

    /** As many rows as are independent of each other. */
    Sparse independent(const Sparse &rows)
    {
      if (rows.rows() == 0)
        return rows;
      constexpr double rounding = 1e-8;
      Sparse           columns  = rows.transpose();
      columns.makeCompressed();
      Eigen::SparseQR<Sparse, Eigen::COLAMDOrdering<int>> qr;
      qr.setPivotThreshold(rounding);
      qr.compute(columns);
      if (qr.info() != Eigen::Success)
        throw base::NumericalError("ties: the conditions cannot be told apart.");
      std::vector<Eigen::Triplet<double>> kept;
      for (Eigen::Index k = 0; k < qr.rank(); ++k)
        for (Sparse::InnerIterator entry(columns, qr.colsPermutation().indices()[k]); entry; ++entry)
          kept.emplace_back(static_cast<int>(k), static_cast<int>(entry.row()), entry.value());
      Sparse result(qr.rank(), rows.cols());
      result.setFromTriplets(kept.begin(), kept.end());
      return result;
    }
  } // namespace

  Ties::Ties(const std::vector<Tie> &ties, const std::vector<HeldMotions> &held, const double length)
    : scale(length)
    , conditions(independent(rows_of(ties, held, length)))
    , factor(Sparse(conditions * conditions.transpose()))
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
    , factor(Sparse(kept.conditions * inverse_mass.asDiagonal() * kept.conditions.transpose()))
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

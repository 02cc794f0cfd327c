#pragma once

#include "dem/network/stiffness_operator.h"

#include <Eigen/Core>
#include <Eigen/SparseCholesky>
#include <Eigen/SparseCore>

#include <cstddef>
#include <vector>

namespace dem
{
  /** Small motions of carriers (particles, then joints of a body), six each: displacement [m], rotation [-]. */
  using CarrierMotions = Eigen::Matrix<double, motions, Eigen::Dynamic>;

  /** One term of a condition. */
  struct TieTerm
  {
    std::size_t carrier;
    int         motion; ///< 0 to 5
    double      weight;
  };

  /** A condition: its terms add up to nothing. */
  using Tie = std::vector<TieTerm>;

  /**
   * Solves (T W T^T) x = b for the rows T of conditions and weights W of motions (doc/theory/static-handshake.md, 2). Where each condition
   * has a motion of its own, T = [D C] with a diagonal D, and by the formula of Woodbury (1950) only W^-1 + C^T (D W D)^-1 C is factored:
   * its size is the number of the other motions, those of the few joints that many constrained particles follow.
   */
  class TieFactor
  {
  public:
    /** @param own of each row the motion that no other row has; empty: not every row has one */
    TieFactor(const Eigen::SparseMatrix<double> &rows,
              const Eigen::VectorXd             &weights,
              const std::vector<Eigen::Index>   &own);

    Eigen::VectorXd solve(const Eigen::VectorXd &b) const;

  private:
    Eigen::VectorXd                                    inverse_own; ///< of D W D; empty: the whole is factored
    Eigen::SparseMatrix<double>                        others;      ///< C, its columns that weigh anything
    Eigen::SimplicialLDLT<Eigen::SparseMatrix<double>> factor;
  };

  /**
   * Linear conditions between small motions, which hold exactly. What tied motions cannot feel is no force: in equilibrium that which
   * is unbalanced is borne by the ties.
   */
  class Ties
  {
  public:
    /**
     * Conditions that follow from others are left out.
     * @param held of each carrier: motions that are no unknowns, and vanish @param scale length that makes a length of a rotation [m]
     * @param smooth conditions, of which each has a motion of its own, that only leave motions which keep `ties`; empty: these themselves
     */
    Ties(const std::vector<Tie>         &ties,
         const std::vector<HeldMotions> &held,
         double                          scale,
         const std::vector<Tie>         &smooth = {});

    /** A row for each condition that is left, a column for each of the carriers' motions, rotations times the scale. */
    const Eigen::SparseMatrix<double> &rows() const { return conditions; }

    /**
     * All motions (rows) by the independent ones (columns; numbered as all are, dependent ones have none), where each condition has a motion of its
     * own, as those of constrained particles have: then these can be left out of a system altogether. Without columns otherwise.
     */
    const Eigen::SparseMatrix<double> &by_leaders() const { return leaders; }

    /** Whether nothing but unknowns of the motions themselves is needed to keep them. */
    bool is_led() const { return leaders.cols() > 0 || conditions.rows() == 0; }

    /** Motions of many carriers together that keep the ties, a column each, rotations times the scale: what an iteration should see as a whole. */
    const Eigen::SparseMatrix<double> &common_motions() const { return common; }

    /** Takes from forces and moments what the ties bear. */
    void release(CarrierMotions &forces) const;

    /** The same conditions as smallest impulses see them that keep velocities of masses. */
    class Keeper
    {
    public:
      /** @param inverse_mass of each motion [1/kg], of rotations [1/(kg m^2)] */
      Keeper(const Ties &ties, const CarrierMotions &inverse_mass);

      /** Of velocities what the conditions allow. */
      void correct(CarrierMotions &velocity) const;

    private:
      const Ties     *ties;
      Eigen::VectorXd inverse_mass; ///< every motion a length [1/kg]
      TieFactor       factor;
    };

  private:
    Eigen::VectorXd lengths_of(const CarrierMotions &motion, double factor_of_rotations) const;

    double                      scale;
    Eigen::SparseMatrix<double> conditions;
    std::vector<Eigen::Index>   own; ///< of each condition the motion that no other knows; empty: not each has one
    Eigen::SparseMatrix<double> leaders, common;
    TieFactor                   factor; ///< of the conditions times their transpose
  };
} // namespace dem

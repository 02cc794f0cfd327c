#pragma once

#include <Eigen/Eigenvalues>
#include <deal.II/base/mpi.h>
#include <deal.II/base/point.h>

namespace fem
{
  /// Collects prescribed displacements, and decides whether they hold a solid against all rigid motions.
  template <int dim>
  class RigidMotion
  {
  public:
    static constexpr int n = dim == 2 ? 3 : 6;

    /// @param corner, @param extent: place and size of the solid [m]: turns are about the corner and scaled by the extent.
    RigidMotion(const dealii::Point<dim> &corner_, const double extent_)
      : corner(corner_)
      , extent(extent_)
    {
    }

    /// Holds one displacement component of a point.
    void hold(const dealii::Point<dim> &place, const unsigned int component)
    {
      const dealii::Tensor<1, dim> x   = (place - corner) / extent;
      Eigen::Matrix<double, n, 1>  row = Eigen::Matrix<double, n, 1>::Zero();
      row[component]                   = 1;
      if constexpr (dim == 2)
        row[2] = component == 0 ? -x[1] : x[0];
      else
        for (unsigned int axis = 0; axis < 3; ++axis)
          {
            dealii::Tensor<1, 3> turn;
            turn[axis]    = 1;
            row[3 + axis] = dealii::cross_product_3d(turn, x)[component];
          }
      held += row * row.transpose();
    }

    /// The motion that what all ranks hold leaves free, by name; empty if there is none.
    std::string free_motion(const MPI_Comm communicator) const
    {
      Eigen::Matrix<double, n, n> all;
      for (int i = 0; i < n; ++i)
        for (int j = 0; j < n; ++j)
          all(i, j) = dealii::Utilities::MPI::sum(held(i, j), communicator);
      const Eigen::SelfAdjointEigenSolver<Eigen::Matrix<double, n, n>> eigen(all);
      if (eigen.eigenvalues()[0] > 1e-10 * std::max(eigen.eigenvalues()[n - 1], 1e-300))
        return "";
      static const char *names[2][6] = {
        {"translation x", "translation y", "turn about z", "", "", ""},
        {"translation x", "translation y", "translation z", "turn about x", "turn about y", "turn about z"}};
      int free = 0;
      eigen.eigenvectors().col(0).cwiseAbs().maxCoeff(&free);
      return names[dim - 2][free];
    }

  private:
    dealii::Point<dim>          corner;
    double                      extent;
    Eigen::Matrix<double, n, n> held = Eigen::Matrix<double, n, n>::Zero();
  };
}

#include "fem/output/solid_extremes.h"

#include <Eigen/Dense>
#include <deal.II/base/mpi.h>

#include <algorithm>
#include <cmath>

namespace fem
{
  namespace
  {
    template <int dim>
    std::array<double, 3> coordinates(const dealii::Point<dim> &place)
    {
      return {place[0], place[1], dim == 3 ? place[dim - 1] : 0.0};
    }

    /// The largest of all ranks, of equals that of the first of them.
    Extreme largest_of_ranks(const Extreme &own, const MPI_Comm comm)
    {
      const std::vector<Extreme> all = [&] {
        std::vector<Extreme> gathered;
        for (const auto &[value, place] :
             dealii::Utilities::MPI::all_gather(comm, std::make_pair(own.value, own.place)))
          gathered.push_back({value, place});
        return gathered;
      }();
      return *std::max_element(all.begin(), all.end(), [](const auto &a, const auto &b) { return a.value < b.value; });
    }

    /// A stress that varies linearly over an element, fitted to that of its points by least squares.
    template <int dim>
    class LinearStress
    {
    public:
      void add(const PointView<dim> &point)
      {
        places.push_back(point.place);
        stresses.push_back(point.stress);
        volume += point.volume;
      }

      /// At the corners of the element.
      template <typename Cell>
      std::vector<base::Voigt> at_corners(const Cell &cell) const
      {
        using Rows                      = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic>;
        const auto               n      = static_cast<Eigen::Index>(places.size());
        const bool               slopes = n > dim; // fewer points say nothing but a mean
        const Eigen::Index       terms  = slopes ? dim + 1 : 1;
        const dealii::Point<dim> centre = cell->center();
        const double             size   = cell->diameter();
        const auto               row_of = [&](const dealii::Point<dim> &place) {
          Eigen::RowVectorXd row = Eigen::RowVectorXd::Ones(terms);
          for (Eigen::Index c = 1; c < terms; ++c)
            row[c] = (place[static_cast<unsigned int>(c - 1)] - centre[static_cast<unsigned int>(c - 1)]) / size;
          return row;
        };
        Rows basis(n, terms), values(n, 6);
        for (Eigen::Index i = 0; i < n; ++i)
          {
            basis.row(i)  = row_of(places[static_cast<std::size_t>(i)]);
            values.row(i) = stresses[static_cast<std::size_t>(i)].transpose();
          }
        const Rows               fitted = (basis.transpose() * basis).ldlt().solve(basis.transpose() * values);
        std::vector<base::Voigt> corners;
        for (const unsigned int v : cell->vertex_indices())
          corners.push_back((row_of(cell->vertex(v)) * fitted).transpose());
        return corners;
      }

      double volume = 0; ///< [m^3]

    private:
      std::vector<dealii::Point<dim>> places;
      std::vector<base::Voigt>        stresses;
    };

    /// Mean stress of elements of one material around each corner, kept as displacements are.
    template <int dim>
    class CornerMeans
    {
    public:
      explicit CornerMeans(const Solid<dim> &solid)
        : weight(solid.make_vector())
        , sums((6 + dim - 1) / dim, weight)
      {
      }

      template <typename Cell>
      void add(const Cell &cell, const std::vector<base::Voigt> &corners, const double volume)
      {
        for (const unsigned int v : cell->vertex_indices())
          {
            weight[cell->vertex_dof_index(v, 0)] += volume;
            for (unsigned int c = 0; c < 6; ++c)
              sums[c / dim][cell->vertex_dof_index(v, c % dim)] += volume * corners[v][c];
          }
      }

      void finish()
      {
        weight.compress(dealii::VectorOperation::add);
        weight.update_ghost_values();
        for (Vector &sum : sums)
          {
            sum.compress(dealii::VectorOperation::add);
            sum.update_ghost_values();
          }
      }

      template <typename Cell>
      base::Voigt at(const Cell &cell, const unsigned int v) const
      {
        base::Voigt mean;
        for (unsigned int c = 0; c < 6; ++c)
          mean[c] = sums[c / dim][cell->vertex_dof_index(v, c % dim)] / weight[cell->vertex_dof_index(v, 0)];
        return mean;
      }

    private:
      Vector              weight;
      std::vector<Vector> sums;
    };

    /// The element of the largest equivalent stress, where a rank owns it.
    template <int dim>
    struct WorstElement
    {
      typename dealii::DoFHandler<dim>::active_cell_iterator cell;
      bool                                                   owned = false;
    };

    template <int dim>
    double
    disagreement_at(Solid<dim> &solid, const Vector &displacement, const WorstElement<dim> &worst, const double largest)
    {
      const MPI_Comm comm     = solid.communicator();
      const auto     material = static_cast<dealii::types::material_id>(
        dealii::Utilities::MPI::max(worst.owned ? static_cast<unsigned int>(worst.cell->material_id()) : 0u, comm));
      CornerMeans<dim>         means(solid);
      LinearStress<dim>        element;
      std::vector<base::Voigt> own;
      unsigned int             points = 0;
      solid.visit_points(displacement, [&](const PointView<dim> &point) {
        element.add(point);
        if (++points < solid.quadrature().size())
          return;
        if (point.cell->material_id() == material)
          {
            const std::vector<base::Voigt> corners = element.at_corners(point.cell);
            means.add(point.cell, corners, element.volume);
            if (worst.owned && point.cell == worst.cell)
              own = corners;
          }
        element = {};
        points  = 0;
      });
      means.finish();
      double most = 0;
      for (unsigned int v = 0; v < own.size(); ++v)
        most = std::max(most, mises(own[v] - means.at(worst.cell, v)));
      return dealii::Utilities::MPI::max(most, comm) / largest;
    }
  }

  double mises(const base::Voigt &s)
  {
    const double xy = s[0] - s[1], yz = s[1] - s[2], zx = s[2] - s[0];
    return std::sqrt(0.5 * (xy * xy + yz * yz + zx * zx) + 3 * (s[3] * s[3] + s[4] * s[4] + s[5] * s[5]));
  }

  template <int dim>
  SolidExtremes extremes_of(Solid<dim> &solid, const Vector &displacement)
  {
    const MPI_Comm    comm = solid.communicator();
    const double      none = std::numeric_limits<double>::lowest();
    Extreme           tension{none, {}}, pressure{none, {}}, equivalent{none, {}}, moved{none, {}};
    WorstElement<dim> worst;
    const auto        note = [](Extreme &largest, const double value, const dealii::Point<dim> &place) {
      if (!(value > largest.value))
        return false;
      largest = {value, coordinates(place)};
      return true;
    };
    solid.visit_points(displacement, [&](const PointView<dim> &point) {
      const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> principal(base::stress_tensor(point.stress),
                                                                     Eigen::EigenvaluesOnly);
      note(tension, principal.eigenvalues()[2], point.place);
      note(pressure, -principal.eigenvalues()[0], point.place);
      if (note(equivalent, mises(point.stress), point.place))
        worst.cell = point.cell;
    });
    for (const auto &cell : solid.dofs().active_cell_iterators())
      if (cell->is_locally_owned())
        for (const unsigned int v : cell->vertex_indices())
          {
            double squared = 0;
            for (unsigned int c = 0; c < dim; ++c)
              squared += displacement[cell->vertex_dof_index(v, c)] * displacement[cell->vertex_dof_index(v, c)];
            note(moved, std::sqrt(squared), cell->vertex(v));
          }
    SolidExtremes found;
    found.tension           = largest_of_ranks(tension, comm);
    found.compression       = largest_of_ranks(pressure, comm);
    found.compression.value = -found.compression.value;
    found.mises             = largest_of_ranks(equivalent, comm);
    found.displacement      = largest_of_ranks(moved, comm);
    worst.owned             = equivalent.value == found.mises.value && equivalent.place == found.mises.place;
    if (solid.linear() && found.mises.value > 0)
      found.disagreement = disagreement_at(solid, displacement, worst, found.mises.value);
    return found;
  }

  template SolidExtremes extremes_of(Solid<2> &, const Vector &);
  template SolidExtremes extremes_of(Solid<3> &, const Vector &);
}

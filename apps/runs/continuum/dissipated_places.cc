#include "apps/runs/continuum/dissipated_places.h"

#include <deal.II/base/mpi.h>

namespace apps
{
  namespace
  {
    constexpr Eigen::Index components = 6, record = 2 * components + 1;

    using Record = Eigen::Matrix<double, record, 1>;

    /** Dissipated on the way from one record to another [J/m^3]. */
    double dissipated_between(const Record &before, const Record &now)
    {
      const base::Voigt strain = (now - before).head<components>();
      const base::Voigt stress = (0.5 * (now + before)).segment<components>(components);
      return stress.dot(strain) - (now - before)[record - 1];
    }

    void add_up(SpreadAmount &amount, MPI_Comm ranks)
    {
      using dealii::Utilities::MPI::sum;
      amount.amount = sum(amount.amount, ranks);
      for (double &value : amount.first)
        value = sum(value, ranks);
      for (double &value : amount.second.reshaped())
        value = sum(value, ranks);
    }
  } // namespace

  template <int dim>
  void DissipatedPlaces<dim>::update(fem::Solid<dim> &solid, const fem::Vector &displacement)
  {
    SpreadAmount more;
    base::Column next;
    next.reserve(points.size());
    solid.visit_points(displacement, [&](const fem::PointView<dim> &point) {
      Record now;
      now << point.strain, point.stress, point.material->stored_energy(point.index, point.strain, point.stress);
      Record before = Record::Zero();
      if (!points.empty())
        before = Eigen::Map<const Record>(points.data() + next.size());
      Eigen::Vector3d place = Eigen::Vector3d::Zero();
      for (int i = 0; i < dim; ++i)
        place[i] = point.place[i];
      more.add(point.volume * dissipated_between(before, now), place);
      next.insert(next.end(), now.begin(), now.end());
    });
    points = std::move(next);
    add_up(more, solid.communicator());
    sum.amount += more.amount;
    sum.first += more.first;
    sum.second += more.second;
  }

  template <int dim>
  void DissipatedPlaces<dim>::start_at(fem::Solid<dim> &solid, const fem::Vector &displacement)
  {
    update(solid, displacement);
    sum = {};
  }

  template <int dim>
  void DissipatedPlaces<dim>::visit_state(base::StateVisitor &visitor)
  {
    visitor.column("dissipated/points", points);
    sum.visit_state(visitor, "dissipated/sum");
  }

  template class DissipatedPlaces<2>;
  template class DissipatedPlaces<3>;
} // namespace apps

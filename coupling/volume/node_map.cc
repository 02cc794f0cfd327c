#include "coupling/volume/node_map.h"

namespace coupling
{
  template <int dim>
  std::size_t NodeMap<dim>::number(const std::size_t carrier)
  {
    number_of.resize(participant.carriers(), 0);
    if (number_of[carrier] == 0)
      {
        carriers.push_back(carrier);
        number_of[carrier] = carriers.size();
      }
    return number_of[carrier] - 1;
  }

  template <int dim>
  std::size_t NodeMap<dim>::enter(const fem::PlaceInElement<dim> &place)
  {
    for (std::size_t k = 0; k < place.nodes.size(); ++k)
      {
        Eigen::Vector3d gradient = Eigen::Vector3d::Zero();
        for (int c = 0; c < dim; ++c)
          gradient[c] = place.gradients.empty() ? 0.0 : place.gradients[k][c];
        entries.push_back({rows, number(participant.carrier_of(place.nodes[k][0])), place.weights[k], gradient});
      }
    return rows++;
  }

  template <int dim>
  bool NodeMap<dim>::enter(const Eigen::Vector3d &place)
  {
    dealii::Point<dim> where;
    for (int c = 0; c < dim; ++c)
      where[c] = place[c];
    const auto found = solid.point_search().find(where);
    if (found)
      enter(*found);
    return found.has_value();
  }

  template <int dim>
  std::vector<typename NodeMap<dim>::Entry> NodeMap<dim>::take()
  {
    rows = 0;
    return std::move(entries);
  }

  template class NodeMap<2>;
  template class NodeMap<3>;
} // namespace coupling

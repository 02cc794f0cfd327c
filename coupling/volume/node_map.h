#pragma once

#include "coupling/participants/solid_participant.h"
#include "coupling/volume/multipliers.h"
#include "fem/solid/point_search.h"

#include <optional>
#include <vector>

namespace coupling
{
  /** The nodes of a solid that take part in a coupling, in the order in which they were first met. */
  template <int dim>
  class NodeMap
  {
  public:
    /** Both must outlive it. */
    NodeMap(const fem::Solid<dim> &of_solid, const SolidParticipant<dim> &of_participant)
      : solid(of_solid)
      , participant(of_participant)
    {
    }

    /** Weight of one node at one of the places that were entered. */
    struct Entry
    {
      std::size_t     row, node;
      double          weight;
      Eigen::Vector3d gradient; ///< of the weight with the place [1/m]
    };

    /** Enter a place in an element that is known. @return its row */
    std::size_t enter(const fem::PlaceInElement<dim> &place);
    /** Find an undeformed place and enter it. @return whether it is in the solid */
    bool enter(const Eigen::Vector3d &place);
    /** From now on rows count from 0 again, for another matrix with the same nodes. @return what was entered so far */
    std::vector<Entry> take();

    /** Carriers of the solid's participant, by number here. */
    const std::vector<std::size_t> &nodes() const { return carriers; }

  private:
    std::size_t number(std::size_t carrier);

    const fem::Solid<dim>       &solid;
    const SolidParticipant<dim> &participant;
    std::vector<std::size_t>     carriers;
    std::vector<std::size_t>     number_of; ///< of each carrier of the solid, from 1; 0: it has none
    std::vector<Entry>           entries;
    std::size_t                  rows = 0;
  };

  /** @param columns number of nodes */
  template <typename Entries>
  WeightRows weights_of(const Entries &entries, const std::size_t rows, const std::size_t columns)
  {
    std::vector<Eigen::Triplet<double>> all;
    for (const auto &e : entries)
      all.emplace_back(static_cast<Eigen::Index>(e.row), static_cast<Eigen::Index>(e.node), e.weight);
    WeightRows weights(static_cast<Eigen::Index>(rows), static_cast<Eigen::Index>(columns));
    weights.setFromTriplets(all.begin(), all.end());
    return weights;
  }
} // namespace coupling

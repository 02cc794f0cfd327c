#pragma once

#include "coupling/participants/solid_participant.h"

#include <set>
#include <vector>

namespace coupling
{
  /** The parts of a solid that are connected by nodes that elements share. */
  struct SolidPart
  {
    std::vector<std::size_t>             carriers; ///< its nodes, ascending
    std::vector<unsigned int>            cells;    ///< their active indices, ascending
    std::set<dealii::types::material_id> materials;
  };

  /** All parts of a solid, in the order of their first elements. */
  template <int dim>
  std::vector<SolidPart> solid_parts(const fem::Solid<dim> &solid, const SolidParticipant<dim> &participant);
} // namespace coupling

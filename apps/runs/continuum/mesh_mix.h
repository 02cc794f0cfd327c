#pragma once

#include "apps/models/mix.h"

#include <string>

namespace fem
{
  template <int dim>
  struct Mesh;
}

namespace apps
{
  /** Sub-section "Mix" of "Mesh": elements of mortar and of aggregate (doc/theory/mesostructure.md, 4). */
  struct MeshMixSection
  {
    MixSection  mix;
    std::string group; ///< of the mesh, that is concrete; "": all of it

    bool given() const { return mix.given(); }
    /**
     * Elements whose middles lie in an aggregate become the group of the aggregates, all others that of the mortar. Aggregates lie in the box
     * around the group; in the plane it is the section of a periodic box. Says on the standard error what was reached.
     * @throws base::InputError
     */
    template <int dim>
    void share_out(fem::Mesh<dim> &mesh) const;
  };
} // namespace apps

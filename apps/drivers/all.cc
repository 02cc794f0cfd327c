#include "apps/drivers/all.h"

#include "apps/drivers/cell/scene.h"
#include "apps/drivers/continuum/scene.h"
#include "apps/drivers/coupled/scene.h"
#include "apps/drivers/homogenisation/scene.h"
#include "apps/drivers/particles/scene.h"
#include "apps/drivers/peridynamic_core/scene.h"
#include "apps/drivers/peridynamics/scene.h"
#include "apps/drivers/quasi_static/scene.h"
#include "apps/drivers/sequential/scene.h"
#include "apps/drivers/structure/scene.h"
#include "apps/drivers/transmission/scene.h"
#include "apps/drivers/uniaxial/scene.h"
#include "apps/scene/same_name.h"

#include <stdexcept>

namespace apps
{
  namespace
  {
    template <typename Kind>
    std::unique_ptr<Scene> make()
    {
      return std::make_unique<Kind>();
    }
  } // namespace

  namespace
  {
    std::vector<SceneKind> &known_kinds()
    {
      static std::vector<SceneKind> kinds = {
        {"cell", "a periodic cell led in time along a path of strains and stresses", make<CellScene>},
        {"continuum", "a solid of finite elements, static past its peak or explicit", make<ContinuumScene>},
        {"coupled", "particles and a solid of finite elements that touch, in motion", make<CoupledScene>},
        {"homogenisation", "macroscopic stiffness of periodic packings, swept over link parameters",
         make<HomogenisationScene>},
        {"particles", "specimens and loose particles, bonded or not, moved and thrown by formula",
         make<ParticlesScene>},
        {"peridynamic_core", "a solid of finite elements with a core of bonds over a horizon, in motion",
         make<PeridynamicCoreScene>},
        {"peridynamics", "a rod, plate or block of bonds over a horizon, at rest or in motion, that may break",
         make<PeridynamicsScene>},
        {"quasi_static", "a bonded-particle specimen or periodic cell pulled and crushed without inertia",
         make<QuasiStaticScene>},
        {"sequential", "an event by particles, handed over to a continuum that carries on", make<SequentialScene>},
        {"structure", "particles, and a solid around them, led along their equilibria without inertia",
         make<StructureScene>},
        {"transmission", "packets of waves that run through particles and on into a continuum",
         make<TransmissionScene>},
        {"uniaxial", "a bonded-particle specimen pulled and crushed", make<UniaxialScene>},
      };
      return kinds;
    }
  } // namespace

  const std::vector<SceneKind> &scene_kinds() { return known_kinds(); }

  void add_scene_kind(const SceneKind &kind)
  {
    for (const SceneKind &known : known_kinds())
      if (same_name(known.name, kind.name))
        throw std::invalid_argument("there is a kind of scene \"" + known.name + "\" already");
    known_kinds().push_back(kind);
  }
} // namespace apps

#include "apps/scene/kinds/kinds.h"

#include "apps/runs/cell/forecast.h"
#include "apps/runs/cell/outcome.h"
#include "apps/runs/cell/run.h"
#include "apps/runs/continuum/forecast.h"
#include "apps/runs/continuum/outcome.h"
#include "apps/runs/continuum/run.h"
#include "apps/runs/coupled/forecast.h"
#include "apps/runs/coupled/outcome.h"
#include "apps/runs/coupled/run.h"
#include "apps/runs/homogenisation/forecast.h"
#include "apps/runs/homogenisation/outcome.h"
#include "apps/runs/homogenisation/run.h"
#include "apps/runs/particles/forecast.h"
#include "apps/runs/particles/outcome.h"
#include "apps/runs/particles/run.h"
#include "apps/runs/peridynamic_core/forecast.h"
#include "apps/runs/peridynamic_core/outcome.h"
#include "apps/runs/peridynamic_core/run.h"
#include "apps/runs/peridynamics/forecast.h"
#include "apps/runs/peridynamics/outcome.h"
#include "apps/runs/peridynamics/run.h"
#include "apps/runs/quasi_static/forecast.h"
#include "apps/runs/quasi_static/outcome.h"
#include "apps/runs/quasi_static/run.h"
#include "apps/runs/sequential/forecast.h"
#include "apps/runs/sequential/outcome.h"
#include "apps/runs/sequential/run.h"
#include "apps/runs/structure/forecast.h"
#include "apps/runs/structure/outcome.h"
#include "apps/runs/structure/run.h"
#include "apps/runs/transmission/forecast.h"
#include "apps/runs/transmission/outcome.h"
#include "apps/runs/transmission/run.h"
#include "apps/runs/uniaxial/forecast.h"
#include "apps/runs/uniaxial/outcome.h"
#include "apps/runs/uniaxial/run.h"
#include "apps/scene/cell/model.h"
#include "apps/scene/continuum/model.h"
#include "apps/scene/coupled/model.h"
#include "apps/scene/homogenisation/model.h"
#include "apps/scene/particles/model.h"
#include "apps/scene/peridynamic_core/model.h"
#include "apps/scene/peridynamics/model.h"
#include "apps/scene/quasi_static/model.h"
#include "apps/scene/scene_of.h"
#include "apps/scene/sequential/model.h"
#include "apps/scene/structure/model.h"
#include "apps/scene/transmission/model.h"
#include "apps/scene/uniaxial/model.h"
#include "apps/text/same_name.h"

#include <stdexcept>

namespace apps
{
  namespace
  {
    std::vector<SceneKind> &known_kinds()
    {
      static std::vector<SceneKind> kinds = {
        {"cell", "a periodic cell driven in time along a path of strains and stresses", make_scene<CellModel, true>},
        {"continuum", "a solid of finite elements, static past its peak or explicit", make_scene<ContinuumModel, true>},
        {"coupled", "particles and a solid of finite elements that touch, in motion", make_scene<CoupledModel, true>},
        {"homogenisation", "macroscopic stiffness of periodic packings, swept over link parameters",
         make_scene<HomogenisationModel, true>},
        {"particles", "specimens and loose particles, bonded or not, moved and thrown by formula",
         make_scene<ParticlesModel, true>},
        {"peridynamic_core", "a solid of finite elements with a core of bonds over a horizon, in motion",
         make_scene<PeridynamicCoreModel>},
        {"peridynamics", "a rod, plate or block of bonds over a horizon, at rest or in motion, that may break",
         make_scene<PeridynamicsModel>},
        {"quasi_static", "a bonded-particle specimen or periodic cell pulled and crushed without inertia",
         make_scene<QuasiStaticModel, true>},
        {"sequential", "an event by particles, handed over to a continuum that carries on",
         make_scene<SequentialModel>},
        {"structure", "particles, and a solid around them, along their equilibria without inertia",
         make_scene<StructureModel, true>},
        {"transmission", "packets of waves that run through particles and on into a continuum",
         make_scene<TransmissionModel>},
        {"uniaxial", "a bonded-particle specimen pulled and crushed", make_scene<UniaxialModel, true>},
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

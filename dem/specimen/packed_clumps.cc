#include "dem/specimen/packed_clumps.h"

#include "base/errors.h"
#include "dem/model/materials.h"
#include "dem/specimen/specimen.h"

namespace dem
{
  void add_packed_clumps(Specimen &specimen, const Packing &packing, const LinkMaterials &materials)
  {
    const SpecimenParameters &p         = specimen.parameters();
    const std::vector<double> densities = materials.densities(p.density);
    std::vector<RigidClump>   clumps(packing.bodies.size());
    for (std::size_t i = 0; i < packing.clump.size(); ++i)
      if (packing.clump[i] >= 0)
        clumps.at(static_cast<std::size_t>(packing.clump[i])).particles.push_back(i);
    for (std::size_t b = 0; b < clumps.size(); ++b)
      {
        const PackedBody &body  = packing.bodies[b];
        RigidClump       &clump = clumps[b];
        const std::size_t first = clump.particles.at(0);
        const std::size_t of    = packing.material.empty() ? 0 : static_cast<std::size_t>(packing.material[first]);
        clump.mass              = densities.at(of) * body.volume * (p.physics.dimension == 2 ? p.thickness : 1.0);
        clump.centre            = body.centre;
        clump.inertia           = clump.mass * body.inertia;
        try
          {
            specimen.clumps().add(clump);
          }
        catch (const base::InputError &refused)
          {
            throw base::InputError("packing, body " + std::to_string(b) + ": " + refused.what());
          }
      }
  }
} // namespace dem

#include "apps/runs/structure/forecast.h"

#include "apps/forecasts/duration.h"
#include "apps/forecasts/path_forecast.h"
#include "apps/models/tension_beyond_apex.h"
#include "apps/process/mpi_session.h"
#include "apps/runs/structure/promotion.h"
#include "apps/runs/structure/run.h"
#include "apps/specimens/packing_extents.h"

#include <fmt/format.h>

namespace apps
{
  std::string forecast(const StructureModel &model)
  {
    start_mpi();
    const base::Stopwatch       watch;
    std::optional<dem::Packing> cell;
    const dem::Packing          packing = model.packing(&cell);
    const ParticleMedia         media   = model.media(cell);
    const Promotion             promotion(model, packing, media); // refuses what a run would refuse
    const Structure            &structure = promotion.structure();
    const double                set_up    = watch.seconds();
    std::string                 text;
    text += fmt::format("  particles    {}\n  links        {}\n", structure.network().network.particles(),
                        structure.network().network.links.size());
    if (!model.voids.empty())
      text += fmt::format("  voids        {}: {} links that would cross one are left out\n", model.voids.size(),
                          model.linked(packing).links.size() - structure.network().network.links.size());
    text += extent_lines(packing, structure.network().network.dimension);
    text += lines_of_tension_beyond_apex(model.material);
    text += structure.material_counts().text();
    text += fmt::format("  groups       {}\n", text_of(structure.members()));
    if (model.gravity.acts())
      text += fmt::format("  weight       {:.6g} N, without {} particles that would swing on hinges\n",
                          structure.weight().norm(), structure.weightless().size());
    if (const StructureSolid *solid = structure.surrounding())
      {
        text += fmt::format("  elements     {}\n  unknowns     {}, of which particles see {} nodes\n",
                            solid->elements(), solid->unknowns(), solid->joints());
        auto handshake = model.handshakes.handshakes.begin();
        for (const auto &[all, damaged] : structure.shared_bonds())
          text += fmt::format("  handshake    {}: {} bonds in the overlap\n", (handshake++)->name, all);
        handshake = model.handshakes.handshakes.begin();
        for (const std::size_t elements : promotion.promotable())
          text += fmt::format("  promotion    {}: up to {} elements may become particles, {} with them\n",
                              (handshake++)->name, elements, packing.size());
      }
    const dem::QuasiStaticParameters path = model.path.parameters(nullptr);
    text += fmt::format("  path         at least {:.0f} points to its end\n", path.end_strain / path.strain_step);
    return text + duration_line(set_up + expected_path_seconds(structure.network(), model.materials(packing), path));
  }

} // namespace apps

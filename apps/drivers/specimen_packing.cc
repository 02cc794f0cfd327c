#include "apps/drivers/specimen_packing.h"

#include "apps/interrupt.h"
#include "apps/progress.h"
#include "dem/core/errors.h"
#include "dem/packing/tiling.h"
#include "postprocess/packing_io.h"

#include <fmt/format.h>

namespace apps
{
  dem::CompactionResult compact_with_progress(const dem::CompactionParameters &parameters)
  {
    Progress   progress("packing");
    const auto show = [&](const dem::CompactionProgress &now) {
      progress.update(fmt::format("stage {} of 2, step {}, packing fraction {:.3f}, pressure {:.2f} of its target",
                                  now.stage, now.steps, now.packing_fraction, now.pressure));
      return !interrupted();
    };
    return dem::compact(parameters, show);
  }

  dem::Packing cropped(const dem::Packing &packing, const Eigen::Vector3d &box)
  {
    dem::Tiling tiling = dem::tile_and_crop(packing, box);
    if (!tiling.note.empty())
      fmt::print(stderr, "breccia: note: {}\n", tiling.note);
    return std::move(tiling.packing);
  }

  namespace
  {
    dem::Packing make_cell(const SpecimenSection &specimen)
    {
      if (specimen.source == SpecimenSection::Source::generator)
        return compact_with_progress(specimen.generator.parameters()).packing;
      dem::Packing packing = postprocess::read_packing(specimen.file);
      if (!packing.periodic_cell)
        throw dem::InputError(specimen.file + ": the packing is not periodic, and there is no cell without it.");
      return packing;
    }

    dem::Packing make_particles(const SpecimenSection &specimen)
    {
      if (specimen.body == SpecimenSection::Body::cell)
        return make_cell(specimen);
      if (specimen.source == SpecimenSection::Source::generator)
        return cropped(compact_with_progress(specimen.generator.parameters()).packing, specimen.box_edges());
      dem::Packing packing = postprocess::read_packing(specimen.file);
      if (specimen.has_box())
        return cropped(packing, specimen.box_edges());
      if (packing.periodic_cell)
        throw dem::InputError(
          specimen.file +
          ": the packing is periodic, and a specimen has ends. Set Specimen/Box size: the packing is then "
          "repeated to fill the box and cropped to it.");
      return packing;
    }
  } // namespace

  dem::Packing make_packing(const SpecimenSection &specimen, const MaterialSection &material, const int dimension)
  {
    dem::Packing packing = make_particles(specimen);
    material.assign(packing, dimension,
                    specimen.source == SpecimenSection::Source::file ? specimen.file : "generated packing");
    return packing;
  }
} // namespace apps

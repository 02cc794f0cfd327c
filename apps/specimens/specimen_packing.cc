#include "apps/specimens/specimen_packing.h"

#include "apps/process/mpi_ranks.h"
#include "apps/process/mpi_session.h"
#include "apps/process/progress.h"
#include "apps/results/warning.h"
#include "apps/specimens/genesis_work.h"
#include "apps/specimens/packing_cache.h"
#include "apps/specimens/packing_density.h"
#include "apps/specimens/packing_file.h"
#include "base/errors.h"
#include "dem/neighbours/pieces.h"
#include "dem/packing/compaction_on_ranks.h"
#include "dem/packing/moulded_box.h"
#include "dem/packing/overlaps.h"
#include "dem/packing/tiling.h"
#include "postprocess/packings/packing_io.h"

#include <fmt/format.h>

#include <algorithm>
#include <limits>
#include <optional>
#include <string>

namespace apps
{
  namespace
  {
    /** Bodies of which there are pebbles left, numbered anew. */
    void keep_bodies_with_pebbles(const dem::Packing &whole, dem::Packing &rest)
    {
      std::vector<std::int32_t> number(whole.bodies.size(), -1);
      for (std::int32_t &of : rest.clump)
        if (of >= 0)
          {
            std::int32_t &kept = number[static_cast<std::size_t>(of)];
            if (kept < 0)
              {
                kept = static_cast<std::int32_t>(rest.bodies.size());
                rest.bodies.push_back(whole.bodies[static_cast<std::size_t>(of)]);
              }
            of = kept;
          }
    }
  } // namespace

  dem::Packing particles_where(const dem::Packing &packing, const std::function<bool(std::size_t)> &keeps)
  {
    dem::Packing rest;
    rest.material_names = packing.material_names;
    for (std::size_t i = 0; i < packing.size(); ++i)
      if (keeps(i))
        {
          rest.centre.push_back(packing.centre[i]);
          rest.radius.push_back(packing.radius[i]);
          if (!packing.material.empty())
            rest.material.push_back(packing.material[i]);
          if (!packing.clump.empty())
            rest.clump.push_back(packing.clump[i]);
        }
    keep_bodies_with_pebbles(packing, rest);
    return rest;
  }

  dem::CompactionResult compact_with_progress(const dem::CompactionParameters &parameters)
  {
    const std::optional<PackingCache> cache = packing_cache();
    if (std::optional<dem::CompactionResult> kept = find_on_first_rank(cache, parameters))
      return std::move(*kept);
    Progress   progress("packing");
    const auto show = [&](const dem::CompactionProgress &now) {
      progress.update(fmt::format("stage {} of 2, step {}, packing fraction {:.3f}, pressure {:.2f} of its target",
                                  now.stage, now.steps, now.packing_fraction, now.pressure));
      return !interrupted_on_any_rank();
    };
    dem::CompactionResult made = dem::compact_on(launched_team().get(), parameters, show);
    if (cache && is_first_rank())
      cache->keep(parameters, made);
    return made;
  }

  dem::Packing cropped(const dem::Packing &packing, const Eigen::Vector3d &box)
  {
    dem::Tiling tiling = dem::tile_and_crop(packing, box);
    if (!tiling.note.empty())
      give_note(tiling.note);
    return std::move(tiling.packing);
  }

  namespace
  {
    dem::Packing make_cell(const SpecimenSection &specimen)
    {
      if (specimen.source == SpecimenSection::Source::generator)
        return compact_with_progress(specimen.compaction()).packing;
      dem::Packing packing = packing_in_file(specimen.file, specimen.length_unit);
      if (!packing.periodic_cell)
        throw base::InputError(specimen.file + ": the packing is not periodic, and there is no cell without it.");
      return packing;
    }

    std::string text_of(const dem::Pieces &pieces, const SpecimenSection &specimen)
    {
      std::string sizes;
      for (std::size_t k = 0; k < std::min<std::size_t>(pieces.size.size(), 5); ++k)
        sizes += (k > 0 ? ", " : "") + std::to_string(pieces.size[k]);
      return fmt::format("the specimen consists of {} pieces at Specimen/Interaction ratio = {}: of {}{} particles; "
                         "{} of {} particles are linked to nothing",
                         pieces.size.size(), specimen.interaction_ratio, sizes, pieces.size.size() > 5 ? ", ..." : "",
                         pieces.strays(), pieces.piece.size());
    }

    /** The specimen with what becomes of its loose pieces. @throws base::InputError if it has some and must not */
    dem::Packing in_one_piece(dem::Packing packing, const SpecimenSection &specimen)
    {
      const auto        links  = dem::find_pairs(packing.centre, packing.radius, specimen.interaction_ratio,
                                                 specimen.installation_gap, std::nullopt);
      const dem::Pieces pieces = dem::find_pieces(packing.size(), links);
      if (pieces.size.size() < 2 || links.empty()) // nothing linked at all is refused elsewhere
        return packing;
      const std::string finding = text_of(pieces, specimen);
      switch (specimen.loose_pieces)
        {
        case SpecimenSection::LoosePieces::keep:
          give_note(finding + ". All are kept.");
          return packing;
        case SpecimenSection::LoosePieces::drop:
          give_note(finding + ". The largest is the specimen.");
          return particles_where(packing, [&](const std::size_t i) { return pieces.piece[i] == 0; });
        default:
          throw base::InputError(finding +
                                 ". Raise the ratio, mend the packing, or set Specimen/Loose pieces to drop or "
                                 "keep.");
        }
    }

    /** Discs lie in the plane, whatever the third edge. */
    Eigen::Vector3d box_of(const SpecimenSection &specimen, const int dimension)
    {
      Eigen::Vector3d box = specimen.box_edges();
      if (dimension == 2)
        box[2] = std::numeric_limits<double>::infinity();
      return box;
    }

    /** A small box cut out of a cell is weaker than what it is cut out of, and its user should know. */
    void tell_of_sparse_faces(const dem::Packing &packing, const SpecimenSection &specimen, const int dimension)
    {
      const PackingDensity density = density_in(packing, specimen.box_edges(), dimension);
      if (!density.has_sparse_faces())
        return;
      give_note(
        fmt::format("the faces of the specimen are cut and sparse: packing fraction {:.3f} inside, {:.3f} of "
                    "Specimen/Box size. It is softer and weaker than its inside: by its links it has some {:.0f} % of "
                    "the stiffness. {}",
                    density.inside, density.whole,
                    100 * linked_part(packing, specimen.box_edges(), dimension, specimen.interaction_ratio,
                                      specimen.installation_gap),
                    specimen.source == SpecimenSection::Source::generator ?
                      "Specimen/Generator/Faces = moulded gives flat faces." :
                      "`breccia pack --moulded` makes packings with flat faces."));
    }

    dem::Packing make_particles(const SpecimenSection &specimen, const int dimension, std::optional<dem::Packing> *cell)
    {
      if (specimen.source == SpecimenSection::Source::genesis)
        return specimen.grown ? *specimen.grown : grown_with_progress(specimen, dimension);
      if (specimen.body == SpecimenSection::Body::cell)
        return make_cell(specimen);
      if (specimen.is_moulded())
        {
          if (cell)
            *cell = compact_with_progress(specimen.compaction()).packing;
          return dem::moulded_box(specimen.compaction(), specimen.box_edges(), compact_with_progress);
        }
      dem::Packing packing = specimen.source == SpecimenSection::Source::generator ?
                               compact_with_progress(specimen.compaction()).packing :
                               packing_in_file(specimen.file, specimen.length_unit);
      if (cell && packing.periodic_cell)
        *cell = packing;
      if (specimen.has_box())
        {
          dem::Packing box = cropped(packing, box_of(specimen, dimension));
          if (specimen.bonded)
            tell_of_sparse_faces(box, specimen, dimension);
          return box;
        }
      if (packing.periodic_cell)
        throw base::InputError(
          specimen.file +
          ": the packing is periodic, and a specimen has ends. Set Specimen/Box size: the packing is then "
          "repeated to fill the box and cropped to it.");
      return packing;
    }
  } // namespace

  std::string origin_of(const SpecimenSection &specimen)
  {
    return specimen.source == SpecimenSection::Source::file    ? specimen.file :
           specimen.source == SpecimenSection::Source::genesis ? "grown packing" :
                                                                 "generated packing";
  }

  dem::Packing
  specimen_particles(const SpecimenSection &specimen, const int dimension, std::optional<dem::Packing> *const cell)
  {
    const bool        from_file = specimen.source == SpecimenSection::Source::file;
    const std::string origin    = origin_of(specimen);
    dem::Packing      packing   = make_particles(specimen, dimension, cell);
    if (from_file || specimen.body == SpecimenSection::Body::box)
      dem::check_packing(packing, origin);
    if (from_file)
      dem::check_overlaps(packing, origin, dimension);
    if (specimen.body == SpecimenSection::Body::box && specimen.bonded)
      packing = in_one_piece(std::move(packing), specimen);
    return packing;
  }

  dem::Packing make_packing(const SpecimenSection &specimen, const MaterialSection &material, const int dimension)
  {
    dem::Packing packing = specimen_particles(specimen, dimension);
    if (!packing.bodies.empty())
      throw base::InputError(origin_of(specimen) +
                             ": the packing has rigid bodies, for which there are scenes of Kind = "
                             "particles.");
    material.assign(packing, dimension, origin_of(specimen));
    return packing;
  }

  namespace
  {
    constexpr const char *packing_name = "packing.h5";
  }

  void keep_packing(const dem::Packing &packing, const std::filesystem::path &folder)
  {
    postprocess::write_packing(packing, folder / packing_name);
  }

  dem::Packing kept_packing(const std::filesystem::path &folder)
  {
    return postprocess::read_packing(folder / packing_name);
  }
} // namespace apps

#include "apps/runs/continuum/snapshot.h"

#include "apps/process/mpi_session.h"
#include "fem/output/snapshot.h"
#include "postprocess/files/errors.h"
#include "postprocess/vtk/pvd.h"
#include "postprocess/vtk/vtk_solid.h"

#include <deal.II/base/mpi.h>
#include <fmt/format.h>

#include <vector>

namespace apps
{
  namespace
  {
    std::string stem_of(const SnapshotPlace &place) { return fmt::format("{}_{:06}", place.name, place.number); }
  } // namespace

  template <int dim>
  void write_whole_solid(fem::Solid<dim>     &solid,
                         const fem::Vector   &displacement,
                         const fem::Vector   &reaction,
                         const SnapshotPlace &place)
  {
    postprocess::write_vtk_solid(place.folder / (stem_of(place) + ".vtu"),
                                 fem::take_snapshot(solid, displacement, reaction), place.time);
  }

  template <int dim>
  std::string write_solid(fem::Solid<dim>     &solid,
                          const fem::Vector   &displacement,
                          const fem::Vector   &reaction,
                          const SnapshotPlace &place)
  {
    const fem::SolidSnapshot snapshot = fem::take_snapshot(solid, displacement, reaction);
    const unsigned int       ranks    = dealii::Utilities::MPI::n_mpi_processes(solid.communicator()),
                       rank           = dealii::Utilities::MPI::this_mpi_process(solid.communicator());
    const std::string        stem     = stem_of(place);
    std::vector<std::string> pieces;
    for (unsigned int r = 0; r < ranks; ++r)
      pieces.push_back(ranks > 1 ? postprocess::piece_name(stem, r, ".vtu") : stem + ".vtu");
    std::string problem;
    if (ranks > 1 || is_first_rank()) // where every rank has the whole, one writes it
      try
        {
          postprocess::write_vtk_solid(place.folder / pieces[rank], snapshot, place.time);
          if (ranks > 1 && rank == 0)
            postprocess::write_vtk_solid_record(place.folder / (stem + ".pvtu"), snapshot, pieces);
        }
      catch (const postprocess::OutputError &error)
        {
          problem = error.what();
        }
    if (on_any_rank(!problem.empty()))
      throw postprocess::OutputError(!problem.empty() ? problem : stem + ": another rank cannot write its part.");
    return ranks > 1 ? stem + ".pvtu" : pieces.front();
  }

  template void write_whole_solid(fem::Solid<2> &, const fem::Vector &, const fem::Vector &, const SnapshotPlace &);
  template void write_whole_solid(fem::Solid<3> &, const fem::Vector &, const fem::Vector &, const SnapshotPlace &);
  template std::string write_solid(fem::Solid<2> &, const fem::Vector &, const fem::Vector &, const SnapshotPlace &);
  template std::string write_solid(fem::Solid<3> &, const fem::Vector &, const fem::Vector &, const SnapshotPlace &);
} // namespace apps

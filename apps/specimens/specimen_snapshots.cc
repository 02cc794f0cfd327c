#include "apps/specimens/specimen_snapshots.h"

#include "apps/process/mpi_session.h"
#include "apps/results/snapshots.h"
#include "dem/observation/link_images.h"
#include "dem/specimen/read_by_first.h"
#include "postprocess/vtk/break_log.h"
#include "postprocess/vtk/vtk_links.h"
#include "postprocess/vtk/vtk_particles.h"
#include "postprocess/vtk/vtk_walls.h"

namespace apps
{
  void
  SpecimenSnapshots::open(const std::filesystem::path &folder, const std::string &name, const ShownBesides &besides)
  {
    classes = besides.classes;
    particles.emplace(folder, name + "_particles");
    links.emplace(folder, name + "_links");
    if (besides.walls)
      walls.emplace(folder, name + "_walls");
    if (besides.breaks)
      breaks.emplace(folder, name + "_breaks");
  }

  void SpecimenSnapshots::take(const dem::ObservedSpecimen &specimen)
  {
    if (!on_any_rank(wanted()))
      return;
    const dem::ReadByFirst reading(specimen);
    if (!wanted())
      return;
    const dem::ParticleOutput state  = specimen.particles();
    const dem::LinkOutput     joined = specimen.links();
    const double              time   = specimen.time();
    postprocess::write_vtk_particles(particles->next(), state, time);
    particles->add(time);
    std::vector<dem::LinkImage> images;
    if (specimen.parameters().physics.periodic)
      images = dem::link_images(specimen, joined, state);
    postprocess::write_vtk_links(links->next(), joined, state, time, images, classes.of_links(joined));
    links->add(time);
    if (walls)
      {
        postprocess::write_vtk_walls(walls->next(), specimen, time);
        walls->add(time);
      }
    if (breaks)
      {
        postprocess::write_vtk_breaks(breaks->next(), specimen.breaks(), specimen.parameters().thickness, time);
        breaks->add(time);
      }
  }

  void SpecimenSnapshots::visit_state(RunState &state)
  {
    visit_snapshots(state, "particle_snapshots", particles);
    visit_snapshots(state, "link_snapshots", links);
    visit_snapshots(state, "wall_snapshots", walls);
    visit_snapshots(state, "break_snapshots", breaks);
  }
} // namespace apps

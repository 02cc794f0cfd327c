#include "apps/runs/structure/run.h"

#include "apps/figures/drawn_curve.h"
#include "apps/process/mpi_session.h"
#include "apps/process/path_solver.h"
#include "apps/process/progress.h"
#include "apps/results/life_cycle.h"
#include "apps/results/snapshots.h"
#include "apps/results/warning.h"
#include "apps/runs/structure/report.h"
#include "apps/specimens/specimen_packing.h"
#include "apps/specimens/specimen_picture.h"
#include "postprocess/pictures/specimen_picture.h"
#include "postprocess/vtk/vtk_links.h"
#include "postprocess/vtk/vtk_particles.h"

#include <fmt/format.h>

#include <algorithm>

namespace apps
{
  StructureRun::StructureRun(const RunRequest &requested, const StructureModel &what)
    : request(requested)
    , model(what)
  {
  }

  RunResult StructureRun::execute() { return LifeCycle(request, model.checkpoint_interval, *this).execute(); }

  void StructureRun::make_structure()
  {
    const Progress progress("links and solid");
    promotion.emplace(model, packing, media);
  }

  void StructureRun::prepare()
  {
    std::optional<dem::Packing> cell;
    packing = model.packing(&cell);
    media   = model.media(cell);
    make_structure();
  }

  void StructureRun::keep_files(const std::filesystem::path &folder, const bool fresh)
  {
    location = folder;
    if (fresh)
      keep_packing(packing, folder);
    if (fresh && !media.empty())
      media.write(folder / ParticleMedia::file_name);
    if (model.snapshot_interval == 0)
      return;
    particles.emplace(folder, "particles");
    links.emplace(folder, "links");
    if (model.has_solid())
      solids.emplace(folder, "solid", ".vtu");
  }

  void StructureRun::begin(const Record &) { snapshot(); }

  void StructureRun::reopen(const std::filesystem::path &folder)
  {
    packing = kept_packing(folder);
    media   = ParticleMedia::kept_in(folder, model.continuum);
    make_structure();
  }

  void StructureRun::visit_state(RunState &state)
  {
    promotion->visit_state(state);
    structure().visit_path(state);
    visit_snapshots(state, "particle_snapshots", particles);
    visit_snapshots(state, "link_snapshots", links);
    visit_snapshots(state, "solid_snapshots", solids);
  }

  double StructureRun::done() const { return std::min(1.0, structure().load_factor() / model.path.end); }

  std::string StructureRun::details() const
  {
    const dem::QuasiStaticPoint &p = structure().last();
    return fmt::format("point {}, load factor {:.3e}, mean damage {:.3g}, {}", structure().way().points().size() - 1,
                       structure().load_factor(), p.mean_damage, dem::name_of(p.control));
  }

  bool StructureRun::snapshot_due() const
  {
    return particles && static_cast<std::int64_t>(structure().way().points().size() - 1) % model.snapshot_interval == 0;
  }

  void StructureRun::advance(const Record &record)
  {
    structure().advance();
    note(record);
    while (promotion->promote())
      note(record);
    structure().watch();
  }

  void StructureRun::note(const Record &record)
  {
    record(structure().row());
    if (snapshot_due())
      snapshot();
  }

  void StructureRun::snapshot()
  {
    if (!particles)
      return;
    // ParaView's time is the number of the point: the load factor may fall.
    const auto                at    = static_cast<double>(structure().way().points().size() - 1);
    const dem::ParticleOutput state = structure().particle_output();
    const dem::LinkOutput     bonds = structure().link_output();
    postprocess::write_vtk_particles(particles->next(), state, at);
    postprocess::write_vtk_links(links->next(), bonds, state, at, {}, classes().of_links(bonds));
    if (solids)
      {
        structure().surrounding()->write(location, solids->size(), at, structure().way().motion());
        solids->add(at);
      }
    particles->add(at);
    links->add(at);
    list_together();
  }

  void StructureRun::list_together() const
  {
    std::vector<postprocess::PvdPart> parts;
    const base::Column               &times = particles->listed();
    for (std::size_t i = 0; i < times.size(); ++i)
      {
        const auto list = [&](const int part, const char *name, const char *extension) {
          parts.push_back({times[i], part, name, fmt::format("{0}/{0}_{1:06}{2}", name, i, extension)});
        };
        list(0, "particles", ".vtp");
        list(1, "links", ".vtp");
        if (solids)
          list(2, "solid", ".vtu");
      }
    postprocess::write_pvd(location / "structure.pvd", parts);
  }

  LinkClasses StructureRun::classes() const { return LinkClasses(model.mixed().link_classes(packing.material_names)); }

  std::string StructureRun::draw_crack(const std::filesystem::path &file) const
  {
    const dem::ParticleOutput state = structure().particle_output();
    postprocess::PictureSlab  slab;
    slab.magnify   = magnification(state);
    slab.materials = packing.material_names;
    if (model.mix.given())
      slab.classes = classes().of_pairs();
    slab.axis = model.dimension == 2 ? 2 : 1;
    if (const StructureSolid *solid = structure().surrounding())
      slab.bodies = solid->outlines(structure().way().motion(), slab.magnify, slab.axis);
    return postprocess::picture_of_specimen(file, state, structure().link_output(),
                                            fmt::format("{} at point {}, displacements x {}",
                                                        std::filesystem::path(request.scene_file).stem().string(),
                                                        structure().way().points().size() - 1, slab.magnify),
                                            slab);
  }

  RunFindings StructureRun::findings(const postprocess::CsvTable &series, const double wall_seconds)
  {
    const StructureReport found{request, model, structure(), media, series, wall_seconds};
    return {found.summary(), found.text(), nullptr};
  }

  void StructureRun::write_results(const std::filesystem::path &folder, const postprocess::CsvTable &series)
  {
    on_first_rank([&] {
      if (particles && !snapshot_due())
        snapshot();
      warn_of_missing("crack.png", draw_crack(folder / "crack.png"));
      warn_of_missing("grading.png", model.mixed().draw_grading(folder));
      const auto [horizontal, vertical] = structure().curve();
      write_curve(folder, series, horizontal, vertical, std::filesystem::path(request.scene_file).stem().string(),
                  true);
    });
  }

  RunResult run(const StructureModel &model, const RunRequest &request)
  {
    start_mpi();
    refuse_factor_on_ranks(base::EntryPath().at("Path"), model.path.solver);
    return StructureRun(request, model).execute();
  }
} // namespace apps

#include "apps/specimens/specimen_snapshots.h"

#include "apps/process/mpi_session.h"
#include "apps/process/rank_meetings.h"
#include "apps/results/snapshots.h"
#include "dem/observation/link_images.h"
#include "dem/specimen/rank_output.h"
#include "dem/specimen/told_to_first.h"
#include "postprocess/vtk/break_log.h"
#include "postprocess/vtk/vtk_links.h"
#include "postprocess/vtk/vtk_particles.h"
#include "postprocess/vtk/vtk_walls.h"

#include <fmt/ranges.h>

#include <sstream>
#include <utility>

namespace apps
{
  void SpecimenSnapshots::open(const std::filesystem::path &folder,
                               const std::string           &name,
                               const SnapshotPieces         pieces,
                               const ShownBesides          &besides)
  {
    classes   = besides.classes;
    in_pieces = pieces == SnapshotPieces::per_rank;
    particles.emplace(folder, name + "_particles", in_pieces ? ".pvtp" : ".vtp");
    links.emplace(folder, name + "_links", in_pieces ? ".pvtp" : ".vtp");
    if (besides.walls)
      walls.emplace(folder, name + "_walls");
    if (besides.breaks)
      breaks.emplace(folder, name + "_breaks");
  }

  void SpecimenSnapshots::take(const dem::ObservedSpecimen &specimen)
  {
    if (!on_any_rank(wanted()))
      return;
    if (on_any_rank(in_pieces))
      take_pieces(specimen);
    else
      take_whole(specimen);
  }

  namespace
  {
    /** What a file of links shows of particles; the rest gives its memory back. */
    dem::ParticleOutput ends_among(dem::ParticleOutput &&particles)
    {
      dem::ParticleOutput ends;
      ends.position     = std::move(particles.position);
      ends.displacement = std::move(particles.displacement);
      ends.radius       = std::move(particles.radius);
      particles         = {};
      return ends;
    }
  } // namespace

  void SpecimenSnapshots::take_whole(const dem::ObservedSpecimen &specimen)
  {
    const double        time  = specimen.time();
    dem::ParticleOutput state = dem::all_particles_for_first(specimen);
    on_first_rank([&] {
      postprocess::write_vtk_particles(particles->next(), state, time);
      particles->add(time);
    });
    const dem::ParticleOutput   ends = ends_among(std::move(state));
    std::vector<dem::LinkImage> images;
    dem::SeeLinks               find_images;
    if (specimen.parameters().physics.periodic)
      find_images = [&](const dem::LinkOutput &some) {
        const std::vector<dem::LinkImage> more = dem::link_images(specimen, some, ends);
        images.insert(images.end(), more.begin(), more.end());
      };
    const dem::LinkOutput joined = dem::shown_links_for_first(specimen, find_images);
    on_first_rank([&] {
      postprocess::write_vtk_links(links->next(), joined, ends, time, images, classes.of_links(joined));
      links->add(time);
      take_besides(specimen);
    });
  }

  void SpecimenSnapshots::take_besides(const dem::ObservedSpecimen &specimen)
  {
    const double time = specimen.time();
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

  namespace
  {
    using std::filesystem::path;

    path piece_of(const path &record, const std::size_t rank)
    {
      return record.parent_path() / postprocess::piece_name(record.stem().string(), rank, ".vtp");
    }

    /** As a record lists them. */
    std::vector<std::string> names_of_pieces(const path &record)
    {
      std::vector<std::string> names;
      for (std::size_t r = 0; r < static_cast<std::size_t>(rank_count()); ++r)
        names.push_back(piece_of(record, r).filename().string());
      return names;
    }

    /** Of more ranks, which had gone further than the checkpoint that this run goes on from. */
    void remove_others(const path &record)
    {
      std::error_code none;
      for (auto r = static_cast<std::size_t>(rank_count()); std::filesystem::remove(piece_of(record, r), none); ++r)
        continue;
    }

    /** The record of the next snapshot, which the first rank alone knows. */
    path record_of(const std::optional<postprocess::PvdCollection> &collection)
    {
      std::string record = collection ? collection->next().string() : "";
      take_from_first_rank(record);
      return record;
    }
  } // namespace

  void SpecimenSnapshots::take_pieces(const dem::ObservedSpecimen &specimen)
  {
    const path                     of_particles = record_of(particles), of_links = record_of(links);
    const LinkClasses              link_classes = classes_on_each_rank();
    const double                   time         = specimen.time();
    std::optional<dem::RankOutput> shown;
    postprocess::ImagesOfCell      images;
    postprocess::ClassesOfLinks    numbers;
    on_each_rank([&](const std::size_t rank) {
      shown.emplace(specimen, rank, static_cast<std::size_t>(rank_count()));
      if (specimen.parameters().physics.periodic)
        images = dem::link_images(specimen, shown->links, shown->points);
      if (link_classes.given())
        numbers = link_classes.of_links(shown->links);
      postprocess::write_vtk_particles(piece_of(of_particles, rank), *shown, time);
      postprocess::write_vtk_links(piece_of(of_links, rank), *shown, time, images, numbers);
    });
    on_first_rank([&] {
      postprocess::write_vtk_particles_record(of_particles, *shown, names_of_pieces(of_particles));
      particles->add(time);
      postprocess::write_vtk_links_record(of_links, *shown, images, numbers, names_of_pieces(of_links));
      links->add(time);
      remove_others(of_particles);
      remove_others(of_links);
      take_besides(specimen);
    });
  }

  LinkClasses SpecimenSnapshots::classes_on_each_rank() const
  {
    std::string names = fmt::format("{}", fmt::join(classes.of_pairs(), "\n"));
    take_from_first_rank(names);
    std::vector<std::string> of_pairs;
    std::istringstream       lines(names);
    for (std::string name; std::getline(lines, name);)
      of_pairs.push_back(name);
    return LinkClasses(of_pairs);
  }

  void SpecimenSnapshots::visit_state(RunState &state)
  {
    visit_snapshots(state, "particle_snapshots", particles);
    visit_snapshots(state, "link_snapshots", links);
    visit_snapshots(state, "wall_snapshots", walls);
    visit_snapshots(state, "break_snapshots", breaks);
  }
} // namespace apps

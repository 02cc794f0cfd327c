#pragma once

#include "apps/models/output.h"
#include "apps/results/run_state.h"
#include "apps/specimens/link_classes.h"
#include "dem/specimen/observation.h"
#include "postprocess/vtk/pvd.h"

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace apps
{
  /** What snapshots show besides particles and links. */
  struct ShownBesides
  {
    bool        walls = false, breaks = false;
    LinkClasses classes = {}; ///< of links, where there are several
  };

  /** Snapshots of a specimen for ParaView: NAME_particles.pvd, NAME_links.pvd and, where they are requested, NAME_walls.pvd and NAME_breaks.pvd with their files. None until they are opened. */
  class SpecimenSnapshots
  {
  public:
    /** @throws postprocess::OutputError. */
    void open(const std::filesystem::path &folder,
              const std::string           &name,
              SnapshotPieces               pieces,
              const ShownBesides          &besides = {});
    bool wanted() const { return particles.has_value(); }
    /** If wanted, by the rank that has opened them; all ranks call this. @throws postprocess::OutputError. */
    void take(const dem::ObservedSpecimen &specimen);
    /** The lists of what was taken. */
    void visit_state(RunState &state);

  private:
    void take_whole(const dem::ObservedSpecimen &specimen);
    void take_pieces(const dem::ObservedSpecimen &specimen);
    /** Which the rank that has opened them knows. */
    LinkClasses classes_on_each_rank() const;
    /** What all ranks know of surfaces and breaks. */
    void take_besides(const dem::ObservedSpecimen &specimen);

    bool                                      in_pieces = false;
    LinkClasses                               classes;
    std::optional<postprocess::PvdCollection> particles, links, walls, breaks;
  };
} // namespace apps

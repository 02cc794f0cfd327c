#pragma once

#include "apps/runs/structure/model.h"
#include "apps/scene/kinds/read_scene.h"
#include "apps/studies/study_journal.h"

#include <cstddef>
#include <string>
#include <vector>

namespace apps
{
  constexpr double notch_of_beams = 0.3; ///< alpha, its depth over the beam's

  /** A beam of the bench: how large, which particles and aggregates, and what of it is particles. */
  struct BeamCase
  {
    int  size = 1, geometry = 1;
    bool notched       = true;
    bool all_particles = false; ///< no elements around the core
    bool whole =
      false; ///< followed as far as the scene says, for the work of fracture; otherwise until the peak is past

    std::string name() const; ///< "size 2, geometry 1, without notch, all particles"
  };

  /** What became of it. */
  struct BrokenBeam
  {
    BeamCase of;
    double   depth = 0, strength = 0; ///< [m], sigma_N [Pa]
    double   work      = 0;           ///< over the ligament [J/m^2], as far as the beam was followed
    double   left      = 0;           ///< load at the end over the peak
    double   particles = 0, points = 0;
    double   shared  = 0; ///< largest part of an overlap's bonds that is damaged at the end
    double   balance = 0; ///< error of the energies [-]
    double   cost    = 0; ///< processor time [s]

    RunRecord         record() const; ///< as a journal keeps it
    static BrokenBeam read(const BeamCase &of, const RunRecord &record);
  };

  /**
   * The scene of one beam: box, core, notch, supports and path of the scene's smallest, as deep as the case says. Width, particles, aggregates,
   * elements and the notch's width stay. The core without a notch reaches to where the elastic stress of the lower face
   * is 60 % of the largest, if that is further than the scene's (doc/theory/size-effect.md, 6).
   * @param scene, overrides as typed @param one model of the smallest beam @throws base::InputError
   */
  CheckedScene scene_of_beam(const std::string              &scene,
                             const std::vector<std::string> &overrides,
                             const StructureModel           &one,
                             const BeamCase                 &beam);

  /** @param checked as scene_of_beam() gives it @throws base::InputError, base::NumericalError */
  BrokenBeam broken(const CheckedScene &checked, const BeamCase &beam);
} // namespace apps

#pragma once

#include "apps/figures/contact_figures.h"
#include "apps/models/precice.h"
#include "apps/runs/continuum/contact_section.h"
#include "apps/runs/continuum/loads.h"
#include "apps/runs/continuum/materials.h"
#include "apps/runs/continuum/mesh.h"
#include "base/entry_path.h"

namespace apps
{
  /** What kind of solid a continuum scene computes with. */
  struct SolidSection
  {
    enum class Analysis
    {
      statics,
      dynamics
    };

    int          dimension          = 0;
    Analysis     analysis           = Analysis::statics;
    bool         plane_stress       = false;
    double       thickness          = 1;
    std::int64_t degree             = 1;
    bool         large_displacement = false, mean_dilatation = false, remove_rigid_motion = false;
  };

  /** Section "Control": how a static analysis goes on. */
  struct ControlSection
  {
    enum class Follow
    {
      time,
      indirect,
      arc_length
    };
    enum class LinearSolver
    {
      automatic,
      direct,
      iterative
    };

    Follow                follow = Follow::time;
    double                end = 1, first_step = 0, smallest_step = 0, largest_step = 0, growth = 1.5, stop_fraction = 0;
    std::int64_t          most_steps = 10000, easy_iterations = 6;
    std::string           opening_from, opening_to;
    std::array<double, 3> direction{};
    double                tolerance        = 1e-8;
    std::int64_t          iterations       = 25;
    bool                  line_search      = true;
    bool                  relax            = false;
    LinearSolver          linear_solver    = LinearSolver::automatic;
    double                linear_tolerance = 1e-10;

    void check(const base::EntryPath &root, const std::vector<std::string> &points) const;

    double first() const { return first_step > 0 ? first_step : end / 20; }
    double largest() const { return largest_step > 0 ? largest_step : first(); }
    double smallest() const { return smallest_step > 0 ? smallest_step : 1e-6 * first(); }
  };

  /** Section "Motion": how an explicit analysis goes on. */
  struct MotionSection
  {
    double                    end_time = 0, damping = 0, safety = 0.9;
    std::array<Expression, 3> initial_velocity;
    std::vector<std::string>  rigid;              ///< materials of bodies that do not deform
    bool                      ends_itself = true; ///< otherwise the scene says when
  };

  /** Section "Output": what is written, and how often. */
  struct ContinuumOutputSection
  {
    std::int64_t samples = 500, snapshots = 20;
    double       checkpoint_interval = 600; ///< [s] wall clock: at most ten minutes of work can be lost
    std::string  horizontal, vertical;      ///< columns of the series; "": chosen by the program
    bool         fracture_zone = false;     ///< its width is a figure
  };

  /** Everything that a continuum analysis computes from, as a scene says it. Other kinds of scenes may hold one. */
  struct ContinuumModel
  {
    SolidSection           solid;
    MeshSection            mesh;
    MaterialsSection       materials;
    LoadsSection           loads;
    ControlSection         control;
    MotionSection          motion;
    ContactsSection        contacts;
    ReferencesSection      references;
    PreciceSection         precice;
    ContinuumOutputSection output;
    bool                   spread = true; ///< over ranks; otherwise each has all of it

    /** Of a solid beside something that each rank has whole. */
    static ContinuumModel of_each_rank();

    /** Rules between entries. @throws base::InputError. */
    void check(const base::EntryPath &root) const;
    void check_as_part(const base::EntryPath &root) const;
    void check_as_static_part(const base::EntryPath &root) const;

    /** Whether some of its points are cells of particles. */
    bool has_cells() const;
    bool is_static() const { return solid.analysis == SolidSection::Analysis::statics; }

    /** Ranks over which the mesh is spread, if it is. With cells each has all of it, and the cells alone are spread: the same bits for any number. */
    MPI_Comm ranks_of_mesh() const;
  };
} // namespace apps

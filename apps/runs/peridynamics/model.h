#pragma once

#include "apps/models/output.h"
#include "apps/runs/peridynamics/loads.h"
#include "apps/runs/peridynamics/materials.h"
#include "base/entry_path.h"
#include "dem/peridynamics/equilibrium.h"
#include "dem/peridynamics/relaxation.h"

#include <list>
#include <string>
#include <vector>

namespace apps
{
  /** One to three coordinates of a place [m]; what is left out is zero. */
  using Coordinates = std::vector<double>;

  /** Sub-section of "Holes". */
  struct PeridynamicHole
  {
    std::string name;
    Coordinates centre;
    double      radius = 0;
  };

  /** Sub-section of "Cracks". */
  struct PeridynamicCrack
  {
    std::string name;
    Coordinates from, to, depth; ///< depth: empty in the plane
  };

  /** Sub-section of "No-fail zones". */
  struct NoFailZone
  {
    std::string name;
    Region      region;
  };

  /** Section "Analysis": how the body is brought to rest, or moves. */
  struct PeridynamicAnalysisSection
  {
    enum class Method
    {
      relaxation,
      statics,
      motion
    };
    enum class Breakage
    {
      between, ///< equilibria
      steps    ///< in every step of the relaxation
    };

    Method                               method     = Method::statics;
    dem::peridynamics::Kinematics        kinematics = dem::peridynamics::Kinematics::linear;
    dem::peridynamics::Solver            solver     = dem::peridynamics::Solver::direct;
    dem::peridynamics::FictitiousDensity density    = dem::peridynamics::FictitiousDensity::gershgorin;
    Breakage                             breakage   = Breakage::between;
    double       at_once    = 0; ///< part of the largest stretch over its limit from which on bonds break together
    std::int64_t increments = 1, step_limit = 20000, row_interval = 10;
    double       tolerance = 1e-6, end_time = 0, step_factor = 0.8;
    double       repulsion = 0; ///< in bond constants; 0: none

    bool quiet() const { return method != Method::motion; }
  };

  /** Everything that a scene of kind "peridynamics" says. */
  struct PeridynamicsModel
  {
    Coordinates                 size; ///< along as many axes as there are dimensions
    double                      thickness = 0;
    dem::peridynamics::Space    plane     = dem::peridynamics::Space::plane_stress;
    double                      spacing   = 0;
    dem::peridynamics::Layout   layout    = dem::peridynamics::Layout::cell_centred;
    dem::peridynamics::Horizon  horizon;
    PeridynamicMaterialsSection materials;
    std::list<PeridynamicHole>  holes;
    std::list<PeridynamicCrack> cracks;
    std::list<NoFailZone>       safe;
    PeridynamicLoadsSection     loads;
    Expressions                 velocity; ///< at the start
    PeridynamicAnalysisSection  analysis;
    OutputSection               output;

    /** @throws base::InputError */
    void check(const base::EntryPath &root) const;

    int                     dimension() const;
    dem::peridynamics::Body body() const;
    /** With its cracks and zones, before anything happens. @throws base::InputError */
    dem::peridynamics::Bonds bonds() const;

  private:
    void                     check_body(const base::EntryPath &root) const;
    void                     check_places(const base::EntryPath &root) const;
    dem::peridynamics::Space space() const;
  };
} // namespace apps

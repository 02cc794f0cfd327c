#pragma once

#include "apps/drivers/peridynamics/loads.h"
#include "apps/drivers/peridynamics/materials.h"
#include "apps/scene/output_section.h"
#include "dem/peridynamics/equilibrium.h"
#include "dem/peridynamics/relaxation.h"

#include <list>
#include <string>
#include <vector>

namespace apps
{
  /** Places [m] that a scene gives as one to three numbers between commas; what is left out is zero. */
  struct PlaceEntry
  {
    std::string text;

    Eigen::Vector3d value() const;
  };

  /** Sub-section of "Holes". */
  struct PeridynamicHole
  {
    std::string name;
    PlaceEntry  centre;
    double      radius = 0;
  };

  /** Sub-section of "Cracks". */
  struct PeridynamicCrack
  {
    std::string name;
    PlaceEntry  from, to, depth;
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

    void declare(Section &root);
    /** Of a body that moves together with something else. */
    void declare_as_part(Section &root);
    bool quiet() const { return method != Method::motion; }

  private:
    void declare_kinematics(Section &section);
    void declare_steps(Section &section);
  };

  /** Everything that a scene of kind "peridynamics" says. */
  struct PeridynamicsModel
  {
    std::string                 size;
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

    void declare(Section &root);
    /** The sections of a body that moves together with something else: the scene says where that ends, what is written, and how fast it is at the start. */
    void declare_as_part(Section &root);
    /** @throws base::InputError */
    void check(const base::EntryPath &root) const;

    int                     dimension() const;
    dem::peridynamics::Body body() const;
    /** With its cracks and zones, before anything happens. @throws base::InputError */
    dem::peridynamics::Bonds bonds() const;

  private:
    void                     declare_body(Section &root);
    void                     declare_defects(Section &root);
    void                     check_body(const base::EntryPath &root) const;
    void                     check_places(const base::EntryPath &root) const;
    dem::peridynamics::Space space() const;
  };
} // namespace apps

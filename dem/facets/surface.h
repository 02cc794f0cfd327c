#pragma once

#include "base/column.h"
#include "base/state.h"
#include "dem/facets/facet_mesh.h"
#include "dem/facets/footprint.h"
#include "dem/facets/surface_law.h"

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

namespace dem
{
  /**
   * Particles that are glued to a surface from the start, of those that touch it: by links to the facets nearest to them
   * (surface_bonds.h). Until one is torn off it has no other contact with the surface.
   */
  struct SurfaceGlue
  {
    double within = 0;                  ///< gaps between particle and surface up to this are glued [m]; 0: none is
    std::shared_ptr<const LinkLaw> law; ///< nullptr: that of the specimen's bonds
  };

  /** A surface that particles touch, before it is one of a specimen. */
  struct SurfaceParameters
  {
    std::string   name; ///< for messages
    FacetMesh     mesh;
    LinkMaterials contact = LinearContactParameters(); ///< law of contacts with any particle (surface_law.h)
    double skin = 0; ///< thickness in which pressure builds up [m] (pressure.h), linear; 0: contacts act at a point
    std::vector<std::size_t> particles = {}; ///< that touch it, by their number in the packing; empty: all
    SurfaceGlue              glue      = {}; ///< of those that touch it
    bool spread = false; ///< contacts at a point are spread over the facets under the sphere (footprint.h)
  };

  /**
   * Holds a wall at a force: it moves along a direction at the speed
   *
   *     v = min(max(gain (F* - F) / (K dt), -largest), largest)
   *
   * with K the stiffness of its present contacts along the direction, or at the largest speed while it touches nothing. That is a
   * dashpot in series with the contacts, which only takes energy from what it pushes, and lets an error of the force fade by (1 - gain)
   * in each step: stable for a gain up to 1 (doc/theory/facets.md, 4).
   */
  struct ForceServo
  {
    Eigen::Vector3d direction     = {0, 0, 0}; ///< unit
    double          force         = 0;         ///< F*, of the wall on the particles along the direction [N]
    double          largest_speed = 0;         ///< [m/s], > 0
    double          gain          = 0.1;       ///< in (0, 1]
  };

  /** Box around a facet, and its plane. */
  struct FacetBounds
  {
    Eigen::Vector3d low, high;
    Eigen::Vector3d normal,
      low_corner; ///< of the plane (unit; zero: of a segment in space there is none), and a point on it
  };

  /** A surface in motion, and what particles have done to it. */
  struct Surface
  {
    /** What moves it. */
    enum class Driven
    {
      rigidly,  ///< velocity and spin
      by_force, ///< a servo
      by_vertex ///< a coupling, each vertex on its own
    };

    std::string         name;
    FacetMesh           mesh;
    SurfaceLaw          law;
    double              skin = 0;  ///< [m]; 0: contacts act at a point
    std::vector<double> area;      ///< of the facets as they were made, segments their length [m^2, m]; of a skin only
    Footprint           footprint; ///< given where contacts are spread
    std::vector<bool>   meets;     ///< each particle, in the order of Particles; empty: all
    base::Column        cut;       ///< how deep each may reach in without force, likewise [m]; empty: not at all
    Driven              driven   = Driven::rigidly;
    Eigen::Vector3d     velocity = {0, 0, 0}, spin = {0, 0, 0}; ///< of a rigid one [m/s], [rad/s]
    Eigen::Vector3d     centre = {0, 0, 0};                     ///< that it spins about; moves with it [m]
    Eigen::Vector3d     turn   = {0, 0, 0};                     ///< rotation vector of its last step, if rigid
    Eigen::Vector3d     travel = {0, 0, 0};                     ///< of the centre since the start [m]
    ForceServo          servo;

    std::vector<Eigen::Vector3d> place, motion; ///< of vertices: now [m], displacement of the last step [m]
    std::vector<Eigen::Vector3d> rate;    ///< velocities given to the vertices, if they are driven one by one [m/s]
    std::vector<Eigen::Vector3d> force;   ///< of particles on vertices at t_n [N]
    std::vector<Eigen::Vector3d> impulse; ///< of that since it was last cleared [N s]
    std::vector<Eigen::Vector3d> turn_impulse; ///< its moment about the origin, where vertices were each time [N m s]
    std::vector<double>          stiffness;    ///< of contacts at vertices: sum of k_n N_i at t_n [N/m]

    Eigen::Vector3d total_force = {0, 0, 0}, total_moment = {0, 0, 0};  ///< on it, about the origin, at t_n [N], [N m]
    Eigen::Vector3d momentum = {0, 0, 0}, angular_momentum = {0, 0, 0}; ///< that it has taken since the start
    double          work     = 0;     ///< that it has done on the particles by t_n + half a step [J]
    double          made     = 0;     ///< by contacts whose push is no slope of their energy, since the start [J]
    double          along    = 0;     ///< stiffness of its contacts along the servo's direction [N/m]
    std::int64_t    touching = 0;     ///< contacts at t_n
    std::int64_t glued = 0, torn = 0; ///< particles that are glued to it at t_n, and that were torn off since the start

    /** @param particles that touch it, in the order of Particles; empty: all */
    Surface(const SurfaceParameters &parameters, const Physics &physics, std::vector<bool> particles = {});

    bool   meets_particle(const std::int32_t i) const { return meets.empty() || meets[static_cast<std::size_t>(i)]; }
    double cut_of(const std::int32_t i) const { return cut.empty() ? 0.0 : cut[static_cast<std::size_t>(i)]; }
    /** Facets that bound a body push a centre out of it that has sunk in, where contacts act at the nearest point. */
    bool holds_from_within() const { return !mesh.outward.empty() && skin == 0 && !footprint.given(); }
    /** Distance from its centre within which a particle of this radius finds facets [m]. */
    double search_radius(const double radius) const { return footprint.given() ? Footprint::reach * radius : radius; }
    /** Of a facet where it is now; of a plane signed [m]. */
    double      distance(std::size_t facet, const Eigen::Vector3d &x) const;
    FacetBounds bounds(std::size_t facet) const;
    /** Rotation vector of a facet in the last step, to second order [rad]. */
    Eigen::Vector3d turn_of(std::size_t facet) const;
    /** Sums over its contacts are found anew. */
    void clear_totals();
    /** A vertex takes an impulse where it is now [N s]. */
    void take_impulse(std::size_t vertex, const Eigen::Vector3d &taken);
    void clear_impulses();
    /** Let the servo choose the velocity of the step to come. @param step [s] */
    void serve(double step);
    /** Move over a step [s]. @return the largest displacement of a vertex [m] */
    double advance(double step);
    bool   still() const { return driven == Driven::rigidly && velocity.isZero(0) && spin.isZero(0); }

    void visit_state(base::StateVisitor &visitor, const std::string &group);

  private:
    bool moved = false; ///< in the last step: otherwise motion is zero already
  };
} // namespace dem

#pragma once

#include "base/column.h"
#include "base/matrix6.h"
#include "dem/model/physics.h"

#include <Eigen/Core>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <string>
#include <utility>
#include <vector>

namespace dem
{
  struct LinkSet;
  struct Particles;
  class LinkLaw;

  /** Part of a set: blocks of links that obey the same law, and the first of the history's columns that is this law's. */
  struct LinkLines
  {
    std::size_t first_block = 0, end_block = 0;
    std::size_t first_column = 0;
  };

  /**
   * First of the two passes: force records and new history of every link from its two particles. No scatter; blocks of
   * links are independent, so the result does not depend on the number of threads.
   */
  using LinkPass = void (*)(LinkSet &links, const Particles &particles, const LinkLaw &law, const LinkLines &lines);

  /** A quantity that a law remembers or shows: its name in files, its unit ("-" for a pure number), what it is. */
  struct LinkQuantity
  {
    std::string name, unit, meaning;
    bool        shown = false; ///< to observers: in ParaView files
  };

  /** One link as it lies, for everything that treats single links. */
  struct LinkGeometry
  {
    double strain    = 0; ///< (length - reference) / reference
    double length    = 0; ///< distance of the centres [m]
    double reference = 0; ///< L0 [m]
    double area      = 0; ///< A [m^2]
  };

  /** A link before it has a history. */
  struct NewLink
  {
    double distance     = 0;                    ///< of the centres [m]
    double first_radius = 0, second_radius = 0; ///< [m]
    double area           = 0;                  ///< A [m^2]
    double thickness      = 0;                  ///< of discs [m]; 0: spheres
    double effective_mass = 0;     ///< product of both particles' masses over their sum; on a face the particle's [kg]
    bool   on_face        = false; ///< the second end is a face of a surface, and has no radius

    std::int64_t    first_number = 0, second_number = 1; ///< of the particles, which never change
    Eigen::Vector3d direction = {1, 0, 0};               ///< n, from the first end to the second
  };

  /** Undamaged stiffness of a link. */
  struct LinkStiffnesses
  {
    double normal = 0, shear = 0;  ///< moduli [Pa]: force = modulus * area * displacement / reference length
    double bending = 0, twist = 0; ///< moment over relative rotation [N m]
  };

  /** How much is left of a link. */
  enum class LinkPhase
  {
    whole,  ///< as it was made, damaged perhaps
    broken, ///< its bond is gone, it still touches
    apart,  ///< carries nothing while its particles do not touch; a law that waits keeps it until they do
    gone    ///< it carries nothing any more
  };

  /** How a bond, or an element of one, broke. */
  enum class BreakMode : std::int32_t
  {
    tension,
    shear,
    gradual ///< damaged until nothing was left, by a law that does not distinguish the two
  };

  /** An element of a link that is broken; a bond without elements is one itself. */
  struct BrokenElement
  {
    std::int32_t    element = 0; ///< from 0
    BreakMode       mode    = BreakMode::gradual;
    Eigen::Vector3d offset  = {0, 0, 0}; ///< of its middle from the contact point [m]
    double          share   = 1;         ///< of its area, of the link's A [-]
  };

  /** What damage has done to a link; of laws without damage 0 while whole, 1 when broken. */
  struct LinkLoss
  {
    double stiffness = 0; ///< lost part of the stiffness in tension, omega [-]
    double strength  = 0; ///< lost part of the strength in tension [-]
  };

  /** Nearness of a link to the end of elastic behaviour; 1 where it begins, infinite where it has no strength. */
  struct LinkExertion
  {
    double damage  = 0; ///< driving strain (or stress) over that at which the link damages or breaks
    double sliding = 0; ///< shear force over the strength
  };

  /** A small step of one link along a path at small strain, in space; numbers of its history as in LinkLaw::columns(). */
  struct LinkStep
  {
    LinkGeometry    geometry;                      ///< at the end of the step
    double          strain_before     = 0;         ///< normal strain at its start
    Eigen::Vector3d direction         = {1, 0, 0}; ///< n, from the first end to the second
    Eigen::Vector3d shear_increment   = {0, 0,
                                         0}; ///< tangential displacement over the reference length, perpendicular to n
    Eigen::Vector3d bending_increment = {0, 0, 0}; ///< relative rotation across n [rad]
    double          twist_increment   = 0;         ///< relative rotation about n [rad]
    double          per_second        = 0;         ///< one over its length [1/s]; 0: no time passes, nothing is viscous
    bool            carried = false; ///< the history's vectors have been turned, and hold the increments already
  };

  /** What the link answers to such a step: on its first end. */
  struct LinkAnswer
  {
    Eigen::Vector3d force = {0, 0, 0}, moment = {0, 0, 0};  ///< [N], [N m], at the contact point
    double          friction = 0, damage = 0, released = 0; ///< dissipated and set free in the step [J]
    double          viscous = 0;                            ///< dissipated by a dashpot, or overstress, in the step [J]
    bool            slides  = false;
  };

  /** Which linearisation is wanted of a link, and which branch of the law it is on. */
  struct LinkTangent
  {
    bool secant =
      false; ///< symmetric and positive definite, to steer an iteration; otherwise the derivative of the update
    bool damages = false; ///< damage grew in the update, or is about to
    bool slides  = false; ///< the shear force was returned to the strength, or is about to be
  };

  /** What a law is, for all of its links and for good. */
  struct LinkLawTraits
  {
    std::string name;
    std::size_t pairs           = 0;     ///< of materials
    bool        planar          = false; ///< of discs
    bool        has_moment      = false;
    bool        breaks_in_place = false; ///< a broken bond stays in its place as a contact
    bool        bonds           = false; ///< carries tension; otherwise it lives only in contact
    /** Its contacts may be made before the particles touch, and remain when they part: nothing is made or deleted at each touch. */
    bool waits = false;
    /** Its stiffness grows with the overlap, so that the stable step shrinks in the course of a contact. */
    bool stiffens = false;
    /** Its force depends on the rate at which it is strained, without a dashpot: no step is the shorter for it. */
    bool rate_dependent = false;
    /** Of each pair, part of the critical damping that its dashpots have, zeta [-]; empty: there are none. */
    std::vector<double> damping_ratio;
    /** Where pairs of materials obey laws of different kinds, the number of each one's law; empty: all obey the same. */
    std::vector<std::int32_t> kinds;
  };

  /**
   * The law of all links of one kind (bonds, or contacts) in one specimen: its constants for every pair of materials, the pass that
   * updates the links, and answers all queries of single ones. Chosen once per scene; the pass knows it at compile time.
   *
   * A link's history is a row of numbers, in the order of columns(); `pair` is the number of the pair of materials that it joins.
   */
  class LinkLaw
  {
  public:
    virtual ~LinkLaw() = default;

    const char *name() const { return traits.name.c_str(); }
    std::size_t pairs() const { return traits.pairs; }
    bool        several() const { return pairs() > 1; }
    bool        planar() const { return traits.planar; }
    bool        has_moment() const { return traits.has_moment; }
    bool        breaks_in_place() const { return traits.breaks_in_place; }
    bool        bonds() const { return traits.bonds; }
    bool        waits() const { return traits.waits; }
    bool        stiffens() const { return traits.stiffens; }
    bool        viscous() const; ///< its force depends on the speed
    bool        rate_dependent() const { return traits.rate_dependent; }
    double      damping_ratio(const std::size_t pair) const
    {
      return traits.damping_ratio.empty() ? 0.0 : traits.damping_ratio[pair];
    }
    const std::vector<std::int32_t> &kinds() const { return traits.kinds; }

    /** The pass for what the specimen is. @param mixture of its particles */
    virtual LinkPass pass(Mixture mixture) const = 0;

    /** What a link remembers, one entry per column of its history (vectors across the link: one per component). */
    virtual std::vector<LinkQuantity> columns() const = 0;
    /** Length that strains are measured against [m]. */
    virtual double reference_length(std::size_t pair, const NewLink &link) const = 0;
    /** History of a new link. */
    virtual void begin(std::size_t pair, const NewLink &link, double *history) const = 0;

    virtual LinkStiffnesses stiffness(std::size_t pair, const LinkGeometry &link, const double *history) const = 0;
    /** The same as an explicit step sees it: with a dashpot the spring seems stiffer (doc/theory/integration.md, 3). */
    LinkStiffnesses stiffness_of_step(std::size_t pair, const LinkGeometry &link, const double *history) const
    {
      LinkStiffnesses s    = stiffness(pair, link, history);
      const double    zeta = damping_ratio(pair);
      if (zeta > 0)
        {
          const double by = std::sqrt(1 + zeta * zeta) + zeta;
          s.normal *= by * by;
        }
      return s;
    }
    /** The same as it is damaged now (secant); a closed link as a whole one. */
    virtual LinkStiffnesses damaged_stiffness(std::size_t pair, const LinkGeometry &link, const double *history) const
    {
      return stiffness(pair, link, history);
    }
    virtual LinkPhase phase(std::size_t pair, const LinkGeometry &link, const double *history) const = 0;
    /**
     * Elements that are broken, queried in the step in which one of them broke; those that never held are not among them.
     * @param direction n, from the first end to the second
     */
    virtual std::vector<BrokenElement> broken_elements(std::size_t            pair,
                                                       const LinkGeometry    &link,
                                                       const Eigen::Vector3d &direction,
                                                       const double          *history) const = 0;
    /** Energy stored [J]. */
    virtual double stored(std::size_t pair, const LinkGeometry &link, const double *history) const = 0;
    /** Energy dissipated by damage since the start, where the history has a closed form for it; otherwise the pass sums it up [J]. */
    virtual double   damage_dissipation(std::size_t, const LinkGeometry &, const double *) const { return 0.0; }
    virtual LinkLoss damage(std::size_t pair, const LinkGeometry &link, const double *history) const = 0;
    /** Normal strain past which the link damages further; infinite for a law that opening does not damage. */
    virtual double damaging_strain(std::size_t pair, const double *history) const = 0;
    /** @param force on the first end [N] */
    virtual LinkExertion exertion(std::size_t            pair,
                                  const LinkGeometry    &link,
                                  const Eigen::Vector3d &direction,
                                  const Eigen::Vector3d &force,
                                  const double          *history) const = 0;

    /** One link, one step: history in and out. */
    virtual LinkAnswer update(std::size_t pair, const LinkStep &step, const double *before, double *history) const = 0;
    /**
     * Linearisation of the last update, in global axes: d (force over area, moment) / d (strain vector eps_N n + eps_T, relative
     * rotation of the ends) [Pa], [N m].
     */
    virtual base::Matrix6 tangent(
      std::size_t pair, const LinkStep &step, const double *before, const double *history, LinkTangent kind) const = 0;

  protected:
    explicit LinkLaw(LinkLawTraits own)
      : traits(std::move(own))
    {
    }
    LinkLaw(const LinkLaw &)            = default;
    LinkLaw &operator=(const LinkLaw &) = default;

  private:
    LinkLawTraits traits;
  };

  inline bool LinkLaw::viscous() const
  {
    return rate_dependent() || std::any_of(traits.damping_ratio.begin(), traits.damping_ratio.end(),
                                           [](const double zeta) { return zeta > 0; });
  }
} // namespace dem

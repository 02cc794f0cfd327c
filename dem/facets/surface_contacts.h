#pragma once

#include "base/state.h"
#include "dem/facets/beside.h"
#include "dem/facets/contact_zones.h"
#include "dem/facets/near_facets.h"
#include "dem/facets/pressure.h"
#include "dem/facets/shared_surfaces.h"
#include "dem/facets/surface.h"
#include "dem/facets/surface_bonds.h"
#include "dem/model/particles.h"

#include <cstdint>
#include <utility>
#include <vector>

namespace dem
{
  /** One sphere on one surface. */
  struct SurfaceContact
  {
    std::int32_t    particle, surface, facet; ///< in the order of Particles; the deepest facet
    std::int32_t    parts_begin, parts_end;   ///< its share of corners, in SurfaceContacts::parts()
    Eigen::Vector3d place;                    ///< [m]
    Eigen::Vector3d direction;                ///< from the centre to it, unit
    Eigen::Vector3d shear;                    ///< elastic tangential displacement of the surface over the radius [-]
    Eigen::Vector3d force;                    ///< on the particle [N]
    double          distance;                 ///< of the place from the centre [m]
    double          share;                    ///< of a whole contact
    double          overlap;                  ///< [m]
    double          dissipated;               ///< by sliding, in this step [J]
    Eigen::Vector3d push;                     ///< the force without its shear [N]
    double          pressing;                 ///< size of what friction is in proportion to [N]
    double          stiffness;                ///< across the surface [N/m]
    double          spring;                   ///< stored by it [J]
    FacePoint       stands;                   ///< where it is spread over a flat face
    FaceMemory      memory{};                 ///< of a law that is not linear
    double          dashpot = 0; ///< force of a dashpot on the particle, away from the surface positive [N]
    double          viscous = 0; ///< dissipated by it in this step [J]
    double made = 0; ///< in this step, with others of its particle and surface: pushes that are no slope of energy [J]

    /** On the particle, about its centre: pressure points to it [N m]. */
    Eigen::Vector3d moment() const;
    /** Of the link that it is like [m^2]. @param radius of its particle */
    double area(const ParticleShape &shape, const double radius) const
    {
      return share * shape.link_area(radius, radius);
    }
    /** The same as the law of the surface takes it. @param before overlap a step ago [m] */
    FaceContact of_law(const ParticleShape &shape, const double radius, const double before = 0) const
    {
      return {radius, shape.link_area(radius, radius), share, overlap, before};
    }
  };

  /** Of all contacts with surfaces [J]. */
  struct SurfaceEnergies
  {
    double stored   = 0;
    double friction = 0; ///< dissipated since the start
    double damage   = 0; ///< dissipated in glue since the start
    double viscous  = 0; ///< dissipated by dashpots since the start
    double released = 0; ///< still stored in shear where contacts ended, and in torn bonds, since the start
  };

  /**
   * The surfaces of a specimen and all contacts of particles with them: geometry, law, forces on both sides and their energy
   * (doc/theory/facets.md). Same bits for any number of threads.
   *
   * Of several ranks each finds the contacts of its own particles, and has those alone until all are gathered; what contacts add up to on
   * surfaces, all know (doc/theory/ranks.md, 3). Whatever has a parameter `with_others` is called by all of them.
   */
  class SurfaceContacts
  {
  public:
    bool empty() const { return all.empty(); }

    /**
     * @param meets which particles touch it, in the order of Particles; empty: all
     * @throws base::InputError for a surface that is none
     */
    std::size_t add(const SurfaceParameters &parameters, const Physics &physics, std::vector<bool> meets = {});
    /**
     * Glue particles that it meets to a surface, to which they have no other contact until they are torn off.
     * @return which @throws base::InputError where no particle is near, one lies in it, or it is an unbounded plane
     */
    std::vector<std::int32_t>   glue(std::size_t                    surface,
                                     double                         within,
                                     std::shared_ptr<const LinkLaw> law,
                                     const Particles               &particles,
                                     const ParticleShape           &shape,
                                     bool                           rotations);
    const std::vector<Surface> &surfaces() const { return all; }
    /** To drive it: from the next step on. */
    Surface &surface(const std::size_t number) { return all.at(number); }

    /**
     * Forces of all contacts where everything is now, unless they are known already: what find_forces() of a step finds, that step
     * integrates.
     * @param per_second one over the length of the step that led here [1/s]; 0: no time has passed
     * @return particles that have a contact that they did not have before, or a stiffer one; of all ranks
     */
    const std::vector<std::int32_t> &find_forces(const Particles      &particles,
                                                 const ParticleShape  &shape,
                                                 double                per_second  = 0,
                                                 const SharedSurfaces &with_others = {});
    /** Whether contacts of other ranks' particles are not here. */
    bool lacks_contacts() const { return lacking; }
    /** Have those of all ranks until forces are found anew, and what acts on all particles. */
    void gather(const SharedSurfaces &with_others);
    /** How many are of some particles, from the first to behind the last. */
    std::int64_t count_of(std::int32_t first, std::int32_t last) const;
    bool         viscous() const; ///< the law of some surface is
    /** @throws base::InputError for a particle behind a surface or in it by more than half its radius */
    void check_start(const Particles &particles);
    /** Cuts off what reaches through a surface: particles touch it without force (doc/theory/laboratory.md, 1). @throws base::InputError */
    void cut_off_at(std::size_t surface, const Particles &particles, const ParticleShape &shape);
    bool touching() const { return count() > 0 || holding(); }
    /** Contacts, of all ranks. */
    std::size_t count() const;
    /** Particles beside those that have a facet near, which bound their contacts where these are spread; in no order. */
    std::vector<std::int32_t> standing_beside() const;
    /** Call use(surface, particle, force, moment) for all that acts on particles now, in order. @pre no contacts are lacking */
    template <typename Use>
    void each_push(const Use &use) const
    {
      for (const SurfaceContact &contact : contacts)
        use(contact.surface, contact.particle, contact.force, contact.moment());
      for (const SurfaceBonds &glue : glues)
        for (std::size_t b = 0; b < glue.count(); ++b)
          if (glue.is_alive(b))
            use(glue.surface(), glue.particle_of(b), glue.force(b), glue.couple_on_particle(b));
    }

    /** Records of force (3) [N] | moment (3) [N m] | 0 0 on each particle here; empty as long as none has been touched. */
    const base::Column &on_particles() const { return records; }

    /** Let servos choose their speed, and move all surfaces over a step [s]. @return the largest displacement of a vertex [m] */
    double advance(double step);
    /** Note how far anything has moved [m]. */
    void moved(const double largest_particle, const double largest_vertex)
    {
      near.moved(largest_particle, largest_vertex);
    }
    /** Impulses and angular impulses of the forces over both halves of the steps that meet [s]. */
    void collect_impulses(double kick, const SharedSurfaces &with_others = {});
    /** Particles or vertices have been put elsewhere. */
    void forget_places() { near.forget(), found = false; }
    /** No vertex has moved since forces were last found. */
    void rest();
    /** Particles have moved on without their surfaces. @param largest_particle displacement [m] */
    void particles_moved(const double largest_particle) { moved(largest_particle, 0), found = false; }

    /** Enter the work of surfaces on particles over the half step that led here in their accounts. @return its sum [J] */
    double add_work_of_last_motion(const SharedSurfaces &with_others = {});
    /**
     * Vertices of a surface are elsewhere at the end of the last step than they went in it: that was a part of their motion, and
     * works as such. @return the work of that half of it over which the forces that are known pushed [J]
     */
    double put_on(std::size_t number, const std::vector<Eigen::Vector3d> &by, const SharedSurfaces &with_others = {});
    /** In contacts [J]. @pre none are lacking, as for energies() */
    double          stored(const ParticleShape &shape, const Particles &particles) const;
    SurfaceEnergies energies(const ParticleShape &shape, const Particles &particles) const;

    /** Sum of kappa_c over contacts, for the stable step of each particle here [N/m]; empty: none touches. */
    std::vector<double> stiffness_seen(const Particles &particles, const ParticleShape &shape, bool rotations) const;
    /** The same of one particle. */
    double
    stiffness_seen(const Particles &particles, const ParticleShape &shape, bool rotations, std::int32_t particle) const;

    /** Contacts that are here, by particle, surface and depth. */
    const std::vector<SurfaceContact> &list() const { return contacts; }
    const std::vector<VertexPart>     &parts() const { return vertex_parts; }
    const std::vector<SurfaceBonds>   &bonds() const { return glues; }
    const NearFacets                  &near_facets() const { return near; }

    void visit_state(base::StateVisitor &visitor);

  private:
    void visit_memories(base::StateVisitor &visitor, const std::vector<SurfaceContact> &of);
    struct Room;
    struct Block;
    /** A particle that has gone into a surface further than forces can tell. */
    struct Sunk
    {
      std::int32_t particle = -1, surface = 0; ///< -1: none
    };
    using Known = std::vector<SurfaceContact>::const_iterator;

    /** Call use(surface, vertex, weight) for every vertex that has part in a contact. */
    template <typename Use>
    void for_parts(const SurfaceContact &contact, const Use &use);

    double friction() const;
    /** What the dashpot of a contact that has ended took in the step in which it did [J]. */
    double last_of_dashpot(const SurfaceContact &gone, const Particles &particles) const;
    double damage() const;
    double released() const;
    bool   holding() const;
    bool   spread() const;    ///< contacts of some surface are
    bool   remembers() const; ///< the law of some surface is not linear
    void   clear_forces();
    void   find_bonds(const Particles &particles);
    /** Contacts of a particle with a surface that it was glued to, or is from now on. */
    void let_meet(std::size_t surface, std::int32_t particle, bool meets, std::size_t particles);
    void find_contacts(const Particles &particles, const ParticleShape &shape, const SharedSurfaces &with_others);
    void touch(const Particles &particles, const ParticleShape &shape, std::size_t listed, Block &block) const;
    /** All contacts of the blocks, in order. */
    std::vector<SurfaceContact> gathered(const std::vector<Block> &blocks);
    /** Those known of some particles, from the first to behind the last. */
    std::pair<Known, Known> known_of(std::int32_t first, std::int32_t last) const;
    /** Take contacts of a step, with what they add up to. @throws base::NumericalError for a particle that has sunk in, on all ranks alike */
    void take(std::vector<SurfaceContact> &&now,
              const Sunk                   &sunk,
              const Particles              &particles,
              const ParticleShape          &shape,
              const SharedSurfaces         &with_others);
    /** Add to sums over contacts in their order: all of them, or where others' are lacking each rank its own, one after the other. */
    template <typename Add>
    void add_in_turn(const std::vector<RunningSum> &sums, const SharedSurfaces &with_others, const Add &add) const
    {
      if (lacking)
        with_others.in_turn(sums, adding, add);
      else
        add();
    }
    /** What contacts add up to when they are found. */
    std::vector<RunningSum> sums_of_contacts();
    /** The fresh contacts of a particle with a surface, with what those before become. */
    void go_on(const Particles &particles, const ParticleShape &shape, Block &block) const;
    /** A contact of the block with what it was before: slip, shear, forces on its vertices. */
    void follow(const Particles         &particles,
                const ParticleShape     &shape,
                const SurfaceContact    *before,
                SurfaceContact          &now,
                std::vector<VertexPart> &parts_of_now) const;
    /**
     * What the law answers to a step of it, the shear turned and with the step's increment.
     * @param opening of its place away from the sphere in the step [m] @param lost of shear so far [J] @return force on the particle besides the pressure at rest [N]
     */
    Eigen::Vector3d answer(const Particles      &particles,
                           const ParticleShape  &shape,
                           const SurfaceContact *before,
                           const Vec<double, 3> &added,
                           double                opening,
                           double                lost,
                           SurfaceContact       &now) const;
    /**
     * What contacts of one particle and surface, the last of the block, have made in this step with those before them, because their pushes
     * are not the slope of what they store [J]: nothing is pushed, stored or taken twice, but in dents weights change, and caps part.
     */
    double made_by_last(std::size_t count, const Particles &particles, const Block &block) const;
    /** Particles that stand on a surface beside the one that a thread works on. */
    void gather_beside(const Particles &particles, std::size_t listed, const Surface &surface, Block &block) const;
    void add_zones(const Surface         &surface,
                   const ParticleShape   &shape,
                   double                 radius,
                   const Eigen::Vector3d &centre,
                   Block                 &block) const;
    void add_patch(const Surface         &surface,
                   const ParticleShape   &shape,
                   double                 radius,
                   const Eigen::Vector3d &centre,
                   Block                 &block) const;
    /** Take contacts in place of some that were known. */
    void   settle(std::vector<SurfaceContact> &&now,
                  Known                         old,
                  Known                         old_end,
                  const Particles              &particles,
                  const ParticleShape          &shape);
    void   hand_out(const Particles &particles, const ParticleShape &shape);
    double stored(const SurfaceContact &contact, const ParticleShape &shape, const Particles &particles) const;
    double
    kappa(const SurfaceContact &contact, const Particles &particles, const ParticleShape &shape, bool rotations) const;

    std::vector<Surface>        all;
    NearFacets                  near;
    Beside                      beside; ///< where contacts are spread
    std::vector<SurfaceContact> contacts;
    std::vector<VertexPart>     vertex_parts;
    std::vector<SurfaceBonds>   glues;
    base::Column                records;
    std::vector<std::int32_t>   born;
    bool                        found   = false; ///< forces are those of where everything is
    bool                        lacking = false; ///< others have contacts that are not here
    std::vector<std::size_t>    adding;          ///< ranks that have some, while they are lacking
    double                      slid = 0, let_go = 0, damped = 0;
    double                      rate = 0; ///< one over the length of the step that led here [1/s]
  };

  template <typename Use>
  void SurfaceContacts::for_parts(const SurfaceContact &contact, const Use &use)
  {
    Surface &surface = all[static_cast<std::size_t>(contact.surface)];
    for (std::int32_t k = contact.parts_begin; k < contact.parts_end; ++k)
      {
        const VertexPart &part = vertex_parts[static_cast<std::size_t>(k)];
        use(surface, static_cast<std::size_t>(part.vertex), part);
      }
  }
} // namespace dem

#pragma once

#include "base/state.h"
#include "dem/contacts/contact_search.h"
#include "dem/genesis/vessel.h"
#include "dem/kernels/particle_pass.h"
#include "dem/laws/linear_contact.h"
#include "dem/model/links.h"
#include "dem/model/particles.h"

#include <cstdint>
#include <memory>
#include <utility>
#include <vector>

namespace dem
{
  class Ranks;
  class SharedWork;

  /** What particles are made of while they grow. */
  struct GrowthMaterial
  {
    LinearContactParameters contact;         ///< between particles; walls have its modulus and no friction
    double                  damping   = 0.7; ///< local (Cundall) damping, in [0, 1)
    double                  thickness = 1;   ///< of discs [m]
  };

  /** State of a growing assembly at one moment. */
  struct GrowthMeasures
  {
    double ratio =
      1; ///< mean |sum of forces| over mean sum of |contact forces| of the particles; 1 without any contact
    double       stress           = 0;    ///< mean stress, compression negative [Pa]
    double       stress_by_growth = 0;    ///< d(-stress)/d(factor of all radii), of what is in contact [Pa]
    double       largest_overlap  = 0;    ///< over the smaller radius
    std::int64_t touching         = 0;    ///< contacts that push, of particles and of these with walls
    double       stored = 0, kinetic = 0; ///< [J]
  };

  /** Energies since the start [J]. growth = stored + kinetic + damped + friction + stopped, but for the error of the steps. */
  struct GrowthEnergies
  {
    double growth = 0, stored = 0, kinetic = 0, damped = 0, friction = 0, stopped = 0;

    double error() const { return growth - stored - kinetic - damped - friction - stopped; }
  };

  /** Sums over contacts of particles and walls. */
  struct ContactSums
  {
    double stored = 0, virial = 0, stiffening = 0, largest_overlap = 0; ///< [J], [J], [J], over the smaller radius
    double touching = 0;                                                ///< how many

    void add(double stiffness, double overlap, double arms, double smaller_radius);
    void join(const ContactSums &other);
  };

  /** Sums over particles. */
  struct MotionSums
  {
    double unbalanced = 0, pushing = 0; ///< |sum of forces| and sum of |contact forces| [N]
    double kinetic = 0, damped = 0;     ///< of velocities before and after t_n; of the half step before it [J]

    void join(const MotionSums &other);
  };

  /**
   * Particles that grow in a vessel with frictionless walls, pushing at each other by linear contacts with friction, advanced by the two
   * passes that a Specimen is advanced by, with local damping (doc/theory/genesis.md, 2).
   *
   * Their masses are not those of the material: the result is at rest, and does not depend on them. All particles have the mass for which
   * the stable step is 1, in the plane the same for all; a time is a number of steps. Results are the same to the last bit for
   * any number of threads, and of ranks that share the work.
   */
  class GrowingAssembly
  {
  public:
    /** @param start particles inside the vessel, at rest */
    GrowingAssembly(const Packing &start, const Vessel &vessel, const GrowthMaterial &material);
    ~GrowingAssembly();

    /**
     * From now on these ranks share the work (doc/theory/ranks.md, 3). All have made the same assembly, and call all members but steps(), size(),
     * radius() and walls() in the same order; after measure() and gather() each may read alone, until the next step.
     * @param move_every as of SharedWork
     */
    void share_among(std::shared_ptr<Ranks> ranks, std::int64_t move_every = 0);
    /** Let all ranks have all of it. */
    void gather();

    void           advance(std::int64_t steps);
    GrowthMeasures measure();  ///< where particles are now; moves nothing
    GrowthEnergies energies(); ///< likewise
    std::int64_t   steps() const { return step_count; }
    std::size_t    size() const { return particles.count; }

    /** Take away all velocities; their energy is entered as stopped. */
    void stop();
    /**
     * Give particles other radii [m], at rest; what that does to stored energy is entered as growth.
     * @param radius by packing number @param centre likewise, other places [m]; empty: they stay where they are
     */
    void set_radii(const std::vector<double> &radius, const std::vector<Eigen::Vector3d> &centre = {});
    /** Multiply all radii by a factor next to 1, in motion; likewise. */
    void scale_radii(double factor);
    /** Another coefficient of friction between particles from now on, >= 0. */
    void set_friction(double coefficient);

    /** Contacts that push, of each particle with others and with walls, by packing number. */
    std::vector<int> contact_numbers();
    /** Sum over these of each particle's overlaps [m], by packing number. */
    std::vector<double> overlap_sums();
    Packing             packing(); ///< where particles are now, in the order of the start
    double radius(std::size_t number) const { return particles.radius_of(static_cast<std::size_t>(slot[number])); }
    const Vessel &walls() const { return vessel; }

    /** Everything needed to go on to the same bits; a reader must have been made of the same start, and on ranks have taken no step. */
    void visit_state(base::StateVisitor &visitor);

  private:
    void   share_out();      ///< what is not shared out among ranks yet
    void   share_out_anew(); ///< and all of it where contacts have made shares uneven, or in tests
    void   gather_places();
    void   find_forces();
    void   push_from_walls();
    void   look_for_contacts();
    void   take_friction(double coefficient);
    void   fit_to_radii();
    void   fit_contacts(); ///< reference lengths and areas, the shear displacements as they are
    void   fit_contact(std::size_t link);
    void   set_masses();
    void   take_radii_of_poses(); ///< where they are kept apart, after they changed
    void   look_for_walls();
    double wall_stiffness(double radius) const;
    /** Net force of links and walls on a particle (3) [N] | couple (3) [N m], and the sum of their sizes [N]. */
    double net_force(std::size_t particle, double *force) const;
    /** Whether what some contacts remember and do is known to other ranks only, and likewise of the motion of particles. */
    bool lacks_contacts() const;
    bool lacks_motion() const;
    /** Lines of contacts, and particles, of which it is known here, begin and end. */
    std::pair<std::size_t, std::size_t> known_contacts() const;
    std::pair<std::size_t, std::size_t> known_particles() const;
    bool                                moves(std::int32_t particle) const; ///< this rank does
    ParticleBlocks                      own_blocks() const;
    /** Of contacts begin .. end - 1, at most a block. */
    ContactSums sum_links(std::size_t begin, std::size_t end) const;
    /** Add those with walls of particles begin .. end - 1. */
    void       add_walls(ContactSums &all, std::size_t begin, std::size_t end) const;
    MotionSums sum_particles(std::size_t begin, std::size_t end) const;
    /** Of all contacts where particles are now. @pre forces are known */
    ContactSums sum_contacts();
    /** Of all particles likewise. */
    MotionSums sum_motion();

    Vessel                            vessel;
    GrowthMaterial                    material;
    ParticleShape                     shape;
    Particles                         particles;
    LinearContactConstants            constants;
    std::shared_ptr<const LinkLaw>    law;
    LinkPass                          pass;
    LinkSet                           none, contacts;
    ContactSearch                     search;
    std::vector<std::int32_t>         slot;      ///< of each packing number in the particles' order
    std::vector<std::int32_t>         near_wall; ///< particles that may touch one
    double                            wall_margin = 0, wall_path = 0; ///< [m]; they move on for so far
    std::vector<ParticleBlockAccount> accounts;
    bool                              forces_known = false;     ///< at the present places
    std::int64_t                      step_count = 0, fits = 0; ///< how often radii were set
    double                            growth = 0, damped = 0, stopped = 0;
    std::unique_ptr<SharedWork>       shared; ///< among ranks; none: alone
  };
} // namespace dem

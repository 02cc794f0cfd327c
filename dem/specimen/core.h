#pragma once

#include "dem/contacts/contact_search.h"
#include "dem/emission/emission.h"
#include "dem/facets/glide_pushes.h"
#include "dem/facets/surface_contacts.h"
#include "dem/integrators/stable_step.h"
#include "dem/kernels/particle_pass.h"
#include "dem/measures/link_measures.h"
#include "dem/model/initial_equilibrium.h"
#include "dem/model/materials.h"
#include "dem/network/rigid_motions.h"
#include "dem/ranks/exact_sum.h"
#include "dem/specimen/approach_watch.h"
#include "dem/specimen/clumps.h"
#include "dem/specimen/crack_record.h"
#include "dem/specimen/energy_book.h"
#include "dem/specimen/held_particles.h"
#include "dem/specimen/parameters.h"
#include "dem/specimen/results.h"
#include "dem/specimen/shared_work.h"
#include "dem/specimen/velocity_kicks.h"

#include <array>
#include <functional>
#include <memory>
#include <optional>
#include <utility>
#include <vector>

namespace dem
{
  struct StepCorrection;

  /** The partner that corrects a step, and the particles that it corrects. */
  struct StepPartner
  {
    const std::vector<std::size_t>              *particles = nullptr; ///< by packing number; nullptr: there is none
    const std::function<void(StepCorrection &)> *correct   = nullptr;
  };

  /** Particles on their way through a step of theirs in which surfaces take several. */
  struct Gliding
  {
    bool         under_way = false;
    base::Column pose, motion, velocity; ///< of the particles when they began
    double       glided = 0;             ///< since then [s]
    double       seen   = 0;             ///< of this, when forces were last found [s]
    GlidePushes  pushes;
    double       work_now = 0, work_after = 0; ///< of surfaces, until and since the beginning [J]
  };

  /** What a specimen holds, and how it takes a step; specimen.h says what it is for. */
  struct SpecimenCore
  {
    SpecimenParameters             parameters;
    ParticleShape                  shape;
    Particles                      particles;
    bool                           equal_radii;
    double                         smallest_radius; ///< [m]
    LinkSet                        bonds, contacts;
    std::shared_ptr<const LinkLaw> bond_law, contact_law;
    std::vector<bool>              unbonded; ///< pairs of materials that are not linked; empty: all are
    double          start_margin;            ///< gap that the interaction ratio leaves between unlinked particles [m]
    ContactSearch   search;
    LinkPass        bond_pass, contact_pass;
    SurfaceContacts surfaces;
    double          space_per_solid = 1; ///< volume with voids over that of the particles, to share out stress
    std::size_t     made_links      = 0;

    std::vector<ParticleBlockAccount> accounts; ///< of blocks of particles; where there are clumps, theirs is the last
    Clumps                            clumps;
    HeldParticles                     held;
    std::vector<std::int32_t>         slot; ///< of each packing number in the particles' order

    std::int64_t    step_count = 0;
    double          time = 0, time_step = 0;
    double          last_step    = 0; ///< the last one [s]
    double          longest_step = 0; ///< that the present stiffness allows, with the factor [s]
    Gliding         gliding;
    base::Column    unseen; ///< after a glide: motion of particles since the last update of surfaces; otherwise empty
    SurfaceEnergies before_glide; ///< at t_n, where surfaces have been updated since
    VelocityKicks   kicks;
    base::Column    before_step, corrected; ///< velocities of particles that a partner may correct, during a step
    EnergyBook      book;
    double          largest_turn  = 0; ///< of a particle in one of the steps that were checked [rad]
    Eigen::Matrix3d stress_moment = Eigen::Matrix3d::Zero(); ///< sum l (x) f at t_n [N m]; only if periodic
    CrackRecord     cracks;
    Emission        emission;
    OverlapWatch    overlaps;
    StiffeningWatch stiffening;

    std::optional<SharedWork> shared; ///< with other ranks; none: this process does all

    /** Corrections that are refused once there was a step, and in a periodic cell. @param what names them @throws base::InputError */
    void refuse_late(const char *what) const;
    /** Where work of sudden changes of velocity is entered; before the first step nowhere: it is initial energy. */
    EnergyFlow *work_of_changes() { return step_count == 0 ? nullptr : &book.work; }
    /** Before all of it is read from outside: what other ranks have computed. Until the next step each rank reads without the others then. */
    void gather();
    /** All of particles. */
    void gather_particles();
    /**
     * Go through all lines of bonds or contacts in their order, each rank through its own: numbers that they add up have the bits that they have
     * on one rank, and all ranks have them then. @param part called with some lines, once or more often
     */
    void
    walk(const LinkSet &links, double *numbers, std::size_t count, const std::function<void(const LinkRange &)> &part);
    /** The same where the order does not matter. */
    void walk_without_order(const LinkSet &links, ExactSum &sum, const std::function<void(const LinkRange &)> &part);
    /** The same for the particles. @param part called with the first and behind the last */
    void walk_particles(double *numbers, std::size_t count, const std::function<void(std::size_t, std::size_t)> &part);
    /** Whether this is the first of several ranks, or the only one. */
    bool is_first() const { return !shared || shared->is_first(); }
    /** The first rank takes, in the order of all lines of bonds or contacts, what each rank says of its own. */
    void tell_first(const LinkSet &links, const SharedWork::Tell &tell, const SharedWork::Take &take);
    /** The same of particles. */
    void tell_first_of_particles(const SharedWork::Tell &tell, const SharedWork::Take &take);
    /** Before it is read where particles began. */
    void gather_constants();
    /** What blocks of links have summed up. */
    void gather_accounts();
    /** Whether this process has the state of all links of a set, or of both: then it reads without the others. */
    bool           has_all(const LinkSet &links) const;
    bool           has_all_links() const { return has_all(bonds) && has_all(contacts) && !surfaces.lacks_contacts(); }
    DeepestOverlap deepest_overlap();
    /** Before contacts, lists or overlaps are sought: where all particles are. */
    void gather_places();
    void gather_glide();
    /** Before one is read, by its number in the particles' order. */
    void gather_particle(std::int32_t particle);
    /** In the particles' order, ascending. */
    std::vector<std::int32_t> corrected_by(const StepPartner &partner) const;
    /** Of what each rank has found among its own particles. */
    double largest_of_all(double own) const;
    /** How this process takes part in what particles and surfaces do to each other. */
    SharedSurfaces surfaces_with_others() { return shares() ? shared->surfaces() : SharedSurfaces(); }
    /** Before contacts with surfaces are read: those of all ranks. */
    void gather_wall_contacts();
    /** Particles of others, too, that surfaces read in every step, ascending. */
    std::vector<std::int32_t> read_by_surfaces() const;
    /** Keep the step, with its factor, below the stable ones of some particles. */
    void shorten_step_for(const std::vector<std::int32_t> &some);
    /** Everything needed to go on to the same bits. */
    void visit_state(base::StateVisitor &visitor);

    /** @param found_by ranks that search for neighbours together meanwhile; null: this process alone */
    SpecimenCore(const Packing &packing, const SpecimenParameters &p, const LinkMaterials &materials, Ranks *found_by);
    Mixture mixture() const
    {
      return bond_law->several() ? Mixture::materials : equal_radii ? Mixture::equal : Mixture::radii;
    }
    void link(const SharedSearch &with_others);
    /** Take pairs with a loose particle out; they may be nearer than the ratio leaves others, and the search must know. */
    void leave_loose(std::vector<NeighbourPair> &pairs);
    /** Take pairs of materials out that are not to be linked. */
    void leave_unbonded(std::vector<NeighbourPair> &pairs);
    bool moments() const { return bonds.has_moment || contacts.has_moment; }
    /** Contacts that carry something: those that wait do not count. */
    std::size_t              touching_contacts();
    std::vector<LawfulLinks> all_links() const { return {{bonds, *bond_law}, {contacts, *contact_law}}; }
    /** Stable step (5.1) of the present state, of particles and clumps [s]. */
    double stable();
    /** The same of one particle, or of the clump that it is a pebble of. */
    double stable(std::int32_t particle) const;
    double stable_of_clump(std::size_t clump) const;
    /** Take out what bonds particles with each other. @param among whether each particle is one of them */
    void remove_bonds(const std::vector<bool> &among);
    void remove_contacts_within_bodies();
    /** Stable step (5.1) of particles that have no links yet: for as many contacts as equal spheres can have at once [s]. */
    double step_of_lone_particles() const;
    /** Of particles that no bonds join, as if they touched all around with the stiffness that the time step allows for [J]. */
    double energy_of_strained_packing(double strain) const;
    /** Of a pebble the part that it stands for of its clump's [kg]. */
    double mass_of(const std::size_t i) const
    {
      return particles.clump_of(i) < 0 ? particles.mass[i] : clumps.mass_of_pebble(particles, i);
    }
    /** Particles' kinetic energy with the velocities as they are [J]. */
    double       kinetic_of_velocities() const;
    Surroundings surroundings() const { return surroundings(surfaces.touching()); }
    Surroundings surroundings(const bool touched) const
    {
      return parameters.physics.periodic  ? Surroundings::periodic :
             touched                      ? Surroundings::touched :
             !particles.pushed.empty()    ? Surroundings::pushed :
             parameters.gravity.isZero(0) ? Surroundings::free :
                                            Surroundings::weight;
    }
    /** Set the energy account to where the first step starts from. */
    void begin();
    /** Find the forces of contacts that exist before the first step. @return energy of theirs that the account starts from [J] */
    double begin_contacts();
    /** Work of the weight on the way from the packing to where the particles were at t_n [J]. */
    double             weight_work();
    InitialEquilibrium find_equilibrium(const EquilibriumWatch &watch);
    /** Forces of links and weight where the particles are. */
    void find_forces();
    /** Move particles (by packing number) as a step would: the links follow with the next forces. */
    void displace(const ParticleMotions &motion);
    void start_from_equilibrium(InitialEquilibrium &found);
    /** One leap-frog step: links, contacts, break tests, particles, accounts, new contacts. @param partner that corrects it; by default none */
    void step(const StepPartner &partner = {});
    /** Its parts: forces of links; motion by them and by forces of surfaces; what follows once all has moved. */
    void       find_link_forces();
    StepHalves next_halves() const { return {0.5 * (step_count == 0 ? time_step : last_step), 0.5 * time_step}; }
    void       move_particles(const StepHalves   &halves,
                              const base::Column &of_surfaces,
                              bool                touched,
                              const StepPartner  &partner = {});
    /** Enter velocities of the particles that the partner may correct, six of each. */
    void enter_velocities(const StepPartner &partner, base::Column &rates) const;
    /** Let the partner correct what the particles have just done. @return its work at t_n's half step, and at the half after [J] */
    std::array<double, 2> let_correct(const StepHalves &halves, const StepPartner &partner);
    /** Of one particle: six velocities before t_n and corrected. @param work is added to */
    void take_corrected(std::size_t            particle,
                        const StepHalves      &halves,
                        const double          *before,
                        const double          *now,
                        std::array<double, 2> &work);
    void move_clumps(const StepHalves &halves);
    /** Let the faces of grips that turn follow the forces at t_n; their particles have moved on as before. */
    void turn_grips(const StepHalves &halves);
    void end_step();
    /** The particles let surfaces take several steps in one of theirs: see Specimen::glide(). */
    void   begin_glide();
    void   glide(double step, double kick);
    void   finish_glide();
    double place_gliding(double since);
    void   keep_unseen();
    void   visit_glide(base::StateVisitor &visitor);
    /** At t_n, as all others. */
    SurfaceEnergies surface_energies() const
    {
      return unseen.empty() ? surfaces.energies(shape, particles) : before_glide;
    }
    /** Stress moment of all links and contacts as the link passes have left it. */
    void sum_stress();
    /** Sum up what blocks, kicks, grips and cell say of the step, in their order. */
    void account(const StepHalves &halves);
    /** Handle the links that broke in this step, or are gone: enter broken bonds in the crack log, take out those that are gone. */
    void settle_events(LinkSet &links, const LinkLaw &law);
    void delete_link(LinkSet &links, const LinkReader &link, std::size_t number);
    /** Make contacts of pairs that have begun to overlap (or, where they wait, may soon), where motion can have made one. */
    void make_contacts() { make_contacts(search_with_others()); }
    void make_contacts(const SharedSearch &with_others);
    /** How this process takes part in searches for neighbours. */
    SharedSearch search_with_others();
    /** Contacts whose stiffness grows: find the stable step again before it might become shorter. */
    void watch_stiffening();
    /** Take out contacts that wait for particles far away by now. */
    void drop_distant_contacts();
    /** Not below the largest displacement of a particle in the step [m]. */
    double largest_displacement() const;
    /** Forces of surfaces at t_n, unless they are known; new contacts may shorten the step. */
    void find_surface_forces();
    /** The same for a partner that needs them now; before the first step, places are checked first. @throws base::InputError */
    void find_forces_of_surfaces();
    /** Enter in the log what of glue broke when these were found. */
    void log_torn_glue();
    /** Glue particles to a surface. @throws base::InputError where no particle is near, or the law has no bonds */
    void glue(std::size_t surface, const SurfaceGlue &glue);
    /** Take where particles are before the first step. @return energy of surfaces that the account starts from [J] @throws base::InputError */
    double begin_surfaces();
    /** Move the surfaces, and take up what they have done in the halves of this step. */
    void advance_surfaces(const StepHalves &halves);
    /** A particle that passes its radius in a step may pass others, or a surface, unseen. @throws base::NumericalError naming it */
    void refuse_too_fast(double largest_of_particles, double largest_of_surfaces);
    /** NaN and infinity spread to velocities within a step. */
    void check_numbers() const;
    /** Particles that this process moves: the first, and behind the last. */
    std::pair<std::size_t, std::size_t> own_particles() const;
    /** Whether other ranks do a part of the work already; all do all before the first step. */
    bool shares() const { return shared && shared->planned(); }
    /** Particles that every rank moves, or of which all prescribe how they move. */
    std::vector<std::int32_t> moved_by_all() const;
    /** Share out with other ranks what is to be, before links are updated. */
    void share_out();
    /** Blocks of particles that this process moves. */
    ParticleBlocks own_blocks() const { return shares() ? shared->bricks() : ParticleBlocks{0, accounts.size()}; }
    /** Laws take rotations of a step for small ones: note the largest. */
    void watch_turns();
  };
} // namespace dem

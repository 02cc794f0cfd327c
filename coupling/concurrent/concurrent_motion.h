#pragma once

#include "coupling/concurrent/sub_cycling_loss.h"
#include "coupling/concurrent/window_steps.h"
#include "coupling/contact/rigid_bodies.h"
#include "coupling/contact/solid_contacts.h"
#include "coupling/participants/particle_participant.h"
#include "coupling/surface/surface_coupling.h"
#include "coupling/volume/volume_coupling.h"

#include <cstdint>
#include <functional>
#include <memory>
#include <vector>

namespace coupling
{
  /**
   * Particles and a solid that move together, a step of the solid after another (doc/theory/surface-coupling.md, 2): adapters carry the
   * solid's motion to the particles, and their forces back.
   *
   * Synchronous by default: both sides feel the force of where both are at t_n, and move with it; momentum is kept and the power of both
   * sides is equal to rounding. Sub-cycled, the side whose stable step is the shorter one takes several steps in one of the other, which moves
   * on through them as it came, and then feels their mean force. Momentum is kept, energy to first order in the longer step:
   * SubCyclingLoss says how long a window may be.
   */
  template <int dim>
  class ConcurrentMotion
  {
  public:
    /**
     * All but the materials must outlive it. @param drive sets external actions of the particles' next step: motion, walls, forces;
     * called before each @param rigid materials of bodies that do not deform @throws as RigidBodies
     */
    ConcurrentMotion(dem::Specimen                  &specimen,
                     const fem::Solid<dim>          &solid,
                     fem::ExplicitSolver<dim>       &motion,
                     SolidParticipant<dim>          &participant,
                     std::function<void()>           drive = {},
                     const std::vector<std::string> &rigid = {});

    /** Before the first window. @throws as SurfaceCoupling */
    const SurfaceCoupling<dim>                               &add_surface(const SurfaceCouplingParameters &parameters);
    const std::vector<std::unique_ptr<SurfaceCoupling<dim>>> &surfaces() const { return couplings; }

    /** Before the first window, after every grip. @throws as VolumeCoupling, base::InputError where two share nodes or particles */
    const VolumeCoupling<dim>                               &add_volume(const VolumeCouplingParameters &parameters);
    const std::vector<std::unique_ptr<VolumeCoupling<dim>>> &volumes() const { return handshakes; }

    /** Between bodies of the solid; added to before the first window. */
    SolidContacts<dim>       &contacts() { return body_contacts; }
    const SolidContacts<dim> &contacts() const { return body_contacts; }

    /** What pushes the solid from outside in its next step, with SolidParticipant::add_force(); called before each. */
    void set_drive_of_solid(std::function<void()> push) { drive_solid = std::move(push); }

    /** Steps of either side in one of the other, at most. 1: both take the same. */
    void set_largest_ratio(int ratio) { largest_ratio = ratio; }
    /** What such windows may lose, as a part of the largest energy: they are as long as that allows. 1: whatever is lost. */
    void                  set_sub_cycling_loss(double part) { sub_cycling.set_part(part); }
    const SubCyclingLoss &sub_cycling_loss() const { return sub_cycling; }
    /**
     * Windows of several steps that have lost more than half of what may still be lost are taken back, and again with shorter ones: what is
     * lost stays below the part, whatever comes into contact in a window. Costs a copy of both sides' states in each such window.
     * @param drive_state what `drive` remembers besides the specimen; empty: nothing
     */
    void check_windows(std::function<void(base::StateVisitor &)> drive_state = {});
    /** How many have been taken back so far. */
    std::int64_t taken_back() const { return windows_taken_back; }

    /**
     * Longest step of the solid now, contacts included [s]: 2 s / sqrt(omega^2 + max_i sum_c k_c N_i / m_i), omega its own largest
     * frequency, s its safety; the second term bounds the eigenvalues of the contacts by their row sums, and is the largest so far:
     * steps do not change with every contact that comes and goes. Contacts of bodies count in the same way.
     */
    double solid_step() const;
    double particle_step() const { return specimen.longest_step(); }
    /** The window that would be taken now, of those that end together after the rest [s]. */
    WindowSteps next_window(double rest) const { return next_window(rest, largest_ratio); }

    /** One window, no longer than the rest [s]. @return what was taken. @throws what either side throws */
    WindowSteps advance(double rest);

    /** What is neither the specimen's nor the solid's. A reader must have the same surfaces. */
    void visit_state(base::StateVisitor &visitor);

  private:
    /** Whether the forces of surfaces have reached the particles for less time than their own step lasted. */
    bool        after_glide() const { return last_solid_step < last_particle_step; }
    WindowSteps next_window(double rest, int ratio) const;
    /** Both sides and all that is between them, to be taken back to. */
    void save();
    void restore();
    /** Forces of surfaces where everything is now, and how stiff they have become. */
    void        update_couplings();
    WindowSteps take(const WindowSteps &steps);
    /** By all couplings so far, but for those that lose by themselves whatever the ratio [J]. */
    double spurious() const;
    /** p of SubCyclingLoss where particles glide: half the sum of force squared over mass, of what touches surfaces [W/s]. */
    double power_of_gliding() const;
    void   sub_cycle_particles(const WindowSteps &steps);
    /** @return what was taken, less where new contacts require shorter steps */
    WindowSteps sub_cycle_solid(WindowSteps steps);
    void        move_together(const WindowSteps &steps);
    /** @param share of the forces of t_n */
    void move_solid(double step, double share);
    /** Its parts: what pushes in the step, handshakes apart; and the step itself. */
    void push_solid(double step, double share);
    void step_solid(double step);
    void move_particles(const WindowSteps &steps);
    /** The same where particles and solid fill the same space: both at once where the window is a single step. */
    void handshake(const WindowSteps &steps);

    dem::Specimen                                     &specimen;
    const fem::Solid<dim>                             &solid;
    fem::ExplicitSolver<dim>                          &motion;
    SolidParticipant<dim>                             &participant;
    ParticleParticipant                                particles;
    std::function<void()>                              drive, drive_solid;
    std::vector<std::unique_ptr<SurfaceCoupling<dim>>> couplings;
    std::vector<std::unique_ptr<VolumeCoupling<dim>>>  handshakes;
    std::vector<std::size_t>                           corrected; ///< particles of the handshakes, one after the other
    SolidContacts<dim>                                 body_contacts;
    RigidBodies<dim>                                   rigid_bodies;
    int                                                largest_ratio = 1;
    SubCyclingLoss                                     sub_cycling;
    double                                             stiffest  = 0; ///< sum of added eigenvalues so far [1/s^2]
    double                                    last_particle_step = 0, last_solid_step = 0; ///< [s]; 0: none yet
    bool                                      checked            = false;                  ///< see check_windows()
    std::int64_t                              windows_taken_back = 0;
    std::function<void(base::StateVisitor &)> drive_state;
    base::Column                              between; ///< couplings and drive, as saved
  };
} // namespace coupling

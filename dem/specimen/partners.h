#pragma once

#include "base/column.h"

#include <Eigen/Core>

#include <cstddef>
#include <functional>
#include <vector>

namespace dem
{
  struct SpecimenCore;

  /**
   * Particles in a step that is not over: by themselves they have moved on, and a partner may still correct that, as if impulses had acted on
   * them at t_n. Six numbers of each: along x, y, z and about them.
   */
  struct StepCorrection
  {
    double                          half_before = 0, half_after = 0; ///< of the steps that meet at t_n [s]
    const std::vector<std::size_t> &particles;                       ///< by their number in the packing
    /** Six numbers of one of these, by its place among them: of links, contacts, weight and push at t_n [N, N m]. */
    std::function<const double *(std::size_t)> force;
    const base::Column                        &before; ///< velocities half a step before t_n [m/s, rad/s]
    base::Column
      &velocity; ///< half a step after: what is changed here is corrected, and moves the particle with it [m/s, rad/s]
  };

  /**
   * The door for another model that fills the same space as a specimen, or touches it: a solid of finite elements, an absorber, a user's
   * own loads. Valid as long as the specimen.
   */
  class Partners
  {
  public:
    explicit Partners(SpecimenCore &specimen)
      : core(&specimen)
    {
    }

    /**
     * Before the first step: leave a part of everything to a partner that fills the same space; several calls multiply. Bonds keep, of
     * their area, the weight of their contact point.
     * @param of_bonds weight of a place [m], in (0, 1] @param of_masses weight of each particle's mass, by packing number, likewise
     * @throws base::InputError for another weight, once there was a step, and in a periodic cell
     */
    void share(const std::function<double(const Eigen::Vector3d &)> &of_bonds, const std::vector<double> &of_masses);
    /**
     * Before the first step: leave particles to a partner that moves them and has their mass. Bonds between two of them go, unless they
     * are to stay, and with these contacts. They rest until a correction of a step moves them. @throws base::InputError once there was a
     * step, and in a periodic cell
     */
    void leave(const std::vector<std::size_t> &particles, bool keep_bonds_between);
    /**
     * Take a step that a partner corrects before it is over: contacts, walls and the energy account know only the corrected one.
     * The work of a correction is external work. A correction moves particles that were left to a partner; corrections of degrees of
     * freedom prescribed by another grip are ignored.
     * @param particles that may be corrected, by packing number @throws base::InputError in a periodic cell
     */
    void advance(const std::vector<std::size_t> &particles, const std::function<void(StepCorrection &)> &correct);

    /**
     * Push a particle from outside [N, N m], in every step until clear_forces(). Several add up; their work is external work. Not part of
     * the state that visit_state() shows. @throws base::InputError in a periodic cell
     */
    void add_force(std::size_t particle, const Eigen::Vector3d &force, const Eigen::Vector3d &couple);
    void clear_forces();
    /**
     * Change a particle's velocity at once, where it is not prescribed [m/s, rad/s]. The energy that this gives or takes is external work;
     * before the first step it is initial energy.
     */
    void apply_impulse(std::size_t particle, const Eigen::Vector3d &change, const Eigen::Vector3d &spin);

    /** Put a surface's vertices to where their owner has them [m], to the last bit: no motion, only the difference by rounding. */
    void place_vertices(std::size_t surface, const std::vector<Eigen::Vector3d> &place);
    void clear_vertex_impulses(std::size_t surface); ///< Surface::impulse is zero again
    /**
     * Find the forces of all surfaces at the present positions; the step to come takes these. For an owner of vertices that needs them
     * to move its vertices on: at t_n both sides then feel the same force, and move with it.
     */
    void find_surface_forces();
    /**
     * Let surfaces take several steps in one of the particles (doc/theory/surface-coupling.md, 2): these glide on with the velocities that
     * they have while surfaces move, and the impulses of contacts on the way are summed up; the particles' own step, as long as all of that,
     * then takes their mean. Between begin_glide() and finish_glide() comes, once or more, find_surface_forces() and glide().
     * @param step [s] @param kick time that forces push for in it [s]
     */
    void begin_glide();
    void glide(double step, double kick);
    void finish_glide();

  private:
    SpecimenCore *core;
  };
} // namespace dem

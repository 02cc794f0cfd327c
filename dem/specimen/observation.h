#pragma once

#include "base/mandel.h"
#include "dem/emission/emission_event.h"
#include "dem/model/break_log.h"
#include "dem/model/energy.h"
#include "dem/ranks/ranks.h"
#include "dem/specimen/grips.h"
#include "dem/specimen/parameters.h"
#include "dem/specimen/results.h"
#include "dem/specimen/rigid_clumps.h"
#include "dem/specimen/surfaces.h"

#include <Eigen/Core>

#include <cstddef>
#include <cstdint>
#include <memory>
#include <vector>

namespace dem
{
  struct ElasticNetwork;

  /**
   * What can be read of a specimen. Code that only reads a specimen takes one of these, and depends on nothing that builds or moves it.
   * Unless said otherwise, forces and energies are those at t_n of the last step.
   */
  class ObservedSpecimen
  {
  public:
    const SpecimenParameters &parameters() const;

    std::int64_t steps() const;     ///< taken since the start
    double       time() const;      ///< [s]
    double       time_step() const; ///< [s], in use
    double
    longest_step() const; ///< that may be set: the step factor times the stable step of the stiffest state so far [s]
    double stable_step() const;   ///< per-particle bound (5.1) of the present state [s]
    double critical_step() const; ///< sharp: 2/sqrt(largest eigenvalue) by Lanczos, of the undamaged elastic system [s]

    Counts                counts() const;
    std::vector<RankWork> shares() const; ///< of the work, of each rank (Specimen::share_among()); empty: there is one
    std::size_t           bytes() const;  ///< memory held by particles, links and contacts

    ParticleState      particle(std::size_t number) const; ///< by packing number
    double             mass(std::size_t particle) const;   ///< likewise; of a pebble its part of its clump's [kg]
    ParticleKinematics kinematics() const;
    ParticleOutput     particles() const; ///< reads all links, where kinematics() reads none
    LinkOutput         links() const;
    Eigen::Vector3d displacement(std::size_t particle) const; ///< of a particle, by packing number, since the start [m]
    double          stiffness_around(std::size_t particle) const; ///< of its links and contacts, as (5.1) has it [N/m]
    ElasticNetwork  network() const; ///< the bonds as they lie now, undamaged; particles by packing number

    GripReadings    grips() const;
    SurfaceReadings surfaces() const;
    ClumpReadings   clumps() const;
    CellState       cell() const; ///< @throws base::InputError without a periodic cell

    EnergyAccount energy() const;
    double        kinetic_energy() const; ///< cheap: does not visit links [J]
    double        external_work() const;  ///< likewise: of grips, walls and pushes since the start [J]

    /** Of links, contacts and surfaces on a group, from all that is not of it [N]. @param group packing numbers, ascending */
    Eigen::Vector3d force_on(const std::vector<std::size_t> &group) const;
    /** Broken links that have an end in a group. @param group packing numbers, ascending */
    std::size_t broken_links_of(const std::vector<std::size_t> &group) const;
    double      mean_damage() const;   ///< of the links made at the start, broken ones count as 1 [-]
    std::size_t logged_breaks() const; ///< bonds and elements of them that broke so far
    /** Those from a place in the log on; their ends are packing numbers. */
    std::vector<Break> breaks(std::size_t from = 0) const;
    /** Events of acoustic emission so far; none where nothing is listened to (SpecimenParameters::emission_reach). */
    const std::vector<EmissionEvent> &emission() const;

    /**
     * Stiffness of the cell if every particle followed its strain without turning, of the links as damaged as they are (secant; closed
     * links whole) [Pa]: engineering shears, order 11 22 33 23 31 12. An upper bound of the true one (doc/theory/homogenisation.md, 2).
     */
    base::Matrix6 affine_stiffness() const;
    /**
     * Mean size of the force on a particle over the mean sum of sizes of all single forces on it (weight too): ratio_mean of codes.
     * Prescribed particles do not count; 1 where nothing acts on any.
     */
    double force_ratio() const;
    /** Mean |force on a particle| over mean |link or contact force|; how far from equilibrium. Prescribed particles do not count. */
    double unbalanced_ratio() const;

  protected:
    explicit ObservedSpecimen(std::unique_ptr<SpecimenCore> core);
    ~ObservedSpecimen();
    ObservedSpecimen(ObservedSpecimen &&) noexcept;
    ObservedSpecimen &operator=(ObservedSpecimen &&) noexcept;
    ObservedSpecimen(const ObservedSpecimen &other);
    ObservedSpecimen &operator=(const ObservedSpecimen &other);

    std::unique_ptr<SpecimenCore> self;
  };
} // namespace dem

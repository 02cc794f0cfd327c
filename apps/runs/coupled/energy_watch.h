#pragma once

#include "apps/results/run_state.h"
#include "apps/runs/continuum/contacts.h"
#include "apps/runs/coupled/model.h"
#include "coupling/concurrent/concurrent_motion.h"

#include <string>
#include <vector>

namespace apps
{
  /** Energies of both sides, as they are written into a row. */
  struct CoupledEnergies
  {
    double              time = 0; ///< [s]
    fem::ExplicitEnergy solid;
    dem::EnergyAccount  particles;
    double              dissipated = 0; ///< in the solid's points: what stresses have worked and is not stored [J]
  };

  /**
   * Ends a run whose couplings make energy, or lose more than they may (entries Energy limit). An account can be in balance and book a gain
   * all the same, as less dissipation or as something that is stored twice: whatever is booked has to be possible, and all together may not grow.
   */
  template <int dim>
  class EnergyWatch
  {
  public:
    /** All must outlive it. */
    EnergyWatch(const CoupledModel                    &model,
                const coupling::ConcurrentMotion<dim> &both,
                const ObservedContacts<dim>           &touching);

    /** Whenever a row is written. @throws StoppedShort */
    void update(const CoupledEnergies &now);
    /** What couplings and sub-cycling have lost, where it is felt: a sentence each. */
    std::vector<std::string> doubts() const;

    void visit_state(RunState &state);

  private:
    void check_surfaces(double time) const;
    void check_handshakes(const CoupledEnergies &now);
    void check_balance(const CoupledEnergies &now) const;
    /** @param of as a section of the scene @throws StoppedShort where that is more than it may, made or lost */
    void require(const std::string &of, double made, double limit, double time, const std::string &remedy) const;
    /** What makes less: loss by sub-cycling is in proportion to the longer of both steps. */
    std::string remedy(double made, double limit) const;
    double      smallest_limit() const;

    const CoupledModel                    &model;
    const coupling::ConcurrentMotion<dim> &both;
    const ObservedContacts<dim>           &touching;
    double                                 largest = 0;   ///< energy so far [J]
    std::vector<double>                    most_absorbed; ///< by each handshake [J]
  };
} // namespace apps
